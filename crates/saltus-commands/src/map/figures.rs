//! The figure of a map.

use crate::plane::{Layers, Plane, motions};
use saltus_results::Figure;

/// The periods, and what is not periodic.
pub(super) fn periods(plane: &Plane, layers: &Layers) -> Figure {
    let pixels = layers
        .status
        .iter()
        .copied()
        .zip(layers.period.iter().copied());
    let chaotic = layers.tally().chaotic_for();
    Figure::new(motions(plane.figure_grid(), pixels, &chaotic).shares())
}
