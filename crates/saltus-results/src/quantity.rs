//! Quantities: what a number is called, what it means and its unit, said once for all formats.
//!
//! ```
//! use saltus_results::Quantity;
//! const CONTACT_RATIO: Quantity = Quantity::new("contact_ratio", "Part of the time on the floor", "1");
//! let variable = CONTACT_RATIO.over(&["jumper"], vec![0.4, 0.6]);
//! assert_eq!((variable.name(), variable.long_name_text()), ("contact_ratio", "Part of the time on the floor"));
//! ```

use crate::{Values, Variable};

/// One name, one meaning and one unit in every format, and in the help.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// Key in JSON, column of a table, variable in NetCDF and Python: `contact_ratio`.
    pub name: &'static str,
    /// Long name, note and help: "Part of the time on the floor".
    pub meaning: &'static str,
    /// As UDUNITS spells it, "1" for a ratio; empty where there is none, as of a text.
    pub unit: &'static str,
    /// Words that whole numbers from 0 on stand for; empty for numbers.
    pub words: &'static [&'static str],
}

impl Quantity {
    /// A number.
    pub const fn new(name: &'static str, meaning: &'static str, unit: &'static str) -> Self {
        let words = &[];
        Self {
            name,
            meaning,
            unit,
            words,
        }
    }

    /// A text, or a yes or no.
    pub const fn text(name: &'static str, meaning: &'static str) -> Self {
        Self::new(name, meaning, "")
    }

    /// One of some words.
    pub const fn one_of(
        name: &'static str,
        meaning: &'static str,
        words: &'static [&'static str],
    ) -> Self {
        Self {
            name,
            meaning,
            unit: "",
            words,
        }
    }

    /// The same under another name, as that of a special point beside that of an orbit.
    pub const fn named(self, name: &'static str) -> Self {
        Self { name, ..self }
    }

    /// Values over `axes`, the last of which varies fastest.
    pub fn over(&self, axes: &[&str], values: impl Into<Values>) -> Variable {
        let variable = Variable::new(self.name, axes, values).long_name(self.meaning);
        let variable = match self.unit {
            "" => variable,
            unit => variable.units(unit),
        };
        match self.words {
            [] => variable,
            words => variable.words(words),
        }
    }

    /// Words over `axes`, each kept as its place among [`Self::words`]. One that is not among them becomes a gap.
    pub fn spelt<'a>(&self, axes: &[&str], words: impl IntoIterator<Item = &'a str>) -> Variable {
        let place = |word| self.words.iter().position(|&known| known == word);
        let code = |word| place(word).map_or(u8::MAX, |code| code as u8);
        self.over(axes, words.into_iter().map(code).collect::<Vec<u8>>())
    }

    /// A single value.
    pub fn is(&self, value: impl Into<Values>) -> Variable {
        self.over(&[], value)
    }

    /// The values along the dimension of the same name, for [`Dataset::coordinate`](crate::Dataset::coordinate).
    pub fn along(&self, values: impl Into<Values>) -> Variable {
        self.over(&[self.name], values)
    }

    /// A dimension of `length` whose places are numbered from `first` on.
    pub fn numbered(&self, first: i32, length: usize) -> Variable {
        self.along((first..).take(length).collect::<Vec<i32>>())
    }
}
