//! Fig. 2: brute-force bifurcation diagrams over the damping ratio.

use std::sync::Arc;

use saltus_hybrid::Status;

use super::{Effort, RATIOS, setup};
use crate::model::{Inertia, Model, ModelError, PreparedPlate};
use crate::physics::{ContactLaw, FrequencyReference, Plate};
use crate::study::{
    Control, Pass, Settled, StudyError, Sweep, SweepRow, recurrence, settle, sweep_many,
};

/// One panel of Fig. 2 under one contact law and one reading of omega_h.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagram {
    /// The contact law.
    pub law: ContactLaw,
    /// What omega_h means.
    pub reference: FrequencyReference,
    /// Omega/omega_h.
    pub ratio: f64,
    /// Omega/(2 pi) (Hz).
    pub hertz: f64,
    /// The passes made: up, down, then one per start.
    pub passes: Vec<Pass>,
    /// One row per pass and damping ratio.
    pub rows: Vec<SweepRow>,
}

/// Samples agree when they are this close, in units of eta: far below what a figure shows, far above
/// what a converged orbit leaves after 300 periods away from bifurcations.
const SAME: f64 = 1e-3;

/// All diagrams: the paper's law under both readings with every pass, the other two laws under the
/// occupied reading with the up- and down-sweep, on their own coarser grid.
///
/// # Errors
/// [`StudyError`] if there is no model of the paper's plate, or when stopped.
pub fn diagrams(effort: &Effort, control: &Control) -> Result<Vec<Diagram>, StudyError> {
    use FrequencyReference::{Free, Occupied};
    let plate = PreparedPlate::new(&Plate::dias_del_prado())?;
    let mut wanted = Vec::new();
    for (law, reference) in [
        (ContactLaw::ReactionForce, Occupied),
        (ContactLaw::ReactionForce, Free),
        (ContactLaw::Gap, Occupied),
        (ContactLaw::RelaxingLeg, Occupied),
    ] {
        wanted.extend(RATIOS.map(|ratio| (law, reference, ratio)));
    }
    let sweeps: Vec<_> = wanted
        .iter()
        .map(|&(law, reference, ratio)| {
            (
                sweep_of(effort, law),
                model_at(&plate, law, reference, ratio),
            )
        })
        .collect();
    let rows = sweep_many(&sweeps, control)?;
    let mut out = Vec::new();
    for (((law, reference, ratio), (sweep, model_at)), rows) in
        wanted.into_iter().zip(sweeps).zip(rows)
    {
        let hertz = model_at(0.3)?.scales().omega / std::f64::consts::TAU;
        out.push(Diagram {
            law,
            reference,
            ratio,
            hertz,
            passes: sweep.passes,
            rows,
        });
    }
    Ok(out)
}

fn sweep_of(effort: &Effort, law: ContactLaw) -> Sweep {
    let mut passes = vec![Pass::Up, Pass::Down];
    let mut values = effort.law_values;
    if law == ContactLaw::ReactionForce {
        values = effort.values;
        passes.extend(effort.starts.iter().map(|&(z, v)| Pass::Start { z, v }));
    }
    Sweep {
        values: Sweep::linspace(0.1, 0.5, values),
        passes,
        start: (3.0, 2.0),
        transient: effort.transient,
        record: effort.record,
    }
}

fn model_at(
    plate: &Arc<PreparedPlate>,
    law: ContactLaw,
    reference: FrequencyReference,
    ratio: f64,
) -> impl Fn(f64) -> Result<Model, ModelError> + Sync {
    let plate = Arc::clone(plate);
    move |zeta| setup(zeta, ratio, reference, law, Inertia::Condensed).model_on(&plate)
}

/// A stretch of damping ratios with one period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regime {
    /// Forcing periods after which the samples repeat; `None` if they do not.
    pub period: Option<u32>,
    /// First damping ratio.
    pub from: f64,
    /// Last damping ratio.
    pub to: f64,
}

impl Diagram {
    /// The rows of one pass, damping ratio ascending.
    pub fn pass(&self, pass: usize) -> impl Iterator<Item = &SweepRow> {
        self.rows.iter().filter(move |row| row.pass == pass)
    }
}

