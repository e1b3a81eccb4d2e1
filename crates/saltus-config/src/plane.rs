//! Are the planes of `[map]` and `[basins]` possible ones?

use crate::axis::{self, Axis};
use crate::structure::Fault;
use crate::study::Study;

/// What a start is made of.
const STARTS: [&str; 2] = ["start.z", "start.v"];

/// Both parameters can vary over their ranges, together.
pub(crate) fn map(study: &Study, faults: &mut Vec<Fault>) {
    let Some(map) = &study.map else { return };
    let axes = [Axis::of("map.x", &map.x), Axis::of("map.y", &map.y)];
    let refusal = axis::of_the_system([
        "a map begins every pixel from the same [start]",
        "a plane of first states is what [basins] is for",
    ]);
    axis::check(study, &axes, refusal, faults);
}

/// Both axes are numbers of the start, and not the same one.
pub(crate) fn basins(study: &Study, faults: &mut Vec<Fault>) {
    let Some(basins) = &study.basins else { return };
    let axes = [
        Axis::of("basins.x", &basins.x),
        Axis::of("basins.y", &basins.y),
    ];
    let refusal = |given: &str| {
        (!STARTS.contains(&given)).then_some([
            "\"start.z\" or \"start.v\" is needed",
            "a plane of two parameters of the system is what [map] is for",
        ])
    };
    axis::check(study, &axes, refusal, faults);
}
