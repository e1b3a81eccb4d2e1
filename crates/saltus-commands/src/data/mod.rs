//! Parts that the data of several questions have: where it comes from, parameters as axes, whole numbers, gaps.

mod listed;
pub(crate) mod motion;

pub(crate) use listed::Listed;

use crate::quantities as q;
use crate::words::capitalized;
use saltus::model::Model;
use saltus_config::{Parameter, Study};
use saltus_results::{Dataset, Quantity, Table, Variable};
use std::f64::consts::TAU;

/// A dataset that says where it comes from.
pub(crate) fn about(title: &str, study: &Study) -> Dataset {
    Dataset::new(title)
        .header("source", format!("saltus {}", env!("CARGO_PKG_VERSION")))
        .header("study", study.to_toml())
        .header("study_sha256", study.hash())
}

/// Whole numbers; those beyond the type are its largest.
pub(crate) fn wholes<N: TryInto<i32>>(numbers: impl IntoIterator<Item = N>) -> Vec<i32> {
    let whole = |number: N| number.try_into().unwrap_or(i32::MAX);
    numbers.into_iter().map(whole).collect()
}

/// A single whole number.
pub(crate) fn whole<N: TryInto<i64>>(number: N) -> i64 {
    number.try_into().unwrap_or(i64::MAX)
}

/// Texts.
pub(crate) fn texts<'a>(texts: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    texts.into_iter().map(str::to_owned).collect()
}

/// The first `length` of `values`, and NaN where there are fewer.
pub(crate) fn padded(values: &[f64], length: usize) -> impl Iterator<Item = f64> {
    let missing = length.saturating_sub(values.len());
    let missing = std::iter::repeat_n(f64::NAN, missing);
    values.iter().copied().take(length).chain(missing)
}

/// Frequency and period of the base, single values.
pub(crate) fn base(set: Dataset, model: &Model) -> Dataset {
    let scales = model.scales();
    set.variable(q::BASE_FREQUENCY.is(scales.omega / TAU))
        .variable(q::FORCING_PERIOD.is(scales.period()))
}

/// The parameter that changes, as attributes.
pub(crate) fn parameter(set: Dataset, parameter: &Parameter) -> Dataset {
    parameter_of(set, "", parameter)
}

/// One of several parameters that change; names begin with `prefix`.
pub(crate) fn parameter_of(set: Dataset, prefix: &str, parameter: &Parameter) -> Dataset {
    set.attribute(format!("{prefix}parameter"), parameter.key())
        .attribute(format!("{prefix}unit"), parameter.unit())
        .attribute(format!("{prefix}label"), parameter.label())
}

/// Units of height of each person (m), at each value of the parameter that changes; NaN at a value that the study does
/// not allow.
pub(crate) fn eta(study: &Study, along: Option<(&Parameter, &[f64])>) -> Vec<f64> {
    let of = |study: &Study| -> Vec<f64> {
        let gravity = study.gravity.acceleration;
        let people = study.jumpers();
        people
            .iter()
            .map(|person| person.static_compression(gravity))
            .collect()
    };
    let at = |parameter: &Parameter, value: f64| match parameter.apply(study, value) {
        Ok(study) => of(&study),
        Err(_) => vec![f64::NAN; study.jumper.len()],
    };
    match along {
        None => of(study),
        Some((parameter, values)) => values
            .iter()
            .flat_map(|&value| at(parameter, value))
            .collect(),
    }
}

/// Name of the variable with the values of a parameter, and of the column: `jumper_damping_ratio`.
pub(crate) fn name(parameter: &Parameter) -> String {
    parameter.key().replace('.', "_")
}

/// Values of a parameter over `axes`, named after it.
pub(crate) fn values(parameter: &Parameter, axes: &[&str], values: Vec<f64>) -> Variable {
    let label = parameter.label();
    let unit = format!(" ({})", parameter.unit());
    let meaning = capitalized(label.strip_suffix(&unit).unwrap_or(&label));
    let variable = Variable::new(name(parameter), axes, values).long_name(meaning);
    in_unit_of(parameter, variable)
}

/// Gives values of a parameter its unit, and says which parameter it is.
pub(crate) fn in_unit_of(parameter: &Parameter, variable: Variable) -> Variable {
    variable
        .units(units(parameter.unit()))
        .attribute("study_key", parameter.key())
}

/// Values of a parameter as a coordinate.
pub(crate) fn coordinate(parameter: &Parameter, along: &[f64]) -> Variable {
    values(parameter, &[&name(parameter)], along.to_vec())
}

/// Endings of the columns of each person: none for one, `_0`, `_1`, ... for several.
pub(crate) fn each_jumper(jumpers: usize) -> Vec<String> {
    match jumpers {
        1 => vec![String::new()],
        _ => (0..jumpers).map(|jumper| format!("_{jumper}")).collect(),
    }
}

/// Endings of the columns of numbers that are counted from 1: `_1`, `_2`, ...
pub(crate) fn each_number(count: usize) -> Vec<String> {
    (1..=count).map(|number| format!("_{number}")).collect()
}

/// Endings of the columns of the plate's transverse terms: `_1_1`, `_1_3`, ...
pub(crate) fn each_term(model: &Model) -> Vec<String> {
    let terms = model.setup().plate.modes.w.iter();
    terms.map(|w| format!("_{}_{}", w.m, w.n)).collect()
}

/// A quantity, and how to take it.
pub(crate) type Of<T, N> = (Quantity, fn(&T) -> N);

/// Adds columns whose titles leave out a prefix of their variables.
pub(crate) fn without(prefix: &str, table: Table, titles: &[&str]) -> Table {
    let add = |table: Table, title: &&str| table.titled(*title, format!("{prefix}{title}"));
    titles.iter().fold(table, add)
}

/// A unit as UDUNITS spells it.
fn units(unit: &str) -> String {
    match unit {
        "-" => "1".to_owned(),
        other => other
            .replace('²', "2")
            .replace('³', "3")
            .split_once('/')
            .map_or(other.to_owned(), |(above, below)| {
                let digits = below.trim_start_matches(char::is_alphabetic);
                let power = if digits.is_empty() { "1" } else { digits };
                let name = below.trim_end_matches(char::is_numeric);
                format!("{above} {name}-{power}")
            }),
    }
}

#[cfg(test)]
mod tests {
    use super::units;

    #[test]
    fn units_are_spelt_for_udunits() {
        for (ours, theirs) in [
            ("-", "1"),
            ("m", "m"),
            ("Hz", "Hz"),
            ("N/m", "N m-1"),
            ("kg/m³", "kg m-3"),
            ("m/s²", "m s-2"),
        ] {
            assert_eq!(units(ours), theirs);
        }
    }
}
