//! Stores of the parts of an answer: files of a folder, or memory.

use crate::context::RunContext;
use crate::failure::CommandError;
use saltus_config::Study;
use saltus_results::{
    Dataset, Figure, FigureStyle, Manifest, ResultFolder, ResultsError, csv, shown,
};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Pixels of a PNG per unit of the SVG.
const PNG_SCALE: f32 = 2.0;

/// Fills a text.
pub type Fill<'a> = &'a mut dyn FnMut(&mut dyn Write) -> io::Result<()>;

/// Takes the parts of an answer, each under the name of its file.
pub trait Store {
    /// A text or a JSON document.
    ///
    /// # Errors
    /// [`CommandError`] if it cannot be kept.
    fn put_text(&mut self, name: &str, fill: Fill) -> Result<(), CommandError>;

    /// A figure; its name has no ending.
    ///
    /// # Errors
    /// [`CommandError`] if it cannot be drawn or kept.
    fn put_figure(&mut self, name: &str, figure: &Figure) -> Result<(), CommandError>;

    /// A dataset and its tables.
    ///
    /// # Errors
    /// [`CommandError`] if it cannot be kept.
    fn put_dataset(&mut self, name: &str, dataset: Dataset) -> Result<(), CommandError>;

    /// The answer in words, which stand in no file of their own.
    fn put_words(&mut self, name: &str, text: &str) {
        let _ = (name, text);
    }
}

impl dyn Store + '_ {
    /// Adds a text.
    pub(crate) fn text(&mut self, name: &str, text: &str) -> Result<(), CommandError> {
        self.put_text(name, &mut |file| file.write_all(text.as_bytes()))
    }

    /// Adds a figure.
    pub(crate) fn figure(&mut self, name: &str, figure: &Figure) -> Result<(), CommandError> {
        self.put_figure(name, figure)
    }
}

/// A folder in the making; dropped before [`Folder::commit`] it leaves no trace.
#[derive(Debug)]
pub struct Folder {
    inner: ResultFolder,
    figures: FigureStyle,
    stop: Arc<AtomicBool>,
}

impl Folder {
    /// Prepares `dir` for an answer and puts the resolved study in it; `about` is what the manifest says of the answer,
    /// as [`about`](crate::about()) gives it. Done before a long computation too, so that a folder that cannot be written
    /// is refused at once.
    ///
    /// Without `about` the folder will hold the study alone, and takes the place of no answer: that may be
    /// hours of work.
    ///
    /// # Errors
    /// [`CommandError::Results`] if the folder cannot be written or holds files of others; [`CommandError::Work`] if an answer is
    /// in it and nothing was asked.
    pub fn stage(
        dir: &Path,
        about: Option<serde_json::Value>,
        study: &Study,
        context: &RunContext,
    ) -> Result<Self, CommandError> {
        let mut inner = ResultFolder::stage(dir)?;
        match about {
            Some(mut about) => {
                // for `rerun`, which draws them so again
                if context.figures != FigureStyle::default() {
                    about["figures"] = serde_json::json!(context.figures);
                }
                inner.about(about);
            }
            None => refuse_answer(dir)?,
        }
        inner.write("study.toml", study.to_toml())?;
        let stop = Arc::clone(&context.stop);
        let figures = context.figures;
        Ok(Self {
            inner,
            figures,
            stop,
        })
    }

    /// Moves everything into place.
    ///
    /// # Errors
    /// [`CommandError::Results`] if that is not possible, [`CommandError::Interrupted`] if it must not be.
    pub fn commit(self) -> Result<PathBuf, CommandError> {
        self.check()?;
        Ok(self.inner.commit()?)
    }

    /// Drawing may take seconds and does not see who stops it.
    fn check(&self) -> Result<(), CommandError> {
        if self.stop.load(Ordering::SeqCst) {
            Err(CommandError::Interrupted)
        } else {
            Ok(())
        }
    }
}

fn refuse_answer(dir: &Path) -> Result<(), CommandError> {
    match Manifest::read(dir) {
        Ok(manifest) if !manifest.about["request"].is_null() => Err(CommandError::work(
            format!(
                "`{}` holds an answer, which a study alone does not replace",
                shown::path(dir)
            ),
            "choose another folder, or remove this one",
        )),
        _ => Ok(()),
    }
}

impl Store for Folder {
    fn put_words(&mut self, name: &str, text: &str) {
        self.inner.note(name, text);
    }

    fn put_text(&mut self, name: &str, fill: Fill) -> Result<(), CommandError> {
        Ok(self.inner.write_with(name, |file| fill(file))?)
    }

    fn put_figure(&mut self, name: &str, figure: &Figure) -> Result<(), CommandError> {
        self.check()?;
        let figure = figure.clone().style(self.figures);
        self.inner.write(&format!("{name}.svg"), figure.svg())?;
        self.inner.write(&format!("{name}.pdf"), figure.pdf())?;
        let png = figure.png(PNG_SCALE)?;
        Ok(self.inner.write(&format!("{name}.png"), png)?)
    }

    fn put_dataset(&mut self, name: &str, dataset: Dataset) -> Result<(), CommandError> {
        for table in dataset.tables().iter().filter(|table| table.is_file()) {
            self.check()?;
            let file = format!("{}.csv", table.name());
            let fill = |to: &mut dyn Write| csv(&dataset, table, to).map(drop).map_err(plain);
            self.inner.write_with(&file, fill)?;
        }
        self.check()?;
        Ok(self.inner.write(name, dataset.to_bytes()?)?)
    }
}

fn plain(error: ResultsError) -> io::Error {
    match error {
        ResultsError::Table { source } => source,
        other => io::Error::other(other),
    }
}
