//! Ctrl-C: the first asks a computation to stop, the second ends the program at once.

use crate::exit::Failure;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

static ASKED: OnceLock<Arc<AtomicBool>> = OnceLock::new();

/// Turns true at the first Ctrl-C. Short commands do not call this and end as any program does.
pub(crate) fn flag() -> Arc<AtomicBool> {
    let watch = || {
        let asked = Arc::new(AtomicBool::new(false));
        let seen = Arc::clone(&asked);
        // without a handler Ctrl-C ends the program at once, which is well enough
        let _ = ctrlc::set_handler(move || {
            if seen.swap(true, Ordering::SeqCst) {
                std::process::exit(130);
            }
        });
        asked
    };
    Arc::clone(ASKED.get_or_init(watch))
}

/// `Err` after Ctrl-C; asked between the parts of a command that the computation does not see.
pub(crate) fn check() -> Result<(), Failure> {
    let asked = ASKED.get().is_some_and(|flag| flag.load(Ordering::SeqCst));
    if asked {
        Err(Failure::Interrupted)
    } else {
        Ok(())
    }
}
