//! A progress bar on standard error, if that is a terminal.

use crate::output;
use indicatif::{ProgressBar, ProgressStyle};
use saltus_commands::{Progress, Stage};
use std::io::{self, IsTerminal};
use std::sync::atomic::Ordering;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::sync::{Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// Time between two looks at the counter: smooth to the eye, nothing to the processor.
const TICK: Duration = Duration::from_millis(100);

/// Draws a bar for each part of the work.
pub(crate) struct Bars {
    quiet: bool,
    drawn: Mutex<Option<Drawn>>,
}

/// A bar with the thread that moves it.
struct Drawn {
    /// Dropped when the part ends, and that ends the thread.
    working: Sender<()>,
    thread: JoinHandle<()>,
}

impl Bars {
    /// Silent if `quiet`; no bar is drawn if standard error is not a terminal.
    pub(crate) fn new(quiet: bool) -> Self {
        let drawn = Mutex::default();
        Self { quiet, drawn }
    }

    fn replace(&self, next: Option<Drawn>) {
        let mut drawn = self.drawn.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(last) = std::mem::replace(&mut *drawn, next) {
            drop(last.working);
            // a bar that could not be drawn is no reason to fail
            let _ = last.thread.join();
        }
    }
}

impl Progress for Bars {
    fn begin(&self, stage: Stage) {
        if self.quiet || !io::stderr().is_terminal() {
            return;
        }
        let (working, watch) = mpsc::channel();
        let draw = move || {
            let bar = bar(&stage);
            while watch.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
                bar.set_position(stage.done.load(Ordering::Relaxed));
            }
            // a message must not follow half of it
            bar.finish_and_clear();
        };
        // no thread, no bar
        let thread = thread::Builder::new().spawn(draw).ok();
        self.replace(thread.map(|thread| Drawn { working, thread }));
    }

    fn end(&self) {
        self.replace(None);
    }

    fn note(&self, text: &str) {
        if !self.quiet {
            output::note(text);
        }
    }
}

fn bar(stage: &Stage) -> ProgressBar {
    let (bar, template) = match stage.total {
        Some(total) => (
            ProgressBar::new(total),
            "{msg} {wide_bar} {pos}/{len}, {eta} left",
        ),
        None => (
            ProgressBar::new_spinner(),
            "{msg} {spinner} {pos}, {elapsed}",
        ),
    };
    let bar = match ProgressStyle::with_template(template) {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    };
    let bar = bar
        .with_message(stage.what.clone())
        .with_position(stage.done.load(Ordering::Relaxed));
    bar.reset_eta();
    bar
}
