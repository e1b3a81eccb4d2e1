//! Tables: what of a dataset stands row by row in a file of cells, and as a list of records in a document.
//!
//! A table holds no numbers. It names axes, whose places are its rows, and variables, which are its columns.
//!
//! ```
//! use saltus_results::{Dataset, Quantity, Table};
//! # fn main() -> Result<(), saltus_results::ResultsError> {
//! const RATIO: Quantity = Quantity::new("ratio", "Frequency ratio", "1");
//! const PERIOD: Quantity = Quantity::new("period", "Period in forcing periods", "1");
//! let dataset = Dataset::new("Periods")
//!     .coordinate(RATIO.along(vec![0.9, 1.1]))
//!     .variable(PERIOD.over(&["ratio"], vec![2, 0]).gap(0))
//!     .table(Table::new("rows", &["ratio"]).columns(&["ratio", "period"]));
//! let csv = saltus_results::csv(&dataset, &dataset.tables()[0], Vec::new())?;
//! assert!(csv.ends_with(b"ratio,period\n0.9,2\n1.1,\n"));
//! let json = serde_json::to_string(&saltus_results::Document::new(&dataset)).unwrap();
//! assert_eq!(json, r#"{"rows":[{"ratio":0.9,"period":2},{"ratio":1.1,"period":null}]}"#);
//! # Ok(())
//! # }
//! ```

use crate::ResultsError;
use crate::dataset::{Cell, Dataset, Values, Variable};

/// One row for each place of some axes, one column for each of some variables.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    name: String,
    rows: Vec<String>,
    columns: Vec<(String, String)>,
    beside: Vec<(String, Vec<String>)>,
    only: Option<String>,
    wanted: Option<Vec<bool>>,
    goes: Goes,
}

/// In which formats a table is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Goes {
    Everywhere,
    Files,
    Document,
}

impl Table {
    /// A table named as its file, without ending, and as its list in the document. Its rows are the places of these
    /// axes, the last of which varies fastest; without axes it has one row, and its columns are keys of the document
    /// itself.
    pub fn new(name: impl Into<String>, rows: &[&str]) -> Self {
        Self {
            name: name.into(),
            rows: owned(rows),
            columns: Vec::new(),
            beside: Vec::new(),
            only: None,
            wanted: None,
            goes: Goes::Everywhere,
        }
    }

    /// Keys of the document itself, which no file has.
    pub fn of_document(variables: &[&str]) -> Self {
        Self::new("", &[]).columns(variables).in_document()
    }

    /// Adds columns named as their variables.
    #[must_use]
    pub fn columns(self, variables: &[&str]) -> Self {
        let add = |table: Self, name: &&str| table.titled(*name, *name);
        variables.iter().fold(self, add)
    }

    /// Adds a column with another title.
    #[must_use]
    pub fn titled(mut self, title: impl Into<String>, variable: impl Into<String>) -> Self {
        self.columns.push((title.into(), variable.into()));
        self
    }

    /// Gives each place of `axis` a column of its own in files: the title with the suffix of the place. Neighbouring
    /// columns over the same axis take turns: `z_0`, `v_0`, `z_1`, `v_1`. Documents have lists.
    #[must_use]
    pub fn beside(
        mut self,
        axis: impl Into<String>,
        suffixes: impl IntoIterator<Item = String>,
    ) -> Self {
        self.beside
            .push((axis.into(), suffixes.into_iter().collect()));
        self
    }

    /// Leaves out the rows in which `variable` has no value.
    #[must_use]
    pub fn only_where(mut self, variable: impl Into<String>) -> Self {
        self.only = Some(variable.into());
        self
    }

    /// Leaves out all other rows: one answer for each place of the axes.
    #[must_use]
    pub fn only_rows(mut self, wanted: Vec<bool>) -> Self {
        self.wanted = Some(wanted);
        self
    }

    /// Leaves it out of documents.
    #[must_use]
    pub fn in_files(mut self) -> Self {
        self.goes = Goes::Files;
        self
    }

    /// Leaves it out of files.
    #[must_use]
    pub fn in_document(mut self) -> Self {
        self.goes = Goes::Document;
        self
    }

    /// Its name; empty if its columns are keys of the document itself.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether it has a file.
    pub fn is_file(&self) -> bool {
        self.goes != Goes::Document
    }

    /// Whether documents have it.
    pub fn is_in_document(&self) -> bool {
        self.goes != Goes::Files
    }

