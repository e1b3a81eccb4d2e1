//! The figures of a map.

use crate::plane::{Layers, Plane, Status};
use saltus_results::{Class, ClassMap, Colour, Figure};

/// Periods with a class of their own.
const PERIODS: [u16; 8] = [1, 2, 3, 4, 5, 6, 8, 16];

/// The periods, and what is not periodic.
pub(super) fn periods(plane: &Plane, layers: &Layers) -> Figure {
    let own = PERIODS.iter().map(|&n| {
        let label = match n {
            1 => "Every forcing period".to_owned(),
            n => format!("Every {n} periods"),
        };
        Class::new(label, Colour::of_period(n.into()))
    });
    let chaotic = format!("Chaotic{}", layers.tally().chaotic_for());
    let others = [
        Class::new("Another period up to 32", Colour::OTHER),
        Class::new("Quasi-periodic", Colour::QUASI_PERIODIC),
        Class::new(chaotic, Colour::IRREGULAR),
        Class::new("Not periodic", Colour::IRREGULAR),
        Class::new("Undecided", Colour::UNDECIDED),
        Class::new("Failed", Colour::FAILED),
    ];
    let other = PERIODS.len() as u8;
    let class = |(&status, &period): (&Status, &u16)| match status {
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
    let cells: Vec<u8> = layers
        .status
        .iter()
        .zip(&layers.period)
        .map(class)
        .collect();
    let map = ClassMap::new(
        "Long-term motion",
        plane.figure_grid(),
        cells,
        own.chain(others),
    );
    Figure::new(map.shares())
}
