//! The base motion A_b cos(Omega t), DP Eq. (3c).

use super::{Jumper, PhysicsError, Plate};
use std::f64::consts::TAU;

/// Harmonic vertical motion of the plate's edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Base {
    /// Amplitude A_b (m).
    pub amplitude: f64,
    /// Frequency Omega, in hertz or as a ratio.
    pub frequency: BaseFrequency,
}

/// Omega directly, or relative to a frequency of the system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BaseFrequency {
    /// Omega/(2 pi) (Hz).
    Hertz(f64),
    /// Omega as a multiple of a natural frequency.
    Ratio {
        /// Omega/omega_reference (-).
        ratio: f64,
        /// Frequency that it is a multiple of.
        reference: FrequencyReference,
    },
}

/// The frequency that DP's "0.9, 1.0, 1.1 omega_h" refers to. The paper does not say which.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum FrequencyReference {
    /// The body's frequency on the flexible plate (2.5373 Hz): agrees best with DP section 4 (see the
    /// table of facts of `saltus reproduce`).
    #[default]
    Occupied,
    /// The body's frequency on rigid ground (2.4794 Hz): contradicts two of them.
    Free,
    /// The first frequency of the empty plate (2.2969 Hz).
    Plate,
}

impl FrequencyReference {
    /// The word used in study files and legends.
    pub fn name(self) -> &'static str {
        match self {
            Self::Occupied => "occupied",
            Self::Free => "free",
            Self::Plate => "plate",
        }
    }
}

impl Base {
    /// Checks the numbers.
    ///
    /// # Errors
    /// [`PhysicsError::OutOfRange`] unless the amplitude is finite and the frequency positive.
    pub fn check(&self) -> Result<(), PhysicsError> {
        PhysicsError::require(
            self.amplitude >= 0.0,
            "base.amplitude",
            self.amplitude,
            "zero or a positive number of metres is needed",
        )?;
        let (key, value) = match self.frequency {
            BaseFrequency::Hertz(hz) => ("base.frequency", hz),
            BaseFrequency::Ratio { ratio, .. } => ("base.frequency_ratio", ratio),
        };
        PhysicsError::require(value > 0.0, key, value, "a positive number is needed")
    }

    /// The forcing frequency Omega (rad/s).
    ///
    /// A ratio refers to the first of `jumpers` ([`FrequencyReference::Occupied`] and
    /// [`FrequencyReference::Free`]) or to the lowest frequency of the empty plate.
    ///
    /// # Errors
    /// Those of [`Base::check`], [`Plate::check`] and [`Plate::occupied`] for what is needed;
    /// [`PhysicsError::NeedsJumper`] if the reference is a jumper's and there is none.
    pub fn omega(&self, plate: &Plate, jumpers: &[Jumper]) -> Result<f64, PhysicsError> {
        self.check()?;
        let (ratio, reference) = match self.frequency {
            BaseFrequency::Hertz(hz) => return Ok(TAU * hz),
            BaseFrequency::Ratio { ratio, reference } => (ratio, reference),
        };
        let needs_jumper = || PhysicsError::NeedsJumper {
            reference: reference.name(),
        };
        Ok(ratio
            * match reference {
                FrequencyReference::Occupied => {
                    let modes = plate.occupied(jumpers)?;
                    TAU * modes
                        .body_index
                        .map(|index| modes.hz[index])
                        .ok_or_else(needs_jumper)?
                }
                FrequencyReference::Free => {
                    let first = jumpers.first().ok_or_else(needs_jumper)?;
                    first.check(0)?;
                    first.omega()
                }
                FrequencyReference::Plate => TAU * plate.frequencies_hz()?[0],
            })
    }
}
