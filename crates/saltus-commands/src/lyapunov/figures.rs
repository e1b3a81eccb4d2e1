//! The figure of convergence.

use super::Found;
use super::summary::with_error;
use crate::words::setting;
use saltus::orbits::{Exponent, Running};
use saltus_results::{Axis, Curves, Figure};

/// Exponents drawn at most: there are no more colours for curves.
const SHOWN: usize = 7;

/// The exponents from the first periods of the record, over how many these are.
pub(super) fn convergence(found: &Found) -> Figure {
    // without an error a mean of few periods says nothing, but sets the scale
    let known = |running: &&Running| {
        running
            .exponents
            .iter()
            .all(|e| e.standard_error.is_finite())
    };
    let known: Vec<&Running> = found.convergence.iter().filter(known).collect();
    let periods: Vec<f64> = known
        .iter()
        .map(|running| running.iterates as f64)
        .collect();
    let (all, replicas) = (found.how.exponents, found.how.replicas);
    let which = match all {
        _ if all > SHOWN => format!(" (the largest {SHOWN} of {all})"),
        _ => String::new(),
    };
    let curves = Curves::new(
        format!(
            "Lyapunov exponents{which}: {}",
            setting(&found.study, &found.model)
        ),
        Axis::new(format!(
            "Forcing periods of each of {replicas} replicas (-)"
        ))
        .logarithmic(),
        Axis::new("Lyapunov exponent $λ$ per forcing period"),
    );
    let last = found.growth.exponents();
    let curves = last
        .iter()
        .take(SHOWN)
        .enumerate()
        .fold(curves, |curves, (k, whole)| {
            let of = |value: fn(&Exponent) -> f64| -> Vec<f64> {
                known
                    .iter()
                    .map(|running| value(&running.exponents[k]))
                    .collect()
            };
            // a true minus sign, as on the axes
            let value =
                with_error(whole.per_iterate, whole.standard_error, "±").replace('-', "\u{2212}");
            curves
                .line(
                    format!("$λ_{{{}}}$ = {value}", k + 1),
                    &periods[..],
                    of(|e| e.per_iterate),
                )
                .band(
                    "± one standard error",
                    of(|e| e.per_iterate - e.standard_error),
                    of(|e| e.per_iterate + e.standard_error),
                )
        });
    Figure::new(curves.level("Zero", 0.0))
}
