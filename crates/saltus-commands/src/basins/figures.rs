//! The figures of basins.

use super::Basins;
use crate::colours;
use crate::plane::Plane;
use saltus::orbits::MotionKind;
use saltus::study::Entry;
use saltus_results::{Class, ClassMap, Colour, Figure};

/// A colour for each attractor, as far as there are some.
pub(super) fn basins(plane: &Plane, basins: &Basins) -> Figure {
    // The colours that they have along the sweep of attractors, as far as there are some.
    let kinds = basins.attractors.iter().map(|entry| entry.attractor.kind);
    let colours = colours::of(kinds).into_iter().enumerate();
    let shown: Vec<(usize, Colour)> = colours
        .filter_map(|(place, colour)| {
            let identity = basins.identity(place);
            let own = identity.and_then(|identity| Colour::ATTRACTORS.get(identity));
            Some((place, own.copied().or(colour)?))
        })
        .collect();
    let named = shown
        .iter()
        .map(|&(place, colour)| Class::new(label(place, &basins.attractors[place]), colour));
    let others = [
        Class::new("Another attractor", Colour::OTHER),
        Class::new("Undecided", Colour::UNDECIDED),
        Class::new("Failed", Colour::FAILED),
    ];
    let other = shown.len() as u8;
    let class = |(pixel, &number): (usize, &u16)| match usize::from(number).checked_sub(1) {
        Some(wanted) => shown
            .iter()
            .position(|(place, _)| *place == wanted)
            .map_or(other, |place| place as u8),
        None if basins.layers.status[pixel].is_motion() => other + 1,
        None => other + 2,
    };
    let cells: Vec<u8> = basins.attractor.iter().enumerate().map(class).collect();
    let map = ClassMap::new(
        "Basins of attraction",
        plane.figure_grid(),
        cells,
        named.chain(others),
    );
    Figure::new(map.shares())
}

fn label(place: usize, entry: &Entry) -> String {
    let motion = &entry.attractor;
    let contact = motion.contact_ratio.first().copied().unwrap_or(f64::NAN);
    let what = match motion.kind {
        MotionKind::Periodic(1) => "every forcing period".to_owned(),
        MotionKind::Periodic(n) => format!("every {n} periods"),
        MotionKind::NotPeriodic | MotionKind::Undecided => "not periodic".to_owned(),
        kind => kind.name().to_owned(),
    };
    format!("{}: {what}, {:.0} % contact", place + 1, 100.0 * contact)
}
