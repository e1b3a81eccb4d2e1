//! An orbit as a dataset for xarray and its like.

use super::Run;
use super::report::Report;
use crate::dataset::{self, about, motion, numbered, variable};
use saltus_results::{Dataset, Variable};

pub(super) fn dataset(run: &Run, report: &Report) -> Dataset {
    let (seen, multipliers) = (&run.portrait, &report.multipliers);
    let points: Vec<_> = seen.section.iter().map(Some).collect();
    let multiplier = |part: &str, value: fn(&[f64; 2]) -> f64| -> Variable {
        let values: Vec<f64> = multipliers.iter().map(value).collect();
        let words = format!("Floquet multiplier, {part}");
        let name = format!("multiplier_{}", part.replace(' ', "_"));
        variable(name, &["multiplier"], values, (&words, "1"))
    };
    let place = "Place of the orbit at cos(Omega t) = 1";
    let largest = "By falling modulus";
    let mut set = about(
        "A periodic orbit of people on a vibrating plate",
        &run.study,
    )
    .attribute("stability", report.stability)
    .attribute("sequence", report.sequence.clone())
    .coordinate(numbered("point", 0, points.len(), place))
    .coordinate(numbered("multiplier", 1, multipliers.len(), largest))
    .variable(dataset::base_frequency(&run.model));
    set = motion::dimensions(set, &run.model);
    set = motion::section(set, "", &["point"], &run.model, &points)
        .variable(multiplier("real", |m| m[0]))
        .variable(multiplier("imaginary", |m| m[1]))
        .variable(multiplier("modulus", |m| m[0].hypot(m[1])))
        .variable(variable(
            "contact_ratio",
            &["jumper"],
            seen.contact_ratio.clone(),
            ("Part of the time on the floor", "1"),
        ))
        .variable(variable(
            "peak_reaction",
            &["jumper"],
            seen.peak_reaction.clone(),
            ("Largest plate reaction force over body weight", "1"),
        ));
    set = motion::history(set, &seen.history);
    motion::switches(set, &report.switches)
}
