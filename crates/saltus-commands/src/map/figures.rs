//! The figures of a map.

use crate::plane::{Layers, Plane, Status};
use saltus::orbits::MotionKind;
use saltus_results::{Class, ClassMap, Colour, Figure};

/// Periods with a colour of their own: doublings first, as they are the most frequent.
const PERIODS: [u32; 9] = [1, 2, 4, 8, 3, 6, 5, 7, 16];

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
    let chaotic = match layers.tally().chaotic_over {
        Some(span) => format!("Chaotic for {} periods and more", span.min),
        None => "Chaotic".to_owned(),
    };
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
    let class = |status: &Status| match status {
        Status::Motion(MotionKind::Periodic(n)) => order
            .iter()
            .position(|&i| PERIODS[i] == *n)
            .map_or(other, |place| place as u8),
        Status::Motion(MotionKind::QuasiPeriodic) => other + 1,
        Status::Motion(MotionKind::Chaotic) => other + 2,
        Status::Motion(MotionKind::NotPeriodic) => other + 3,
        Status::Motion(MotionKind::Undecided) => other + 4,
        Status::Lost(_) => other + 5,
    };
    let cells: Vec<u8> = layers.status.iter().map(class).collect();
    let map = ClassMap::new(
        "The motion repeats",
        plane.figure_grid(),
        cells,
        own.chain(others),
    );
    Figure::new(map.shares())
}
