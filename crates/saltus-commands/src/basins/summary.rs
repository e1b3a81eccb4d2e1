//! Summary of `saltus basins` for people.

use super::Basins;
use crate::plane::{Plane, Tally, period};
use saltus::orbits::MotionKind;
use saltus::study::Entry;
use std::fmt::Write;

/// Attractors listed.
const LISTED: usize = 12;

pub(super) fn text(plane: &Plane, basins: &Basins) -> String {
    let (attractors, tally) = (&basins.attractors, basins.layers.tally());
    let mut text = format!("{}, {} attractors\n", plane.text(), attractors.len());
    for (place, entry) in attractors.iter().take(LISTED).enumerate() {
        text += &line(plane, place, entry, &tally);
    }
    // writing to a string cannot fail
    if attractors.len() > LISTED {
        let _ = writeln!(text, "  and {} more", attractors.len() - LISTED);
    }
    let lost = tally.without_attractor();
    if lost > 0 {
        let share = 100.0 * lost as f64 / plane.grid.len() as f64;
        let _ = writeln!(text, "       {share:>5.1} %  undecided or failed");
    }
    text + &basins.layers.first_failure()
}

fn line(plane: &Plane, place: usize, entry: &Entry, tally: &Tally) -> String {
    let motion = &entry.attractor;
    let contact = motion.contact_ratio.iter();
    let contact: Vec<String> = contact.map(|ratio| format!("{ratio:.3}")).collect();
    let over = match motion.kind {
        MotionKind::Chaotic => tally.chaotic_for(),
        _ => String::new(),
    };
    let kind = period(motion.kind).map_or(motion.kind.name().to_owned(), |n| format!("{n}T"));
    let (x, y) = plane.grid.at(entry.first);
    format!(
        "  {:>3}  {:>5.1} %  {kind}{over}, contact {}, first from [{x:.4}, {y:.4}]\n",
        place + 1,
        100.0 * entry.share(plane.grid.len() as u64),
        contact.join(" and "),
    )
}
