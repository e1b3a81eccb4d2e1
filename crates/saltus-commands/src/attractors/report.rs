//! The JSON document of attractors.

use super::evidence::{Evidence, Passing};
use super::section::{self, Section};
use super::{Loss, Run};
use crate::per_jumper::PerJumper;
use saltus::study::{Counted, Fraction, Hysteresis, Identity, Lost, Turn};
use saltus_config::{Parameter, Study};
use serde::Serialize;

/// The document; `saltus attractors --help` explains each key.
#[derive(Serialize)]
pub(super) struct Report<'a> {
    version: &'static str,
    parameter: Option<String>,
    unit: Option<&'static str>,
    label: Option<String>,
    pub(super) starts: u32,
    pub(super) unseen: f64,
    pub(super) rows: Vec<Row>,
    pub(super) attractors: Vec<Span>,
    pub(super) loops: Vec<Loop>,
    pub(super) unfinished: usize,
    periods_run: u64,
    study: &'a Study,
}

/// One value.
#[derive(Serialize)]
pub(super) struct Row {
    pub(super) value: Option<f64>,
    pub(super) attractors: Vec<Attractor>,
    pub(super) transients: Vec<Passing>,
    pub(super) undecided: Share,
    pub(super) lost: Share,
    pub(super) first_failure: Option<FirstFailure>,
}

/// One attractor at a value.
#[derive(Serialize)]
pub(super) struct Attractor {
    pub(super) number: usize,
    /// Null if not periodic.
    pub(super) period: Option<u32>,
    #[serde(flatten)]
    pub(super) evidence: Evidence,
    #[serde(flatten)]
    pub(super) drawn: Share,
    pub(super) contact_ratio: PerJumper<f64>,
    pub(super) peak_reaction: PerJumper<f64>,
    pub(super) peak_acceleration: f64,
    /// Section points.
    pub(super) z: PerJumper<Vec<f64>>,
    pub(super) v: PerJumper<Vec<f64>>,
}

/// Part of the first states, and its 95 % confidence interval.
#[derive(Clone, Copy, Serialize)]
pub(super) struct Share {
    pub(super) starts: u64,
    /// Value, low, high.
    pub(super) share: [f64; 3],
}

/// Why there is no model, or why the first run that ended early did.
#[derive(Serialize)]
pub(super) struct FirstFailure {
    status: String,
    pub(super) status_text: String,
}

/// One attractor along the parameter.
#[derive(Serialize)]
pub(super) struct Span {
    pub(super) number: usize,
    pub(super) first: Option<f64>,
    pub(super) last: Option<f64>,
    pub(super) birth: Option<End>,
    pub(super) death: Option<End>,
}

/// Where an attractor begins or ends, and where it leads to beyond.
#[derive(Serialize)]
pub(super) struct End {
    pub(super) between: [f64; 2],
    pub(super) to: Option<usize>,
}

/// A loop of hysteresis.
#[derive(Serialize)]
pub(super) struct Loop {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) up: usize,
    pub(super) down: usize,
    pub(super) period_up: Option<u32>,
    pub(super) period_down: Option<u32>,
    pub(super) jump_up: Option<[f64; 2]>,
    pub(super) jump_down: Option<[f64; 2]>,
}

impl<'a> Report<'a> {
    pub(super) fn new(run: &'a Run) -> Self {
        let (found, parameter) = (&run.found, run.parameter.as_ref());
        let sections = section::connected(found);
        let starts = run.study.attractors.starts;
        let rows = found.rows.iter().zip(&sections);
        let identities = found.identities.iter().enumerate();
        Self {
            version: env!("CARGO_PKG_VERSION"),
            parameter: parameter.map(Parameter::key),
            unit: parameter.map(Parameter::unit),
            label: parameter.map(Parameter::label),
            starts,
            unseen: Fraction::unseen(starts.into()),
            rows: rows
                .map(|(row, sections)| Row::new(run, row, sections))
                .collect(),
            attractors: identities
                .map(|(identity, span)| Span::new(run, identity, span))
                .collect(),
            loops: found.loops.iter().map(Loop::new).collect(),
            unfinished: found.unfinished,
            periods_run: run.periods_run,
            study: &run.study,
        }
    }
}

impl Row {
    fn new(run: &Run, row: &saltus::study::Row, sections: &[Section]) -> Self {
        let attractors = row.attractors().iter().zip(sections);
        let transients = row.census.iter().flat_map(|census| &census.transients);
        let number = |place: usize| row.attractors()[place].identity + 1;
        let (undecided, lost, failure) = match &row.census {
            Ok(census) => (census.undecided, census.lost, census.first_lost.clone()),
            Err(error) => {
                let none = Fraction::default();
                (none, none, Some(Lost::NoModel(error.clone())))
            }
        };
        Self {
            value: run.value(row.value),
            attractors: attractors
                .map(|(counted, section)| Attractor::new(counted, section))
                .collect(),
            transients: transients
                .map(|transient| Passing::new(transient, number))
                .collect(),
            undecided: undecided.into(),
            lost: lost.into(),
            first_failure: failure.map(Loss::from).map(|loss| FirstFailure {
                status: loss.status,
                status_text: loss.reason,
            }),
        }
    }
}

impl Attractor {
    fn new(counted: &Counted, section: &Section) -> Self {
        let motion = &counted.entry.attractor;
        let of = |part: usize| {
            let body = |body: &Vec<[f64; 2]>| body.iter().map(|sample| sample[part]).collect();
            section.iter().map(body).collect()
        };
        Self {
            number: counted.identity + 1,
            period: motion.kind.period(),
            evidence: counted.into(),
            drawn: counted.fraction.into(),
            contact_ratio: motion.contact_ratio.clone().into(),
            peak_reaction: motion.peak_reaction.clone().into(),
            peak_acceleration: motion.peak_acceleration,
            z: of(0),
            v: of(1),
        }
    }
}

impl Attractor {
    /// `2T`, or `chaotic`.
    pub(super) fn name(&self) -> String {
        let kind = || self.evidence.kind.name().to_owned();
        self.period.map_or_else(kind, |n| format!("{n}T"))
    }
}

impl From<Fraction> for Share {
    fn from(fraction: Fraction) -> Self {
        let [low, high] = fraction.interval();
        Self {
            starts: fraction.count,
            share: [fraction.value(), low, high],
        }
    }
}

impl Span {
    fn new(run: &Run, identity: usize, span: &Identity) -> Self {
        let end = |turn: Turn| End {
            between: turn.between,
            to: turn.to.map(|to| to + 1),
        };
        Self {
            number: identity + 1,
            first: run.value(span.first),
            last: run.value(span.last),
            birth: span.birth.map(end),
            death: span.death.map(end),
        }
    }
}

impl Loop {
    fn new(found: &Hysteresis) -> Self {
        Self {
            from: found.from,
            to: found.to,
            up: found.up + 1,
            down: found.down + 1,
            period_up: found.kinds.0.period(),
            period_down: found.kinds.1.period(),
            jump_up: found.jump_up,
            jump_down: found.jump_down,
        }
    }
}

/// `2T`, or `not periodic`.
pub(super) fn name(period: Option<u32>) -> String {
    period.map_or("not periodic".to_owned(), |n| format!("{n}T"))
}
