//! Reasons why there is no model.

use saltus_hybrid::BuildError;

use crate::physics::PhysicsError;

/// Errors of a setup that makes no model.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    /// The physics makes no sense.
    #[error(transparent)]
    Physics(#[from] PhysicsError),
    /// A contact law that needs damping.
    #[error(
        "jumper.{index}.damping_ratio = 0: contact.law = \"{law}\" needs a damped leg; \
         without damping it is the same as \"reaction-force\""
    )]
    Undamped {
        /// Number of the jumper, from 0.
        index: usize,
        /// The law.
        law: &'static str,
    },
    /// More w terms than the slow manifold is written for.
    #[error(
        "plate.inertia = \"slow-manifold\" with {terms} w terms: at most {limit} are possible; \
         take \"condensed\" or \"full\""
    )]
    SlowManifold {
        /// Terms of the plate.
        terms: usize,
        /// Most possible.
        limit: usize,
    },
    /// More terms and people than a program can hold.
    #[error(
        "plate.modes with {terms} w terms: the equations of motion have {quantities} quantities and \
         at most 65536 are possible; take fewer terms (some 140)"
    )]
    TooLarge {
        /// Transverse terms of the plate.
        terms: usize,
        /// Quantities of the program.
        quantities: usize,
    },
    /// Numbers that combine to something no machine can hold.
    #[error("the equations of motion are out of range ({0}); are the numbers in SI units?")]
    Range(#[from] BuildError),
    /// A fixed step the integration cannot survive.
    #[error(
        "solver.steps_per_period = {steps}: RK4 is unstable above {limit:.3e} s per step for a fastest \
         rate of 2 pi x {hz:.1} Hz; at least {needed} steps are needed (or plate.inertia = \"condensed\")"
    )]
    UnstableStep {
        /// Steps asked for.
        steps: u32,
        /// Largest stable step (s).
        limit: f64,
        /// Fastest linear rate over 2 pi (Hz).
        hz: f64,
        /// Steps needed.
        needed: u32,
    },
}
