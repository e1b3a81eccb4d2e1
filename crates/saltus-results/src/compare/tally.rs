//! Differences within a part of a file, gathered value by value.

use serde::Serialize;
use std::fmt;

/// Differences in one part of a file: a table, a report, or a variable of a dataset.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Difference {
    /// The variable; empty if the file has one part only.
    pub part: String,
    /// Number of values compared.
    pub compared: u64,
    /// Number of them that differ.
    pub differing: u64,
    /// The largest |b − a| of two numbers, if numbers differ.
    pub absolute: Option<Largest>,
    /// The largest |b − a| / max(|a|, |b|) of two numbers (-), if numbers differ.
    pub relative: Option<Largest>,
    /// The first difference that is not one of two finite numbers: texts, something missing, a NaN.
    pub first: Option<Mismatch>,
}

/// The largest difference of two numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Largest {
    /// Its size.
    pub difference: f64,
    /// Its place, as "column `z`, row 17".
    pub place: String,
    /// The number in the first result.
    pub first: f64,
    /// The number in the second result.
    pub second: f64,
}

/// Two values that differ and are not both finite numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Mismatch {
    /// Their place.
    pub place: String,
    /// The value in the first result, shortened if it is long.
    pub first: String,
    /// The value in the second result.
    pub second: String,
}

/// Letters of a text that are shown.
const SHOWN: usize = 60;

impl Difference {
    pub(super) fn new(part: &str) -> Self {
        Self {
            part: part.to_owned(),
            compared: 0,
            differing: 0,
            absolute: None,
            relative: None,
            first: None,
        }
    }

    /// Nothing, if nothing differs.
    pub(super) fn found(self) -> Option<Self> {
        (self.differing > 0).then_some(self)
    }

    /// Compares two numbers; NaN equals NaN.
    pub(super) fn numbers(&mut self, first: f64, second: f64, place: impl Fn() -> String) {
        self.compared += 1;
        if first == second || (first.is_nan() && second.is_nan()) {
            return;
        }
        if !(first.is_finite() && second.is_finite()) {
            self.mismatch(place, &format!("{first:?}"), &format!("{second:?}"));
            return;
        }
        self.differing += 1;
        // By halves, or it may overflow.
        let scale = first.abs().max(second.abs());
        let absolute = (second - first).abs().min(f64::MAX);
        let relative = 2.0 * (0.5 * second / scale - 0.5 * first / scale).abs();
        for (largest, difference) in [
            (&mut self.absolute, absolute),
            (&mut self.relative, relative),
        ] {
            if largest
                .as_ref()
                .is_none_or(|known| difference > known.difference)
            {
                *largest = Some(Largest {
                    difference,
                    place: place(),
                    first,
                    second,
                });
            }
        }
    }

    /// Compares two texts, as numbers if both are.
    pub(super) fn texts(&mut self, first: &str, second: &str, place: impl Fn() -> String) {
        if first == second {
            self.compared += 1;
            return;
        }
        let whole = first.parse::<i128>().is_ok() && second.parse::<i128>().is_ok();
        match (first.parse::<f64>(), second.parse::<f64>()) {
            // Large whole numbers may differ where floating-point numbers do not.
            (Ok(a), Ok(b)) if a != b || !whole => self.numbers(a, b, place),
            _ => {
                self.compared += 1;
                self.mismatch(place, first, second);
            }
        }
    }

    /// Two values that are known to differ.
    pub(super) fn mismatch(&mut self, place: impl Fn() -> String, first: &str, second: &str) {
        self.differing += 1;
        if self.first.is_none() {
            self.first = Some(Mismatch {
                place: place(),
                first: shortened(first),
                second: shortened(second),
            });
        }
    }
}

fn shortened(text: &str) -> String {
    let mut letters = text.chars();
    let short: String = letters.by_ref().take(SHOWN).collect();
    if letters.next().is_some() {
        format!("{short}…")
    } else {
        short
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.part.is_empty() {
            write!(f, "`{}`: ", self.part)?;
        }
        write!(
            f,
            "{} of {} values differ",
            self.differing,
            self.compared.max(self.differing)
        )?;
        if let Some(largest) = &self.absolute {
            write!(f, ", at most by {largest}")?;
        }
        if let Some(largest) = &self.relative {
            write!(f, ", relative to size at most by {largest}")?;
        }
        if let Some(mismatch) = &self.first {
            let Mismatch {
                place,
                first,
                second,
            } = mismatch;
            write!(
                f,
                ", at first not a number: {place} is `{first}` and `{second}`"
            )?;
        }
        Ok(())
    }
}

impl fmt::Display for Largest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            difference,
            place,
            first,
            second,
        } = self;
        write!(f, "{difference:.1e} ({place}: {first:?} and {second:?})")
    }
}
