//! The Parquet file that a table has beside its CSV, if it was asked for and the program can write it.

#[cfg(feature = "parquet")]
use saltus_results::ParquetTable;
use saltus_results::{ResultFolder, ResultsError, Value};

/// The table in the making; without the feature `parquet` there never is one.
pub(crate) struct Twin(#[cfg(feature = "parquet")] Option<ParquetTable>);

#[cfg(feature = "parquet")]
impl Twin {
    pub(crate) fn new(wanted: bool, settings: &[(&str, &str)], header: &[&str]) -> Self {
        Self(wanted.then(|| ParquetTable::new(settings, header)))
    }

    pub(crate) fn row(&mut self, row: &[Value]) -> Result<(), ResultsError> {
        let row = |table: &mut ParquetTable| table.row(row.iter().cloned());
        self.0.as_mut().map_or(Ok(()), row)
    }

    /// `rows.csv` has the twin `rows.parquet`.
    pub(crate) fn write(self, name: &str, folder: &mut ResultFolder) -> Result<(), ResultsError> {
        let stem = name.strip_suffix(".csv").unwrap_or(name);
        let write = |table| folder.write_parquet(&format!("{stem}.parquet"), table);
        self.0.map_or(Ok(()), write)
    }
}

#[cfg(not(feature = "parquet"))]
impl Twin {
    pub(crate) fn new(_: bool, _: &[(&str, &str)], _: &[&str]) -> Self {
        Self()
    }

    pub(crate) fn row(&mut self, _: &[Value]) -> Result<(), ResultsError> {
        Ok(())
    }

    pub(crate) fn write(self, _: &str, _: &mut ResultFolder) -> Result<(), ResultsError> {
        Ok(())
    }
}
