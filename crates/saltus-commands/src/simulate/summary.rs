//! Summary of `saltus simulate` for people.

use super::Found;
use crate::data::motion::kind;
use crate::per_jumper::{alike, shared_column, told};
use crate::words::phase;
use crate::{repeats, status};
use std::f64::consts::TAU;
use std::fmt::Write;

/// Section points, and of each the amplitudes, shown at most; and bodies that differ.
const LAST: usize = 5;
const BODIES: usize = 2;

pub(super) fn text(found: &Found) -> String {
    let mut text = String::new();
    let mut line = |name: &str, what: String| {
        // writing to a string cannot fail
        let _ = writeln!(text, "{name:<12}{what}");
    };
    let (end, scales) = (&found.trajectory.end, found.model.scales());
    line("status", status::text(&end.status, Some(scales.omega)));
    let (hertz, seconds) = (scales.omega / TAU, scales.period());
    line("base", format!("{hertz:.4} Hz, period {seconds:.6} s"));
    line(
        "run",
        format!("{} periods, {} steps", end.periods, end.steps),
    );
    if found.jumpers() > 0 {
        let contact = each(&found.contact_ratio(), |r| format!("{:.2}", 100.0 * r));
        line("contact", format!("{contact} % of the time"));
        let force = |peak: f64| match peak {
            _ if peak.is_nan() => "-".to_owned(),
            _ => format!("{peak:.4}"),
        };
        let peak = each(&found.peak_reaction(), force);
        line("peak force", format!("{peak} body weights"));
        line("switches", switches(found));
        if found.trajectory.section.len() > 3 {
            line("recurrence", repeats(found));
        }
    }
    let energy = found.largest();
    line(
        "energy",
        format!(
            "largest residual of a period {:.1e} J of {:.4} J turned over ({:.1e})",
            energy.residual,
            energy.turnover,
            energy.relative()
        ),
    );
    text.push_str(&last_points(found));
    text
}

fn each(values: &[f64], show: impl Fn(f64) -> String) -> String {
    let shown: Vec<String> = values.iter().map(|&value| show(value)).collect();
    told(&shown, ", ")
}

fn switches(found: &Found) -> String {
    let all = &found.trajectory.switches;
    let count = |word| all.iter().filter(|switch| kind(switch) == word).count();
    let named = ["take-off", "touch-down"].map(|word| format!("{} {word}s", count(word)));
    let grazed = match count("tangency") {
        0 => String::new(),
        n => format!(", {n} tangencies"),
    };
    named.join(", ") + &grazed
}

/// A count over the later half of the found, which the start has mostly left behind.
fn repeats(found: &Found) -> String {
    let section = &found.trajectory.section;
    let late = &section[section.len() / 2..];
    let samples = |jumper: usize| {
        let z = late.iter().map(|point| point.z[jumper]).collect();
        let v = late.iter().map(|point| point.v[jumper]).collect();
        (z, v)
    };
    match repeats::every(found.jumpers(), late.len(), samples) {
        Some(1) => "the later half repeats every forcing period to 1e-6".to_owned(),
        Some(n) => format!("the later half repeats every {n} forcing periods to 1e-6"),
        None => format!("none to 1e-6 within {} forcing periods", late.len() / 2),
    }
}

fn last_points(found: &Found) -> String {
    let section = &found.trajectory.section;
    let first = section.len().saturating_sub(LAST);
    let terms = &found.model.setup().plate.modes.w;
    let body = |i: usize| {
        let points = section[first..].iter();
        let one = points.map(move |point| {
            let (z, v) = (point.z[i], point.v[i]);
            format!(" {z:>12.6} {v:>12.6} {:>9}", phase(point.phase[i]))
        });
        one.collect::<Vec<_>>()
    };
    let bodies: Vec<Vec<String>> = (0..found.jumpers()).map(body).collect();
    let different = alike(&bodies);
    let shown = &different[..different.len().min(BODIES)];
    let mut text = format!("\n{:>8}", "period");
    for run in shown {
        let name = |name: &str| shared_column(name, run, bodies.len());
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
        for run in shown {
            text.push_str(&bodies[run.start][index - first]);
        }
        for w in point.w.iter().take(LAST) {
            let _ = write!(text, " {w:>12.3e}");
        }
    }
    if shown.len() < different.len() {
        let last = shown.last().map_or(0, |run| run.end - 1);
        let _ = write!(text, "\njumpers 0 to {last} of {}", bodies.len());
    }
    text + "\n"
}
