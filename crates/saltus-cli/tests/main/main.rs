//! Integration tests: the program as a person starts it.
#![allow(clippy::unwrap_used)]

mod attractors;
mod bad_days;
mod cli;
mod common;
mod continuation;
mod lyapunov;
mod orbit;
mod plane;
mod results;
mod shards;
mod shell;
mod simulate;
mod sweep;
