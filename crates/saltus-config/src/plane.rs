//! Are the planes of `[map]` and `[basins]` possible ones?

use crate::structure::Fault;
use crate::study::{AxisTable, Study};
use crate::validate::{parameter, wrong};

/// What a start is made of.
const STARTS: [&str; 2] = ["start.z", "start.v"];

/// Both parameters can vary over their ranges, together.
pub(crate) fn map(study: &Study, faults: &mut Vec<Fault>) {
    let Some(map) = &study.map else { return };
    let found = faults.len();
    let axes = [("map.x", &map.x), ("map.y", &map.y)];
    axis_names(axes, faults);
    for (name, axis) in axes {
        let key = format!("{name}.parameter");
        let given = axis.parameter.as_str();
        if STARTS.contains(&given) {
            let mut fault = wrong(
                &key,
                given,
                "a map begins every pixel from the same [start]",
            );
            fault.help = Some("a plane of first states is what [basins] is for".to_owned());
            faults.push(fault);
        } else if given.starts_with("solver.") {
            faults.push(wrong(&key, given, "the solver is not a part of the system"));
        }
    }
    if faults.len() == found {
        corners(study, axes, faults);
    }
}

/// Both axes are numbers of the start, and not the same one.
pub(crate) fn basins(study: &Study, faults: &mut Vec<Fault>) {
    let Some(basins) = &study.basins else { return };
    let found = faults.len();
    let axes = [("basins.x", &basins.x), ("basins.y", &basins.y)];
    for (name, axis) in axes {
        let given = axis.parameter.as_str();
        if !STARTS.contains(&given) {
            let key = format!("{name}.parameter");
            let mut fault = wrong(&key, given, "\"start.z\" or \"start.v\" is needed");
            fault.help =
                Some("a plane of two parameters of the system is what [map] is for".to_owned());
            faults.push(fault);
        }
    }
    if faults.len() == found {
        axis_names(axes, faults);
    }
    if faults.len() == found {
        corners(study, axes, faults);
    }
}

/// Keys that hold numbers, two different ones, and more than one value of each.
fn axis_names(axes: [(&str, &AxisTable); 2], faults: &mut Vec<Fault>) {
    for (name, axis) in axes {
        faults.extend(parameter(&format!("{name}.parameter"), &axis.parameter).err());
        if axis.from == axis.to {
            let what = format!("a value different from {name}.from is needed");
            faults.push(wrong(&format!("{name}.to"), axis.to, &what));
        }
    }
    let [(first, x), (second, y)] = axes;
    if x.parameter == y.parameter {
        let what = format!("{first}.parameter is the same; two different ones are needed");
        let key = format!("{second}.parameter");
        faults.push(wrong(&key, y.parameter.as_str(), &what));
    }
}

/// The ends of one axis, at the ends of the other.
fn corners(study: &Study, axes: [(&str, &AxisTable); 2], faults: &mut Vec<Fault>) {
    let [(first, x), (second, y)] = axes;
    // without people the rest of the study is still good for the empty plate; the command refuses
    let people = |axis: &AxisTable| axis.parameter.starts_with("jumper.");
    if study.jumper.is_empty() && (people(x) || people(y)) {
        return;
    }
    let blamed = |name: String, value: f64, error: &crate::StudyError| {
        let mut fault = wrong(&name, value, &error.to_string());
        fault.help = error.advice().map(str::to_owned);
        fault
    };
    for (x_end, x_value) in [("from", x.from), ("to", x.to)] {
        let column = match study.set(&x.parameter, x_value) {
            Ok(column) => column,
            Err(error) => {
                faults.push(blamed(format!("{first}.{x_end}"), x_value, &error));
                continue;
            }
        };
        for (y_end, y_value) in [("from", y.from), ("to", y.to)] {
            if let Err(error) = column.set(&y.parameter, y_value) {
                faults.push(blamed(format!("{second}.{y_end}"), y_value, &error));
            }
        }
    }
    faults.dedup();
}
