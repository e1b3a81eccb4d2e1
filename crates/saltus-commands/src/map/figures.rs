//! The figures of a map.

use crate::plane::{Layers, Plane, Status};
use saltus_results::{Class, ClassMap, Colour, Figure};

/// Periods with a colour of their own: doublings first, as they are the most frequent.
const PERIODS: [u16; 9] = [1, 2, 4, 8, 3, 6, 5, 7, 16];

/// The periods, and what is not periodic.
pub(super) fn periods(plane: &Plane, layers: &Layers) -> Figure {
    let mut order: Vec<usize> = (0..PERIODS.len()).collect();
    order.sort_by_key(|&i| PERIODS[i]);
    let own = order.iter().map(|&i| {
        let n = PERIODS[i];
        let label = match n {
            1 => "Every forcing period".to_owned(),
            n => format!("Every {n} periods"),
        };
        Class::new(label, Colour::SERIES[i])
    });
    let chaotic = format!("Chaotic{}", layers.tally().chaotic_for());
    let others = [
        Class::new("Another period up to 32", Colour::OTHER),
        // the colour that the periods leave
        Class::new("Quasi-periodic", Colour::SERIES[PERIODS.len()]),
        Class::new(chaotic, Colour::IRREGULAR),
        Class::new("Not periodic", Colour::IRREGULAR),
        Class::new("Undecided", Colour::UNDECIDED),
        Class::new("Failed", Colour::FAILED),
    ];
    let other = PERIODS.len() as u8;
    let class = |(&status, &period): (&Status, &u16)| match status {
        Status::Periodic => order
            .iter()
            .position(|&i| PERIODS[i] == period)
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
        "The motion repeats",
        plane.figure_grid(),
        cells,
        own.chain(others),
    );
    Figure::new(map.shares())
}
