//! Datasets: arrays over named dimensions with units, written as one NetCDF-4 file.
//!
//! A [`Dataset`] is what xarray calls by that name: coordinates, variables over some of them, and
//! attributes, by the Climate and Forecast conventions (CF-1.11). `xarray.open_dataset` reads the file with
//! either engine, h5netcdf or netcdf4, and every value comes back to the same bits.
//!
//! ```
//! use saltus_results::{Dataset, Variable};
//! # fn main() -> Result<(), saltus_results::ResultsError> {
//! let period = vec![1_u8, 2, 0, 1, 1, 4];
//! let dataset = Dataset::new("Attractors of a map")
//!     .attribute("source", "saltus 0.1.0")
//!     .coordinate(Variable::coordinate("ratio", vec![0.9, 1.0, 1.1]).long_name("Frequency ratio").units("1"))
//!     .coordinate(Variable::coordinate("zeta", vec![0.1, 0.2]).long_name("Damping ratio").units("1"))
//!     .variable(
//!         Variable::new("period", &["zeta", "ratio"], period)
//!             .long_name("Period of the motion")
//!             .flags([(0, "not_periodic"), (1, "period_1"), (2, "period_2"), (4, "period_4")]),
//!     );
//! assert!(dataset.to_bytes()?.starts_with(b"\x89HDF\r\n\x1a\n"));
//! # Ok(())
//! # }
//! ```
//!
//! Files of equal datasets are equal to the byte: no time of writing is kept.

mod check;
mod file;
pub(crate) mod open;

use crate::{ResultsError, Table};

/// Arrays over named dimensions, and the tables that show them row by row.
#[derive(Clone, Debug)]
pub struct Dataset {
    dimensions: Vec<(String, usize)>,
    variables: Vec<Variable>,
    /// Arrays that tables alone show.
    columns: Vec<Variable>,
    /// Attributes of files of arrays alone.
    header: Vec<(String, Attribute)>,
    attributes: Vec<(String, Attribute)>,
    tables: Vec<Table>,
    ragged: Vec<String>,
}

/// One array of a [`Dataset`] with its attributes.
#[derive(Clone, Debug)]
pub struct Variable {
    name: String,
    dimensions: Vec<String>,
    values: Values,
    attributes: Vec<(String, Attribute)>,
    flags: Vec<(i32, String)>,
    fill: Option<i32>,
    words: &'static [&'static str],
    gap: Option<i32>,
}

/// The values of a [`Variable`], in rows: the last dimension varies fastest.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Values {
    /// Double precision; NaN where there is no value.
    F64(Vec<f64>),
    /// Single precision; NaN where there is no value.
    F32(Vec<f32>),
    /// Whole numbers with a sign, four bytes each.
    I32(Vec<i32>),
    /// Whole numbers, two bytes each.
    U16(Vec<u16>),
    /// Whole numbers, one byte each.
    U8(Vec<u8>),
    /// Whole numbers with a sign, eight bytes each.
    I64(Vec<i64>),
    /// Yes or no, one byte each: 1 and 0 with flags that say so, and the attribute `dtype` by which xarray
    /// knows its own boolean arrays.
    Bool(Vec<bool>),
    /// Texts of any length, not compressed: for labels, not for books.
    Text(Vec<String>),
}

/// One value, as tables and documents show it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Cell<'a> {
    /// No value: an empty cell, or null.
    Gap,
    Number(f64),
    Whole(i64),
    Flag(bool),
    Text(&'a str),
}

/// The value of an attribute.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Attribute {
    /// A text of any length.
    Text(String),
    /// A number.
    Number(f64),
    /// A whole number.
    Integer(i32),
    /// Several numbers.
    Numbers(Vec<f64>),
}

impl Dataset {
    /// An empty dataset with the attributes `title` and `Conventions`.
    pub fn new(title: impl Into<String>) -> Self {
        let empty = Self {
            dimensions: Vec::new(),
            variables: Vec::new(),
            columns: Vec::new(),
            header: Vec::new(),
            attributes: Vec::new(),
            tables: Vec::new(),
            ragged: Vec::new(),
        };
        empty
            .header("Conventions", "CF-1.11")
            .header("title", title.into())
    }

