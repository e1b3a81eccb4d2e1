//! Full against condensed: what it costs to let the in-plane motion follow statically.

use saltus::hybrid::Status;
use saltus::model::{Inertia, PreparedPlate};
use saltus::physics::{ContactLaw, FrequencyReference, Plate};
use saltus::study::{
    Bodies, Control, Pass, StudyError, Sweep, SweepRow, linspace, recurrence, sweep_many,
};

use crate::effort::Effort;
use crate::setting::{RATIOS, setup};

/// Both models at one damping ratio of one panel, from the same start.
#[derive(Clone, Debug, PartialEq)]
pub struct InertiaRow {
    /// Omega/omega_h.
    pub ratio: f64,
    /// zeta_h.
    pub damping_ratio: f64,
    /// Section of the full model, (z/eta, z'/(eta omega_h)).
    pub full: (Vec<f64>, Vec<f64>),
    /// Section of the condensed model.
    pub condensed: (Vec<f64>, Vec<f64>),
    /// Largest difference of the two sections in eta, where both are on the same periodic attractor;
    /// chaotic motions have none to compare.
    pub difference: Option<f64>,
    /// Contact ratio of both.
    pub contact_ratio: (f64, f64),
}

/// The comparison over all panels.
#[derive(Clone, Debug, PartialEq)]
pub struct InertiaComparison {
    /// One row per panel and damping ratio.
    pub rows: Vec<InertiaRow>,
    /// Largest difference among periodic motions, in eta.
    pub largest: f64,
    /// Number of motions on the same periodic attractor in both.
    pub periodic: usize,
}

/// Runs both models from the start (3, 2) at equal damping ratios in the three panels.
///
/// # Errors
/// [`StudyError`] if there is no model, or when stopped.
pub fn compare_inertia(
    effort: &Effort,
    control: &Control,
) -> Result<InertiaComparison, StudyError> {
    let plate = PreparedPlate::new(&Plate::dias_del_prado())?;
    let (transient, record) = effort.full_periods;
    let sweep = Sweep {
        values: linspace(0.1, 0.5, effort.full_values),
        passes: vec![Pass::Start((3.0, 2.0))],
        start: (3.0, 2.0),
        transient,
        record,
    };
    let mut sweeps = Vec::new();
    for inertia in [Inertia::Full, Inertia::Condensed] {
        for ratio in RATIOS {
            let plate = std::sync::Arc::clone(&plate);
            let model_at = move |zeta| {
                let reference = FrequencyReference::Occupied;
                setup(zeta, ratio, reference, ContactLaw::ReactionForce, inertia).model_on(&plate)
            };
            sweeps.push((sweep.clone(), model_at));
        }
    }
    let mut results = sweep_many(&sweeps, control)?;
    let condensed = results.split_off(RATIOS.len());
    let mut rows = Vec::new();
    for ((ratio, full), condensed) in RATIOS.into_iter().zip(results).zip(condensed) {
        rows.extend(
            full.iter()
                .zip(&condensed)
                .map(|(full, condensed)| compare(ratio, full, condensed)),
        );
    }
    let differences: Vec<f64> = rows.iter().filter_map(|row| row.difference).collect();
    Ok(InertiaComparison {
        rows,
        largest: differences.iter().copied().fold(0.0, f64::max),
        periodic: differences.len(),
    })
}

impl Effort {
    /// Periods of the comparison of full and condensed, for a progress display.
    pub fn inertia_periods(&self) -> u64 {
        (2 * RATIOS.len() * self.full_values) as u64 * (self.full_periods.0 + self.full_periods.1)
    }
}

fn compare(ratio: f64, full: &SweepRow, condensed: &SweepRow) -> InertiaRow {
    let section = |row: &SweepRow| {
        (
            row.z().first().cloned().unwrap_or_default(),
            row.v().first().cloned().unwrap_or_default(),
        )
    };
    let (a, b) = (section(full), section(condensed));
    let ended = full.status == Ok(Status::Completed) && condensed.status == Ok(Status::Completed);
    let contact = |row: &SweepRow| row.contact_ratio.first().copied().unwrap_or(f64::NAN);
    InertiaRow {
        ratio,
        damping_ratio: full.value,
        difference: if ended { difference(&a, &b) } else { None },
        contact_ratio: (contact(full), contact(condensed)),
        full: a,
        condensed: b,
    }
}

/// Two orbits further apart than this (in eta) are different attractors, which a chaotic transient
/// chooses between, and no measure of the models' difference.
const SAME_ATTRACTOR: f64 = 0.1;

/// Largest distance of two orbits of equal period, in the phase in which they agree best.
fn difference(a: &(Vec<f64>, Vec<f64>), b: &(Vec<f64>, Vec<f64>)) -> Option<f64> {
    let n = recurrence(&a.0, &a.1, 1e-3)?;
    if recurrence(&b.0, &b.1, 1e-3) != Some(n) {
        return None;
    }
    let n = n as usize;
    let gap = |shift: usize| {
        (0..n).fold(0.0, |m: f64, i| {
            let j = (i + shift) % n;
            m.max((a.0[i] - b.0[j]).abs()).max((a.1[i] - b.1[j]).abs())
        })
    };
    (0..n)
        .map(gap)
        .min_by(f64::total_cmp)
        .filter(|&gap| gap < SAME_ATTRACTOR)
}