    /// The columns of its file: title, meaning with unit, and cells.
    ///
    /// # Errors
    /// [`ResultsError::Dataset`] if it does not fit `dataset`.
    pub fn to_columns(&self, dataset: &Dataset) -> Result<Vec<NamedColumn>, ResultsError> {
        let rows = Rows::of(self, dataset)?;
        let columns = rows.file_columns(self, dataset)?;
        let named = |column: &Column<'_>| NamedColumn {
            title: column.title.clone(),
            note: note(column.variable),
            cells: column.cells(rows.iter().map(|row| column.index(&row))),
        };
        Ok(columns.iter().map(named).collect())
    }

    /// Whether its axes and variables are part of `dataset`.
    pub(crate) fn check(&self, dataset: &Dataset) -> Result<(), ResultsError> {
        let rows = Rows::of(self, dataset)?;
        if self.is_file() {
            rows.file_columns(self, dataset)?;
        }
        rows.columns(self, dataset).map(drop)
    }
}

/// A column of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedColumn {
    /// Its title in the header.
    pub title: String,
    /// Its meaning, with its unit.
    pub note: String,
    /// Its cells.
    pub cells: Cells,
}

/// The cells of a column, by the type of its variable.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Cells {
    /// Numbers, NaN for empty cells; also whole numbers of which some are empty.
    F64(Vec<f64>),
    /// Whole numbers.
    I64(Vec<i64>),
    /// Yes or no.
    Flags(Vec<bool>),
    /// Texts, `None` for empty cells.
    Text(Vec<Option<String>>),
}

/// A variable in a table.
pub(crate) struct Column<'a> {
    pub(crate) title: String,
    pub(crate) variable: &'a Variable,
    /// Distances between its values along each axis of the rows; 0 where it has no such axis.
    strides: Vec<usize>,
    offset: usize,
    /// Its axes that are no rows: name, length, stride.
    pub(crate) inner: Vec<(&'a str, usize, usize)>,
}

impl<'a> Column<'a> {
    fn new(
        title: &str,
        variable: &'a Variable,
        rows: &[String],
        dataset: &Dataset,
    ) -> Result<Self, ResultsError> {
        let mut strides = vec![0; rows.len()];
        let mut inner = Vec::new();
        let mut stride = 1;
        for axis in variable.dimensions().iter().rev() {
            let length = dataset
                .length(axis)
                .ok_or_else(|| missing(title, "dimension", axis))?;
            match rows.iter().position(|row| row == axis) {
                Some(place) => strides[place] = stride,
                None => inner.insert(0, (axis.as_str(), length, stride)),
            }
            stride *= length;
        }
        Ok(Self {
            title: title.to_owned(),
            variable,
            strides,
            offset: 0,
            inner,
        })
    }

    /// Index of its value, or of the first of its list, in a row.
    pub(crate) fn index(&self, row: &[usize]) -> usize {
        let along = self.strides.iter().zip(row);
        self.offset + along.map(|(stride, place)| stride * place).sum::<usize>()
    }

    fn cells(&self, indices: impl Iterator<Item = usize>) -> Cells {
        let cells: Vec<Cell<'_>> = indices.map(|index| self.variable.cell(index)).collect();
        let any_gap = cells.contains(&Cell::Gap);
        let number = |cell: &Cell<'_>| match *cell {
            Cell::Number(x) => x,
            Cell::Whole(n) => n as f64,
            _ => f64::NAN,
        };
        match self.variable.values() {
            _ if self.variable.has_words() => Cells::Text(cells.iter().map(text).collect()),
            Values::Text(_) => Cells::Text(cells.iter().map(text).collect()),
            Values::Bool(_) => {
                Cells::Flags(cells.iter().map(|cell| *cell == Cell::Flag(true)).collect())
            }
            Values::F64(_) | Values::F32(_) => Cells::F64(cells.iter().map(number).collect()),
            _ if any_gap => Cells::F64(cells.iter().map(number).collect()),
            _ => {
                let whole = |cell: &Cell<'_>| match *cell {
                    Cell::Whole(n) => n,
                    _ => 0,
                };
                Cells::I64(cells.iter().map(whole).collect())
            }
        }
    }
}

fn text(cell: &Cell<'_>) -> Option<String> {
    match cell {
        Cell::Text(text) => Some((*text).to_owned()),
        _ => None,
    }
}

/// The rows of a table.
pub(crate) struct Rows<'a> {
    axes: &'a [String],
    lengths: Vec<usize>,
    only: Option<Column<'a>>,
    wanted: Option<&'a [bool]>,
}

