//! Colours of motions, which are those of the program's figures.

use pyo3::prelude::*;
use saltus_commands::attractor_colours;
use saltus_orbits::MotionKind;
use saltus_results::Colour;

/// Colour of a kind of motion, by its period if it has one, as `#rrggbb`.
#[pyfunction]
pub(crate) fn colour(kind: &str, period: u32) -> String {
    let colour = match kind {
        "periodic" => Colour::of_period(period),
        "quasi-periodic" => Colour::QUASI_PERIODIC,
        "chaotic" | "not-periodic" => Colour::IRREGULAR,
        "undecided" => Colour::UNDECIDED,
        _ => Colour::FAILED,
    };
    colour.hex()
}

/// Colours of attractors side by side, each with its kind and period.
#[pyfunction]
pub(crate) fn colours(attractors: Vec<(String, u32)>) -> Vec<String> {
    let kinds = attractors.iter().map(|(kind, period)| match kind.as_str() {
        "periodic" => MotionKind::Periodic(*period),
        "quasi-periodic" => MotionKind::QuasiPeriodic,
        _ => MotionKind::NotPeriodic,
    });
    let found = attractor_colours(kinds).into_iter();
    found
        .map(|colour| colour.unwrap_or(Colour::OTHER).hex())
        .collect()
}

/// Colours of attractors that keep their numbers along a parameter, in the order of these.
#[pyfunction]
pub(crate) fn palette() -> Vec<String> {
    Colour::ATTRACTORS.map(Colour::hex).to_vec()
}
