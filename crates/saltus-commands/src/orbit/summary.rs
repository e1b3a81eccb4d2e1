//! What `saltus orbit` says to people.

use super::Run;
use super::report::Report;
use crate::motion::phase;
use crate::per_jumper::{PerJumper, column};
use std::fmt::Write;

/// Multipliers, points, and of each the bodies shown at most.
const SHOWN: usize = 8;

pub(super) fn text(run: &Run, report: &Report) -> String {
    let mut text = String::new();
    let mut line = |name: &str, what: String| {
        // writing to a string cannot fail
        let _ = writeln!(text, "{name:<12}{what}");
    };
    line("orbit", period(report));
    line("stability", stability(report));
    line(
        "base",
        format!("{:.4} Hz, period {:.6} s", report.base_hz, report.period_s),
    );
    line(
        "residual",
        format!(
            "{:.1e}, steps of Newton's method: {}",
            report.residual, report.iterations
        ),
    );
    if !run.study.jumper.is_empty() {
        let contact = each(&report.contact_ratio, |r| format!("{:.4}", 100.0 * r));
        line("contact", format!("{contact} % of the time"));
        let peak = each(&report.peak_prf, |f| format!("{f:.6}"));
        line("peak force", format!("{peak} body weights"));
        let switches = report.sequence.as_str();
        let none = switches.chars().all(|c| c == '|');
        line("switches", if none { "none" } else { switches }.to_owned());
        let phases = |all: &&[f64]| match all {
            [] => "never".to_owned(),
            all => list(all.iter().map(|p| format!("{p:.4}"))),
        };
        let landings = each(&report.landing_phases, phases);
        line("lands at", format!("Omega t = {landings} (rad)"));
    }
    let of = match report.multipliers.len() {
        all @ ..=SHOWN => format!("{all}"),
        all => format!("the first {SHOWN} of {all}"),
    };
    let _ = writeln!(text, "\nmultipliers, by falling modulus ({of})");
    for [re, im] in report.multipliers.iter().take(SHOWN) {
        let modulus = re.hypot(*im);
        let _ = writeln!(text, "{re:>14.8} {im:>+14.8} i   modulus {modulus:.8}");
    }
    text + &points(run)
}

fn period(report: &Report) -> String {
    let found = periods(report.period);
    match report.asked {
        Some(asked) if asked != report.period => {
            format!("closes after {found}; {asked} were asked for, and it is this one repeated")
        }
        _ => format!("closes after {found}"),
    }
}

fn periods(count: usize) -> String {
    match count {
        1 => "1 forcing period".to_owned(),
        n => format!("{n} forcing periods"),
    }
}

fn stability(report: &Report) -> String {
    let verdict = match (report.stability, report.outside) {
        ("unstable", 1) => "unstable: 1 multiplier outside the unit circle".to_owned(),
        ("unstable", n) => format!("unstable: {n} multipliers outside the unit circle"),
        ("neutral", _) => {
            "neutral: a multiplier is on the unit circle to rounding, and none outside".to_owned()
        }
        (verdict, _) => verdict.to_owned(),
    };
    if report.in_family {
        verdict
            + "; a multiplier is 1: other orbits lie beside this one (a quantity is conserved, or a fold is here)"
    } else {
        verdict
    }
}

fn each<T>(values: &PerJumper<T>, show: impl Fn(&T) -> String) -> String {
    let shown: Vec<String> = values.as_slice().iter().map(show).collect();
    shown.join("; ")
}

fn list(values: impl Iterator<Item = String>) -> String {
    values.collect::<Vec<_>>().join(", ")
}

fn points(run: &Run) -> String {
    let jumpers = run.study.jumper.len();
    let shown = jumpers.min(SHOWN);
    if shown == 0 {
        return String::new();
    }
    let mut text = format!("\n{:>8}", "point");
    for i in 0..shown {
        let name = |name: &str| column(name, i, jumpers);
        let (z, v, phase) = (name("z/eta"), name("v"), name("phase"));
        let _ = write!(text, " {z:>14} {v:>14} {phase:>9}");
    }
    for (index, point) in run.portrait.section.iter().take(SHOWN).enumerate() {
        let _ = write!(text, "\n{index:>8}");
        for i in 0..shown {
            let (z, v) = (point.z[i], point.v[i]);
            let _ = write!(text, " {z:>14.9} {v:>14.9} {:>9}", phase(point.phase[i]));
        }
    }
    text + "\n"
}