    /// Says where files of arrays come from, as their `source`. A document has a head of its own, so it does not repeat
    /// this.
    #[must_use]
    pub fn header(mut self, name: impl Into<String>, value: impl Into<Attribute>) -> Self {
        set(&mut self.header, name.into(), value.into());
        self
    }

    /// Says something about the whole dataset, such as its `source`, `history` or settings. The value may
    /// be a text, a number or several.
    #[must_use]
    pub fn attribute(mut self, name: impl Into<String>, value: impl Into<Attribute>) -> Self {
        set(&mut self.attributes, name.into(), value.into());
        self
    }

    /// Adds a dimension together with the values along it: `variable` comes from [`Variable::coordinate`].
    #[must_use]
    pub fn coordinate(mut self, variable: Variable) -> Self {
        self.dimensions
            .push((variable.name.clone(), variable.values.len()));
        self.variables.push(variable);
        self
    }

    /// Adds a dimension of `length` without values along it. The length may be zero, as that
    /// of the switches of a run without any.
    #[must_use]
    pub fn dimension(mut self, name: impl Into<String>, length: usize) -> Self {
        self.dimensions.push((name.into(), length));
        self
    }

    /// Adds an array over dimensions that are, or will be, part of the dataset.
    #[must_use]
    pub fn variable(mut self, variable: Variable) -> Self {
        self.variables.push(variable);
        self
    }

    /// Adds an array that tables alone show: what a variable holds, told in another way.
    #[must_use]
    pub fn column(mut self, variable: Variable) -> Self {
        self.columns.push(variable);
        self
    }

    /// Adds a table of what is, or will be, part of the dataset.
    #[must_use]
    pub fn table(mut self, table: Table) -> Self {
        self.tables.push(table);
        self
    }

    /// Declares that lists along this dimension have lengths of their own: a document cuts them behind their last known
    /// value.
    #[must_use]
    pub fn ragged(mut self, dimension: impl Into<String>) -> Self {
        self.ragged.push(dimension.into());
        self
    }

    /// The file as bytes. While it is made, each array is in memory once as it is and twice compressed.
    ///
    /// # Errors
    /// As [`check`](Self::check).
    pub fn to_bytes(self) -> Result<Vec<u8>, ResultsError> {
        self.check()?;
        file::encode(self)
    }

    /// The dataset in the bytes of a file that [`to_bytes`](Self::to_bytes) made: arrays, attributes, flags and fill
    /// values to the bit and in their order. Tables are in no such file.
    ///
    /// # Errors
    /// [`ResultsError::Unreadable`] if the bytes are no such file.
    pub fn from_bytes(bytes: Vec<u8>) -> Result<Self, ResultsError> {
        open::decode(bytes).map_err(|error| ResultsError::Unreadable {
            reason: error.to_string(),
        })
    }

    /// Whether all parts fit each other, for who takes them from memory.
    ///
    /// # Errors
    /// [`ResultsError::Dataset`], which names the part that does not fit: a dimension that is missing or
    /// given twice, a wrong number of values, a name that NetCDF does not allow.
    pub fn check(&self) -> Result<(), ResultsError> {
        check::check(self)
    }

    /// Names and lengths of the dimensions.
    pub fn dimensions(&self) -> &[(String, usize)] {
        &self.dimensions
    }

    /// Coordinates and variables, in the order of the file.
    pub fn variables(&self) -> &[Variable] {
        &self.variables
    }

    /// The variable or coordinate of this name.
    pub fn get(&self, name: &str) -> Option<&Variable> {
        self.variables.iter().find(|known| known.name == name)
    }

    /// Whether `name` is a coordinate: the values along the dimension of the same name.
    pub fn is_coordinate(&self, name: &str) -> bool {
        self.dimensions.iter().any(|known| known.0 == name) && self.get(name).is_some()
    }

    /// Names and values of the attributes of the whole dataset: the header, then the others.
    pub fn attributes(&self) -> impl Iterator<Item = &(String, Attribute)> {
        self.header.iter().chain(&self.attributes)
    }

    /// Attributes that documents tell too.
    pub(crate) fn told(&self) -> &[(String, Attribute)] {
        &self.attributes
    }

