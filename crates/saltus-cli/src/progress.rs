//! A progress bar on standard error, only where someone is looking.
#![expect(dead_code, reason = "for the commands that compute")]

use indicatif::{ProgressBar, ProgressStyle};
use std::io::{self, IsTerminal};

/// Counts finished pieces of work; may be shared between threads.
pub(crate) struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// `total` pieces of `what`; silent if `quiet` or if standard error is not a terminal.
    pub(crate) fn new(total: u64, what: &str, quiet: bool) -> Self {
        if quiet || !io::stderr().is_terminal() {
            return Self {
                bar: ProgressBar::hidden(),
            };
        }
        let bar = ProgressBar::new(total).with_message(what.to_owned());
        if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len} {eta}") {
            bar.set_style(style);
        }
        Self { bar }
    }

    /// `pieces` more are finished.
    pub(crate) fn inc(&self, pieces: u64) {
        self.bar.inc(pieces);
    }

    /// All is done: the line is cleared.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Drop for Progress {
    /// An error message must not follow half a bar.
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
