//! The tables of a sweep: every sample, and every row.

use super::Run;
use super::report::{Report, Row};
use crate::failure::Failure;
use crate::per_jumper::PerJumper;
use crate::store::Store;
use saltus_results::Value;

pub(super) fn write(folder: &mut dyn Store, run: &Run, report: &Report) -> Result<(), Failure> {
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
            "label",
            "periodic with its period, quasi-periodic, chaotic or undecided",
        ),
        (
            "confidence",
            "of the test behind the label; empty for a cycle known by its returns",
        ),
        (
            "exponent",
            "mean growth of a small deviation, with its standard error (1/forcing period)",
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
        "label",
        "period",
        "confidence",
        "status",
        "status_text",
    ];
    // without a question the one that a label took
    let exponents = run.table.exponents.max(1) as usize;
    let columns = (1..=exponents).flat_map(|k| [format!("exponent_{k}"), format!("error_{k}")]);
    let header: Vec<String> = header
        .map(str::to_owned)
        .into_iter()
        .chain(columns)
        .collect();
    let lines = |row| jumpers(row, exponents);
    folder.table(
        "rows.csv",
        &settings,
        &header,
        report.rows.iter().flat_map(lines),
    )
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

/// One line per jumper, with so many exponents.
fn jumpers<'a>(row: &'a Row<'a>, exponents: usize) -> impl Iterator<Item = Vec<Value>> + 'a {
    let ratios: &PerJumper<f64> = &row.contact_ratio;
    ratios
        .as_slice()
        .iter()
        .enumerate()
        .map(move |(jumper, &ratio)| {
            let known = [
                Value::Integer(row.pass as i64),
                row.direction.into(),
                row.start[0].into(),
                row.start[1].into(),
                row.value.into(),
                Value::Integer(jumper as i64),
                finite(ratio),
                row.label.into(),
                row.period.into(),
                row.confidence.into(),
                row.status.into(),
                row.status_text.as_str().into(),
            ];
            let rates = (0..exponents).flat_map(|k| match row.exponents.get(k) {
                Some(rate) => [finite(rate.per_period), finite(rate.standard_error)],
                None => [Value::Empty, Value::Empty],
            });
            known.into_iter().chain(rates).collect()
        })
}

fn finite(value: f64) -> Value {
    Some(value).filter(|value| value.is_finite()).into()
}
