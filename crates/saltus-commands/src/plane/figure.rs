//! The figure of the continuous layers, and the classes of motion.

use super::{Layers, Plane, Status};
use saltus_results::{Axis, Class, ClassMap, Colour, Figure, Grid, ValueMap};

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

/// Periods with a class of their own.
const PERIODS: [u16; 8] = [1, 2, 3, 4, 5, 6, 8, 16];

/// Each pixel in the colour of its period, or of what it is without one; `chaotic` is said of chaos in the legend.
pub(crate) fn motions(
    grid: Grid,
    pixels: impl Iterator<Item = (Status, u16)>,
    chaotic: &str,
) -> ClassMap {
    let own = PERIODS.iter().map(|&n| {
        let label = match n {
            1 => "Every forcing period".to_owned(),
            n => format!("Every {n} periods"),
        };
        Class::new(label, Colour::of_period(n.into()))
    });
    let others = [
        Class::new("Another period up to 32", Colour::OTHER),
        Class::new("Quasi-periodic", Colour::QUASI_PERIODIC),
        Class::new(format!("Chaotic{chaotic}"), Colour::IRREGULAR),
        Class::new("Not periodic", Colour::IRREGULAR),
        Class::new("Undecided", Colour::UNDECIDED),
        Class::new("Failed", Colour::FAILED),
    ];
    let other = PERIODS.len() as u8;
    let class = |(status, period): (Status, u16)| match status {
        Status::Periodic => PERIODS
            .iter()
            .position(|&own| own == period)
            .map_or(other, |place| place as u8),
        Status::QuasiPeriodic => other + 1,
        Status::Chaotic => other + 2,
        Status::NotPeriodic => other + 3,
        Status::Undecided => other + 4,
        _ => other + 5,
    };
    let cells: Vec<u8> = pixels.map(class).collect();
    ClassMap::new("Long-term motion", grid, cells, own.chain(others))
}
