//! Names of what each jumper has: columns of texts, panels of figures.

use saltus_results::{Figure, Panel};
use std::ops::Range;

/// Names of columns of a table: `z` for one jumper, `z_0`, `z_1`, ... for several.
pub(crate) fn column(name: &str, jumper: usize, jumpers: usize) -> String {
    if jumpers == 1 {
        name.to_owned()
    } else {
        format!("{name}_{jumper}")
    }
}

/// Panels of a figure: more do not fit on a page.
pub(crate) const PANELS: usize = 24;

/// A figure of one panel for each jumper, in as many columns as they need to fit on a page; up to three stand in
/// `columns`.
pub(crate) fn page(columns: usize, panels: Vec<Panel>) -> Figure {
    match panels.len() {
        0..=3 => Figure::grid(columns, panels),
        4..=9 => Figure::grid(3, panels)
            .plot_size(280.0, 210.0)
            .same_scales(),
        _ => Figure::grid(4, panels)
            .plot_size(210.0, 150.0)
            .same_scales(),
    }
}

/// Jumpers, one after the other, that have the same.
pub(crate) fn alike<T: PartialEq>(all: &[T]) -> Vec<Range<usize>> {
    let mut next = 0;
    let runs = all.chunk_by(|a, b| a == b).map(|run| {
        next += run.len();
        next - run.len()..next
    });
    runs.collect()
}

/// As [`column`] for jumpers that have the same: `z_0-19`.
pub(crate) fn shared_column(name: &str, of: &Range<usize>, jumpers: usize) -> String {
    match of.len() {
        1 => column(name, of.start, jumpers),
        _ => format!("{name}_{}-{}", of.start, of.end - 1),
    }
}

/// Texts of all jumpers, equal ones once: `20 x 99.00`, and of many different ones the first.
pub(crate) fn told(all: &[String], between: &str) -> String {
    let runs = alike(all);
    let one = |run: &Range<usize>| match run.len() {
        1 => all[run.start].clone(),
        n => format!("{n} x {}", all[run.start]),
    };
    let mut shown: Vec<String> = runs.iter().take(TOLD).map(one).collect();
    if let more @ 1.. = all.len() - runs.iter().take(TOLD).map(Range::len).sum::<usize>() {
        shown.push(format!("and {more} more"));
    }
    shown.join(between)
}

/// Different ones that a line holds.
const TOLD: usize = 8;

/// Title of a jumper's panel; none is needed for one.
pub(crate) fn panel_title(jumper: usize, jumpers: usize) -> String {
    match jumpers {
        1 => String::new(),
        _ if jumpers > PANELS => {
            format!("Jumper {jumper} (of {jumpers}, the first {PANELS} shown)")
        }
        _ => format!("Jumper {jumper}"),
    }
}

#[cfg(test)]
mod tests {
    use super::{shared_column, told};

    #[test]
    fn equal_ones_are_told_once() {
        let all = |words: &[&str]| {
            words
                .iter()
                .map(|&word| word.to_owned())
                .collect::<Vec<_>>()
        };
        assert_eq!(told(&all(&["99.00"; 20]), ", "), "20 x 99.00");
        assert_eq!(told(&all(&["1", "1", "2", "1"]), ", "), "2 x 1, 2, 1");
        let many: Vec<String> = (0..12).map(|i| format!("{i}")).collect();
        assert_eq!(told(&many, "; "), "0; 1; 2; 3; 4; 5; 6; 7; and 4 more");
        assert_eq!(told(&[], ", "), "");
        assert_eq!(shared_column("z", &(0..20), 20), "z_0-19");
        assert_eq!(shared_column("z", &(3..4), 20), "z_3");
        assert_eq!(shared_column("z", &(0..1), 1), "z");
    }
}
