//! The JSON document of an orbit.

use super::{Run, search};
use crate::motion::{SectionPoint, SwitchPoint};
use crate::per_jumper::PerJumper;
use saltus_config::Study;
use serde::Serialize;
use std::f64::consts::TAU;

/// The document; `saltus orbit --help` explains each key.
#[derive(Serialize)]
pub(super) struct Report<'a> {
    version: &'static str,
    pub(super) period: usize,
    pub(super) asked: Option<usize>,
    pub(super) stability: &'static str,
    /// Null if neutral.
    pub(super) stable: Option<bool>,
    pub(super) in_family: bool,
    pub(super) outside: usize,
    pub(super) multipliers: Vec<[f64; 2]>,
    pub(super) multiplier_errors: Vec<f64>,
    pub(super) residual: f64,
    pub(super) iterations: usize,
    pub(super) segments: usize,
    pub(super) base_hz: f64,
    pub(super) period_s: f64,
    pub(super) contact_ratio: PerJumper<f64>,
    pub(super) landing_phases: PerJumper<&'a [f64]>,
    pub(super) peak_prf: PerJumper<f64>,
    pub(super) sequence: String,
    section: Vec<SectionPoint<'a>>,
    pub(super) switches: Vec<SwitchPoint>,
    study: &'a Study,
}

impl<'a> Report<'a> {
    pub(super) fn new(run: &'a Run) -> Self {
        let (orbit, seen, scales) = (&run.orbit, &run.portrait, run.model.scales());
        let (search, period) = (search(&run.study.orbit), orbit.period());
        Self {
            version: env!("CARGO_PKG_VERSION"),
            period,
            asked: search.period,
            stability: orbit.stability().name(),
            stable: orbit.stability().is_stable(),
            in_family: orbit.in_family(),
            outside: orbit.outside(),
            multipliers: orbit.multipliers.iter().map(|m| [m.re, m.im]).collect(),
            multiplier_errors: orbit.multipliers.iter().map(|m| m.error).collect(),
            residual: orbit.residual,
            iterations: orbit.iterations,
            segments: search.segments.map_or(period, |n| n.min(period)),
            base_hz: scales.omega / TAU,
            period_s: scales.period(),
            contact_ratio: seen.contact_ratio.iter().copied().collect(),
            landing_phases: seen.landing_phases.iter().map(Vec::as_slice).collect(),
            peak_prf: seen.peak_reaction.iter().copied().collect(),
            sequence: saltus::study::sequence(&run.model, orbit),
            section: seen.section.iter().map(SectionPoint::from).collect(),
            switches: seen.switches.iter().map(SwitchPoint::from).collect(),
            study: &run.study,
        }
    }
}