    /// A text of the header.
    pub(crate) fn head(&self, name: &str) -> &str {
        match self.header.iter().find(|known| known.0 == name) {
            Some((_, Attribute::Text(text))) => text,
            _ => "",
        }
    }

    /// The tables.
    pub fn tables(&self) -> &[Table] {
        &self.tables
    }

    /// An array that tables may show: a variable, or a column of theirs alone.
    pub(crate) fn shown(&self, name: &str) -> Option<&Variable> {
        let columns = self.columns.iter().find(|known| known.name == name);
        columns.or_else(|| self.get(name))
    }

    /// Length of a dimension.
    pub(crate) fn length(&self, dimension: &str) -> Option<usize> {
        let known = self.dimensions.iter().find(|known| known.0 == dimension);
        known.map(|known| known.1)
    }

    pub(crate) fn is_ragged(&self, dimension: &str) -> bool {
        self.ragged.iter().any(|known| known == dimension)
    }

    /// Coordinates and variables, to be taken over without a copy.
    pub fn into_variables(self) -> Vec<Variable> {
        self.variables
    }
}

impl Variable {
    /// An array over the named `dimensions`, the last of which varies fastest.
    pub fn new(name: impl Into<String>, dimensions: &[&str], values: impl Into<Values>) -> Self {
        Self {
            name: name.into(),
            dimensions: dimensions.iter().map(|&name| name.to_owned()).collect(),
            values: values.into(),
            attributes: Vec::new(),
            flags: Vec::new(),
            fill: None,
            words: &[],
            gap: None,
        }
    }

    /// The same array under another name.
    #[must_use]
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.name = name.into();
        self
    }

    /// The values along the dimension of the same name, for [`Dataset::coordinate`].
    pub fn coordinate(name: impl Into<String>, values: impl Into<Values>) -> Self {
        let name = name.into();
        Self::new(name.clone(), &[&name], values)
    }

    /// The attribute `units`, as "Hz" or "m s-2"; "1" for a ratio.
    #[must_use]
    pub fn units(self, units: impl Into<String>) -> Self {
        self.attribute("units", units.into())
    }

    /// The attribute `long_name`, a label for axes.
    #[must_use]
    pub fn long_name(self, name: impl Into<String>) -> Self {
        self.attribute("long_name", name.into())
    }

    /// Says what the whole numbers in the array mean, by the attributes `flag_values` and `flag_meanings`.
    /// A meaning is one word there; spaces within become `_`.
    #[must_use]
    pub fn flags<T: Into<String>>(mut self, meanings: impl IntoIterator<Item = (i32, T)>) -> Self {
        let word = |word: T| word.into().trim().replace(char::is_whitespace, "_");
        let meanings = meanings.into_iter();
        self.flags = meanings.map(|(value, text)| (value, word(text))).collect();
        self
    }

    /// Says what the whole numbers from 0 on stand for: tables and documents show the words, files of arrays the numbers
    /// with flags. A number behind the last word is a gap.
    #[must_use]
    pub fn words(mut self, words: &'static [&'static str]) -> Self {
        self.words = words;
        self.flags((0..).zip(words.iter().copied()))
    }

    /// The whole number that stands for no value in tables and documents, such as the period 0. Files of arrays keep it
    /// as it is; see [`fill`](Self::fill).
    #[must_use]
    pub fn gap(mut self, value: i32) -> Self {
        self.gap = Some(value);
        self
    }

    /// The value that stands for "no value" in an array of whole numbers, as the attribute `_FillValue`.
    /// xarray then reads the array as floating-point numbers with NaN; for discrete labels a flag of their
    /// own is better. Arrays of floating-point numbers have NaN for it without being told.
    #[must_use]
    pub fn fill(mut self, value: i32) -> Self {
        self.fill = Some(value);
        self
    }

    /// Any other attribute.
    #[must_use]
    pub fn attribute(mut self, name: impl Into<String>, value: impl Into<Attribute>) -> Self {
        set(&mut self.attributes, name.into(), value.into());
        self
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Names of its dimensions, the last of which varies fastest; none for a single value.
    pub fn dimensions(&self) -> &[String] {
        &self.dimensions
    }

    /// Its values.
    pub fn values(&self) -> &Values {
        &self.values
    }

    /// Its values, taken over without a copy.
    pub fn into_values(self) -> Values {
        self.values
    }

    /// Its long name, if it has one.
    pub fn long_name_text(&self) -> &str {
        self.text("long_name")
    }

    /// Its unit, if it has one.
    pub fn units_text(&self) -> &str {
        self.text("units")
    }

    fn text(&self, name: &str) -> &str {
        match self.attributes.iter().find(|known| known.0 == name) {
            Some((_, Attribute::Text(text))) => text,
            _ => "",
        }
    }

    pub(crate) fn has_words(&self) -> bool {
        !self.words.is_empty()
    }

    /// The value at `index`, as tables and documents show it.
    pub(crate) fn cell(&self, index: usize) -> Cell<'_> {
        let whole = |number: i64| match self.gap {
            Some(gap) if number == i64::from(gap) => Cell::Gap,
            _ if self.words.is_empty() => Cell::Whole(number),
            _ => usize::try_from(number)
                .ok()
                .and_then(|code| self.words.get(code))
                .map_or(Cell::Gap, |word| Cell::Text(word)),
        };
        let number = |number: f64| match number {
            _ if number.is_nan() => Cell::Gap,
            _ => Cell::Number(number),
        };
        match &self.values {
            Values::F64(values) => number(values[index]),
            Values::F32(values) => number(values[index].into()),
            Values::I32(values) => whole(values[index].into()),
            Values::U16(values) => whole(values[index].into()),
            Values::U8(values) => whole(values[index].into()),
            Values::I64(values) => whole(values[index]),
            Values::Bool(values) => Cell::Flag(values[index]),
            Values::Text(values) if values[index].is_empty() => Cell::Gap,
            Values::Text(values) => Cell::Text(&values[index]),
        }
    }

    /// Names and values of its attributes, without those that follow from flags and fill value.
    pub fn attributes(&self) -> &[(String, Attribute)] {
        &self.attributes
    }

    /// What its whole numbers mean, each a single word: `flag_values` and `flag_meanings` in the file.
    pub fn flag_meanings(&self) -> &[(i32, String)] {
        &self.flags
    }

    /// The value that stands for "no value", if one was given: `_FillValue` in the file.
    pub fn fill_value(&self) -> Option<i32> {
        self.fill
    }
}

