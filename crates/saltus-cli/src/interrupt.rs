//! Ctrl-C and its like: the first asks a computation to stop, the second ends the program at once.

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Signals that ask to stop: from Ctrl-C, a scheduler, and on Unix a terminal that goes away.
const ASKING: &[i32] = &[
    SIGINT,
    SIGTERM,
    #[cfg(unix)]
    signal_hook::consts::SIGHUP,
];

/// Exit code after the second.
const INTERRUPTED: i32 = 130;

/// Turns true at the first signal. Short commands do not call this and end as any program does.
///
/// A signal that is ignored at the start stays ignored: under `nohup` a run must outlive its terminal.
pub(crate) fn flag() -> Arc<AtomicBool> {
    let asked = Arc::new(AtomicBool::new(false));
    let once = Arc::new(AtomicBool::new(false));
    for &signal in ASKING.iter().filter(|&&signal| !is_ignored(signal)) {
        // In this order: what is registered first acts first, so the program ends when `once` was raised before.
        // Without a handler the signal ends it at once, which is well enough.
        let _ = flag::register(signal, Arc::clone(&asked));
        let _ = flag::register_conditional_shutdown(signal, INTERRUPTED, Arc::clone(&once));
        let _ = flag::register(signal, Arc::clone(&once));
    }
    asked
}

/// Whether the process ignores the signal. Linux lists the ignored signals of each process; elsewhere a child
/// shows them, since it inherits them.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    match mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()) {
        Some(mask) => mask >> (signal - 1) & 1 == 1,
        None => std::process::Command::new("sh")
            .args(["-c", &format!("kill -{signal} $$")])
            .status()
            .is_ok_and(|status| status.success()),
    }
}

/// Windows knows nothing like it.
#[cfg(not(unix))]
fn is_ignored(_: i32) -> bool {
    false
}
