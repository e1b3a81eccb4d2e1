//! The setup: plate, people and base in SI units, before anything is made of it.

use super::elastic::MANY;
use super::error::ModelError;
use crate::physics::{
    Base, BaseFrequency, ContactLaw, FrequencyReference, Jumper, PhysicsError, Plate,
};

/// Treatments of the in-plane degrees of freedom.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Inertia {
    /// All degrees of freedom, as DP integrates them: in-plane motion at hundreds of hertz included.
    #[default]
    Full,
    /// In-plane amplitudes follow the transverse ones as oscillators far above the driving frequency do:
    /// statically, and by two terms of their inertia and damping; their free oscillations are lost.
    /// For the paper's plate 20 periods end 2e-10 h from the full ones (at zeta_h 0.45, Omega 0.9; 2e-9 at
    /// 1.1; `tests/main/slow_manifold.rs`), at a twenty-fifth of the cost. At most 9 w terms.
    SlowManifold,
    /// In-plane amplitudes follow statically, p = -K^-1 B r r. For the paper's plate orbits differ
    /// from the full ones by less than 1e-3 eta (4e-6 far from bifurcations, see `tests/main/motion.rs` and
    /// `saltus reproduce`), at some hundredth of the cost.
    Condensed,
}

impl Inertia {
    /// The word used in study files and legends.
    pub fn name(self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::SlowManifold => "slow-manifold",
            Self::Condensed => "condensed",
        }
    }
}

/// Standard gravity as DP uses it (m/s^2).
pub const GRAVITY: f64 = 9.81;

/// A complete physical question in SI units: what stands where on what, and how the base moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    /// The plate.
    pub plate: Plate,
    /// The people; none is the empty plate.
    pub jumpers: Vec<Jumper>,
    /// Law of contact: when feet leave the floor and when they are back.
    pub contact: ContactLaw,
    /// The base motion.
    pub base: Base,
    /// Acceleration of gravity g (m/s^2).
    pub gravity: f64,
    /// Full or condensed.
    pub inertia: Inertia,
}

impl Setup {
    /// The paper's case at one damping ratio zeta_h and one Omega/omega_h, with the occupied body
    /// frequency as reference.
    pub fn dias_del_prado(damping_ratio: f64, frequency_ratio: f64) -> Self {
        let plate = Plate::dias_del_prado();
        let jumper = Jumper::dias_del_prado(plate.length, plate.width);
        Self {
            jumpers: vec![Jumper {
                damping_ratio,
                ..jumper
            }],
            contact: ContactLaw::ReactionForce,
            base: Base {
                amplitude: 0.013, // 0.13 h
                frequency: BaseFrequency::Ratio {
                    ratio: frequency_ratio,
                    reference: FrequencyReference::Occupied,
                },
            },
            gravity: GRAVITY,
            inertia: Inertia::Condensed,
            plate,
        }
    }

    /// Checks what can be seen without any algebra; [`Setup::model`] does it too.
    ///
    /// # Errors
    /// [`ModelError`] names the quantity that is wrong.
    pub fn check(&self) -> Result<(), ModelError> {
        self.base.check()?;
        PhysicsError::require(
            self.gravity > 0.0,
            "gravity.acceleration",
            self.gravity,
            "a positive number of m/s^2 is needed",
        )?;
        Jumper::check_all(&self.jumpers, &self.plate)?;
        for (index, jumper) in self.jumpers.iter().enumerate() {
            if jumper.damping_ratio == 0.0 && self.contact != ContactLaw::ReactionForce {
                return Err(ModelError::Undamped {
                    index,
                    law: self.contact.name(),
                });
            }
        }
        let (terms, limit) = (self.plate.modes.w.len(), MANY - 1);
        if self.inertia == Inertia::SlowManifold && terms > limit {
            return Err(ModelError::SlowManifold { terms, limit });
        }
        Ok(())
    }
}
