//! Are the questions of `[orbit]`, `[continue]` and `[attractors]` possible ones?

use crate::axis::{self, Axis, Ends};
use crate::error::StudyError;
use crate::structure::{Fault, description};
use crate::study::{AxisTable, ContinueTable, SecondTable, Study};
use crate::validate::{key, wrong};
use crate::values;

/// No more segments than periods, where these are known.
pub(crate) fn orbit(study: &Study, faults: &mut Vec<Fault>) {
    let orbit = &study.orbit;
    if orbit.period > 0 && orbit.segments > orbit.period {
        let what = format!("at most orbit.period = {} are needed", orbit.period);
        faults.push(wrong("orbit.segments", orbit.segments, &what));
    }
}

/// The parameters of `[continue]` can vary over their ranges, together, and the curves have possible names.
pub(crate) fn branches(study: &Study, faults: &mut Vec<Fault>) {
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
pub(crate) fn attractors(study: &Study, faults: &mut Vec<Fault>) {
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
