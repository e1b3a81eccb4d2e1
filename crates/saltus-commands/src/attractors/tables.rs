//! The tables of attractors: what each is at each value, its section, and loops of hysteresis.

use super::Run;
use super::report::{Attractor, Report, Row};
use crate::failure::Failure;
use crate::store::Store;
use saltus_config::Parameter;
use saltus_results::Value;

pub(super) fn write(folder: &mut dyn Store, run: &Run, report: &Report) -> Result<(), Failure> {
    let value = run
        .parameter
        .as_ref()
        .map_or_else(|| "of no parameter: empty".to_owned(), Parameter::label);
    let shared = [
        ("saltus", env!("CARGO_PKG_VERSION")),
        ("study", "study.toml"),
        ("value", value.as_str()),
        ("attractor", "number that stays along the parameter, from 1"),
    ];
    let attractors = [
        ("rows", "one per value, attractor and jumper"),
        ("period", "forcing periods; empty if not periodic"),
        ("kind", "periodic, quasi-periodic, chaotic or not-periodic"),
        (
            "multiplier",
            "largest modulus of the Floquet multipliers of a cycle (-)",
        ),
        (
            "exponent, exponent_error",
            "largest Lyapunov exponent per forcing period where there is no cycle, and its standard error",
        ),
        (
            "lifetime_low",
            "chaos: none of the watched motions left it, so that its mean lifetime is above this (forcing periods) with \
             95 % confidence",
        ),
        ("starts", "first states that lead to it, and their share"),
        ("share_low, share_high", "95 % confidence interval (-)"),
        ("contact_ratio", "part of the time on the floor (-)"),
        ("peak_reaction", "largest reaction (body weights)"),
        (
            "peak_acceleration",
            "of the floor under the first jumper (m/s2)",
        ),
    ];
    let sections = [
        ("rows", "one per value, attractor, jumper and sample"),
        (
            "sample",
            "from 1; those of a cycle connect along the parameter",
        ),
        (
            "z",
            "height over eta = g/omega_h^2, at cos(Omega t) = 1 (-)",
        ),
        ("v", "velocity over eta omega_h, at cos(Omega t) = 1 (-)"),
    ];
    let transients = [
        ("rows", "one per value and chaos that ends"),
        (
            "starts",
            "first states that were in it when their search was over; counted for attractor",
        ),
        (
            "attractor",
            "number of the one that most watched motions ended on",
        ),
        (
            "motions, ended, periods",
            "motions watched, how many left it, and forcing periods of chaos of all together",
        ),
        (
            "lifetime, lifetime_low, lifetime_high",
            "mean, and 95 % confidence interval (forcing periods)",
        ),
    ];
    let loops = [
        ("rows", "one per loop of hysteresis"),
        (
            "up, down",
            "attractors of a motion carried upwards and downwards",
        ),
        (
            "period",
            "forcing periods where it jumps; empty if not periodic",
        ),
        (
            "jump",
            "values between which it jumps; empty if it does not",
        ),
    ];
    let jumpers = 0..run.study.jumper.len();
    let lines = |line: fn(&Row, &Attractor, usize) -> Vec<Vec<Value>>| {
        let jumpers = jumpers.clone();
        let row = move |row: &'_ Row| -> Vec<Vec<Value>> {
            let all = row.attractors.iter();
            all.flat_map(|one| {
                jumpers
                    .clone()
                    .flat_map(move |jumper| line(row, one, jumper))
            })
            .collect()
        };
        report.rows.iter().flat_map(row)
    };
    let header = |names: &[&str]| {
        names
            .iter()
            .map(|&name| name.to_owned())
            .collect::<Vec<_>>()
    };
    folder.table(
        "attractors.csv",
        &[&shared[..], &attractors].concat(),
        &header(&ATTRACTORS),
        lines(attractor),
    )?;
    folder.table(
        "sections.csv",
        &[&shared[..], &sections].concat(),
        &header(&SECTIONS),
        lines(samples),
    )?;
    folder.table(
        "transients.csv",
        &[&shared[..3], &transients].concat(),
        &header(&TRANSIENTS),
        transient_rows(report),
    )?;
    folder.table(
        "loops.csv",
        &[&shared[..3], &loops].concat(),
        &header(&LOOPS),
        loop_rows(report),
    )
}

