//! The run of a question: threads, a way to stop them, a display of progress.

use crate::failure::CommandError;
use saltus::study::Control;
use saltus_config::Study;
use saltus_results::FigureStyle;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// How a question is worked on. None of it changes an answer.
pub struct RunContext<'a> {
    /// Threads; 0 for as many as the machine has.
    pub threads: usize,
    /// Raised to stop the work at its next step.
    pub stop: Arc<AtomicBool>,
    /// Told how far the work has come.
    pub watch: &'a dyn Progress,
    /// Place of finished pieces, if the work can be cut; none by default.
    pub keep: Option<Pieces>,
    /// The look of figures in a folder.
    pub figures: FigureStyle,
}

/// Pieces of long work: they outlive an interruption, and may come from elsewhere.
#[derive(Clone, Debug)]
pub struct Pieces {
    /// Their place.
    pub place: PiecesAt,
    /// Treatment of those that are there.
    pub found: Existing,
}

/// Places of pieces.
#[derive(Clone, Debug)]
pub enum PiecesAt {
    /// In a hidden folder beside this one, the folder of results to be.
    Beside(PathBuf),
    /// In memory, with their numbers, as [`Request::compute`](crate::Request::compute) gave them.
    Memory(Vec<(u32, Vec<u8>)>),
}

/// Treatments of pieces that are there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// They are in the way: the work begins anew or not at all. In memory nothing is in the way.
    Refuse,
    /// The work goes on with those that are whole, and makes the others.
    Resume,
    /// They are put together, and nothing is computed: all must be there and whole.
    Merge,
}

/// A part of the work.
#[derive(Clone, Debug)]
pub struct Stage {
    /// Name of the things counted, such as "pixels".
    pub what: String,
    /// How many there are; `None` where nobody knows.
    pub total: Option<u64>,
    /// How many are done.
    pub done: Arc<AtomicU64>,
}

/// Display of how far the work has come.
pub trait Progress: Sync {
    /// A part begins. What is done already does not count as fast.
    fn begin(&self, stage: Stage);

    /// It has ended, in whatever way.
    fn end(&self);

    /// Something worth knowing that is neither result nor failure.
    fn note(&self, text: &str);
}

/// Nobody watches.
#[derive(Clone, Copy, Debug)]
pub struct Unwatched;

impl Progress for Unwatched {
    fn begin(&self, _: Stage) {}
    fn end(&self) {}
    fn note(&self, _: &str) {}
}

impl Default for RunContext<'_> {
    fn default() -> Self {
        Self {
            threads: 0,
            stop: Arc::default(),
            watch: &Unwatched,
            keep: None,
            figures: FigureStyle::default(),
        }
    }
}

impl RunContext<'_> {
    /// Everything about how a study runs: stepper, threads, a way to stop.
    pub(crate) fn control(&self, study: &Study) -> Control {
        Control {
            options: study.options(),
            threads: self.threads,
            stop: Arc::clone(&self.stop),
            ..Control::default()
        }
    }

    /// Does `work` while someone watches `done` come towards `total` pieces of `what`.
    pub(crate) fn follow<T>(
        &self,
        total: u64,
        what: &str,
        done: &Arc<AtomicU64>,
        work: impl FnOnce() -> T,
    ) -> T {
        self.watched(Some(total), what, done, work)
    }

    /// As [`Self::follow`] where nobody knows how much there is to do.
    pub(crate) fn count<T>(
        &self,
        what: &str,
        done: &Arc<AtomicU64>,
        work: impl FnOnce() -> T,
    ) -> T {
        self.watched(None, what, done, work)
    }

    fn watched<T>(
        &self,
        total: Option<u64>,
        what: &str,
        done: &Arc<AtomicU64>,
        work: impl FnOnce() -> T,
    ) -> T {
        /// Ends the watch also where the work panics.
        struct Watched<'a>(&'a dyn Progress);
        impl Drop for Watched<'_> {
            fn drop(&mut self) {
                self.0.end();
            }
        }
        self.watch.begin(Stage {
            what: what.to_owned(),
            total,
            done: Arc::clone(done),
        });
        let _watched = Watched(self.watch);
        work()
    }

    /// `Err` once the work must stop; asked between parts that do not see it themselves.
    pub(crate) fn check(&self) -> Result<(), CommandError> {
        if self.stop.load(Ordering::SeqCst) {
            Err(CommandError::Interrupted)
        } else {
            Ok(())
        }
    }
}