impl<'a> Rows<'a> {
    pub(crate) fn of(table: &'a Table, dataset: &'a Dataset) -> Result<Self, ResultsError> {
        let length = |axis: &String| {
            let known = dataset.length(axis);
            known.ok_or_else(|| missing(&table.name, "dimension", axis))
        };
        let lengths: Vec<usize> = table.rows.iter().map(length).collect::<Result<_, _>>()?;
        let places: usize = lengths.iter().product();
        if let Some(wanted) = table.wanted.as_ref().filter(|w| w.len() != places) {
            let problem = format!("has {places} places, and {} are chosen among", wanted.len());
            return Err(refuse(&table.name, problem));
        }
        let only = table.only.as_ref().map(|name| {
            let variable = shown(&table.name, dataset, name)?;
            Column::new(name, variable, &table.rows, dataset)
        });
        Ok(Self {
            axes: &table.rows,
            lengths,
            only: only.transpose()?,
            wanted: table.wanted.as_deref(),
        })
    }

    /// The places of each row on the axes.
    pub(crate) fn iter(&self) -> impl Iterator<Item = Vec<usize>> {
        let places = 0..self.lengths.iter().product();
        places
            .filter(|&place| self.wanted.is_none_or(|wanted| wanted[place]))
            .map(|place| self.row(place))
            .filter(|row| {
                let known =
                    |column: &Column<'_>| column.variable.cell(column.index(row)) != Cell::Gap;
                self.only.as_ref().is_none_or(known)
            })
    }

    fn row(&self, mut place: usize) -> Vec<usize> {
        let mut row = vec![0; self.lengths.len()];
        for (index, length) in row.iter_mut().zip(&self.lengths).rev() {
            (*index, place) = (place % length, place / length);
        }
        row
    }

    /// A column for each variable of the table.
    pub(crate) fn columns(
        &self,
        table: &Table,
        dataset: &'a Dataset,
    ) -> Result<Vec<Column<'a>>, ResultsError> {
        let column = |(title, name): &(String, String)| {
            let variable = shown(&table.name, dataset, name)?;
            Column::new(title, variable, self.axes, dataset)
        };
        table.columns.iter().map(column).collect()
    }

    /// As files have them: places side by side.
    pub(crate) fn file_columns(
        &self,
        table: &Table,
        dataset: &'a Dataset,
    ) -> Result<Vec<Column<'a>>, ResultsError> {
        let mut all = Vec::new();
        let mut columns = self.columns(table, dataset)?.into_iter().peekable();
        while let Some(column) = columns.next() {
            let axis = match column.inner.as_slice() {
                [] => {
                    all.push(column);
                    continue;
                }
                [(axis, length, _)] => (*axis, *length),
                _ => return Err(refuse(&table.name, several(&column))),
            };
            let beside = table.beside.iter().find(|(known, _)| known == axis.0);
            let Some((_, suffixes)) = beside.filter(|beside| beside.1.len() == axis.1) else {
                return Err(refuse(&table.name, several(&column)));
            };
            let mut group = vec![column];
            let same = |next: &Column<'_>| next.inner.len() == 1 && next.inner[0].0 == axis.0;
            while let Some(next) = columns.next_if(same) {
                group.push(next);
            }
            for (place, suffix) in suffixes.iter().enumerate() {
                all.extend(group.iter().map(|column| Column {
                    title: format!("{}{suffix}", column.title),
                    variable: column.variable,
                    strides: column.strides.clone(),
                    offset: place * column.inner[0].2,
                    inner: Vec::new(),
                }));
            }
        }
        Ok(all)
    }
}

fn several(column: &Column<'_>) -> String {
    let axes: Vec<&str> = column.inner.iter().map(|axis| axis.0).collect();
    format!(
        "has the column `{}` with several values in a row, over {}: make it a row, or give each place a column",
        column.title,
        axes.join(", ")
    )
}

/// Meaning of a variable, with its unit.
pub(crate) fn note(variable: &Variable) -> String {
    let (meaning, unit) = (variable.long_name_text(), variable.units_text());
    match unit {
        "" => meaning.to_owned(),
        "1" => format!("{meaning} (-)"),
        unit => format!("{meaning} ({unit})"),
    }
}

fn shown<'a>(table: &str, dataset: &'a Dataset, name: &str) -> Result<&'a Variable, ResultsError> {
    dataset
        .shown(name)
        .ok_or_else(|| missing(table, "variable", name))
}

fn missing(table: &str, what: &str, name: &str) -> ResultsError {
    refuse(
        table,
        format!("shows the {what} `{name}`, which is not there"),
    )
}

fn refuse(table: &str, problem: String) -> ResultsError {
    ResultsError::Dataset {
        name: format!("table {table}"),
        problem,
    }
}

fn owned(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.to_owned()).collect()
}
