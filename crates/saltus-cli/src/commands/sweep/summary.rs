//! What `saltus sweep` says to people.

use super::Run;
use super::report::{Report, Row};
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
        let _ = writeln!(text, "  {name:<18} {}", tally(run, &rows));
    }
    if let Some(row) = report.rows.iter().find(|row| row.status != "completed") {
        let _ = writeln!(
            text,
            "  first that ended early, at {}: {}",
            row.value, row.status_text
        );
    }
    text + "Counts of what repeats to 1e-6, no proof of periodicity.\n"
}

/// How many values repeat after how many periods.
fn tally(run: &Run, rows: &[&Row]) -> String {
    let mut counts: BTreeMap<u32, usize> = BTreeMap::new();
    for n in rows.iter().filter_map(|row| row.recurrence) {
        *counts.entry(n).or_default() += 1;
    }
    let failed = rows.iter().filter(|row| row.status != "completed").count();
    let open = rows.len() - failed - counts.values().sum::<usize>();
    let mut parts: Vec<String> = counts
        .iter()
        .map(|(n, count)| format!("{count} x {n}T"))
        .collect();
    if open > 0 {
        let within = run.sweep.record / 2;
        parts.push(format!("{open} without repetition within {within} periods"));
    }
    if failed > 0 {
        parts.push(format!("{failed} ended early"));
    }
    parts.join(", ")
}
