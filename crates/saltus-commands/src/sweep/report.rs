//! The JSON document of a sweep.

use super::Run;
use crate::per_jumper::PerJumper;
use crate::status;
use saltus::orbits::{Exponent, MotionKind};
use saltus::study::Pass;
use saltus_config::Study;
use serde::Serialize;

/// The document; `saltus sweep --help` explains each key.
#[derive(Serialize)]
pub(super) struct Report<'a> {
    version: &'static str,
    parameter: String,
    unit: &'static str,
    label: String,
    passes: Vec<PassPoint>,
    pub(super) rows: Vec<Row<'a>>,
    study: &'a Study,
}

#[derive(Serialize)]
struct PassPoint {
    direction: &'static str,
    start: [f64; 2],
}

#[derive(Serialize)]
pub(super) struct Row<'a> {
    pub(super) pass: usize,
    pub(super) direction: &'static str,
    pub(super) start: [f64; 2],
    pub(super) value: f64,
    pub(super) z: PerJumper<&'a [f64]>,
    pub(super) v: PerJumper<&'a [f64]>,
    pub(super) contact_ratio: PerJumper<f64>,
    pub(super) label: Option<&'static str>,
    pub(super) period: Option<u32>,
    pub(super) confidence: Option<f64>,
    pub(super) exponents: Vec<Rate>,
    pub(super) status: &'static str,
    pub(super) status_text: String,
}

/// An exponent; JSON has no -inf and no inf, so they are null.
#[derive(Serialize)]
pub(super) struct Rate {
    pub(super) per_period: f64,
    pub(super) standard_error: f64,
}

impl<'a> Report<'a> {
    pub(super) fn new(run: &'a Run) -> Self {
        let pass = |pass| PassPoint {
            direction: direction(pass),
            start: start(run, pass),
        };
        Self {
            version: env!("CARGO_PKG_VERSION"),
            parameter: run.parameter.key(),
            unit: run.parameter.unit(),
            label: run.parameter.label(),
            passes: run.sweep.passes.iter().map(pass).collect(),
            rows: (0..run.rows.len()).map(|row| Row::new(run, row)).collect(),
            study: &run.study,
        }
    }
}

impl<'a> Row<'a> {
    fn new(run: &'a Run, index: usize) -> Self {
        let row = &run.rows[index];
        let label = run.labels[index].as_ref();
        let rate = |exponent: &Exponent| Rate {
            per_period: exponent.per_iterate,
            standard_error: exponent.standard_error,
        };
        let pass = &run.sweep.passes[row.pass];
        Self {
            pass: row.pass,
            direction: direction(pass),
            start: start(run, pass),
            value: row.value,
            z: of_each(run, &row.z),
            v: of_each(run, &row.v),
            contact_ratio: (0..run.jumpers())
                .map(|i| row.contact_ratio.get(i).copied().unwrap_or(f64::NAN))
                .collect(),
            label: label.map(|label| name(label.kind)),
            period: label.and_then(|label| label.kind.period()),
            confidence: label.and_then(|label| label.confidence),
            exponents: run.exponents[index].iter().map(rate).collect(),
            status: row.status.as_ref().map_or("no-model", |end| end.name()),
            status_text: match &row.status {
                Ok(end) => status::text(end, None),
                Err(error) => error.to_string(),
            },
        }
    }
}

/// A row without a model has no samples, of nobody; its lists are as many as those of the others.
fn of_each<'a>(run: &Run, samples: &'a [Vec<f64>]) -> PerJumper<&'a [f64]> {
    (0..run.jumpers())
        .map(|i| samples.get(i).map_or(&[][..], Vec::as_slice))
        .collect()
}

/// All names of motions: a sweep asks for exponents, so nothing stays at "not-periodic".
pub(super) const LABELS: [&str; 4] = {
    let [periodic, quasi_periodic, chaotic, _, undecided] = MotionKind::NAMES;
    [periodic, quasi_periodic, chaotic, undecided]
};

fn name(kind: MotionKind) -> &'static str {
    match kind {
        MotionKind::NotPeriodic => MotionKind::Undecided.name(),
        kind => kind.name(),
    }
}

/// Word for a pass.
pub(super) fn direction(pass: &Pass) -> &'static str {
    match pass {
        Pass::Up => "up",
        Pass::Down => "down",
        Pass::Start { .. } => "start",
    }
}

/// The state a pass begins with: z/eta and z'/(eta omega_h).
pub(super) fn start(run: &Run, pass: &Pass) -> [f64; 2] {
    match *pass {
        Pass::Start { z, v } => [z, v],
        Pass::Up | Pass::Down => run.sweep.start.into(),
    }
}
