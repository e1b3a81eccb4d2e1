//! Tables: CSV whose numbers read back to the same bits, and Markdown for people.

use crate::ResultsError;
use std::fmt::Write as _;
use std::io::{self, Write};

/// One cell of a table.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Value {
    /// A number, written with as many digits as reading back needs and no more.
    Number(f64),
    /// A whole number.
    Integer(i64),
    /// A text.
    Text(String),
    /// Yes or no, written `true` or `false`.
    Flag(bool),
    /// Nothing.
    Empty,
}

impl From<f64> for Value {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<i64> for Value {
    fn from(value: i64) -> Self {
        Self::Integer(value)
    }
}

impl From<u32> for Value {
    fn from(value: u32) -> Self {
        Self::Integer(value.into())
    }
}

impl From<bool> for Value {
    fn from(value: bool) -> Self {
        Self::Flag(value)
    }
}

impl From<&str> for Value {
    fn from(value: &str) -> Self {
        Self::Text(value.to_owned())
    }
}

impl From<String> for Value {
    fn from(value: String) -> Self {
        Self::Text(value)
    }
}

impl<T: Into<Value>> From<Option<T>> for Value {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Empty, Into::into)
    }
}

impl std::fmt::Display for Value {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            // The debug form is the shortest that reads back, with an exponent where that is shorter.
            Self::Number(value) => write!(f, "{value:?}"),
            Self::Integer(value) => write!(f, "{value}"),
            Self::Text(value) => f.write_str(value),
            Self::Flag(value) => write!(f, "{value}"),
            Self::Empty => Ok(()),
        }
    }
}

/// A CSV table on its way into a file or any other writer.
///
/// First come the settings, each on a line that begins with `#`, then the header, then the rows.
/// Readers skip the settings with `comment='#'`.
///
/// ```
/// use saltus_results::CsvTable;
/// # fn main() -> Result<(), saltus_results::ResultsError> {
/// let mut table = CsvTable::new(Vec::new(), &[("mass (kg)", "75")], &["zeta", "phase"])?;
/// table.row(["0.1".into(), "flight".into()])?;
/// assert_eq!(table.finish()?, b"# mass (kg) = 75\nzeta,phase\n0.1,flight\n");
/// # Ok(())
/// # }
/// ```
pub struct CsvTable<W: Write> {
    writer: csv::Writer<W>,
    columns: usize,
    rows: usize,
}

impl<W: Write> CsvTable<W> {
    /// Writes the settings and the header.
    ///
    /// # Errors
    /// [`ResultsError::Table`] if `writer` refuses.
    pub fn new(
        mut writer: W,
        settings: &[(&str, &str)],
        header: &[&str],
    ) -> Result<Self, ResultsError> {
        for (key, value) in settings {
            // A line break inside a setting must not look like a row.
            let line = format!("{key} = {value}").replace(['\r', '\n'], " ");
            writeln!(writer, "# {line}").map_err(table_error)?;
        }
        let mut writer = csv::WriterBuilder::new().from_writer(writer);
        writer.write_record(header).map_err(csv_error)?;
        Ok(Self {
            writer,
            columns: header.len(),
            rows: 0,
        })
    }

    /// Appends a row.
    ///
    /// # Errors
    /// [`ResultsError::RowLength`] if it does not fit the header, [`ResultsError::Table`] if the writer
    /// refuses. Writing is buffered, so a full disk may show only in [`finish`](Self::finish).
    pub fn row(&mut self, cells: impl IntoIterator<Item = Value>) -> Result<(), ResultsError> {
        self.rows += 1;
        let cells: Vec<String> = cells.into_iter().map(|cell| cell.to_string()).collect();
        if cells.len() != self.columns {
            return Err(ResultsError::RowLength {
                row: self.rows,
                cells: cells.len(),
                columns: self.columns,
            });
        }
        self.writer.write_record(&cells).map_err(csv_error)
    }

