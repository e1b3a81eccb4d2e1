//! The figures of an orbit: its phase portrait and its multipliers.

use super::Found;
use crate::answer::Take;
use crate::failure::CommandError;
use crate::portrait::{self, Motion};
use crate::words::setting;
use saltus_results::{Axis, Figure, Portrait};
use std::f64::consts::TAU;

/// Width and height (px) of the complex plane.
const SIDE: f64 = 460.0;

pub(super) fn draw(found: &Found, take: Take) -> Result<(), CommandError> {
    let jumpers = found.jumpers();
    if jumpers > 0 {
        let motion = Motion {
            title: title(found, "Orbit"),
            states: &found.portrait.history.states,
            section: &found.portrait.section,
            before: &[],
        };
        take("portrait", &portrait::portraits(&motion, jumpers))?;
    }
    take("multipliers", &multipliers(found))
}

fn title(found: &Found, what: &str) -> String {
    let period = found.orbit.period();
    let setting = setting(&found.study, &found.model);
    format!("{what}, period {period}: {setting}")
}

/// The complex plane, its axes equal so that the circle is one.
fn multipliers(found: &Found) -> Figure {
    let all = &found.orbit.multipliers;
    let far = all.iter().map(|m| m.modulus()).fold(1.0, f64::max) * 1.12;
    let axis = |label: &str| Axis::new(label).range(-far, far);
    let circle = (0..=360).map(|i| (f64::from(i) / 360.0 * TAU).sin_cos());
    let (sin, cos): (Vec<f64>, Vec<f64>) = circle.unzip();
    let mut plane = Portrait::new(
        title(found, "Multipliers"),
        axis("Real part"),
        axis("Imaginary part"),
    )
    .path("Unit circle", cos, sin);
    for (label, outside) in [("Outside", true), ("Inside", false)] {
        let here = all.iter().filter(|m| (m.modulus() > 1.0) == outside);
        let (re, im): (Vec<f64>, Vec<f64>) = here.map(|m| (m.re, m.im)).unzip();
        let label = if re.is_empty() { "" } else { label };
        plane = plane.points(label, re, im);
    }
    Figure::new(plane).plot_size(SIDE, SIDE)
}
