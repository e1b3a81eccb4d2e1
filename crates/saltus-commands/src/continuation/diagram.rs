//! A branch as the figure has it: its special points among its points.

use super::view::{Seen, View};
use saltus::orbits::{BranchWithOrigin, End, Point};

/// At the birth of a branch a multiplier is 1, and which side of the circle it is on is chance.
const EDGE: f64 = 1e-6;

/// A branch of one jumper.
pub(super) struct Track {
    pub(super) values: Vec<f64>,
    /// Special points count as stable, so that they end the stable part.
    pub(super) stable: Vec<bool>,
    /// Heights z/eta, a curve for each place of the orbit.
    pub(super) heights: Vec<Vec<f64>>,
}

pub(super) fn track(limb: &BranchWithOrigin, view: &View, jumper: usize) -> Track {
    let branch = &limb.branch;
    let period = view.points.first().map_or(0, |seen| seen.section.len());
    let mut track = Track {
        values: Vec::new(),
        stable: Vec::new(),
        heights: vec![Vec::new(); period],
    };
    let mut put = |value: f64, stable: bool, seen: &Seen| {
        track.values.push(value);
        track.stable.push(stable);
        for (heights, section) in track.heights.iter_mut().zip(&seen.section) {
            heights.push(section.z[jumper]);
        }
    };
    let mut specials = branch.specials.iter().zip(&view.specials).peekable();
    if matches!(branch.ends[0], End::Halved | End::Grazing)
        && let Some((special, seen)) = specials.next()
    {
        put(special.parameter, true, seen);
    }
    for (index, (point, seen)) in branch.points.iter().zip(&view.points).enumerate() {
        put(point.parameter, stable(point), seen);
        while let Some((special, seen)) = specials.next_if(|(special, _)| special.near == index) {
            put(special.parameter, true, seen);
        }
    }
    track
}

fn stable(point: &Point) -> bool {
    let largest = point.orbit.multipliers.first();
    largest.is_none_or(|multiplier| multiplier.modulus() < 1.0 + EDGE)
}
