//! The phase portraits of a motion.

use crate::per_jumper::{PANELS, page, panel_title};
use crate::words::{HEIGHT, VELOCITY};
use saltus::model::{Observation, Section};
use saltus_results::{Axis, Figure, Panel, Portrait};

/// Content of a phase portrait.
pub(super) struct Motion<'a> {
    pub(super) title: String,
    /// The way, at equal times.
    pub(super) states: &'a [Observation],
    /// The section while the way is followed.
    pub(super) section: &'a [Section],
    /// The section before, where the motion is still on its way.
    pub(super) before: &'a [Section],
}

/// Of `jumpers` people, the first ones.
pub(super) fn portraits(motion: &Motion, jumpers: usize) -> Figure {
    let shown = jumpers.min(PANELS);
    if shown == 1 {
        return Figure::new(portrait(motion, 0, &motion.title)).plot_size(620.0, 460.0);
    }
    let panels = (0..shown).map(|i| portrait(motion, i, &panel_title(i, jumpers)));
    page(2, panels.collect()).title(&motion.title)
}

fn portrait(motion: &Motion, jumper: usize, title: &str) -> Panel {
    let of = |value: fn(&Observation) -> &Vec<f64>| -> Vec<f64> {
        let states = motion.states.iter();
        states.map(|state| value(state)[jumper]).collect()
    };
    let flying: Vec<bool> = of(|s| &s.prf).iter().map(|&force| force == 0.0).collect();
    let points = |section: &[Section]| -> (Vec<f64>, Vec<f64>) {
        let states = section
            .iter()
            .map(|point| (point.z[jumper], point.v[jumper]));
        states.unzip()
    };
    let ((z, v), (z_before, v_before)) = (points(motion.section), points(motion.before));
    let before = match motion.before {
        [] => "",
        _ => "Before: transient",
    };
    Portrait::new(title, Axis::new(HEIGHT), Axis::new(VELOCITY))
        .marked_path(("Contact", "Flight"), of(|s| &s.z), of(|s| &s.v), &flying)
        .faint(before, z_before, v_before)
        .points("At $cos Ωt = 1$", z, v)
        .into()
}
