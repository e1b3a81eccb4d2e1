//! Summary of `saltus lyapunov` for people.

use super::{Found, words};
use crate::status;
use saltus::hybrid::Status;
use saltus::orbits::{Exponent, MotionKind};
use std::f64::consts::TAU;
use std::fmt::Write;

/// A sum that is further from the divergence than this (per period) is reported as wrong: far above what tolerances
/// leave, far below any exponent of interest.
const AGREE: f64 = 1e-6;

pub(super) fn text(found: &Found) -> String {
    let mut text = String::new();
    let mut line = |name: &str, what: String| {
        // writing to a string cannot fail
        let _ = writeln!(text, "{name:<12}{what}");
    };
    let (growth, kind, scales) = (&found.growth, found.verdict.kind, found.model.scales());
    if growth.status != Status::Completed {
        line("status", status::text(&growth.status, None));
    }
    let sure = words::percent(found.verdict.confidence);
    line(
        "motion",
        match kind {
            MotionKind::Undecided => kind.name().to_owned(),
            _ => format!("{}, with a confidence of {sure}", kind.name()),
        },
    );
    line("", words::meaning(&found.verdict));
    let (hertz, period) = (scales.omega / TAU, scales.period());
    line("base", format!("{hertz:.4} Hz, period {period:.6} s"));
    line("record", record(found));
    line(
        "exponents",
        match found.source() {
            "orbit" => "of the multipliers of the orbit that the motion has come to".to_owned(),
            _ => "means of the record, with one standard error; nearly twice that holds 95 %"
                .to_owned(),
        },
    );
    line("dimension", dimension(found));
    line("sum", sum(found));
    text.push_str(&spectrum(found));
    text
}

fn record(found: &Found) -> String {
    let (how, measured) = (&found.how, found.growth.spectrum.iterates());
    format!(
        "{} x {} forcing periods after {} left out, {measured} measured",
        how.replicas, how.periods, how.transient
    )
}

fn dimension(found: &Found) -> String {
    found.growth.spectrum.kaplan_yorke().map_or_else(
        || "unknown: more exponents or a longer record are needed".to_owned(),
        |found| {
            let value = with_error(found.value, found.standard_error, "+-");
            format!("{value} (Kaplan-Yorke)")
        },
    )
}

fn sum(found: &Found) -> String {
    let sum = found.growth.sum();
    let check = match found.difference() {
        None => format!("not to be compared, {}", found.check().1),
        Some(off) if off.abs() <= AGREE => format!("the same to {:.0e}, as it must be", off.abs()),
        Some(off) => format!("wrong by {off:.1e}: a smaller solver.tolerance may help"),
    };
    format!(
        "{} per period; mean divergence {:.6}: {check}",
        with_error(sum.per_iterate, sum.standard_error, "+-"),
        found.growth.divergence()
    )
}

fn spectrum(found: &Found) -> String {
    let mut text = format!("\n{:<12}{:<31}per second\n", "exponent", "per period");
    let period = found.model.scales().period();
    for (index, exponent) in found.growth.exponents().iter().enumerate() {
        let line = format!("{:>8}{}", index + 1, columns(exponent, period));
        let _ = writeln!(text, "{}", line.trim_end());
    }
    text
}

/// Both units, with decimal points below each other.
fn columns(exponent: &Exponent, period: f64) -> String {
    let (value, error) = (exponent.per_iterate, exponent.standard_error);
    let pairs = [(value, error), (value / period, error / period)];
    let column = |(value, error)| {
        let [value, error] = rounded(value, error);
        let (whole, decimals) = value.split_at(value.find('.').unwrap_or(value.len()));
        let sign = if error.is_empty() { "" } else { "+-" };
        format!("{whole:>6}{decimals:<10}{sign:<3}{error:<12}")
    };
    pairs.map(column).concat()
}

/// As `0.1234 +- 0.0012`, with `sign` between them; the value alone if it has no error.
pub(super) fn with_error(value: f64, error: f64, sign: &str) -> String {
    let [value, error] = rounded(value, error);
    match error.as_str() {
        "" => value,
        _ => format!("{value} {sign} {error}"),
    }
}

/// A value and its error to two digits of the error, or its power of ten where it is tiny; an error of 0 is none.
fn rounded(value: f64, error: f64) -> [String; 2] {
    if error == 0.0 {
        return [format!("{value}"), String::new()];
    }
    if error.is_infinite() {
        return [format!("{value:.4}"), "unknown".to_owned()];
    }
    let decimals = (1.0 - error.log10().floor()).clamp(0.0, 8.0) as usize;
    let error = match error {
        _ if error < 1e-7 => format!("{error:.0e}"),
        _ => format!("{error:.decimals$}"),
    };
    [format!("{value:.decimals$}"), error]
}

#[cfg(test)]
mod tests {
    use super::with_error;

    #[test]
    fn digits_end_where_the_error_begins() {
        for (value, error, shown) in [
            (0.123_456, 0.001_234, "0.1235 +- 0.0012"),
            (-12.34, 1.9, "-12.3 +- 1.9"),
            (-0.5, 2e-13, "-0.50000000 +- 2e-13"),
            (f64::NEG_INFINITY, 0.0, "-inf"),
            (0.0, 0.0, "0"),
            (0.25, f64::INFINITY, "0.2500 +- unknown"),
        ] {
            assert_eq!(with_error(value, error, "+-"), shown);
        }
    }
}
