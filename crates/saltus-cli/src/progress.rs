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
    if quiet || !io::stderr().is_terminal() {
        return work();
    }
    let bar = &Cleared(bar(total, what, done.load(Ordering::Relaxed)));
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

fn bar(total: u64, what: &str, already: u64) -> ProgressBar {
    let bar = ProgressBar::new(total)
        .with_message(what.to_owned())
        .with_position(already);
    bar.reset_eta();
    if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len}, {eta} left") {
        bar.set_style(style);
    }
    bar
}

/// A bar that leaves its line: a message must not follow half of it.
struct Cleared(ProgressBar);

impl Drop for Cleared {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