/// Period of the kept samples of the first body.
fn period(row: &SweepRow) -> Option<u32> {
    if row.status != Ok(Status::Completed) {
        return None;
    }
    recurrence(row.z.first()?, row.v.first()?, SAME)
}

/// Stretches of equal period along one pass.
pub fn regimes(diagram: &Diagram, pass: usize) -> Vec<Regime> {
    let mut out: Vec<Regime> = Vec::new();
    for row in diagram.pass(pass) {
        let period = period(row);
        match out.last_mut().filter(|last| last.period == period) {
            Some(last) => last.to = row.value,
            None => out.push(Regime {
                period,
                from: row.value,
                to: row.value,
            }),
        }
    }
    out
}

/// A stretch of damping ratios with two attractors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coexistence {
    /// First damping ratio.
    pub from: f64,
    /// Last damping ratio.
    pub to: f64,
    /// Periods of two attractors found in it, at its first damping ratio; `None` does not repeat.
    pub periods: (Option<u32>, Option<u32>),
}

/// Periods more to run before two motions are called different attractors.
const CONFIRM: u64 = 1000;

/// Where two passes of a diagram end on different attractors, at least one of them periodic.
///
/// Near a bifurcation two passes differ for a long time because transients die slowly; so each pair
/// that differs is run on for 1000 periods and compared again.
///
/// # Errors
/// [`StudyError`] if there is no model of the paper's plate, or when stopped.
pub fn coexistence(diagram: &Diagram, control: &Control) -> Result<Vec<Coexistence>, StudyError> {
    let plate = PreparedPlate::new(&Plate::dias_del_prado())?;
    let model_at = model_at(&plate, diagram.law, diagram.reference, diagram.ratio);
    let passes: Vec<Vec<&SweepRow>> = (0..diagram.passes.len())
        .map(|pass| diagram.pass(pass).collect())
        .collect();
    let mut candidates: Vec<(usize, usize)> = Vec::new();
    let mut starts = Vec::new();
    for i in 0..passes.first().map_or(0, Vec::len) {
        let motion =
            |pass: &Vec<&SweepRow>| Some((pass[i].z.first()?.clone(), pass[i].v.first()?.clone()));
        let motions: Vec<_> = passes.iter().filter_map(motion).collect();
        let differs = |other: &(Vec<f64>, Vec<f64>)| different(&motions[0], other).is_some();
        let Some(other) = motions.iter().position(differs) else {
            continue;
        };
        for pass in [0, other] {
            if let Some(end) = &passes[pass][i].end {
                starts.push((model_at(passes[0][i].value)?, end.clone()));
            }
        }
        candidates.push((i, starts.len()));
    }
    let settled = settle(&starts, CONFIRM, 100, control)?;
    let mut out: Vec<Coexistence> = Vec::new();
    let mut last = None;
    for (i, end) in candidates {
        let [a, b] = [&settled[end - 2], &settled[end - 1]];
        let motion = |s: &Settled| (s.z.clone(), s.v.clone());
        let Some(periods) = different(&motion(a), &motion(b)) else {
            continue;
        };
        let value = passes[0][i].value;
        match out.last_mut().filter(|_| last == Some(i - 1)) {
            Some(stretch) => stretch.to = value,
            None => out.push(Coexistence {
                from: value,
                to: value,
                periods,
            }),
        }
        last = Some(i);
    }
    Ok(out)
}

type Motion = (Vec<f64>, Vec<f64>);

/// The periods of two motions that cannot be the same attractor: one periodic, the other not or on
/// other points.
fn different(a: &Motion, b: &Motion) -> Option<(Option<u32>, Option<u32>)> {
    let period = |motion: &Motion| recurrence(&motion.0, &motion.1, SAME);
    let periods = (period(a), period(b));
    let differ = match periods {
        (None, None) => false,
        (Some(n), Some(m)) => n != m || !same_orbit(a, b, n as usize),
        _ => true,
    };
    differ.then_some(periods)
}

/// Whether two n-periodic motions visit the same points (in any phase).
fn same_orbit(a: &Motion, b: &Motion, n: usize) -> bool {
    let near = |i: usize, j: usize| {
        (a.0[i] - b.0[j]).abs() < 2.0 * SAME && (a.1[i] - b.1[j]).abs() < 2.0 * SAME
    };
    (0..n).any(|shift| (0..n).all(|i| near(i, (i + shift) % n)))
}
