//! The plane as a dataset for xarray and its like.

use super::{Layers, Plane, Status};
use crate::dataset::{about, coordinate, wholes};
use crate::per_jumper::column;
use saltus_config::Study;
use saltus_results::{Dataset, Variable};

/// Coordinates, and all layers over (y, x).
pub(crate) fn dataset(title: &str, study: &Study, plane: &Plane, layers: Layers) -> Dataset {
    let (x, y) = (plane.x.variable(), plane.y.variable());
    let over = [y.as_str(), x.as_str()];
    let jumpers = study.jumper.len();
    let status: Vec<u8> = layers.status.iter().map(|status| status.code()).collect();
    let period: Vec<u16> = layers.status.iter().map(|status| status.period()).collect();
    let chaotic = layers.chaotic_periods();
    let meanings = (0..).zip(Status::names().map(|name| name.replace('-', "_")));
    let mut dataset = about(title, study)
        .coordinate(coordinate(&plane.y.parameter, &plane.grid.y))
        .coordinate(coordinate(&plane.x.parameter, &plane.grid.x))
        .variable(
            Variable::new("period", &over, period)
                .long_name(
                    "Period of the attractor in forcing periods, 0 where it has none up to 32",
                )
                .units("1"),
        )
        .variable(
            Variable::new("status", &over, status)
                .long_name("What became of the motion")
                .flags(meanings),
        )
        .variable(
            Variable::new("peak_acceleration", &over, layers.peak_acceleration)
                .long_name(
                    "Largest absolute vertical acceleration of the floor under the first jumper",
                )
                .units("m s-2"),
        );
    let exponents = [
        (
            "exponent",
            "Largest Lyapunov exponent per forcing period, where it says what the motion is",
            layers.exponent,
        ),
        (
            "exponent_error",
            "Standard error of exponent",
            layers.exponent_error,
        ),
    ];
    for (name, long_name, values) in exponents {
        dataset = dataset.variable(
            Variable::new(name, &over, values)
                .long_name(long_name)
                .units("1"),
        );
    }
    let ratios = layers.contact_ratio.into_iter().zip(layers.peak_reaction);
    for (jumper, (contact, reaction)) in ratios.enumerate() {
        let contact = Variable::new(column("contact_ratio", jumper, jumpers), &over, contact);
        let reaction = Variable::new(column("peak_reaction", jumper, jumpers), &over, reaction);
        dataset = dataset
            .variable(
                contact
                    .long_name("Part of the time on the floor")
                    .units("1"),
            )
            .variable(
                reaction
                    .long_name("Largest plate reaction force over the jumper's weight")
                    .units("1"),
            );
    }
    let counts = [
        (
            "periods_run",
            "Forcing periods computed",
            layers.periods_run,
        ),
        (
            "chaotic_periods",
            "Forcing periods over which a chaotic motion was seen not to settle, 0 where it is not chaotic",
            chaotic,
        ),
    ];
    counts
        .into_iter()
        .fold(dataset, |set, (name, meaning, counts)| {
            let counts: Vec<i32> = wholes(counts);
            set.variable(
                Variable::new(name, &over, counts)
                    .long_name(meaning)
                    .units("1"),
            )
        })
}
