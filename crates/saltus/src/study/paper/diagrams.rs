//! Fig. 2: brute-force bifurcation diagrams over the damping ratio.

use std::sync::Arc;

use saltus_hybrid::{Point, Status};

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
    /// The model at a damping ratio.
    ///
    /// # Errors
    /// [`ModelError`] for one that makes no sense.
    pub fn model(&self, damping_ratio: f64) -> Result<Model, ModelError> {
        let inertia = Inertia::Condensed;
        setup(damping_ratio, self.ratio, self.reference, self.law, inertia).model()
    }

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

/// Periods to run on before two motions are compared, and again before they are compared once more.
const CONFIRM: u64 = 500;

/// Two motions approach each other if a confirmation shrinks their distance below this part of it.
const APPROACHING: f64 = 0.9;

/// Where two passes of a diagram end on different attractors, at least one of them periodic.
///
/// Near a bifurcation two passes differ for a long time because transients die slowly. So each pair
/// that differs is run on twice for 500 periods: on different attractors the distance of the two sets
/// of points stays what it is, in a slow transient it shrinks.
///
/// # Errors
/// [`StudyError`] if there is no model of the paper's plate, or when stopped.
pub fn coexistence(diagram: &Diagram, control: &Control) -> Result<Vec<Coexistence>, StudyError> {
    let plate = PreparedPlate::new(&Plate::dias_del_prado())?;
    let model_at = model_at(&plate, diagram.law, diagram.reference, diagram.ratio);
    let (candidates, starts) = candidates(diagram, model_at)?;
    let once = settle(&starts, CONFIRM, 100, control)?;
    let on =
        |((model, _), settled): (&(Model, Point), &Settled)| (model.clone(), settled.end.clone());
    let starts: Vec<_> = starts.iter().zip(&once).map(on).collect();
    let twice = settle(&starts, CONFIRM, 100, control)?;
    let mut out: Vec<Coexistence> = Vec::new();
    let mut last = None;
    for ((row, value), (once, twice)) in candidates
        .into_iter()
        .zip(once.chunks(2).zip(twice.chunks(2)))
    {
        let distance = |pair: &[Settled]| Motion::of(&pair[0]).distance(&Motion::of(&pair[1]));
        let (before, after) = (distance(once), distance(twice));
        let periods = (
            Motion::of(&twice[0]).period(),
            Motion::of(&twice[1]).period(),
        );
        let apart = after > 2.0 * SAME && after > APPROACHING * before;
        if !apart || periods == (None, None) {
            continue;
        }
        match out.last_mut().filter(|_| row > 0 && last == Some(row - 1)) {
            Some(stretch) => stretch.to = value,
            None => out.push(Coexistence {
                from: value,
                to: value,
                periods,
            }),
        }
        last = Some(row);
    }
    Ok(out)
}

/// Rows of a diagram, by place and damping ratio, at which some pass differs from the first one.
type Candidates = Vec<(usize, f64)>;

/// The candidates, and for each the last states of the two passes that differ most.
fn candidates(
    diagram: &Diagram,
    model_at: impl Fn(f64) -> Result<Model, ModelError>,
) -> Result<(Candidates, Vec<(Model, Point)>), StudyError> {
    let passes: Vec<Vec<&SweepRow>> = (0..diagram.passes.len())
        .map(|pass| diagram.pass(pass).collect())
        .collect();
    let (mut candidates, mut starts) = (Vec::new(), Vec::new());
    for i in 0..passes.first().map_or(0, Vec::len) {
        let motions: Option<Vec<Motion<'_>>> =
            passes.iter().map(|rows| Motion::at(rows[i])).collect();
        let Some(motions) = motions else { continue };
        if motions.iter().all(|motion| motion.period().is_none()) {
            continue;
        }
        let distances = motions.iter().map(|motion| motion.distance(&motions[0]));
        let farthest = distances.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
        let Some((other, _)) = farthest.filter(|(_, distance)| *distance > SAME) else {
            continue;
        };
        let ends = (&passes[0][i].end, &passes[other][i].end);
        if let (Some(first), Some(second)) = ends {
            let value = passes[0][i].value;
            let model = model_at(value)?;
            candidates.push((i, value));
            starts.extend([(model.clone(), first.clone()), (model, second.clone())]);
        }
    }
    Ok((candidates, starts))
}

/// The section of a settled motion: z/eta and z'/(eta omega_h).
struct Motion<'a> {
    z: &'a [f64],
    v: &'a [f64],
}

impl<'a> Motion<'a> {
    fn at(row: &'a SweepRow) -> Option<Self> {
        Some(Self {
            z: row.z.first()?,
            v: row.v.first()?,
        })
    }

    fn of(settled: &'a Settled) -> Self {
        Self {
            z: &settled.z,
            v: &settled.v,
        }
    }

    fn period(&self) -> Option<u32> {
        recurrence(self.z, self.v, SAME)
    }

    /// Hausdorff distance of the two sets of points, in the larger of both coordinates.
    fn distance(&self, other: &Self) -> f64 {
        let from = |a: &Self, b: &Self| {
            let nearest = |(z, v): (&f64, &f64)| {
                let gap = |(bz, bv): (&f64, &f64)| (z - bz).abs().max((v - bv).abs());
                b.z.iter().zip(b.v).map(gap).fold(f64::INFINITY, f64::min)
            };
            a.z.iter().zip(a.v).map(nearest).fold(0.0, f64::max)
        };
        from(self, other).max(from(other, self))
    }
}
