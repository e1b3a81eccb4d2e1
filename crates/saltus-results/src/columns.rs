//! Rows of a table as typed columns, for who wants arrays and not text.
//!
//! ```
//! use saltus_results::{Column, Columns, Value};
//! # fn main() -> Result<(), saltus_results::ResultsError> {
//! let mut table = Columns::new(&[("mass (kg)", "75")], &["ratio", "period"]);
//! table.row([0.9.into(), 1_i64.into()])?;
//! table.row([Value::Empty, 2_i64.into()])?;
//! assert_eq!(table.get("period"), Some(&Column::I64(vec![1, 2])));
//! assert!(matches!(table.get("ratio"), Some(Column::F64(ratio)) if ratio[1].is_nan()));
//! # Ok(())
//! # }
//! ```

use crate::{ResultsError, Value};

/// A table in memory, column by column.
#[derive(Clone, Debug, PartialEq)]
pub struct Columns {
    settings: Vec<(String, String)>,
    names: Vec<String>,
    columns: Vec<Column>,
    seen: Vec<Seen>,
    rows: usize,
}

/// The values of one column: the narrowest of these types that holds all its cells, whatever their order.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Column {
    /// Numbers, NaN for empty cells. So is a column of empty cells only.
    F64(Vec<f64>),
    /// Whole numbers, if no cell is empty.
    I64(Vec<i64>),
    /// Yes or no, `None` for empty cells.
    Flags(Vec<Option<bool>>),
    /// Texts, `None` for empty cells. So is a column that mixes numbers, flags and texts, and one of whole
    /// numbers with gaps of which some are too large for a floating-point number; a number is written as it
    /// reads back, without `.0` if it is whole, and NaN is an empty cell.
    Text(Vec<Option<String>>),
}

impl Columns {
    /// A table without rows.
    pub fn new(settings: &[(&str, &str)], header: &[&str]) -> Self {
        let owned = |&(key, value): &(&str, &str)| (key.to_owned(), value.to_owned());
        Self {
            settings: settings.iter().map(owned).collect(),
            names: header.iter().map(|&name| name.to_owned()).collect(),
            columns: vec![Column::F64(Vec::new()); header.len()],
            seen: vec![Seen::default(); header.len()],
            rows: 0,
        }
    }

    /// Appends a row.
    ///
    /// # Errors
    /// [`ResultsError::RowLength`] if it does not fit the header; the table is then as it was.
    pub fn row(&mut self, cells: impl IntoIterator<Item = Value>) -> Result<(), ResultsError> {
        let cells: Vec<Value> = cells.into_iter().collect();
        if cells.len() != self.columns.len() {
            return Err(ResultsError::RowLength {
                row: self.rows + 1,
                cells: cells.len(),
                columns: self.columns.len(),
            });
        }
        for ((column, seen), cell) in self.columns.iter_mut().zip(&mut self.seen).zip(cells) {
            seen.add(&cell);
            column.become_kind(seen.kind());
            column.push(cell);
        }
        self.rows += 1;
        Ok(())
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Names and values of the settings.
    pub fn settings(&self) -> &[(String, String)] {
        &self.settings
    }

    /// Names of the columns, in their order.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The columns, in the order of their names.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The first column of this name.
    pub fn get(&self, name: &str) -> Option<&Column> {
        let place = self.names.iter().position(|known| known == name)?;
        self.columns.get(place)
    }

    /// Names and columns, to be taken over without a copy.
    pub fn into_columns(self) -> impl Iterator<Item = (String, Column)> {
        self.names.into_iter().zip(self.columns)
    }
}

impl Column {
    /// Number of cells.
    pub fn len(&self) -> usize {
        match self {
            Self::F64(values) => values.len(),
            Self::I64(values) => values.len(),
            Self::Flags(values) => values.len(),
            Self::Text(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    fn kind(&self) -> Kind {
        match self {
            Self::F64(_) => Kind::F64,
            Self::I64(_) => Kind::I64,
            Self::Flags(_) => Kind::Flags,
            Self::Text(_) => Kind::Text,
        }
    }

    /// The same cells in another type, which holds them all by the rules of [`Seen::kind`].
    fn become_kind(&mut self, kind: Kind) {
        if self.kind() == kind {
            return;
        }
        let old = std::mem::replace(self, kind.column());
        match old {
            Self::F64(values) => values.into_iter().for_each(|x| self.push(Value::Number(x))),
            Self::I64(values) => values
                .into_iter()
                .for_each(|n| self.push(Value::Integer(n))),
            Self::Flags(values) => values.into_iter().for_each(|flag| self.push(flag.into())),
            Self::Text(values) => values.into_iter().for_each(|text| self.push(text.into())),
        }
    }

    /// Appends a cell that the type holds.
    pub(crate) fn push(&mut self, cell: Value) {
        match (self, cell) {
            (Self::F64(values), Value::Number(x)) => values.push(x),
            (Self::F64(values), Value::Integer(n)) => values.push(n as f64),
            (Self::F64(values), _) => values.push(f64::NAN),
            (Self::I64(values), Value::Integer(n)) => values.push(n),
            (Self::I64(values), _) => values.push(0),
            (Self::Flags(values), Value::Flag(flag)) => values.push(Some(flag)),
            (Self::Flags(values), _) => values.push(None),
            (Self::Text(values), cell) => values.push(text(cell)),
        }
    }
}

fn text(cell: Value) -> Option<String> {
    match cell {
        Value::Empty => None,
        Value::Text(text) => Some(text),
        Value::Number(x) if x.is_nan() => None,
        // As if it had been given as a whole number, which it may have been.
        Value::Number(x) if x.fract() == 0.0 && x.abs() <= EXACT as f64 => {
            Some((x as i64).to_string())
        }
        cell => Some(cell.to_string()),
    }
}

/// Up to here every whole number is a floating-point number: 2⁵³.
const EXACT: u64 = 1 << 53;

/// The types of columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    F64,
    I64,
    Flags,
    Text,
}

impl Kind {
    pub(crate) fn column(self) -> Column {
        match self {
            Self::F64 => Column::F64(Vec::new()),
            Self::I64 => Column::I64(Vec::new()),
            Self::Flags => Column::Flags(Vec::new()),
            Self::Text => Column::Text(Vec::new()),
        }
    }
}

/// What kinds of cells a column has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Seen {
    empty: bool,
    real: bool,
    whole: bool,
    /// A whole number beyond [`EXACT`].
    large: bool,
    flag: bool,
    text: bool,
}

impl Seen {
    pub(crate) fn add(&mut self, cell: &Value) {
        match cell {
            Value::Empty => self.empty = true,
            Value::Number(x) if x.is_nan() => self.empty = true,
            Value::Number(_) => self.real = true,
            Value::Integer(n) => {
                self.whole = true;
                self.large |= n.unsigned_abs() > EXACT;
            }
            Value::Flag(_) => self.flag = true,
            Value::Text(_) => self.text = true,
        }
    }