/// Attributes keep the order in which they were first given; a later value replaces an earlier one.
fn set(attributes: &mut Vec<(String, Attribute)>, name: String, value: Attribute) {
    match attributes.iter_mut().find(|known| known.0 == name) {
        Some(known) => known.1 = value,
        None => attributes.push((name, value)),
    }
}

impl Values {
    /// Number of values.
    pub fn len(&self) -> usize {
        match self {
            Self::F64(values) => values.len(),
            Self::F32(values) => values.len(),
            Self::I32(values) => values.len(),
            Self::U16(values) => values.len(),
            Self::U8(values) => values.len(),
            Self::I64(values) => values.len(),
            Self::Bool(values) => values.len(),
            Self::Text(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// A single value, for a variable without dimensions.
macro_rules! single {
    ($($variant:ident ($source:ty)),*) => {
        $(impl From<$source> for Values {
            fn from(value: $source) -> Self {
                Self::$variant(vec![value])
            }
        })*
    };
}

single!(
    F64(f64),
    I32(i32),
    I64(i64),
    U8(u8),
    Bool(bool),
    Text(String)
);

impl From<&str> for Values {
    fn from(text: &str) -> Self {
        text.to_owned().into()
    }
}

/// Conversions from the types that a variant holds.
macro_rules! holds {
    ($($target:ident :: $variant:ident ($source:ty)),*) => {
        $(impl From<$source> for $target {
            fn from(value: $source) -> Self {
                Self::$variant(value)
            }
        })*
    };
}

holds!(
    Values::F64(Vec<f64>),
    Values::F32(Vec<f32>),
    Values::I32(Vec<i32>),
    Values::U16(Vec<u16>),
    Values::U8(Vec<u8>),
    Values::I64(Vec<i64>),
    Values::Bool(Vec<bool>),
    Values::Text(Vec<String>),
    Attribute::Text(String),
    Attribute::Number(f64),
    Attribute::Integer(i32),
    Attribute::Numbers(Vec<f64>)
);

impl From<&str> for Attribute {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}
