//! Questions of a study: sweep, planes, orbits, branches and attractors. Each must be possible for its system.

use crate::axis::{self, Axis, Ends};
use crate::error::StudyError;
use crate::fault::{Fault, key, refuse, wrong};
use crate::schema::description;
use crate::study::{AxisTable, ContinueTable, Direction, SecondTable, Study};
use crate::validate;
use crate::values;

/// Keys of a start.
const STARTS: [&str; 2] = ["start.z", "start.v"];

impl Study {
    /// Checks every range and what keys say about each other; [`parse`](crate::parse) does so too.
    ///
    /// # Errors
    /// A [`StudyError`] that names the key.
    pub fn validate(&self) -> Result<(), StudyError> {
        refuse(faults(self))
    }
}

/// All faults of the study.
pub(crate) fn faults(study: &Study) -> Vec<Fault> {
    let mut faults = validate::faults_of_system(study);
    // the ends of a parameter are tried on a study that is itself sound
    if faults.is_empty() {
        simulate(study, &mut faults);
        sweep(study, &mut faults);
        map(study, &mut faults);
        basins(study, &mut faults);
        orbit(study, &mut faults);
        branches(study, &mut faults);
        attractors(study, &mut faults);
    }
    faults
}

/// Times of a time history ascend.
fn simulate(study: &Study, faults: &mut Vec<Fault>) {
    let times = study.simulate.times.as_deref().unwrap_or_default();
    let wrong_pair = times.windows(2).position(|pair| pair[0] >= pair[1]);
    faults.extend(wrong_pair.map(|before| {
        let what = format!(
            "a time after the one before it, {:?}, is needed",
            times[before]
        );
        let at = format!("simulate.times.{}", before + 1);
        wrong(&at, times[before + 1], &what)
    }));
}

/// The parameter can vary over its values, and restarts have initial conditions.
fn sweep(study: &Study, faults: &mut Vec<Fault>) {
    let Some(sweep) = &study.sweep else { return };
    if let Some(axis) = values::axis("sweep", &sweep.axis(), faults) {
        axis::check(study, &[axis], |_| None, faults);
    }
    starts(sweep.direction, &sweep.starts, faults);
}

fn starts(direction: Direction, starts: &[[f64; 2]], faults: &mut Vec<Fault>) {
    if direction == Direction::Restarts && starts.is_empty() {
        let key = key("sweep.starts");
        let help = description(&key).map(|d| format!("direction \"restarts\" needs it: {d}"));
        faults.push(Fault::missing(&key, help));
    }
    for (i, start) in starts.iter().enumerate() {
        for (k, &value) in start.iter().enumerate() {
            if !(-1e6..=1e6).contains(&value) {
                faults.push(wrong(
                    &format!("sweep.starts.{i}.{k}"),
                    value,
                    "a number from -1e6 to 1e6 is needed",
                ));
            }
        }
    }
}

/// Both parameters can vary over their ranges, together.
fn map(study: &Study, faults: &mut Vec<Fault>) {
    let Some(map) = &study.map else { return };
    let x = values::axis("map.x", &map.x, faults);
    let y = values::axis("map.y", &map.y, faults);
    let (Some(x), Some(y)) = (x, y) else { return };
    let refusal = axis::of_the_system([
        "a map begins every pixel from the same [start]",
        "a plane of initial conditions is what [basins] is for",
    ]);
    axis::check(study, &[x, y], refusal, faults);
}

/// Both axes are numbers of the start, and not the same one.
fn basins(study: &Study, faults: &mut Vec<Fault>) {
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

/// No more segments than periods, where these are known.
fn orbit(study: &Study, faults: &mut Vec<Fault>) {
    let orbit = &study.orbit;
    if orbit.period > 0 && orbit.segments > orbit.period {
        let what = format!("at most orbit.period = {} are needed", orbit.period);
        faults.push(wrong("orbit.segments", orbit.segments, &what));
    }
}

/// The parameters of `[continue]` can vary over their ranges, together, and the curves have possible names.
fn branches(study: &Study, faults: &mut Vec<Fault>) {
    let Some(table) = &study.continuation else {
        return;
    };
    let second = table.second.as_ref();
    let axes: Vec<Axis> = [table.axis()]
        .into_iter()
        .chain(second.map(SecondTable::axis))
        .collect();
    let refusal = axis::of_the_system([
        "an orbit closes whatever the start is",
        "[start] is where the search for the first orbit begins; name a number of the system",
    ]);
    axis::check(study, &axes, refusal, faults);
    for (i, curve) in second.iter().flat_map(|s| &s.curves).enumerate() {
        if !is_label(curve) {
            let at = format!("continue.second.curves.{i}");
            let what = "a kind such as \"PD\" or a label such as \"PD1\" is needed";
            faults.push(wrong(&at, curve.as_str(), what));
        }
    }
}

/// Letters, and a number if one point is meant.
fn is_label(text: &str) -> bool {
    let kind = text.trim_end_matches(|c: char| c.is_ascii_digit());
    !kind.is_empty() && kind.bytes().all(|b| b.is_ascii_alphabetic())
}

/// Ranges go upwards, and the sweep is whole and possible, or not there.
fn attractors(study: &Study, faults: &mut Vec<Fault>) {
    let table = &study.attractors;
    for (name, range) in [("attractors.z", table.z), ("attractors.v", table.v)] {
        if range[0] > range[1] {
            let given = toml::Value::Array(range.map(toml::Value::from).to_vec());
            faults.push(wrong(name, given, "[lowest, highest] is needed"));
        }
    }
    let axis = table.axis();
    if axis == AxisTable::default() {
        return;
    }
    let found = faults.len();
    if table.parameter.is_none() {
        let key = key("attractors.parameter");
        let help = description(&key).map(|d| format!("a sweep needs parameter: {d}"));
        faults.push(Fault::missing(&key, help));
    }
    let axis = values::axis("attractors", &axis, faults);
    if let Some(axis) = axis.filter(|_| faults.len() == found) {
        let refusal = axis::of_the_system([
            "the starts are drawn, not swept",
            "attractors.z and attractors.v say from where; name a number of the system",
        ]);
        axis::check(study, &[axis], refusal, faults);
    }
}

impl ContinueTable {
    fn axis(&self) -> Axis<'_> {
        Axis {
            table: "continue",
            parameter: &self.parameter,
            from: self.from,
            to: self.to,
            ends: Ends::Keys,
        }
    }

    /// The value at which the first orbit is sought: the study's own.
    ///
    /// # Errors
    /// [`StudyError`] if the study gives the parameter no value, or different ones for different people, or
    /// one outside `from` to `to`. A study may do so, being good for other questions.
    pub fn start(&self, study: &Study) -> Result<f64, StudyError> {
        self.axis().own_value(study)
    }
}

impl SecondTable {
    fn axis(&self) -> Axis<'_> {
        Axis {
            table: "continue.second",
            parameter: &self.parameter,
            from: self.from,
            to: self.to,
            ends: Ends::Keys,
        }
    }

    /// The value at which every curve begins: the study's own.
    ///
    /// # Errors
    /// As [`ContinueTable::start`].
    pub fn start(&self, study: &Study) -> Result<f64, StudyError> {
        self.axis().own_value(study)
    }
}
