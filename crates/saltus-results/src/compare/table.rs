//! Tables, cell by cell.

use super::Difference;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

type Reader = csv::Reader<BufReader<File>>;

pub(super) fn differences(first: &Path, second: &Path) -> Result<Vec<Difference>, String> {
    let refused = |error: std::io::Error| error.to_string();
    let (settings, mut ours) = open(first).map_err(refused)?;
    let (other_settings, mut theirs) = open(second).map_err(refused)?;
    let mut all = Difference::new("");
    for index in 0..settings.len().max(other_settings.len()) {
        let line = |list: &[String]| list.get(index).cloned().unwrap_or_default();
        let place = || format!("setting {}", index + 1);
        all.texts(&line(&settings), &line(&other_settings), place);
    }
    let (mut a, mut b) = (csv::ByteRecord::new(), csv::ByteRecord::new());
    let mut header = csv::ByteRecord::new();
    for row in 0_u64.. {
        let (more, others) = (read(&mut ours, &mut a)?, read(&mut theirs, &mut b)?);
        if !(more && others) {
            if more || others {
                let count = |reader: &mut Reader, more| rest(reader, row, more);
                let (a, b) = (count(&mut ours, more)?, count(&mut theirs, others)?);
                all.mismatch(|| "the number of rows".to_owned(), &a, &b);
            }
            break;
        }
        if row == 0 {
            header = a.clone();
        }
        for column in 0..a.len().max(b.len()) {
            let cell = |record: &csv::ByteRecord| {
                record
                    .get(column)
                    .map(String::from_utf8_lossy)
                    .unwrap_or_default()
                    .into_owned()
            };
            let place = || match row {
                0 => format!("column {} of the header", column + 1),
                _ => format!("column `{}`, row {row}", cell(&header)),
            };
            all.texts(&cell(&a), &cell(&b), place);
        }
    }
    Ok(all.found().into_iter().collect())
}

/// The settings at the top, and a reader that is at the header.
fn open(path: &Path) -> std::io::Result<(Vec<String>, Reader)> {
    let mut file = BufReader::new(File::open(path)?);
    let mut settings = Vec::new();
    while file.fill_buf()?.first() == Some(&b'#') {
        let mut line = Vec::new();
        file.read_until(b'\n', &mut line)?;
        let line = String::from_utf8_lossy(&line);
        settings.push(line.trim_start_matches('#').trim().to_owned());
    }
    let mut builder = csv::ReaderBuilder::new();
    builder.has_headers(false).flexible(true);
    Ok((settings, builder.from_reader(file)))
}

fn read(reader: &mut Reader, record: &mut csv::ByteRecord) -> Result<bool, String> {
    reader
        .read_byte_record(record)
        .map_err(|error| format!("not a table: {error}"))
}

/// The number of rows of a table that has been read up to record `row`, as a text.
fn rest(reader: &mut Reader, row: u64, more: bool) -> Result<String, String> {
    let mut rows = if more { row } else { row.saturating_sub(1) };
    let mut record = csv::ByteRecord::new();
    while more && read(reader, &mut record)? {
        rows += 1;
    }
    Ok(rows.to_string())
}
