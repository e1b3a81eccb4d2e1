//! A run as a dataset for xarray and its like.

use super::Run;
use super::report::Report;
use crate::dataset::{self, about, motion, numbered, padded, variable};
use saltus::model::EnergyBalance;
use saltus_results::{Dataset, Variable};

pub(super) fn dataset(run: &Run, report: &Report) -> Dataset {
    let (trajectory, periods) = (&run.trajectory, run.trajectory.section.len());
    let times: Vec<f64> = (0..periods).map(|index| run.section_time(index)).collect();
    let points: Vec<_> = trajectory.section.iter().map(Some).collect();
    let contact = trajectory.contact_ratio.iter().take(periods);
    let contact: Vec<f64> = contact.flatten().copied().collect();
    let counted = "Forcing period, at whose end cos(Omega t) = 1";
    let mut set = about("Motion of people on a vibrating plate", &run.study)
        .attribute("status", report.status_text.clone())
        .coordinate(numbered("period", 1, periods, counted))
        .variable(dataset::base_frequency(&run.model))
        .variable(variable(
            "time",
            &["period"],
            times,
            ("Time of the section", "s"),
        ));
    set = motion::dimensions(set, &run.model);
    set = motion::section(set, "", &["period"], &run.model, &points);
    set = set.variable(variable(
        "contact_ratio",
        &["period", "jumper"],
        contact,
        ("Part of the forcing period on the floor", "1"),
    ));
    for (name, long_name, of) in ENERGY {
        let parts: Vec<f64> = trajectory.energy.iter().map(of).collect();
        set = set.variable(energy(name, long_name, &parts, periods));
    }
    set = motion::history(set, &trajectory.history);
    motion::switches(set, &report.switches)
}

fn energy(name: &str, long_name: &str, parts: &[f64], periods: usize) -> Variable {
    let parts: Vec<f64> = padded(parts, periods).collect();
    let words = format!("Energy of the forcing period: {long_name}");
    variable(format!("energy_{name}"), &["period"], parts, (&words, "J"))
}

type Part = fn(&EnergyBalance) -> f64;

/// stored = base + gravity - plate - legs + residual
const ENERGY: [(&str, &str, Part); 7] = [
    ("base", "from the base", |e| e.base),
    ("gravity", "from gravity", |e| e.gravity),
    ("plate", "lost in the plate", |e| e.plate),
    ("legs", "lost in the legs", |e| e.legs),
    ("dampers", "of that in their dampers", |e| e.dampers),
    ("stored", "gain of what is stored", |e| e.stored),
    ("residual", "what is left over", |e| e.residual),
];
