//! Summary of `saltus orbit` for people.

use super::Found;
use crate::per_jumper::{column, told};
use crate::words::phase;
use saltus::orbits::{Multiplier, Orbit, Stability};
use std::f64::consts::TAU;
use std::fmt::Write;

/// Multipliers, points, and of each the bodies shown at most.
const SHOWN: usize = 8;

pub(super) fn text(found: &Found) -> String {
    let mut text = String::new();
    let mut line = |name: &str, what: String| {
        // writing to a string cannot fail
        let _ = writeln!(text, "{name:<12}{what}");
    };
    let (orbit, seen, scales) = (&found.orbit, &found.portrait, found.model.scales());
    line(
        "orbit",
        period(orbit.period(), found.study.orbit.period as usize),
    );
    line("stability", stability(orbit));
    let (hertz, seconds) = (scales.omega / TAU, scales.period());
    line("base", format!("{hertz:.4} Hz, period {seconds:.6} s"));
    line(
        "residual",
        format!(
            "{:.1e}, steps of Newton's method: {}",
            orbit.residual, orbit.iterations
        ),
    );
    if found.jumpers() > 0 {
        let contact = each(&seen.contact_ratio, |r| format!("{:.4}", 100.0 * r));
        line("contact", format!("{contact} % of the time"));
        let peak = each(&seen.peak_reaction, |f| format!("{f:.6}"));
        line("peak force", format!("{peak} body weights"));
        let switches = found.sequence();
        let none = switches.chars().all(|c| c == '|');
        line("switches", if none { "none".to_owned() } else { switches });
        let phases = |all: &Vec<f64>| match all.as_slice() {
            [] => "never".to_owned(),
            all => list(all.iter().map(|p| format!("{p:.4}"))),
        };
        let touch_downs = each(&seen.touch_down_phases, phases);
        line("lands at", format!("Omega t = {touch_downs} (rad)"));
    }
    let of = match orbit.multipliers.len() {
        all @ ..=SHOWN => format!("{all}"),
        all => format!("the first {SHOWN} of {all}"),
    };
    let _ = writeln!(text, "\nmultipliers, by falling modulus ({of})");
    for Multiplier { re, im, .. } in orbit.multipliers.iter().take(SHOWN) {
        let modulus = re.hypot(*im);
        let _ = writeln!(text, "{re:>14.8} {im:>+14.8} i   modulus {modulus:.8}");
    }
    text + &points(found)
}

fn period(found: usize, asked: usize) -> String {
    let closes = format!("closes after {}", periods(found));
    match asked {
        0 => closes,
        asked if asked == found => closes,
        asked => format!("{closes}; {asked} were asked for, and it is this one repeated"),
    }
}

fn periods(count: usize) -> String {
    match count {
        1 => "1 forcing period".to_owned(),
        n => format!("{n} forcing periods"),
    }
}

fn stability(orbit: &Orbit) -> String {
    let verdict = match (orbit.stability(), orbit.outside()) {
        (Stability::Unstable, 1) => "unstable: 1 multiplier outside the unit circle".to_owned(),
        (Stability::Unstable, n) => format!("unstable: {n} multipliers outside the unit circle"),
        (Stability::Neutral, _) => {
            "neutral: a multiplier is on the unit circle to rounding, and none outside".to_owned()
        }
        (stability, _) => stability.name().to_owned(),
    };
    if orbit.in_family() {
        verdict
            + "; a multiplier is 1: other orbits lie beside this one (a quantity is conserved, or a fold is here)"
    } else {
        verdict
    }
}

fn each<T>(values: &[T], show: impl Fn(&T) -> String) -> String {
    let shown: Vec<String> = values.iter().map(show).collect();
    told(&shown, "; ")
}

fn list(values: impl Iterator<Item = String>) -> String {
    values.collect::<Vec<_>>().join(", ")
}

fn points(found: &Found) -> String {
    let jumpers = found.jumpers();
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
    for (index, point) in found.portrait.section.iter().take(SHOWN).enumerate() {
        let _ = write!(text, "\n{index:>8}");
        for i in 0..shown {
            let (z, v) = (point.z[i], point.v[i]);
            let _ = write!(text, " {z:>14.9} {v:>14.9} {:>9}", phase(point.phase[i]));
        }
    }
    text + "\n"
}
