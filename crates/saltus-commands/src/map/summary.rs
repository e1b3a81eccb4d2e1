//! Summary of `saltus map` for people.

use super::Found;
use std::fmt::Write;

pub(super) fn text(found: &Found) -> String {
    let layers = &found.layers;
    let mut text = format!("{}\n{}", found.plane.text(), layers.tally().text());
    if let Some(span) = layers.acceleration() {
        // writing to a string cannot fail
        let _ = writeln!(
            text,
            "  floor acceleration up to {:.3} m/s2 ({:.3} m/s2 where it is least)",
            span.max, span.min
        );
    }
    text + &layers.first_failure()
}
