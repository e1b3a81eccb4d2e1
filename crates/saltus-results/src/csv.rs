//! Tables as CSV, whose numbers read back to the same bits.
//!
//! Lines that begin with `#` say what the file is and what each column means; then come header and rows.

use crate::ResultsError;
use crate::dataset::{Cell, Dataset};
use crate::table::{Rows, Table, note};
use std::io::{self, Write};

/// Writes a table of `dataset` and gives the writer back.
///
/// # Errors
/// [`ResultsError::Dataset`] if the table does not fit the dataset, [`ResultsError::Table`] if not every byte could be
/// written.
pub fn csv<W: Write>(dataset: &Dataset, table: &Table, mut writer: W) -> Result<W, ResultsError> {
    let rows = Rows::of(table, dataset)?;
    let columns = rows.file_columns(table, dataset)?;
    let head = match dataset.head("source") {
        "" => dataset.head("title").to_owned(),
        source => format!("{} ({source})", dataset.head("title")),
    };
    let notes = columns
        .iter()
        .map(|column| format!("{}: {}", column.title, note(column.variable)));
    for line in [head].into_iter().chain(notes) {
        writeln!(writer, "# {}", line.replace(['\r', '\n'], " ")).map_err(refused)?;
    }
    let mut writer = csv::WriterBuilder::new().from_writer(writer);
    let refused_row = |error: csv::Error| refused(error.into());
    writer
        .write_record(columns.iter().map(|column| &column.title))
        .map_err(refused_row)?;
    for row in rows.iter() {
        for column in &columns {
            let cell = text(column.variable.cell(column.index(&row)));
            writer.write_field(cell).map_err(refused_row)?;
        }
        writer.write_record(None::<&[u8]>).map_err(refused_row)?;
    }
    let mut inner = writer
        .into_inner()
        .map_err(|error| refused(error.into_error()))?;
    inner.flush().map_err(refused)?;
    Ok(inner)
}

fn text(cell: Cell<'_>) -> String {
    match cell {
        Cell::Gap => String::new(),
        // the debug form is the shortest that reads back, with an exponent where that is shorter
        Cell::Number(value) => format!("{value:?}"),
        Cell::Whole(value) => value.to_string(),
        Cell::Flag(value) => value.to_string(),
        Cell::Text(text) => text.to_owned(),
    }
}

fn refused(source: io::Error) -> ResultsError {
    ResultsError::Table { source }
}
