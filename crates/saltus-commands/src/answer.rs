//! Answers: data, described once, and what people are shown of them.

use crate::failure::CommandError;
use crate::store::Store;
use saltus_config::Study;
use saltus_results::{Dataset, Document, Figure};
use serde::Serialize;
use std::io::{self, Write};
use std::path::Path;

/// Takes figures, each under its name.
pub type Take<'a> = &'a mut dyn FnMut(&str, &Figure) -> Result<(), CommandError>;

/// Output at the end of a command.
pub trait Told {
    /// A text for people.
    fn summary(&self) -> String;

    /// Writes the JSON document.
    ///
    /// # Errors
    /// Those of `to`.
    fn document(&self, to: &mut dyn Write) -> io::Result<()>;
}

/// An answer. Tables, arrays and the document are views of [`data`](Self::data).
pub trait Answer: Send + Sync {
    /// The study that it is about.
    fn study(&self) -> &Study;

    /// Everything that was found, each quantity described once.
    fn data(&self) -> Dataset;

    /// A text for people.
    fn summary(&self) -> String;

    /// Draws the figures one after the other; there are none by default.
    ///
    /// # Errors
    /// Those of `take`.
    fn draw(&self, take: Take) -> Result<(), CommandError> {
        let _ = take;
        Ok(())
    }

    /// Writes the JSON document; `data` is what [`data`](Self::data) gives.
    ///
    /// # Errors
    /// Those of `to`.
    fn document(&self, data: &Dataset, to: &mut dyn Write) -> io::Result<()> {
        #[derive(Serialize)]
        struct Whole<'a> {
            version: &'static str,
            #[serde(flatten)]
            found: Document<'a>,
            study: &'a Study,
        }
        let whole = Whole {
            version: env!("CARGO_PKG_VERSION"),
            found: Document::new(data),
            study: self.study(),
        };
        stream_json(to, &whole)
    }

    /// Hands over what is no document: figures, and the data under the name `dataset`. That is made last and goes away with
    /// the store, since that of a large map is as large as the answer.
    ///
    /// # Errors
    /// [`CommandError`] where the store refuses or a figure cannot be drawn.
    fn fill(&self, store: &mut dyn Store, dataset: &str) -> Result<(), CommandError> {
        self.draw(&mut |name, figure| store.put_figure(name, figure))?;
        store.put_dataset(dataset, self.data())
    }

    /// Why it is not all that was asked for, if so: a motion that ended early, as far as it came.
    fn shortfall(&self) -> Option<CommandError> {
        None
    }

    /// The folder with pieces that were kept until the answer is stored, if there is one.
    fn pieces(&self) -> Option<&Path> {
        None
    }

    /// Removes the pieces: the answer is stored.
    ///
    /// # Errors
    /// [`CommandError::Results`] if they cannot be removed.
    fn stored(&mut self) -> Result<(), CommandError> {
        Ok(())
    }
}

impl<A: Answer + ?Sized> Told for A {
    fn summary(&self) -> String {
        Answer::summary(self)
    }

    fn document(&self, to: &mut dyn Write) -> io::Result<()> {
        Answer::document(self, &self.data(), to)
    }
}

/// Writes a JSON document that ends in a newline.
pub(crate) fn stream_json(to: &mut dyn Write, document: &impl Serialize) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *to, document)?;
    to.write_all(b"\n")
}
