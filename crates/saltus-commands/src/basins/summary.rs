//! What `saltus basins` says to people.

use super::Plane;
use super::report::Report;
use saltus::orbits::MotionKind;
use std::fmt::Write;

/// Attractors listed.
const LISTED: usize = 12;

pub(super) fn text(plane: &Plane, report: &Report) -> String {
    let mut text = format!(
        "{} from {} to {}, {} from {} to {}: {}, {} attractors\n",
        plane.x.parameter.label(),
        plane.x.table.from(),
        plane.x.table.to(),
        plane.y.parameter.label(),
        plane.y.table.from(),
        plane.y.table.to(),
        plane.size(),
        report.attractors.len()
    );
    for attractor in report.attractors.iter().take(LISTED) {
        let contact: Vec<String> = attractor
            .contact_ratio
            .as_slice()
            .iter()
            .map(|c| format!("{c:.3}"))
            .collect();
        let over = report.tally.chaotic_over;
        let over = over.filter(|_| attractor.kind == MotionKind::Chaotic.name());
        let over = over.map_or(String::new(), |span| {
            format!(" for {} periods and more", span.min)
        });
        // writing to a string cannot fail
        let _ = writeln!(
            text,
            "  {:>3}  {:>5.1} %  {}{over}, contact {}, first from [{:.4}, {:.4}]",
            attractor.number,
            100.0 * attractor.share,
            attractor.name(),
            contact.join(" and "),
            attractor.start[0],
            attractor.start[1]
        );
    }
    if report.attractors.len() > LISTED {
        let _ = writeln!(text, "  and {} more", report.attractors.len() - LISTED);
    }
    let lost = report.tally.without_attractor();
    if lost > 0 {
        let share = 100.0 * lost as f64 / report.pixels as f64;
        let _ = writeln!(text, "       {share:>5.1} %  undecided or failed");
    }
    if let Some(failure) = &report.first_failure {
        let _ = writeln!(text, "  first failure: {}", failure.status_text);
    }
    text
}
