//! Processor time of this thread.

use std::time::Instant;

pub struct Clock {
    processor: Option<f64>,
    wall: Instant,
}

/// Seconds this thread has spent on a core, where Linux tells. It counts when the thread is rescheduled,
/// and yielding asks for that: without it the number is up to a timer tick old.
fn processor() -> Option<f64> {
    std::thread::yield_now();
    let line = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some(nanoseconds * 1e-9)
}

impl Clock {
    pub fn start() -> Self {
        Self {
            processor: processor(),
            wall: Instant::now(),
        }
    }

    /// Processor seconds since the start; wall seconds where the system does not tell.
    pub fn seconds(&self) -> f64 {
        match (self.processor, processor()) {
            (Some(begun), Some(now)) => now - begun,
            _ => self.wall.elapsed().as_secs_f64(),
        }
    }
}
