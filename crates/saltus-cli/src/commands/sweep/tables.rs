//! The tables of a sweep: every sample, and every row.

use super::Run;
use super::report::{Report, Row};
use crate::exit::Failure;
use crate::folder::Folder;
use crate::per_jumper::PerJumper;
use saltus_results::Value;

pub(super) fn write(folder: &mut Folder, run: &Run, report: &Report) -> Result<(), Failure> {
    let value = run.parameter.label();
    let settings = [
        ("saltus", env!("CARGO_PKG_VERSION")),
        ("study", "study.toml"),
        ("value", value.as_str()),
        (
            "z",
            "height over eta = g/omega_h^2, at cos(Omega t) = 1 (-)",
        ),
        ("v", "velocity over eta omega_h, at cos(Omega t) = 1 (-)"),
        ("pass", "as in rows.csv"),
    ];
    let header = ["pass", "value", "jumper", "sample", "z", "v"].map(str::to_owned);
    let rows = report.rows.iter().flat_map(samples);
    folder.table("sweep.csv", &settings, &header, rows)?;

    let settings = [
        ("saltus", env!("CARGO_PKG_VERSION")),
        ("study", "study.toml"),
        ("value", value.as_str()),
        (
            "start",
            "first state of the pass, z/eta and z'/(eta omega_h) (-)",
        ),
        (
            "contact_ratio",
            "part of the recorded time on the floor (-)",
        ),
        (
            "recurrence",
            "forcing periods after which the samples repeat to 1e-6",
        ),
    ];
    let header = [
        "pass",
        "direction",
        "start_z",
        "start_v",
        "value",
        "jumper",
        "contact_ratio",
        "recurrence",
        "status",
        "status_text",
    ];
    let rows = report.rows.iter().flat_map(jumpers);
    folder.table("rows.csv", &settings, &header.map(str::to_owned), rows)
}

/// One line per jumper and sample.
fn samples<'a>(row: &'a Row<'a>) -> impl Iterator<Item = Vec<Value>> + 'a {
    let of_jumper = move |(jumper, (z, v)): (usize, (&'a &'a [f64], &'a &'a [f64]))| {
        z.iter().zip(*v).enumerate().map(move |(sample, (&z, &v))| {
            vec![
                Value::Integer(row.pass as i64),
                row.value.into(),
                Value::Integer(jumper as i64),
                Value::Integer(sample as i64 + 1),
                z.into(),
                v.into(),
            ]
        })
    };
    let pairs = row.z.as_slice().iter().zip(row.v.as_slice());
    pairs.enumerate().flat_map(of_jumper)
}

/// One line per jumper.
fn jumpers<'a>(row: &'a Row<'a>) -> impl Iterator<Item = Vec<Value>> + 'a {
    let ratios: &PerJumper<f64> = &row.contact_ratio;
    ratios
        .as_slice()
        .iter()
        .enumerate()
        .map(|(jumper, &ratio)| {
            vec![
                Value::Integer(row.pass as i64),
                row.direction.into(),
                row.start[0].into(),
                row.start[1].into(),
                row.value.into(),
                Value::Integer(jumper as i64),
                Some(ratio).filter(|ratio| ratio.is_finite()).into(),
                row.recurrence.into(),
                row.status.into(),
                row.status_text.as_str().into(),
            ]
        })
}
