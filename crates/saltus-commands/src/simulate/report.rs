//! The JSON document of a run.

use super::Run;
use crate::motion::{SectionPoint, SwitchPoint};
use crate::per_jumper::PerJumper;
use crate::status;
use saltus::model::EnergyBalance;
use saltus_config::Study;
use serde::Serialize;
use std::f64::consts::TAU;

/// The document; `saltus simulate --help` explains each key.
#[derive(Serialize)]
pub(super) struct Report<'a> {
    version: &'static str,
    pub(super) status: &'static str,
    pub(super) status_text: String,
    pub(super) base_hz: f64,
    pub(super) period_s: f64,
    pub(super) periods: u64,
    pub(super) steps: u64,
    pub(super) contact_ratio: PerJumper<f64>,
    pub(super) peak_prf: PerJumper<Option<f64>>,
    pub(super) energy: Energy,
    section: Vec<SectionPoint<'a>>,
    pub(super) switches: Vec<SwitchPoint>,
    study: &'a Study,
}

#[derive(Serialize)]
pub(super) struct Energy {
    unit: &'static str,
    pub(super) max_residual: f64,
    pub(super) max_turnover: f64,
    pub(super) max_relative_residual: f64,
    periods: Vec<Balance>,
}

#[derive(Serialize)]
struct Balance {
    base: f64,
    gravity: f64,
    plate: f64,
    legs: f64,
    dampers: f64,
    stored: f64,
    residual: f64,
}

impl<'a> Report<'a> {
    pub(super) fn new(run: &'a Run) -> Self {
        let (trajectory, scales) = (&run.trajectory, run.model.scales());
        let end = &trajectory.end;
        Self {
            version: env!("CARGO_PKG_VERSION"),
            status: end.status.name(),
            status_text: status::text(&end.status, Some(scales.omega)),
            base_hz: scales.omega / TAU,
            period_s: scales.period(),
            periods: end.periods,
            steps: end.steps,
            contact_ratio: contact_ratio(run),
            peak_prf: peak_force(run),
            energy: Energy::new(&trajectory.energy),
            section: trajectory.section.iter().map(SectionPoint::from).collect(),
            switches: trajectory.switches.iter().map(SwitchPoint::from).collect(),
            study: &run.study,
        }
    }
}

/// Mean over the periods behind the transient.
fn contact_ratio(run: &Run) -> PerJumper<f64> {
    let ratios = &run.trajectory.contact_ratio;
    let kept = ratios.get(run.transient()..).unwrap_or_default();
    let mean = |i| kept.iter().map(|period| period[i]).sum::<f64>() / kept.len() as f64;
    (0..run.jumpers()).map(mean).collect()
}

/// Largest in the time history; none if the run ended before it.
fn peak_force(run: &Run) -> PerJumper<Option<f64>> {
    let peaks = &run.trajectory.peak_reaction;
    let peak = |i: usize| peaks.get(i).copied();
    (0..run.jumpers()).map(peak).collect()
}

impl Energy {
    fn new(periods: &[EnergyBalance]) -> Self {
        let largest = |of: fn(&EnergyBalance) -> f64| periods.iter().map(of).fold(0.0, f64::max);
        let max_residual = largest(|e| e.residual.abs());
        let max_turnover = largest(|e| {
            [e.base, e.gravity, e.plate, e.legs, e.stored]
                .iter()
                .map(|part| part.abs())
                .sum()
        });
        Self {
            unit: "J",
            max_residual,
            max_turnover,
            // nothing moved: nothing is left over
            max_relative_residual: if max_turnover > 0.0 {
                max_residual / max_turnover
            } else {
                0.0
            },
            periods: periods.iter().map(Balance::from).collect(),
        }
    }
}

impl From<&EnergyBalance> for Balance {
    fn from(energy: &EnergyBalance) -> Self {
        let &EnergyBalance {
            base,
            gravity,
            plate,
            legs,
            dampers,
            stored,
            residual,
        } = energy;
        Self {
            base,
            gravity,
            plate,
            legs,
            dampers,
            stored,
            residual,
        }
    }
}
