//! The figure of the continuous layers.

use super::{Layers, Plane};
use saltus_results::{Axis, Figure, ValueMap};

/// The continuous layers, of the first jumper.
pub(crate) fn layers_figure(plane: &Plane, layers: &Layers) -> Figure {
    let map = |title: &str, values: Vec<f64>, label: &str| {
        let bar = Axis::new(label);
        ValueMap::new(title, plane.figure_grid(), values, bar)
            .missing("No motion")
            .into()
    };
    let first = |list: &[Vec<f64>]| list.first().cloned().unwrap_or_default();
    let run = layers.periods_run.iter().map(|&n| f64::from(n)).collect();
    let panels = [
        map(
            "Peak floor acceleration",
            layers.peak_acceleration.clone(),
            "Largest |acceleration| under the jumper (m/s²)",
        ),
        map(
            "Peak reaction",
            first(&layers.peak_reaction),
            "Largest reaction (body weights)",
        ),
        map(
            "Contact",
            first(&layers.contact_ratio),
            "Part of the time on the floor",
        ),
        map("Computed", run, "Forcing periods run"),
    ];
    Figure::grid(2, panels)
}
