//! The folder of results of one command: study, data and figures, whole or not at all.

use crate::exit::Failure;
use crate::{interrupt, output};
use saltus_config::Study;
use saltus_results::{CsvTable, Dataset, Figure, ResultFolder, ResultsError, Value};
use serde::Serialize;
use std::io;
use std::path::{Path, PathBuf};

/// Pixels of a PNG per unit of the SVG.
const PNG_SCALE: f32 = 2.0;

/// A folder in the making; dropped before [`Folder::commit`] it leaves no trace.
pub(crate) struct Folder {
    inner: ResultFolder,
}

impl Folder {
    /// Prepares `dir` and puts the resolved study in it. Done before a long computation, so that a
    /// folder that cannot be written is refused at once.
    pub(crate) fn stage(dir: &Path, study: &Study) -> Result<Self, Failure> {
        let mut inner = ResultFolder::stage(dir)?;
        inner.write("study.toml", study.to_toml())?;
        Ok(Self { inner })
    }

    /// Adds a text.
    pub(crate) fn text(&mut self, name: &str, text: &str) -> Result<(), Failure> {
        Ok(self.inner.write(name, text)?)
    }

    /// Adds a JSON document.
    pub(crate) fn json(&mut self, name: &str, document: &impl Serialize) -> Result<(), Failure> {
        let fill = |file: &mut dyn io::Write| output::stream_json(file, document);
        Ok(self.inner.write_with(name, fill)?)
    }

    /// Adds a CSV table; `settings` stand above the header.
    pub(crate) fn table(
        &mut self,
        name: &str,
        settings: &[(&str, &str)],
        header: &[String],
        rows: impl IntoIterator<Item = Vec<Value>>,
    ) -> Result<(), Failure> {
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        let fill = |file: &mut dyn io::Write| {
            let mut table = CsvTable::new(file, settings, &header).map_err(plain)?;
            rows.into_iter()
                .try_for_each(|row| table.row(row))
                .and_then(|()| table.finish())
                .map_err(plain)
                .map(drop)
        };
        Ok(self.inner.write_with(name, fill)?)
    }

    /// Adds a figure as SVG and PNG.
    pub(crate) fn figure(&mut self, name: &str, figure: &Figure) -> Result<(), Failure> {
        interrupt::check()?;
        self.inner.write(&format!("{name}.svg"), figure.svg())?;
        let png = figure.png(PNG_SCALE)?;
        Ok(self.inner.write(&format!("{name}.png"), png)?)
    }

    /// Adds a dataset as NetCDF.
    pub(crate) fn dataset(&mut self, name: &str, dataset: Dataset) -> Result<(), Failure> {
        interrupt::check()?;
        let bytes = dataset.to_bytes()?;
        Ok(self.inner.write(name, bytes)?)
    }

    /// Moves everything into place.
    pub(crate) fn commit(self) -> Result<PathBuf, Failure> {
        interrupt::check()?;
        Ok(self.inner.commit()?)
    }
}

fn plain(error: ResultsError) -> io::Error {
    match error {
        ResultsError::Table { source } => source,
        other => io::Error::other(other),
    }
}
