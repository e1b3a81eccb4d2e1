//! What `saltus map` says to people.

use super::Plane;
use super::report::Report;
use std::fmt::Write;

pub(super) fn text(plane: &Plane, report: &Report) -> String {
    let mut text = format!(
        "{} from {} to {}, {} from {} to {}: {}\n",
        plane.x.parameter.label(),
        plane.x.table.from(),
        plane.x.table.to(),
        plane.y.parameter.label(),
        plane.y.table.from(),
        plane.y.table.to(),
        plane.size()
    );
    text += &report.tally.text();
    if let Some(span) = report.peak_acceleration {
        // writing to a string cannot fail
        let _ = writeln!(
            text,
            "  floor acceleration up to {:.3} m/s2 ({:.3} m/s2 where it is least)",
            span.max, span.min
        );
    }
    if let Some(failure) = &report.first_failure {
        let _ = writeln!(text, "  first failure: {}", failure.status_text);
    }
    text
}