    /// Writes out what is still buffered and gives the writer back.
    ///
    /// # Errors
    /// [`ResultsError::Table`] if not every byte could be written.
    pub fn finish(self) -> Result<W, ResultsError> {
        let mut inner = self
            .writer
            .into_inner()
            .map_err(|error| table_error(error.into_error()))?;
        inner.flush().map_err(table_error)?;
        Ok(inner)
    }
}

fn table_error(source: io::Error) -> ResultsError {
    ResultsError::Table { source }
}

fn csv_error(error: csv::Error) -> ResultsError {
    table_error(error.into())
}

/// A table in Markdown.
#[derive(Clone, Debug)]
pub struct MarkdownTable {
    text: String,
    columns: usize,
}

impl MarkdownTable {
    /// A table with a header and no rows yet.
    pub fn new(header: &[&str]) -> Self {
        let mut table = Self {
            text: String::new(),
            columns: header.len(),
        };
        table.line(header.iter().map(|cell| (*cell).into()));
        table.line(header.iter().map(|_| "---".into()));
        table
    }

    /// Appends a row; missing cells stay empty and surplus ones are left out.
    #[must_use]
    pub fn row(mut self, cells: impl IntoIterator<Item = Value>) -> Self {
        self.line(cells.into_iter());
        self
    }

    fn line(&mut self, cells: impl Iterator<Item = Value>) {
        let mut cells = cells.map(|cell| markdown(&cell.to_string()));
        for _ in 0..self.columns {
            // Writing to a string cannot fail.
            let _ = write!(self.text, "| {} ", cells.next().unwrap_or_default());
        }
        self.text.push_str("|\n");
    }
}

impl std::fmt::Display for MarkdownTable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.text)
    }
}

/// A cell that stays one cell: no bars and no line breaks.
fn markdown(cell: &str) -> String {
    cell.replace('\\', "\\\\")
        .replace('|', "\\|")
        .replace("\r\n", " ")
        .replace(['\r', '\n'], " ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_back_to_the_same_bits() {
        let numbers = [
            0.1,
            -0.0,
            1.0 / 3.0,
            1e300,
            5e-324,
            f64::MAX,
            std::f64::consts::PI,
            f64::NAN,
            f64::NEG_INFINITY,
        ];
        let mut table = CsvTable::new(Vec::new(), &[("note", "a\nb")], &["x"]).expect("memory");
        for x in numbers {
            table.row([x.into()]).expect("memory");
        }
        let bytes = table.finish().expect("memory");
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .from_reader(&bytes[..]);
        let read: Vec<f64> = reader
            .records()
            .map(|record| record.expect("row")[0].parse().expect("number"))
            .collect();
        assert_eq!(read.len(), numbers.len());
        for (back, x) in read.iter().zip(numbers) {
            assert!(
                back.to_bits() == x.to_bits() || (back.is_nan() && x.is_nan()),
                "{x:?} came back as {back:?}"
            );
        }
    }

    #[test]
    fn texts_are_quoted_and_rows_counted() {
        let mut table = CsvTable::new(Vec::new(), &[], &["a", "b"]).expect("memory");
        table
            .row(["x, \"y\"".into(), Value::Empty])
            .expect("memory");
        let error = table.row([1.0.into()]).expect_err("one cell of two");
        assert_eq!(error.to_string(), "row 2 has 1 cells, the header has 2");
        assert_eq!(table.finish().expect("memory"), b"a,b\n\"x, \"\"y\"\"\",\n");
    }

    #[test]
    fn markdown_cells_stay_cells() {
        let table = MarkdownTable::new(&["claim", "value"])
            .row(["a|b\nc".into(), 2.5.into()])
            .row([]);
        assert_eq!(
            table.to_string(),
            "| claim | value |\n| --- | --- |\n| a\\|b c | 2.5 |\n|  |  |\n"
        );
    }
}
