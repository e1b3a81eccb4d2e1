//! Are the planes of `[map]` and `[basins]` possible ones?

use crate::axis;
use crate::structure::Fault;
use crate::study::Study;
use crate::values;

/// What a start is made of.
const STARTS: [&str; 2] = ["start.z", "start.v"];

/// Both parameters can vary over their ranges, together.
pub(crate) fn map(study: &Study, faults: &mut Vec<Fault>) {
    let Some(map) = &study.map else { return };
    let x = values::axis("map.x", &map.x, faults);
    let y = values::axis("map.y", &map.y, faults);
    let (Some(x), Some(y)) = (x, y) else { return };
    let refusal = axis::of_the_system([
        "a map begins every pixel from the same [start]",
        "a plane of first states is what [basins] is for",
    ]);
    axis::check(study, &[x, y], refusal, faults);
}

/// Both axes are numbers of the start, and not the same one.
pub(crate) fn basins(study: &Study, faults: &mut Vec<Fault>) {
    let Some(basins) = &study.basins else { return };
    let x = values::axis("basins.x", &basins.x, faults);
    let y = values::axis("basins.y", &basins.y, faults);
    let (Some(x), Some(y)) = (x, y) else { return };
    let refusal = |given: &str| {
        (!STARTS.contains(&given)).then_some([
            "\"start.z\" or \"start.v\" is needed",
            "a plane of two parameters of the system is what [map] is for",
        ])
    };
    axis::check(study, &[x, y], refusal, faults);
}
