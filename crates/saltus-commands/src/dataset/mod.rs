//! What the datasets of all commands share: attributes, coordinates that count, words as flags, units.

pub(crate) mod motion;

use crate::words::capitalized;
use saltus_config::{Parameter, Study};
use saltus_results::{Dataset, Values, Variable};

/// A dataset that says where it comes from.
pub(crate) fn about(title: &str, study: &Study) -> Dataset {
    Dataset::new(title)
        .header("source", format!("saltus {}", env!("CARGO_PKG_VERSION")))
        .header("study", study.to_toml())
        .header("study_sha256", study.hash())
}

/// A variable with what a reader needs to know of it.
pub(crate) fn variable(
    name: impl Into<String>,
    over: &[&str],
    values: impl Into<Values>,
    (long_name, units): (&str, &str),
) -> Variable {
    Variable::new(name, over, values)
        .long_name(long_name)
        .units(units)
}

/// A dimension whose places are numbered from `first` on.
pub(crate) fn numbered(name: &str, first: i32, length: usize, long_name: &str) -> Variable {
    let numbers: Vec<i32> = (first..).take(length).collect();
    Variable::coordinate(name, numbers)
        .long_name(long_name)
        .units("1")
}

/// Whole numbers.
pub(crate) fn wholes<N: TryInto<i32>>(numbers: impl IntoIterator<Item = N>) -> Vec<i32> {
    let whole = |number: N| number.try_into().unwrap_or(i32::MAX);
    numbers.into_iter().map(whole).collect()
}

/// Texts.
pub(crate) fn texts<'a>(texts: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    texts.into_iter().map(str::to_owned).collect()
}

/// Each word as its place among those `known`.
pub(crate) fn words<'a>(
    name: impl Into<String>,
    over: &[&str],
    known: &[&str],
    words: impl IntoIterator<Item = &'a str>,
    long_name: &str,
) -> Variable {
    let place = |word| known.iter().position(|&other| other == word);
    let code = |word| place(word).map_or(u8::MAX, |code| code as u8);
    let codes: Vec<u8> = words.into_iter().map(code).collect();
    let meanings = (0..).zip(known.iter().map(|word| word.replace('-', "_")));
    Variable::new(name, over, codes)
        .long_name(long_name)
        .flags(meanings)
}

/// So many of `values` as there are, and NaN up to `length`.
pub(crate) fn padded(values: &[f64], length: usize) -> impl Iterator<Item = f64> {
    let missing = length.saturating_sub(values.len());
    let missing = std::iter::repeat_n(f64::NAN, missing);
    values.iter().copied().take(length).chain(missing)
}

/// Name of a variable with the values of a parameter: `jumper_damping_ratio`.
pub(crate) fn name(parameter: &Parameter) -> String {
    parameter.key().replace('.', "_")
}

/// Values of a parameter.
pub(crate) fn values(
    variable_name: impl Into<String>,
    over: &[&str],
    parameter: &Parameter,
    values: Vec<f64>,
) -> Variable {
    let label = parameter.label();
    let unit = format!(" ({})", parameter.unit());
    let words = capitalized(label.strip_suffix(&unit).unwrap_or(&label));
    let meaning = (words.as_str(), units(parameter.unit()));
    variable(variable_name, over, values, (meaning.0, &meaning.1))
        .attribute("study_key", parameter.key())
}

/// Values of a parameter as a coordinate of its own name.
pub(crate) fn coordinate(parameter: &Parameter, along: &[f64]) -> Variable {
    let name = name(parameter);
    values(name.clone(), &[&name], parameter, along.to_vec())
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
