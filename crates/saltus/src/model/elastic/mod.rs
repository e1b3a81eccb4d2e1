//! Elastic forces beyond linear bending, as a program.
//!
//! Few w terms: the quartic energy as a matrix between squares. Many: through the harmonics
//! of the strains ([`Harmonics`]), whose work grows with the number of pairs and not with its square.

mod few;
mod many;
mod program;

use saltus_hybrid::SystemBuilder;

use super::layout::Layout;
use super::scales::Scales;
use super::setup::Inertia;
use crate::physics::{Elasticity, Harmonics, PhysicsError};
use few::Few;
use many::{InPlane, Many};
use program::Program;
pub(super) use program::{Elastic, Sum};

/// From this many w terms on the harmonics are cheaper: complete sets of 9 terms take 1.4 times as long by
/// them as by the quartic matrix, of 16 terms 0.8 times (`cargo bench -p saltus --bench growth`).
pub(crate) const MANY: usize = 10;

/// Contribution of the stretching of a plate, prepared once for all models on it.
#[derive(Clone, Debug)]
pub(crate) enum Stretching {
    Few(Box<Few>),
    Many(Box<Many>),
}

impl Stretching {
    pub(crate) fn new(e: &Elasticity) -> Result<Self, PhysicsError> {
        if e.bending.len() < MANY {
            return Few::new(e).map(|few| Self::Few(Box::new(few)));
        }
        let (mut condensed, mut flexibility) = (e.condensed_harmonics()?, Vec::new());
        let work = |h: &Harmonics| 2 * h.strain.len() + h.weights.len() + 2 * h.in_plane.len();
        let inverse = e.in_plane_flexibility()?;
        if work(&e.harmonics) + inverse.len() < work(&condensed) {
            (condensed, flexibility) = (e.harmonics.clone(), inverse);
        }
        Ok(Self::Many(Box::new(Many {
            condensed,
            flexibility,
        })))
    }

    /// The forces as nodes.
    pub(crate) fn forces(
        &self,
        b: &mut SystemBuilder,
        e: &Elasticity,
        inertia: Inertia,
        scales: &Scales,
        layout: Layout,
    ) -> Elastic {
        let mut program = Program {
            b,
            e,
            scales,
            layout,
        };
        match (self, inertia) {
            (Self::Few(few), Inertia::Full) => program.few_full(&few.frame),
            (Self::Few(few), Inertia::Condensed) => program.few_condensed(few, &[]),
            (Self::Few(few), Inertia::SlowManifold) => program.few_condensed(few, &few.responses),
            (Self::Many(_), Inertia::Full) => program.many(&e.harmonics, InPlane::Free),
            (Self::Many(many), _) => {
                program.many(&many.condensed, InPlane::Static(&many.flexibility))
            }
        }
    }
}
