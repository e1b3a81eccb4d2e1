//! A motion as arrays, for the datasets of several commands.

use super::numbered;
use saltus_results::Variable;

/// What heights and velocities are, in the units of DP.
pub(crate) const HEIGHT: (&str, &str) = ("Height over eta = g/omega_h^2", "1");
pub(crate) const VELOCITY: (&str, &str) = ("Velocity over eta omega_h", "1");

/// The dimension of people.
pub(crate) fn jumpers(count: usize) -> Variable {
    numbered("jumper", 0, count, "Jumper, in the order of the study")
}
