//! Summary of `saltus sweep` for people.

use super::data::labels;
use super::{Found, Row};
use crate::words::direction;
use std::collections::BTreeMap;
use std::fmt::Write;

pub(super) fn text(found: &Found) -> String {
    let (sweep, values) = (&found.sweep, &found.sweep.values);
    let ends = (values.first(), values.last());
    let (from, to) = (ends.0.unwrap_or(&f64::NAN), ends.1.unwrap_or(&f64::NAN));
    let mut text = format!(
        "{} from {from} to {to}: {} values, at each {} forcing periods recorded after {}\n",
        found.parameter.label(),
        values.len(),
        sweep.record,
        sweep.transient
    );
    for (index, pass) in sweep.passes.iter().enumerate() {
        let [z, v] = found.start(pass);
        let way = direction(pass);
        let word = way.split(' ').next().unwrap_or_default();
        let name = format!("{word} from [{z}, {v}]");
        let rows = || found.rows_of(index);
        // writing to a string cannot fail
        let _ = writeln!(text, "  {name:<18} {}", tally(rows()));
        if let Some([low, high]) = largest(rows()).filter(|_| found.table.exponents > 0) {
            let _ = writeln!(
                text,
                "  {:<18} largest exponent from {low:.4} to {high:.4} per forcing period",
                ""
            );
        }
    }
    if let Some(row) = found.rows.iter().find(|row| !row.is_completed()) {
        let (value, why) = (row.run.value, row.status_text());
        let _ = writeln!(text, "  first that ended early, at {value}: {why}");
    }
    text + NOTE
}

const NOTE: &str = "\
Periods are seen in returns that no transient explains, all else in the largest
exponent, each name at a confidence of 0.999.
";

/// How many values have which motion: the periods first, the shortest before the others.
fn tally<'a>(rows: impl Iterator<Item = &'a Row>) -> String {
    let mut counts: BTreeMap<(usize, u32), usize> = BTreeMap::new();
    for row in rows {
        let label = labels().iter().position(|name| *name == row.label());
        let place = label.unwrap_or(labels().len());
        *counts.entry((place, row.period())).or_default() += 1;
    }
    let part = |(&(place, period), count): (&(usize, u32), &usize)| match labels().get(place) {
        Some(_) if period > 0 => format!("{count} x {period}T"),
        name => format!("{count} {}", name.unwrap_or(&"ended early")),
    };
    let parts: Vec<String> = counts.iter().map(part).collect();
    parts.join(", ")
}

/// Smallest and largest of the largest exponents.
fn largest<'a>(rows: impl Iterator<Item = &'a Row>) -> Option<[f64; 2]> {
    rows.filter_map(|row| row.exponents.first())
        .map(|exponent| [exponent.per_iterate; 2])
        .reduce(|[low, high], [value, _]| [low.min(value), high.max(value)])
}
