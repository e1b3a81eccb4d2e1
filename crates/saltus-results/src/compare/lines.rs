//! Texts, line by line.

use super::Difference;
use std::fs;
use std::path::Path;

pub(super) fn differences(first: &Path, second: &Path) -> Result<Vec<Difference>, String> {
    let read = |path| fs::read_to_string(path).map_err(|error| format!("not a text: {error}"));
    let (first, second) = (read(first)?, read(second)?);
    let (mut ours, mut theirs) = (first.lines(), second.lines());
    let mut all = Difference::new("");
    for line in 1_u64.. {
        match (ours.next(), theirs.next()) {
            (None, None) => break,
            (a, b) => {
                all.compared += 1;
                if a != b {
                    all.mismatch(
                        || format!("line {line}"),
                        a.unwrap_or("(end)"),
                        b.unwrap_or("(end)"),
                    );
                }
            }
        }
    }
    Ok(all.found().into_iter().collect())
}
