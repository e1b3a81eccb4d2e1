//! The phase portraits of a motion.

use crate::per_jumper::{PANELS, panel_title};
use saltus::model::{Observation, Section};
use saltus_results::{Axis, Figure, Panel, Portrait};

/// Content of a phase portrait.
pub(super) struct Motion<'a> {
    pub(super) title: String,
    /// The way, at equal times.
    pub(super) states: &'a [Observation],
    pub(super) section: &'a [Section],
    /// Which points of the section.
    pub(super) seen: String,
}

/// Of `jumpers` people, the first ones.
pub(super) fn portraits(motion: &Motion, jumpers: usize) -> Figure {
    let shown = jumpers.min(PANELS);
    if shown == 1 {
        return Figure::new(portrait(motion, 0, &motion.title)).plot_size(620.0, 460.0);
    }
    let panels = (0..shown).map(|i| portrait(motion, i, &panel_title(i, jumpers)));
    Figure::grid(2, panels).title(&motion.title)
}

fn portrait(motion: &Motion, jumper: usize, title: &str) -> Panel {
    let of = |value: fn(&Observation) -> &Vec<f64>| -> Vec<f64> {
        let states = motion.states.iter();
        states.map(|state| value(state)[jumper]).collect()
    };
    let flying: Vec<bool> = of(|s| &s.prf).iter().map(|&force| force == 0.0).collect();
    let z: Vec<f64> = motion.section.iter().map(|point| point.z[jumper]).collect();
    let v: Vec<f64> = motion.section.iter().map(|point| point.v[jumper]).collect();
    Portrait::new(
        title,
        Axis::new("Height z/η (-)"),
        Axis::new("Velocity ż/(η ω_h) (-)"),
    )
    .marked_path(("Contact", "Flight"), of(|s| &s.z), of(|s| &s.v), &flying)
    .points(&motion.seen, z, v)
    .into()
}
