//! Many tasks on many threads, with the answer of one thread.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use crate::run::{IntegrateError, Options, Task, integrate};

/// Runs all tasks on `threads` threads (0: as many as the machine has) and gives them back in their
/// order. Tasks are started in order, so put the longest first. What a task sees is the same for any
/// number of threads, to the bit.
///
/// # Errors
/// As [`integrate`]; the first error stops the others.
pub fn integrate_all<T: Task>(
    options: &Options,
    tasks: Vec<T>,
    threads: usize,
    stop: &AtomicBool,
) -> Result<Vec<T>, IntegrateError> {
    Ok(integrate_groups(options, vec![tasks], threads, stop)?
        .pop()
        .unwrap_or_default())
}

/// As [`integrate_all`] for several groups, each of systems of one structure. A thread stays with a
/// group while that has tasks, then helps with the next, so that few long tasks of one group do not
/// leave a thread idle while another group has work.
///
/// # Errors
/// As [`integrate`]; the first error stops the others.
pub fn integrate_groups<T: Task>(
    options: &Options,
    groups: Vec<Vec<T>>,
    threads: usize,
    stop: &AtomicBool,
) -> Result<Vec<Vec<T>>, IntegrateError> {
    let counts: Vec<usize> = groups.iter().map(Vec::len).collect();
    let queues: Vec<_> = groups
        .into_iter()
        .map(|tasks| Mutex::new(tasks.into_iter().enumerate()))
        .collect();
    let failed = AtomicBool::new(false);
    let work = |first: usize| {
        let mut ended = Vec::new();
        for turn in 0..queues.len() {
            let group = (first + turn) % queues.len();
            let take = || {
                let go_on = !failed.load(Ordering::Relaxed);
                let mut queue = queues[group].lock().unwrap_or_else(PoisonError::into_inner);
                go_on.then(|| queue.next()).flatten()
            };
            let mine = std::iter::from_fn(take).map(|(id, task)| Numbered {
                id: (group, id),
                task,
            });
            if let Err(error) = integrate(options, mine, stop, |task| ended.push(task)) {
                failed.store(true, Ordering::Relaxed);
                return Err(error);
            }
        }
        Ok(ended)
    };
    let available = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let threads = if threads == 0 { available() } else { threads };
    let threads = threads.clamp(1, counts.iter().sum::<usize>().max(1));
    let results: Vec<_> = std::thread::scope(|scope| {
        let workers: Vec<_> = (1..threads)
            .map(|first| scope.spawn(move || work(first)))
            .collect();
        let own = work(0);
        let join = |worker: std::thread::ScopedJoinHandle<'_, _>| {
            worker
                .join()
                .unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        };
        std::iter::once(own)
            .chain(workers.into_iter().map(join))
            .collect()
    });
    let mut out: Vec<Vec<Numbered<T>>> = counts.iter().map(|&n| Vec::with_capacity(n)).collect();
    for result in results {
        for numbered in result? {
            out[numbered.id.0].push(numbered);
        }
    }
    let in_order = |mut group: Vec<Numbered<T>>| {
        group.sort_by_key(|numbered| numbered.id);
        group.into_iter().map(|numbered| numbered.task).collect()
    };
    Ok(out.into_iter().map(in_order).collect())
}

struct Numbered<T> {
    /// Group and place in it.
    id: (usize, usize),
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
