//! Tables as Parquet files, for those too long for CSV.
//!
//! A Parquet file begins with nothing but needs the type of each column before the first row, and the type
//! follows from all rows ([`Column`]). So rows wait in a temporary file until the last one is there; then
//! they are written in groups. Neither takes more memory than a group: 131 072 rows, at 8 bytes a number.
//! The temporary file takes 9 bytes a number on the disk.
//!
//! Settings are key-value metadata of the file. Empty cells of numbers are NaN, those of texts and flags are
//! null. Columns are compressed by snappy.
//!
//! ```
//! use saltus_results::ParquetTable;
//! # fn main() -> Result<(), saltus_results::ResultsError> {
//! let mut table = ParquetTable::new(&[("mass (kg)", "75")], &["zeta", "phase"]);
//! table.row([0.1.into(), "flight".into()])?;
//! assert!(table.finish(Vec::new())?.starts_with(b"PAR1"));
//! # Ok(())
//! # }
//! ```

use crate::columns::{Kind, Seen};
use crate::{Column, ResultsError, Value};
use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::{Type, TypePtr};
use std::io::{self, BufReader, BufWriter, Read, Seek, Write};
use std::sync::Arc;
use tempfile::SpooledTempFile;

/// Rows of a group.
const GROUP: u64 = 1 << 17;
/// Bytes that wait in memory before there is a file.
const SPOOL: usize = 1 << 20;

/// A Parquet table on its way into a file or any other writer.
pub struct ParquetTable {
    settings: Vec<(String, String)>,
    names: Vec<String>,
    seen: Vec<Seen>,
    rows: u64,
    spool: BufWriter<SpooledTempFile>,
}

impl ParquetTable {
    /// A table without rows.
    pub fn new(settings: &[(&str, &str)], header: &[&str]) -> Self {
        let owned = |&(key, value): &(&str, &str)| (key.to_owned(), value.to_owned());
        Self {
            settings: settings.iter().map(owned).collect(),
            names: header.iter().map(|&name| name.to_owned()).collect(),
            seen: vec![Seen::default(); header.len()],
            rows: 0,
            spool: BufWriter::new(tempfile::spooled_tempfile(SPOOL)),
        }
    }

    /// Appends a row.
    ///
    /// # Errors
    /// [`ResultsError::RowLength`] if it does not fit the header, [`ResultsError::Table`] if the temporary
    /// file refuses.
    pub fn row(&mut self, cells: impl IntoIterator<Item = Value>) -> Result<(), ResultsError> {
        let cells: Vec<Value> = cells.into_iter().collect();
        if cells.len() != self.seen.len() {
            return Err(ResultsError::RowLength {
                row: self.rows as usize + 1,
                cells: cells.len(),
                columns: self.seen.len(),
            });
        }
        for (seen, cell) in self.seen.iter_mut().zip(&cells) {
            seen.add(cell);
            put(&mut self.spool, cell).map_err(table_error)?;
        }
        self.rows += 1;
        Ok(())
    }

    /// Writes the file and gives the writer back.
    ///
    /// # Errors
    /// [`ResultsError::Table`] if not every byte could be written, or if two columns have the same name.
    pub fn finish<W: Write + Send>(self, mut writer: W) -> Result<W, ResultsError> {
        let kinds: Vec<Kind> = self.seen.iter().map(|seen| seen.kind()).collect();
        let spool = self.spool.into_inner();
        let mut spool = spool.map_err(|error| table_error(error.into_error()))?;
        spool.rewind().map_err(table_error)?;
        let mut spool = BufReader::new(spool);
        let layout = (&self.settings[..], &self.names[..], &kinds[..]);
        write(layout, self.rows, &mut spool, &mut writer)
            .map_err(|error| table_error(io_error(error)))?;
        Ok(writer)
    }
}

/// Settings, names and types of the columns.
type Layout<'a> = (&'a [(String, String)], &'a [String], &'a [Kind]);

fn write<W: Write + Send>(
    (settings, names, kinds): Layout<'_>,
    rows: u64,
    spool: &mut impl Read,
    writer: W,
) -> Result<(), ParquetError> {
    let entry = |(key, value): &(String, String)| KeyValue::new(key.clone(), value.clone());
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_key_value_metadata(Some(settings.iter().map(entry).collect()))
        .build();
    let mut file = SerializedFileWriter::new(writer, schema(names, kinds)?, Arc::new(properties))?;
    for start in (0..rows).step_by(GROUP as usize) {
        let mut columns: Vec<Column> = kinds.iter().map(|kind| kind.column()).collect();
        for _ in start..rows.min(start + GROUP) {
            for column in &mut columns {
                column.push(take(spool)?);
            }
        }
        let mut group = file.next_row_group()?;
        for column in &columns {
            if let Some(mut place) = group.next_column()? {
                fill(&mut place, column)?;
                place.close()?;
            }
        }
        group.close()?;
    }
    file.finish().map(drop)
}

