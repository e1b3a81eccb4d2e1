//! What `saltus simulate` says to people.

use super::Run;
use super::report::Report;
use crate::per_jumper::{PerJumper, column};
use crate::{motion::phase, repeats};
use std::fmt::Write;

/// Section points, and of each the bodies and amplitudes, shown at most.
const LAST: usize = 5;

pub(super) fn text(run: &Run, report: &Report) -> String {
    let mut text = String::new();
    let mut line = |name: &str, what: String| {
        // writing to a string cannot fail
        let _ = writeln!(text, "{name:<12}{what}");
    };
    line("status", report.status_text.clone());
    line(
        "base",
        format!("{:.4} Hz, period {:.6} s", report.base_hz, report.period_s),
    );
    line(
        "run",
        format!("{} periods, {} steps", report.periods, report.steps),
    );
    if run.jumpers() > 0 {
        let percent = |ratio: &f64| format!("{:.2}", 100.0 * ratio);
        let force = |peak: &Option<f64>| peak.map_or("-".to_owned(), |f| format!("{f:.4}"));
        let contact = each(&report.contact_ratio, percent);
        line("contact", format!("{contact} % of the time"));
        let peak = each(&report.peak_prf, force);
        line("peak force", format!("{peak} body weights"));
        line("switches", switches(report));
        if run.trajectory.section.len() > 3 {
            line("recurrence", repeats(run));
        }
    }
    let energy = &report.energy;
    line(
        "energy",
        format!(
            "largest residual of a period {:.1e} J of {:.4} J turned over ({:.1e})",
            energy.max_residual, energy.max_turnover, energy.max_relative_residual
        ),
    );
    text.push_str(&last_points(run));
    text
}

fn each<T>(values: &PerJumper<T>, show: impl Fn(&T) -> String) -> String {
    values
        .as_slice()
        .iter()
        .map(show)
        .collect::<Vec<_>>()
        .join(", ")
}

fn switches(report: &Report) -> String {
    let count = |kind| report.switches.iter().filter(|s| s.kind == kind).count();
    let named = ["take-off", "touch-down"].map(|kind| format!("{} {kind}s", count(kind)));
    let grazed = match count("tangency") {
        0 => String::new(),
        n => format!(", {n} tangencies"),
    };
    named.join(", ") + &grazed
}

/// A count over the later half of the run, which the start has mostly left behind.
fn repeats(run: &Run) -> String {
    let section = &run.trajectory.section;
    let late = &section[section.len() / 2..];
    let samples = |jumper: usize| {
        let z = late.iter().map(|point| point.z[jumper]).collect();
        let v = late.iter().map(|point| point.v[jumper]).collect();
        (z, v)
    };
    match repeats::every(run.jumpers(), late.len(), samples) {
        Some(1) => "the later half repeats every forcing period to 1e-6".to_owned(),
        Some(n) => format!("the later half repeats every {n} forcing periods to 1e-6"),
        None => format!("none to 1e-6 within {} forcing periods", late.len() / 2),
    }
}

fn last_points(run: &Run) -> String {
    let section = &run.trajectory.section;
    let first = section.len().saturating_sub(LAST);
    let terms = &run.model.setup().plate.modes.w;
    let mut text = format!("\n{:>8}", "period");
    let shown = run.jumpers().min(LAST);
    for i in 0..shown {
        let name = |name: &str| column(name, i, run.jumpers());
        let _ = write!(
            text,
            " {:>12} {:>12} {:>9}",
            name("z/eta"),
            name("v"),
            name("phase")
        );
    }
    for term in terms.iter().take(LAST) {
        let _ = write!(text, " {:>12}", format!("w_{}_{}/h", term.m, term.n));
    }
    for (index, point) in section.iter().enumerate().skip(first) {
        let _ = write!(text, "\n{:>8}", index + 1);
        for i in 0..shown {
            let (z, v) = (point.z[i], point.v[i]);
            let _ = write!(text, " {z:>12.6} {v:>12.6} {:>9}", phase(point.phase[i]));
        }
        for w in point.w.iter().take(LAST) {
            let _ = write!(text, " {w:>12.3e}");
        }
    }
    text + "\n"
}
