//! Exponents as a dataset for xarray and its like.

use super::Run;
use super::report::{Rate, Report};
use crate::dataset::{self, about, numbered, variable, wholes};
use saltus::orbits::{Exponent, Running};
use saltus_results::{Dataset, Variable};

pub(super) fn dataset(run: &Run, report: &Report, convergence: &[Running]) -> Dataset {
    let each = ["exponent_number"];
    let length = ["periods", "exponent_number"];
    let rates = |of: fn(&Rate) -> f64| -> Vec<f64> { report.exponents.iter().map(of).collect() };
    let running = |of: fn(&Exponent) -> f64| -> Vec<f64> {
        let exponents = convergence.iter().flat_map(|running| &running.exponents);
        exponents.map(of).collect()
    };
    let growth = ("Mean growth of a small deviation per forcing period", "1");
    let error = ("Its standard error", "1");
    let dimension = report.kaplan_yorke.as_ref();
    let periods = wholes(convergence.iter().map(|running| running.iterates));
    let mut set = about(
        "Lyapunov exponents of people on a vibrating plate",
        &run.study,
    )
    .attribute("status", report.status_text.clone())
    .attribute("nature", report.nature.name)
    .attribute("exponents_from", report.from)
    .attribute("nature_text", report.nature.text.clone())
    .coordinate(numbered(
        each[0],
        1,
        run.how.exponents,
        "The largest exponent first",
    ))
    .coordinate(
        Variable::coordinate("periods", periods)
            .long_name("Forcing periods of each replica so far")
            .units("1"),
    )
    .variable(variable("exponent", &each, rates(|e| e.per_period), growth))
    .variable(variable(
        "exponent_error",
        &each,
        rates(|e| e.standard_error),
        error,
    ))
    .variable(variable(
        "exponent_low",
        &each,
        rates(|e| e.interval[0]),
        (
            "Lower end of the interval that holds it with a probability of 0.95",
            "1",
        ),
    ))
    .variable(variable(
        "exponent_high",
        &each,
        rates(|e| e.interval[1]),
        (
            "Upper end of the interval that holds it with a probability of 0.95",
            "1",
        ),
    ))
    .variable(variable(
        "running_exponent",
        &length,
        running(|e| e.per_iterate),
        growth,
    ))
    .variable(variable(
        "running_error",
        &length,
        running(|e| e.standard_error),
        error,
    ))
    .variable(dataset::base_frequency(&run.model));
    for (name, value, long_name) in [
        (
            "exponent_sum",
            report.sum.per_period,
            "Sum of the exponents",
        ),
        (
            "exponent_sum_error",
            report.sum.standard_error,
            "Its standard error",
        ),
        (
            "divergence",
            report.divergence.per_period,
            "Mean divergence of the flow per forcing period",
        ),
        (
            "kaplan_yorke",
            dimension.map_or(f64::NAN, |d| d.value),
            "Dimension of Kaplan and Yorke",
        ),
        (
            "kaplan_yorke_error",
            dimension.map_or(f64::NAN, |d| d.standard_error),
            "Its standard error",
        ),
        (
            "confidence",
            report.nature.confidence,
            "Of the test behind the attribute nature",
        ),
    ] {
        set = set.variable(variable(name, &[], value, (long_name, "1")));
    }
    set
}
