//! A sweep as a dataset for xarray and its like.

use super::Run;
use super::report::{LABELS, Rate, Report, Row};
use crate::dataset::motion::{HEIGHT, VELOCITY, jumpers};
use crate::dataset::{about, coordinate, name, numbered, padded, variable, wholes, words};
use crate::per_jumper::PerJumper;
use saltus_results::{Dataset, Variable};

/// All ends of a row.
const STATUS: [&str; 5] = [
    "completed",
    "chattering",
    "not-finite",
    "too-many-steps",
    "no-model",
];

/// One quantity of a row, samples of each jumper.
type Samples = for<'a, 'b> fn(&'a Row<'b>) -> &'a PerJumper<&'b [f64]>;

/// Rows come pass by pass and, whatever the way of the pass, in the order of the values.
pub(super) fn dataset(run: &Run, report: &Report) -> Dataset {
    let rows = &report.rows;
    let exponents = run.table.exponents.max(1) as usize;
    let record = run.sweep.record as usize;
    let value = name(&run.parameter);
    let cell = ["pass", &value];
    let each_jumper = ["pass", &value, "jumper"];
    let each_sample = ["pass", &value, "jumper", "sample"];
    let each_exponent = ["pass", &value, "exponent_number"];
    let per_row = |name, values: Vec<i32>, meaning| variable(name, &cell, values, meaning);
    let rates = |of: fn(&Rate) -> f64| -> Vec<f64> {
        let rates = |row: &Row| row.exponents.iter().map(of).collect::<Vec<f64>>();
        let rows = rows.iter().map(rates);
        rows.flat_map(|rates| padded(&rates, exponents).collect::<Vec<f64>>())
            .collect()
    };
    let samples = |of: Samples| -> Vec<f64> {
        let bodies = rows.iter().flat_map(|row| of(row).as_slice());
        bodies.flat_map(|samples| padded(samples, record)).collect()
    };
    let ratios = rows.iter().flat_map(|row| row.contact_ratio.as_slice());
    let ratios: Vec<f64> = ratios.copied().collect();
    let confidence: Vec<f64> = rows
        .iter()
        .map(|row| row.confidence.unwrap_or(f64::NAN))
        .collect();
    let period = wholes(rows.iter().map(|row| row.period.unwrap_or(0)));
    let known = [&["none"], &LABELS[..]].concat();
    let labels = rows.iter().map(|row| row.label.unwrap_or("none"));
    let status = rows.iter().map(|row| row.status);
    let rate = "Lyapunov exponent: mean growth of a small deviation per forcing period";
    passes(about("Long-term motion over a parameter", &run.study), run)
        .coordinate(coordinate(&run.parameter, &run.sweep.values))
        .coordinate(jumpers(run.jumpers()))
        .coordinate(numbered(
            "sample",
            1,
            record,
            "Forcing period of the record",
        ))
        .coordinate(numbered(
            "exponent_number",
            1,
            exponents,
            "The largest exponent first",
        ))
        .variable(variable("z", &each_sample, samples(|row| &row.z), HEIGHT))
        .variable(variable("v", &each_sample, samples(|row| &row.v), VELOCITY))
        .variable(variable(
            "contact_ratio",
            &each_jumper,
            ratios,
            ("Part of the recorded time on the floor", "1"),
        ))
        .variable(words("label", &cell, &known, labels, "What the motion is"))
        .variable(per_row(
            "period",
            period,
            ("Period in forcing periods, 0 where it has none", "1"),
        ))
        .variable(variable(
            "confidence",
            &cell,
            confidence,
            (
                "Of the test behind the label; NaN for a cycle known by its returns",
                "1",
            ),
        ))
        .variable(words("status", &cell, &STATUS, status, "How the run ended"))
        .variable(variable(
            "exponent",
            &each_exponent,
            rates(|rate| rate.per_period),
            (rate, "1"),
        ))
        .variable(variable(
            "exponent_error",
            &each_exponent,
            rates(|rate| rate.standard_error),
            ("Standard error of exponent", "1"),
        ))
}

/// The passes, with the way of each and its first state.
fn passes(dataset: Dataset, run: &Run) -> Dataset {
    let passes = &run.sweep.passes;
    let directions = passes.iter().map(super::report::direction);
    let starts: Vec<[f64; 2]> = passes
        .iter()
        .map(|pass| super::report::start(run, pass))
        .collect();
    let start = |name, part: usize, meaning| -> Variable {
        let values: Vec<f64> = starts.iter().map(|start| start[part]).collect();
        variable(name, &["pass"], values, meaning)
    };
    dataset
        .attribute("coordinates", "direction start_z start_v")
        .coordinate(numbered("pass", 0, passes.len(), "Way through the values"))
        .variable(words(
            "direction",
            &["pass"],
            &["up", "down", "start"],
            directions,
            "Up and down carry the state on; start begins anew at each value",
        ))
        .variable(start("start_z", 0, ("First height over eta", "1")))
        .variable(start(
            "start_v",
            1,
            ("First velocity over eta omega_h", "1"),
        ))
}