    /// The narrowest type for all cells seen; it does not depend on their order.
    pub(crate) fn kind(self) -> Kind {
        let numbers = self.real || self.whole;
        let mixed = self.flag && numbers || self.large && (self.real || self.empty);
        if self.text || mixed {
            Kind::Text
        } else if self.flag {
            Kind::Flags
        } else if self.whole && !self.real && !self.empty {
            Kind::I64
        } else {
            Kind::F64
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(cells: &[Value]) -> Column {
        let mut table = Columns::new(&[], &["x"]);
        for cell in cells {
            table.row([cell.clone()]).expect("one cell");
        }
        assert_eq!(table.rows(), cells.len());
        table.get("x").expect("x").clone()
    }

    fn texts(cells: &[&str]) -> Column {
        let cell = |&cell: &&str| Some(cell.to_owned()).filter(|cell| !cell.is_empty());
        Column::Text(cells.iter().map(cell).collect())
    }

    #[test]
    fn a_column_has_the_narrowest_type_of_all_its_cells() {
        use Value::{Empty, Flag, Integer, Number};
        assert_eq!(
            column(&[Integer(i64::MAX), Integer(-1)]),
            Column::I64(vec![i64::MAX, -1])
        );
        assert_eq!(
            column(&[Integer(3), Number(0.5)]),
            Column::F64(vec![3.0, 0.5])
        );
        assert_eq!(column(&[]), Column::F64(vec![]));
        let flags = vec![None, Some(true), None];
        assert_eq!(column(&[Empty, Flag(true), Empty]), Column::Flags(flags));
        assert_eq!(column(&[Empty, "a".into()]), texts(&["", "a"]));
        assert_eq!(column(&[Flag(true), Integer(1)]), texts(&["true", "1"]));
        assert_eq!(
            column(&[Integer(i64::MAX), Empty]),
            texts(&["9223372036854775807", ""])
        );
        for gap in [Empty, Number(f64::NAN)] {
            let Column::F64(values) = column(&[Integer(7), gap.clone(), gap]) else {
                panic!("a gap makes numbers of whole numbers");
            };
            assert!(values[0] == 7.0 && values[1].is_nan() && values[2].is_nan());
        }
    }

    #[test]
    fn the_order_of_the_rows_changes_no_type_and_no_text() {
        use Value::{Empty, Flag, Integer, Number};
        let cells = [
            Integer(2),
            Number(0.1),
            Empty,
            Number(3.0),
            Flag(false),
            "chaos".into(),
        ];
        let expected = ["2", "0.1", "", "3", "false", "chaos"];
        for start in 0..cells.len() {
            let (mut cells, mut expected) = (cells.clone(), expected);
            cells.rotate_left(start);
            expected.rotate_left(start);
            assert_eq!(column(&cells), texts(&expected));
        }
    }

    #[test]
    fn a_row_that_does_not_fit_is_refused_and_leaves_the_table_alone() {
        let mut table = Columns::new(&[("mass (kg)", "75")], &["x", "y"]);
        table.row([1.0.into(), 2.0.into()]).expect("fits");
        let error = table.row([1.0.into()]).expect_err("one cell of two");
        assert_eq!(error.to_string(), "row 2 has 1 cells, the header has 2");
        assert_eq!(
            (table.rows(), table.names()),
            (1, &["x".to_owned(), "y".to_owned()][..])
        );
        let columns: Vec<_> = table.into_columns().collect();
        assert_eq!(columns[1], ("y".to_owned(), Column::F64(vec![2.0])));
    }
}
