//! A progress bar on standard error, only where someone is looking.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::{self, IsTerminal};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

/// Time between two looks at the counter: smooth to the eye, nothing to the processor.
const TICK: Duration = Duration::from_millis(100);

/// Does `work` while showing how far `done` has come towards `total` pieces of `what`, and about how long
/// the rest will take; silent if `quiet` or if standard error is not a terminal. What is done before does
/// not count as fast.
pub(crate) fn follow<T>(
    total: u64,
    what: &str,
    quiet: bool,
    done: &AtomicU64,
    work: impl FnOnce() -> T,
) -> T {
    let bar = || {
        styled(
            ProgressBar::new(total),
            "{wide_bar} {pos}/{len}, {eta} left",
        )
    };
    watch(bar, what, quiet, done, work)
}

/// As [`follow`] where nobody knows how much there is to do.
pub(crate) fn count<T>(what: &str, quiet: bool, done: &AtomicU64, work: impl FnOnce() -> T) -> T {
    let bar = || styled(ProgressBar::new_spinner(), "{spinner} {pos}, {elapsed}");
    watch(bar, what, quiet, done, work)
}

fn watch<T>(
    bar: impl FnOnce() -> ProgressBar,
    what: &str,
    quiet: bool,
    done: &AtomicU64,
    work: impl FnOnce() -> T,
) -> T {
    if quiet || !io::stderr().is_terminal() {
        return work();
    }
    let bar = bar()
        .with_message(what.to_owned())
        .with_position(done.load(Ordering::Relaxed));
    bar.reset_eta();
    let bar = &Cleared(bar);
    thread::scope(|scope| {
        // dropped when the work is done, also by a panic, and that ends the watch
        let (_working, watch) = mpsc::channel::<()>();
        scope.spawn(move || {
            while watch.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
                bar.0.set_position(done.load(Ordering::Relaxed));
            }
        });
        work()
    })
}

fn styled(bar: ProgressBar, template: &str) -> ProgressBar {
    match ProgressStyle::with_template(&format!("{{msg}} {template}")) {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

/// A bar that leaves its line: a message must not follow half of it.
struct Cleared(ProgressBar);

impl Drop for Cleared {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
