//! Integration tests: orbits, branches and exponents of maps and of flows.
#![allow(clippy::unwrap_used)]

mod flow;
mod lyapunov;
mod orbits;
mod systems;
