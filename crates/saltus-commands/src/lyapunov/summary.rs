//! What `saltus lyapunov` says to people.

use super::report::{Rate, Report};
use super::{Run, words};
use saltus::hybrid::Status;
use saltus::orbits::MotionKind;
use std::fmt::Write;

/// A sum that is further from the divergence than this (per period) is told as wrong: far above what
/// tolerances leave, far below any exponent of interest.
const AGREE: f64 = 1e-6;

pub(super) fn text(run: &Run, report: &Report) -> String {
    let mut text = String::new();
    let mut line = |name: &str, what: String| {
        // writing to a string cannot fail
        let _ = writeln!(text, "{name:<12}{what}");
    };
    if run.growth.status != Status::Completed {
        line("status", report.status_text.clone());
    }
    let sure = words::percent(report.nature.confidence);
    line(
        "motion",
        match report.nature.name {
            name if run.verdict.kind == MotionKind::Undecided => name.to_owned(),
            name => format!("{name}, with a confidence of {sure}"),
        },
    );
    line("", report.nature.text.clone());
    line(
        "base",
        format!("{:.4} Hz, period {:.6} s", report.base_hz, report.period_s),
    );
    line("record", record(report));
    line(
        "exponents",
        match report.from {
            "orbit" => "of the multipliers of the orbit that the motion has come to".to_owned(),
            _ => "means of the record, with one standard error; nearly twice that holds 95 %"
                .to_owned(),
        },
    );
    line("dimension", dimension(report));
    line("sum", sum(report));
    text.push_str(&spectrum(report));
    text
}

fn record(report: &Report) -> String {
    format!(
        "{} x {} forcing periods after {} left out, {} measured",
        report.replicas, report.periods, report.transient, report.periods_measured
    )
}

fn dimension(report: &Report) -> String {
    report.kaplan_yorke.as_ref().map_or_else(
        || "unknown: more exponents or a longer record are needed".to_owned(),
        |found| {
            let value = with_error(found.value, found.standard_error, "+-");
            format!("{value} (Kaplan-Yorke)")
        },
    )
}

fn sum(report: &Report) -> String {
    let sum = with_error(report.sum.per_period, report.sum.standard_error, "+-");
    let divergence = &report.divergence;
    let check = match divergence.difference {
        None => format!("not to be compared, {}", divergence.reason),
        Some(off) if off.abs() <= AGREE => format!("the same to {:.0e}, as it must be", off.abs()),
        Some(off) => format!("wrong by {off:.1e}: a smaller solver.tolerance may help"),
    };
    format!(
        "{sum} per period; mean divergence {:.6}: {check}",
        divergence.per_period
    )
}

fn spectrum(report: &Report) -> String {
    let mut text = format!("\n{:<12}{:<31}per second\n", "exponent", "per period");
    for (index, rate) in report.exponents.iter().enumerate() {
        let line = format!("{:>8}{}", index + 1, columns(rate));
        let _ = writeln!(text, "{}", line.trim_end());
    }
    text
}

/// Both units, with decimal points below each other.
fn columns(rate: &Rate) -> String {
    let pairs = [
        (rate.per_period, rate.standard_error),
        (rate.per_second, rate.per_second_error),
    ];
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
