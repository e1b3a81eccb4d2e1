//! Fig. 2: brute-force bifurcation diagrams over the damping ratio.

use std::sync::Arc;

use saltus::hybrid::Status;
use saltus::model::{Inertia, Model, ModelError, PreparedPlate};
use saltus::physics::{ContactLaw, FrequencyReference, Plate};
use saltus::study::{
    Bodies, Control, Pass, StudyError, Sweep, SweepRow, linspace, recurrence, sweep_many,
};

use crate::effort::Effort;
use crate::setting::{RATIOS, setup};
use crate::stretches::Stretch;

/// One panel of Fig. 2 under one contact law and one reading of omega_h.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagram {
    /// The contact law.
    pub law: ContactLaw,
    /// Meaning of omega_h.
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

/// Samples that repeat this closely (eta) may be on a cycle, or on a slow way to one.
pub(crate) const REPEATS: f64 = 1e-3;

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
        passes.extend(effort.starts.iter().map(|&(z, v)| Pass::Start((z, v))));
    }
    Sweep {
        values: linspace(0.1, 0.5, values),
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

impl Effort {
    /// Periods of all diagrams, for a progress display.
    pub fn diagram_periods(&self) -> u64 {
        let paper = 2 * RATIOS.len() * (2 + self.starts.len()) * self.values;
        let laws = 2 * RATIOS.len() * 2 * self.law_values;
        (paper + laws) as u64 * (self.transient + self.record)
    }
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

    /// End of the motion of a row, held against the cycles that are stable at its damping ratio.
    pub fn met(row: &SweepRow, stretches: &[Stretch]) -> Met {
        let (Some(z), Some(v)) = (row.z().first(), row.v().first()) else {
            return Met::Other;
        };
        if row.status != Ok(Status::Completed) {
            return Met::Other;
        }
        let on = stretches.iter().find(|one| one.holds(row.value, z, v));
        match (on, recurrence(z, v, REPEATS)) {
            (Some(stretch), _) => Met::Cycle(stretch.period),
            (None, Some(repeats)) => Met::Slow(repeats as usize),
            (None, None) => Met::Other,
        }
    }
}

/// Ends of a motion of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Met {
    /// A stable cycle of this period.
    Cycle(usize),
    /// No cycle, though it repeats after this number of periods to 1e-3 eta: a transient that is slow, as they are near
    /// a bifurcation.
    Slow(usize),
    /// No cycle, and it does not repeat.
    Other,
}
