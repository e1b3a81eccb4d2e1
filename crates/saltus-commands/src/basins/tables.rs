//! The table of attractors.

use super::report::{AttractorReport, Report};
use crate::failure::Failure;
use crate::store::Store;
use saltus_config::Study;
use saltus_results::Value;

/// One line per attractor, jumper and sample; a motion that is not periodic has one without a sample.
pub(super) fn write(folder: &mut dyn Store, study: &Study, report: &Report) -> Result<(), Failure> {
    let settings = [
        ("saltus", env!("CARGO_PKG_VERSION")),
        ("study", "study.toml"),
        ("attractor", "number, by its share of the pixels"),
        ("period", "forcing periods; empty if not periodic"),
        (
            "kind",
            "periodic, quasi-periodic, chaotic, not-periodic or undecided",
        ),
        ("contact_ratio", "part of the time on the floor (-)"),
        ("peak_reaction", "largest reaction (body weights)"),
        (
            "peak_acceleration",
            "of the floor under the first jumper (m/s2)",
        ),
        (
            "z",
            "height over eta = g/omega_h^2, at cos(Omega t) = 1 (-)",
        ),
        ("v", "velocity over eta omega_h, at cos(Omega t) = 1 (-)"),
    ];
    let header = [
        "attractor",
        "period",
        "kind",
        "pixels",
        "share",
        "jumper",
        "contact_ratio",
        "peak_reaction",
        "peak_acceleration",
        "sample",
        "z",
        "v",
    ];
    let jumpers = study.jumper.len();
    let rows = report
        .attractors
        .iter()
        .flat_map(|attractor| (0..jumpers).flat_map(move |jumper| lines(attractor, jumper)));
    folder.table(
        "attractors.csv",
        &settings,
        &header.map(str::to_owned),
        rows,
    )
}

fn lines(attractor: &AttractorReport, jumper: usize) -> Vec<Vec<Value>> {
    let of = |list: &[f64]| list.get(jumper).copied();
    let head = vec![
        Value::Integer(attractor.number as i64),
        attractor.period.into(),
        attractor.kind.into(),
        Value::Integer(attractor.pixels as i64),
        attractor.share.into(),
        Value::Integer(jumper as i64),
        of(attractor.contact_ratio.as_slice()).into(),
        of(attractor.peak_reaction.as_slice()).into(),
        attractor.peak_acceleration.into(),
    ];
    let (z, v) = (
        attractor.z.as_slice().get(jumper),
        attractor.v.as_slice().get(jumper),
    );
    let samples = z.into_iter().flatten().zip(v.into_iter().flatten());
    let mut lines: Vec<Vec<Value>> = samples
        .enumerate()
        .map(|(sample, (&z, &v))| {
            let tail = [Value::Integer(sample as i64 + 1), z.into(), v.into()];
            [head.clone(), tail.to_vec()].concat()
        })
        .collect();
    if lines.is_empty() {
        let none = || Value::from(None::<f64>);
        lines.push([head, vec![none(), none(), none()]].concat());
    }
    lines
}
