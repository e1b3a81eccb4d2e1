//! Ctrl-C: the first asks a computation to stop, the second ends the program at once.

use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};

static ASKED: AtomicBool = AtomicBool::new(false);
static WATCH: Once = Once::new();

/// Turns true at the first Ctrl-C. Short commands do not call this and end as any program does.
#[expect(dead_code, reason = "for the commands that compute")]
pub(crate) fn flag() -> &'static AtomicBool {
    WATCH.call_once(|| {
        // without a handler Ctrl-C ends the program at once, which is well enough
        let _ = ctrlc::set_handler(|| {
            if ASKED.swap(true, Ordering::SeqCst) {
                std::process::exit(130);
            }
        });
    });
    &ASKED
}