const ATTRACTORS: [&str; 16] = [
    "value",
    "attractor",
    "jumper",
    "period",
    "kind",
    "multiplier",
    "exponent",
    "exponent_error",
    "lifetime_low",
    "starts",
    "share",
    "share_low",
    "share_high",
    "contact_ratio",
    "peak_reaction",
    "peak_acceleration",
];

fn attractor(row: &Row, one: &Attractor, jumper: usize) -> Vec<Vec<Value>> {
    let of = |list: &[f64]| list.get(jumper).copied();
    let [share, low, high] = one.drawn.share;
    vec![vec![
        row.value.into(),
        Value::Integer(one.number as i64),
        Value::Integer(jumper as i64),
        one.period.into(),
        one.evidence.kind.name().into(),
        one.evidence.multiplier.into(),
        one.evidence.exponent.into(),
        one.evidence.exponent_error.into(),
        one.evidence
            .survival
            .and_then(|watched| watched.lifetime[1])
            .into(),
        Value::Integer(one.drawn.starts as i64),
        share.into(),
        low.into(),
        high.into(),
        of(one.contact_ratio.as_slice()).into(),
        of(one.peak_reaction.as_slice()).into(),
        one.peak_acceleration.into(),
    ]]
}

const SECTIONS: [&str; 6] = ["value", "attractor", "jumper", "sample", "z", "v"];

fn samples(row: &Row, one: &Attractor, jumper: usize) -> Vec<Vec<Value>> {
    let (z, v) = (one.z.as_slice().get(jumper), one.v.as_slice().get(jumper));
    let samples = z.into_iter().flatten().zip(v.into_iter().flatten());
    let line = |(sample, (&z, &v)): (usize, (&f64, &f64))| {
        vec![
            row.value.into(),
            Value::Integer(one.number as i64),
            Value::Integer(jumper as i64),
            Value::Integer(sample as i64 + 1),
            z.into(),
            v.into(),
        ]
    };
    samples.enumerate().map(line).collect()
}

const TRANSIENTS: [&str; 9] = [
    "value",
    "starts",
    "attractor",
    "motions",
    "ended",
    "periods",
    "lifetime",
    "lifetime_low",
    "lifetime_high",
];

fn transient_rows(report: &Report) -> impl Iterator<Item = Vec<Value>> {
    let all = report.rows.iter();
    let all = all.flat_map(|row| row.transients.iter().map(move |one| (row.value, one)));
    all.map(|(value, one)| {
        let [mean, low, high] = one.watched.lifetime.map(Value::from);
        vec![
            value.into(),
            Value::Integer(one.drawn.starts as i64),
            Value::Integer(one.to as i64),
            Value::Integer(one.watched.motions.into()),
            Value::Integer(one.watched.ended.into()),
            Value::Integer(one.watched.periods as i64),
            mean,
            low,
            high,
        ]
    })
}

const LOOPS: [&str; 10] = [
    "from",
    "to",
    "up",
    "down",
    "period_up",
    "period_down",
    "jump_up_low",
    "jump_up_high",
    "jump_down_low",
    "jump_down_high",
];

fn loop_rows(report: &Report) -> impl Iterator<Item = Vec<Value>> {
    report.loops.iter().map(|one| {
        let end = |jump: Option<[f64; 2]>, end: usize| jump.map(|jump| jump[end]);
        vec![
            one.from.into(),
            one.to.into(),
            Value::Integer(one.up as i64),
            Value::Integer(one.down as i64),
            one.period_up.into(),
            one.period_down.into(),
            end(one.jump_up, 0).into(),
            end(one.jump_up, 1).into(),
            end(one.jump_down, 0).into(),
            end(one.jump_down, 1).into(),
        ]
    })
}
