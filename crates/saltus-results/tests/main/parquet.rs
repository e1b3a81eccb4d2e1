//! Tables in Parquet come back to the bit, whatever their length, with their settings.

#![cfg(feature = "parquet")]
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use saltus_results::{Columns, ParquetTable, ResultFolder, Value};
use std::process::Command;

const SETTINGS: [(&str, &str); 2] = [("mass (kg)", "75"), ("study", "[jumper.0]\nζ_h = 0.3\n")];
const HEADER: [&str; 5] = ["ratio (-)", "seed", "settled", "kind", "gap"];

/// More than two groups of rows; the last row gives two columns their types.
const ROWS: usize = 300_000;

fn rows() -> impl Iterator<Item = [Value; 5]> {
    (0..ROWS).map(|row| {
        let last = row + 1 == ROWS;
        [
            if row == 7 {
                f64::NAN
            } else {
                (row as f64).sqrt()
            }
            .into(),
            (i64::MAX - row as i64).into(),
            last.then_some(true).into(),
            if last {
                "chaos, \"Ω\"".into()
            } else {
                Value::Empty
            },
            if row == 0 { 1_i64.into() } else { Value::Empty },
        ]
    })
}

fn table() -> ParquetTable {
    let mut table = ParquetTable::new(&SETTINGS, &HEADER);
    rows().for_each(|row| table.row(row).unwrap());
    table
}

#[test]
fn values_and_settings_come_back() {
    let bytes = table().finish(Vec::new()).unwrap();
    let file = SerializedFileReader::new(bytes::Bytes::from(bytes)).unwrap();
    assert_eq!(file.num_row_groups(), 3);
    let settings = file
        .metadata()
        .file_metadata()
        .key_value_metadata()
        .unwrap();
    for (entry, setting) in settings.iter().zip(SETTINGS) {
        assert_eq!(
            (entry.key.as_str(), entry.value.as_deref()),
            (setting.0, Some(setting.1))
        );
    }
    let mut count = 0;
    for (row, cells) in file.get_row_iter(None).unwrap().zip(rows()) {
        let row = row.unwrap();
        for ((name, field), (cell, expected)) in row.get_column_iter().zip(cells.iter().zip(HEADER))
        {
            assert_eq!(name, expected);
            let same = match (field, cell) {
                (Field::Double(x), Value::Number(y)) => x.to_bits() == y.to_bits(),
                (Field::Double(x), Value::Integer(n)) => *x == *n as f64,
                (Field::Double(x), Value::Empty) => x.is_nan(),
                (Field::Long(m), Value::Integer(n)) => m == n,
                (Field::Bool(a), Value::Flag(b)) => a == b,
                (Field::Str(a), Value::Text(b)) => a == b,
                (Field::Null, Value::Empty) => true,
                _ => false,
            };
            assert!(same, "row {count}, {name}: {field:?} and {cell:?}");
        }
        count += 1;
    }
    assert_eq!(count, ROWS);
}

#[test]
fn equal_tables_are_equal_bytes() {
    let few = || {
        let mut table = ParquetTable::new(&SETTINGS, &HEADER);
        rows().take(1000).for_each(|row| table.row(row).unwrap());
        table.finish(Vec::new()).unwrap()
    };
    assert_eq!(few(), few());
}

#[test]
fn a_table_is_a_file_of_the_folder() {
    let home = tempfile::tempdir().unwrap();
    let mut folder = ResultFolder::stage(&home.path().join("out")).unwrap();
    folder
        .write_parquet("data/empty.parquet", ParquetTable::new(&[], &["x"]))
        .unwrap();
    let file = folder.commit().unwrap().join("data/empty.parquet");
    let file = SerializedFileReader::new(std::fs::File::open(file).unwrap()).unwrap();
    assert_eq!(file.metadata().file_metadata().num_rows(), 0);
}

#[test]
fn misfits_and_refusals_are_named() {
    let mut table = ParquetTable::new(&[], &["x", "y"]);
    let error = table.row([1.0.into()]).unwrap_err();
    assert_eq!(error.to_string(), "row 1 has 1 cells, the header has 2");
    #[cfg(target_os = "linux")]
    {
        let full = std::fs::OpenOptions::new()
            .write(true)
            .open("/dev/full")
            .unwrap();
        let error = table.finish(full).map(drop).unwrap_err();
        assert!(
            error.to_string().contains("no space left on the device"),
            "{error}"
        );
    }
}

/// Run with `SALTUS_PYTHON` as a Python that has pandas and pyarrow.
#[test]
#[ignore = "needs Python with pandas and pyarrow"]
fn opens_in_pandas() {
    let home = tempfile::tempdir().unwrap();
    let (file, csv) = (home.path().join("t.parquet"), home.path().join("t.csv"));
    drop(
        table()
            .finish(std::fs::File::create(&file).unwrap())
            .unwrap(),
    );
    let text = std::fs::File::create(&csv).unwrap();
    let mut text = saltus_results::CsvTable::new(text, &SETTINGS, &HEADER).unwrap();
    rows().for_each(|row| text.row(row).unwrap());
    drop(text.finish().unwrap());
    let script = "
import sys, pandas, pyarrow.parquet as pq
a = pandas.read_parquet(sys.argv[1])
b = pandas.read_csv(sys.argv[2], comment='#', float_precision='round_trip', dtype={'seed': 'int64'})
assert list(a.columns) == list(b.columns) and len(a) == len(b)
for name in ('ratio (-)', 'seed', 'gap'):
    assert a[name].equals(b[name]), name
assert a['ratio (-)'].dtype == 'float64' and a['seed'].dtype == 'int64' and a['gap'].dtype == 'float64'
assert a['settled'].isna().sum() == len(a) - 1 and bool(a['settled'].iloc[-1]) is True
assert a['kind'].isna().sum() == len(a) - 1 and a['kind'].iloc[-1] == 'chaos, \"Ω\"'
settings = pq.read_schema(sys.argv[1]).metadata
assert settings[b'mass (kg)'] == b'75' and settings[b'study'].decode() == sys.argv[3], settings
";
    let python = std::env::var("SALTUS_PYTHON").unwrap_or("python3".to_owned());
    let output = Command::new(python)
        .args(["-c", script])
        .args([file, csv])
        .arg(SETTINGS[1].1)
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

#[test]
fn columns_in_memory_have_the_same_types() {
    let mut columns = Columns::new(&SETTINGS, &HEADER);
    rows().take(10).for_each(|row| columns.row(row).unwrap());
    let mut table = ParquetTable::new(&SETTINGS, &HEADER);
    rows().take(10).for_each(|row| table.row(row).unwrap());
    let bytes = bytes::Bytes::from(table.finish(Vec::new()).unwrap());
    let file = SerializedFileReader::new(bytes).unwrap();
    let schema = file.metadata().file_metadata().schema_descr_ptr();
    for (column, place) in columns.columns().iter().zip(schema.columns()) {
        use parquet::basic::Type;
        use saltus_results::Column;
        let expected = match column {
            Column::F64(_) => Type::DOUBLE,
            Column::I64(_) => Type::INT64,
            Column::Flags(_) => Type::BOOLEAN,
            _ => Type::BYTE_ARRAY,
        };
        assert_eq!(place.physical_type(), expected, "{}", place.name());
    }
}
