//! What `saltus sweep` says to people.

use super::Run;
use super::report::{LABELS, Report, Row};
use std::collections::BTreeMap;
use std::fmt::Write;

pub(super) fn text(run: &Run, report: &Report) -> String {
    let (sweep, values) = (&run.sweep, &run.sweep.values);
    let ends = (values.first(), values.last());
    let (from, to) = (ends.0.unwrap_or(&f64::NAN), ends.1.unwrap_or(&f64::NAN));
    let mut text = format!(
        "{} from {from} to {to}: {} values, at each {} forcing periods recorded after {}\n",
        run.parameter.label(),
        values.len(),
        sweep.record,
        sweep.transient
    );
    for pass in 0..sweep.passes.len() {
        let rows: Vec<&Row> = report.rows.iter().filter(|row| row.pass == pass).collect();
        let name = rows.first().map_or(String::new(), |row| {
            format!(
                "{} from [{}, {}]",
                row.direction, row.start[0], row.start[1]
            )
        });
        // writing to a string cannot fail
        let _ = writeln!(text, "  {name:<18} {}", tally(&rows));
        if let Some([low, high]) = largest(&rows).filter(|_| run.table.exponents > 0) {
            let _ = writeln!(
                text,
                "  {:<18} largest exponent from {low:.4} to {high:.4} per forcing period",
                ""
            );
        }
    }
    if let Some(row) = report.rows.iter().find(|row| row.status != "completed") {
        let _ = writeln!(
            text,
            "  first that ended early, at {}: {}",
            row.value, row.status_text
        );
    }
    text + NOTE
}

const NOTE: &str = "\
Periods are seen in returns that no transient explains, all else in the largest
exponent, each name at a confidence of 0.999.
";

/// How many values have which motion: the periods first, the shortest before the others.
fn tally(rows: &[&Row]) -> String {
    let mut counts: BTreeMap<(usize, u32), usize> = BTreeMap::new();
    for row in rows {
        let label = LABELS.iter().position(|name| row.label == Some(name));
        let place = label.unwrap_or(LABELS.len());
        *counts.entry((place, row.period.unwrap_or(0))).or_default() += 1;
    }
    let part = |(&(place, period), count): (&(usize, u32), &usize)| match LABELS.get(place) {
        Some(_) if period > 0 => format!("{count} x {period}T"),
        name => format!("{count} {}", name.unwrap_or(&"ended early")),
    };
    let parts: Vec<String> = counts.iter().map(part).collect();
    parts.join(", ")
}

/// Smallest and largest of the largest exponents.
fn largest(rows: &[&Row]) -> Option<[f64; 2]> {
    let all = rows.iter().filter_map(|row| row.exponents.first());
    all.map(|rate| [rate.per_period; 2])
        .reduce(|[low, high], [value, _]| [low.min(value), high.max(value)])
}
