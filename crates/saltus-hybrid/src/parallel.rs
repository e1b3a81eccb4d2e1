//! Many tasks on many threads, with the answer of one thread.

use std::sync::atomic::AtomicBool;
use std::sync::{Mutex, PoisonError};

use crate::run::{IntegrateError, Options, Task, integrate};

/// Runs all tasks on `threads` threads (0: as many as the machine has) and gives them back in their
/// order. Tasks are started in order, so put the longest first. What a task sees is the same for any
/// number of threads, to the bit.
///
/// # Errors
/// As [`integrate`]; the first error stops the others at their next task.
pub fn integrate_all<T: Task>(
    options: &Options,
    tasks: Vec<T>,
    threads: usize,
    stop: &AtomicBool,
) -> Result<Vec<T>, IntegrateError> {
    let count = tasks.len();
    let queue = Mutex::new(tasks.into_iter().enumerate());
    let take = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
    let work = || {
        let mut ended = Vec::new();
        let mine = std::iter::from_fn(take).map(|(id, task)| Numbered { id, task });
        integrate(options, mine, stop, |task| ended.push(task)).map(|()| ended)
    };
    let available = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let threads = if threads == 0 { available() } else { threads };
    let results: Vec<_> = std::thread::scope(|scope| {
        let workers: Vec<_> = (1..threads.clamp(1, count.max(1)))
            .map(|_| scope.spawn(work))
            .collect();
        let own = work();
        let join = |worker: std::thread::ScopedJoinHandle<'_, _>| {
            worker
                .join()
                .unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        };
        std::iter::once(own)
            .chain(workers.into_iter().map(join))
            .collect()
    });
    let mut ended = Vec::with_capacity(count);
    for result in results {
        ended.extend(result?);
    }
    ended.sort_by_key(|numbered| numbered.id);
    Ok(ended.into_iter().map(|numbered| numbered.task).collect())
}

struct Numbered<T> {
    id: usize,
    task: T,
}

impl<T: Task> Task for Numbered<T> {
    fn begin(&mut self) -> Option<crate::Leg> {
        self.task.begin()
    }
    fn sample(&mut self, sample: &crate::Sample<'_>) -> bool {
        self.task.sample(sample)
    }
    fn switch(&mut self, switch: &crate::Switch<'_>) {
        self.task.switch(switch);
    }
    fn wants_steps(&self) -> bool {
        self.task.wants_steps()
    }
    fn step(&mut self, step: &crate::Step<'_>) {
        self.task.step(step);
    }
    fn end(&mut self, end: crate::End) -> Option<crate::Leg> {
        self.task.end(end)
    }
}