fn schema(names: &[String], kinds: &[Kind]) -> Result<TypePtr, ParquetError> {
    let field = |(name, kind): (&String, &Kind)| {
        let (physical, repetition) = match kind {
            Kind::F64 => (Physical::DOUBLE, Repetition::REQUIRED),
            Kind::I64 => (Physical::INT64, Repetition::REQUIRED),
            Kind::Flags => (Physical::BOOLEAN, Repetition::OPTIONAL),
            Kind::Text => (Physical::BYTE_ARRAY, Repetition::OPTIONAL),
        };
        let text = (*kind == Kind::Text).then_some(LogicalType::String);
        Type::primitive_type_builder(name, physical)
            .with_repetition(repetition)
            .with_logical_type(text)
            .build()
            .map(Arc::new)
    };
    let fields: Result<Vec<TypePtr>, _> = names.iter().zip(kinds).map(field).collect();
    let group = Type::group_type_builder("schema").with_fields(fields?);
    group.build().map(Arc::new)
}

/// Writes the cells of a group into one column.
fn fill(place: &mut SerializedColumnWriter<'_>, column: &Column) -> Result<(), ParquetError> {
    let there = |flags: Vec<bool>| -> Vec<i16> { flags.into_iter().map(i16::from).collect() };
    match column {
        Column::F64(values) => place.typed::<DoubleType>().write_batch(values, None, None),
        Column::I64(values) => place.typed::<Int64Type>().write_batch(values, None, None),
        Column::Flags(values) => {
            let levels = there(values.iter().map(Option::is_some).collect());
            let values: Vec<bool> = values.iter().flatten().copied().collect();
            let place = place.typed::<BoolType>();
            place.write_batch(&values, Some(&levels), None)
        }
        Column::Text(values) => {
            let levels = there(values.iter().map(Option::is_some).collect());
            let values = values.iter().flatten();
            let values: Vec<ByteArray> = values.map(|text| text.as_str().into()).collect();
            let place = place.typed::<ByteArrayType>();
            place.write_batch(&values, Some(&levels), None)
        }
    }
    .map(drop)
}

/// Writes a cell into the temporary file: a letter for its kind, then its bytes.
fn put(spool: &mut impl Write, cell: &Value) -> io::Result<()> {
    let mut with = |letter: u8, bytes: &[u8]| {
        spool.write_all(&[letter])?;
        spool.write_all(bytes)
    };
    match cell {
        Value::Empty => with(b'e', &[]),
        Value::Flag(flag) => with(b'f', &[(*flag).into()]),
        Value::Integer(number) => with(b'i', &number.to_le_bytes()),
        Value::Number(number) => with(b'n', &number.to_le_bytes()),
        Value::Text(text) => {
            with(b't', &(text.len() as u64).to_le_bytes())?;
            spool.write_all(text.as_bytes())
        }
    }
}

/// Reads back what [`put`] wrote.
fn take(spool: &mut impl Read) -> io::Result<Value> {
    fn bytes<const N: usize>(spool: &mut impl Read) -> io::Result<[u8; N]> {
        let mut bytes = [0; N];
        spool.read_exact(&mut bytes)?;
        Ok(bytes)
    }
    let [letter] = bytes(spool)?;
    Ok(match letter {
        b'f' => Value::Flag(bytes(spool)? != [0]),
        b'i' => Value::Integer(i64::from_le_bytes(bytes(spool)?)),
        b'n' => Value::Number(f64::from_le_bytes(bytes(spool)?)),
        b't' => {
            let length = u64::from_le_bytes(bytes(spool)?);
            let mut text = String::new();
            spool.take(length).read_to_string(&mut text)?;
            Value::Text(text)
        }
        _ => Value::Empty,
    })
}

fn table_error(source: io::Error) -> ResultsError {
    ResultsError::Table { source }
}

/// The refusal of the writer, if it was that.
fn io_error(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(source) => match source.downcast() {
            Ok(error) => *error,
            Err(source) => io::Error::other(source),
        },
        error => io::Error::other(error),
    }
}
