//! A key that goes from one value to another, as in `[sweep]`, `[map.x]` and `[continue]`.

use crate::Parameter;
use crate::error::{StudyError, StudyErrorKind};
use crate::fault::{Fault, wrong};
use crate::study::Study;

/// A parameter and its ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axis<'a> {
    /// The table of the axis, such as `map.x`.
    pub(crate) table: &'a str,
    pub(crate) parameter: &'a str,
    pub(crate) from: f64,
    pub(crate) to: f64,
    /// Keys of the two ends in the table.
    pub(crate) ends: Ends,
}

/// How a table gives the ends of its axis.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Ends {
    /// As `from` and `to`.
    Keys,
    /// As the first and the last of a list of this many `values`.
    Listed(usize),
}

/// The fault of a parameter, and what would be right.
pub(crate) type Refusal = [&'static str; 2];

impl Axis<'_> {
    fn fault(&self, key: &str, given: impl Into<toml::Value>, what: &str) -> Fault {
        wrong(&format!("{}.{key}", self.table), given, what)
    }

    /// Both ends, each with its key in the table.
    fn ends(&self) -> [(String, f64); 2] {
        let keys = match self.ends {
            Ends::Keys => ["from".to_owned(), "to".to_owned()],
            Ends::Listed(count) => [0, count.saturating_sub(1)].map(|i| format!("values.{i}")),
        };
        let [from, to] = keys;
        [(from, self.from), (to, self.to)]
    }

    /// The study's own value of the parameter, which must lie between the ends.
    pub(crate) fn own_value(&self, study: &Study) -> Result<f64, StudyError> {
        let Self {
            table, from, to, ..
        } = *self;
        let parameter = Parameter::parse(self.parameter)?;
        // a jumper that is not there is reported as for any other change
        parameter.apply(study, from)?;
        let (what, help) = match parameter.value(study) {
            None => (
                "the study gives no value to begin with".to_owned(),
                format!("give {parameter}, or name a key that the study gives"),
            ),
            Some(value) if parameter.apply(study, value)? != *study => (
                "the people differ in it, and one value to begin with is needed".to_owned(),
                "name the key of one of them, such as jumper.0.mass".to_owned(),
            ),
            Some(value) if !(from.min(to)..=from.max(to)).contains(&value) => (
                format!(
                    "the study's own value {value}, to begin with, lies outside {from} to {to}"
                ),
                format!("change {parameter}, {table}.from or {table}.to"),
            ),
            Some(value) => return Ok(value),
        };
        let key = format!("{table}.parameter");
        let message = format!("{key} = {:?}: {what}", self.parameter);
        Err(StudyError::new(StudyErrorKind::Value, message)
            .key_is(key)
            .help(help))
    }
}

/// Keys that hold numbers and are not refused, different ones, with two different ends at which the study is possible.
pub(crate) fn check(
    study: &Study,
    axes: &[Axis],
    refusal: impl Fn(&str) -> Option<Refusal>,
    faults: &mut Vec<Fault>,
) {
    let found = faults.len();
    for (i, axis) in axes.iter().enumerate() {
        faults.extend(name(axis, refusal(axis.parameter)));
        if axis.from == axis.to {
            let what = format!("a value different from {}.from is needed", axis.table);
            faults.push(axis.fault("to", axis.to, &what));
        }
        if let Some(other) = axes[..i].iter().find(|a| same(a.parameter, axis.parameter)) {
            let what = format!(
                "{}.parameter is the same; two different ones are needed",
                other.table
            );
            faults.push(axis.fault("parameter", axis.parameter, &what));
        }
    }
    if faults.len() == found {
        ends(study, axes, faults);
    }
}

/// For [`check`]: refuses keys that are no part of the system; `start` is the refusal of a number of `[start]`.
pub(crate) fn of_the_system(start: Refusal) -> impl Fn(&str) -> Option<Refusal> {
    move |given| match given.split('.').next() {
        Some("start") => Some(start),
        Some("solver") => Some([
            "the solver is not a part of the system",
            "name a number of the plate, the people, the base or gravity",
        ]),
        _ => None,
    }
}

/// A frequency in Hz and one as a ratio are the same parameter.
fn same(first: &str, second: &str) -> bool {
    first == second
        || [first, second]
            .iter()
            .all(|p| p.starts_with("base.frequency"))
}

fn name(axis: &Axis, refusal: Option<Refusal>) -> Option<Fault> {
    let (what, help) = match refusal {
        Some([what, help]) => (what.to_owned(), Some(help.to_owned())),
        None => {
            let error = Parameter::parse(axis.parameter).err()?;
            (error.to_string(), error.advice().map(str::to_owned))
        }
    };
    let fault = axis.fault("parameter", axis.parameter, &what);
    Some(Fault { help, ..fault })
}

/// The ends of the first axis, and at each of them those of the others.
fn ends(study: &Study, axes: &[Axis], faults: &mut Vec<Fault>) {
    let Some((axis, others)) = axes.split_first() else {
        return;
    };
    // without people the rest of the study is still good for the empty plate; the command refuses
    let nobody = study.jumper.is_empty();
    if nobody && axes.iter().any(|a| a.parameter.starts_with("jumper.")) {
        return;
    }
    for (end, value) in axis.ends() {
        match study.set(axis.parameter, value) {
            Ok(changed) => ends(&changed, others, faults),
            Err(error) => faults.push(Fault {
                help: error.advice().map(str::to_owned),
                ..axis.fault(&end, value, &error.to_string())
            }),
        }
    }
    faults.dedup();
}
