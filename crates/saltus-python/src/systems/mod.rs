//! Systems of a user's own: formulas become a program of the engine, which is integrated, solved for orbits, and
//! asked for exponents.

mod blueprint;
mod coefficients;
mod ensemble;
mod exponents;
mod formula;
mod input;
mod lower;
mod members;
mod orbit;
mod program;

pub(crate) use ensemble::Trajectories;
pub(crate) use exponents::Exponents;
pub(crate) use orbit::Orbit;
pub(crate) use program::Program;
