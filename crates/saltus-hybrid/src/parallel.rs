//! Many tasks on many threads, with the bits of one thread: all kept, or streamed to a sink.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use crate::run::integrate;
use crate::task::{End, IntegrateError, Options, Sample, Segment, Step, Switch, Task};

/// Runs all tasks on `threads` threads (0: as many as the machine has) and gives them back in their
/// order. Tasks are started in order, so put the longest first. The numbers that a task sees are the
/// same for any number of threads, to the bit.
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

/// Runs several groups of tasks, each of systems of one structure, as [`integrate_all`] runs one. A thread stays
/// with a group while that has tasks, then helps with the next, so that few long tasks of one group do not
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
    let results = on_threads(threads, counts.iter().sum(), work);
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

/// Runs tasks as an iterator yields them and gives each to `sink` when it has ended: one at a time, in
/// no particular order. Neither the tasks to come nor those that have ended are kept, so there may be
/// more of them than memory holds. The numbers that a task sees are the same for any number of
/// threads, to the bit.
///
/// The iterator and the sink are each behind a lock: long work belongs into [`Task::begin`] and
/// [`Task::end`], which run side by side.
///
/// # Errors
/// As [`integrate`], and any error of `sink`; the first one stops the others, and nothing
/// more is given to `sink`.
pub fn integrate_stream<T, E>(
    options: &Options,
    tasks: impl Iterator<Item = T> + Send,
    threads: usize,
    stop: &AtomicBool,
    sink: impl FnMut(T) -> Result<(), E> + Send,
) -> Result<(), E>
where
    T: Task,
    E: From<IntegrateError> + Send,
{
    let most = tasks.size_hint().1.unwrap_or(usize::MAX);
    let queue = Mutex::new(tasks.fuse());
    let sink = Mutex::new((sink, None));
    let failed = AtomicBool::new(false);
    let work = |_| {
        let take = || {
            let go_on = !failed.load(Ordering::Relaxed);
            let mut queue = queue.lock().unwrap_or_else(PoisonError::into_inner);
            go_on.then(|| queue.next()).flatten()
        };
        let give = |task| {
            let mut sink = sink.lock().unwrap_or_else(PoisonError::into_inner);
            let (sink, refused) = &mut *sink;
            if refused.is_none()
                && !failed.load(Ordering::Relaxed)
                && let Err(error) = sink(task)
            {
                *refused = Some(error);
                failed.store(true, Ordering::Relaxed);
            }
        };
        integrate(options, std::iter::from_fn(take), stop, give)
            .inspect_err(|_| failed.store(true, Ordering::Relaxed))
    };
    let results = on_threads(threads, most, work);
    let (_, refused) = sink.into_inner().unwrap_or_else(PoisonError::into_inner);
    refused.map_or(Ok(()), Err)?;
    results
        .into_iter()
        .try_for_each(|result| result.map_err(E::from))
}

/// Calls `work(0)`, `work(1)`, ... on `threads` threads (0: as many as the machine has), at most `most`; the results.
///
/// A system may refuse a thread: its limits are reached, or there is no room for a stack. The others then do the work
/// of those that are missing, so `work` must draw its tasks from a queue that all share. The first one runs on the
/// thread that calls.
pub fn on_threads<O: Send>(
    threads: usize,
    most: usize,
    work: impl Fn(usize) -> O + Sync,
) -> Vec<O> {
    let available = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let threads = if threads == 0 { available() } else { threads };
    let threads = threads.clamp(1, most.max(1));
    let work = &work;
    std::thread::scope(|scope| {
        let begin = |number| {
            let builder = std::thread::Builder::new();
            builder.spawn_scoped(scope, move || work(number)).ok()
        };
        let workers: Vec<_> = (1..threads).map_while(begin).collect();
        let own = work(0);
        let join = |worker: std::thread::ScopedJoinHandle<'_, _>| {
            worker
                .join()
                .unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        };
        std::iter::once(own)
            .chain(workers.into_iter().map(join))
            .collect()
    })
}

struct Numbered<T> {
    /// Group and place in it.
    id: (usize, usize),
    task: T,
}

impl<T: Task> Task for Numbered<T> {
    fn begin(&mut self) -> Option<Segment> {
        self.task.begin()
    }
    fn sample(&mut self, sample: &Sample<'_>) -> bool {
        self.task.sample(sample)
    }
    fn tangents(&mut self, columns: &mut [f64]) {
        self.task.tangents(columns);
    }
    fn switch(&mut self, switch: &Switch<'_>) {
        self.task.switch(switch);
    }
    fn wants_steps(&self) -> bool {
        self.task.wants_steps()
    }
    fn step(&mut self, step: &Step<'_>) {
        self.task.step(step);
    }
    fn end(&mut self, end: End) -> Option<Segment> {
        self.task.end(end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::forced_oscillator;
    use std::sync::atomic::AtomicUsize;

    /// An oscillator from its own start, built when its turn comes; keeps its last state.
    struct Swing<'a> {
        number: usize,
        alive: &'a AtomicUsize,
        last: Vec<f64>,
    }

    impl Task for Swing<'_> {
        fn begin(&mut self) -> Option<Segment> {
            self.alive.fetch_add(1, Ordering::SeqCst);
            let system = forced_oscillator(0.05, 1.0, 1.1, 0.3);
            let start = system.point(&[0], &[0.25 - self.number as f64 / 100.0, 0.5]);
            // some are long and some have nothing to do
            let periods = (self.number % 7) as u64;
            (periods > 0).then_some(Segment {
                system,
                start,
                periods,
            })
        }
        fn sample(&mut self, sample: &Sample<'_>) -> bool {
            self.last = sample.x.to_vec();
            true
        }
        fn end(&mut self, _: End) -> Option<Segment> {
            None
        }
    }

    #[derive(Debug, PartialEq)]
    enum Refusal {
        Enough,
        Integrate(IntegrateError),
    }

    impl From<IntegrateError> for Refusal {
        fn from(error: IntegrateError) -> Self {
            Self::Integrate(error)
        }
    }

    fn swings(alive: &AtomicUsize) -> impl Iterator<Item = Swing<'_>> + Send {
        (0..100).map(move |number| Swing {
            number,
            alive,
            last: Vec::new(),
        })
    }

    #[test]
    fn every_task_reaches_the_sink_once_with_the_bits_of_one_thread() {
        let (alive, stop) = (AtomicUsize::new(0), AtomicBool::new(false));
        let options = Options::default();
        let all = integrate_all(&options, swings(&alive).collect(), 1, &stop).expect("runs");
        for threads in [1, 3, 0] {
            let mut found: Vec<Option<Vec<f64>>> = vec![None; all.len()];
            let keep = |swing: Swing<'_>| {
                assert!(found[swing.number].replace(swing.last).is_none());
                Ok::<(), Refusal>(())
            };
            integrate_stream(&options, swings(&alive), threads, &stop, keep).expect("runs");
            let expected: Vec<_> = all.iter().map(|swing| Some(swing.last.clone())).collect();
            assert_eq!(found, expected);
        }
    }

    #[test]
    fn tasks_are_drawn_as_lanes_become_free() {
        let (alive, stop) = (AtomicUsize::new(0), AtomicBool::new(false));
        let (mut ended, mut most) = (0, 0);
        let keep = |_| {
            most = most.max(alive.load(Ordering::SeqCst) - ended);
            ended += 1;
            Ok::<(), Refusal>(())
        };
        integrate_stream(&Options::default(), swings(&alive), 1, &stop, keep).expect("runs");
        assert_eq!(ended, 100);
        assert!(most <= 8, "{most} tasks were under way on eight lanes");
    }

    #[test]
    fn a_refusal_of_the_sink_ends_the_run() {
        let (alive, stop) = (AtomicUsize::new(0), AtomicBool::new(false));
        let mut given = 0;
        let refuse = |_| {
            given += 1;
            if given < 5 {
                Ok(())
            } else {
                Err(Refusal::Enough)
            }
        };
        let result = integrate_stream(&Options::default(), swings(&alive), 2, &stop, refuse);
        assert_eq!(result, Err(Refusal::Enough));
        assert_eq!(given, 5);
        assert!(alive.load(Ordering::SeqCst) < 100);
    }

    #[test]
    fn a_raised_stop_is_told() {
        let (alive, stop) = (AtomicUsize::new(0), AtomicBool::new(true));
        let result = integrate_stream(&Options::default(), swings(&alive), 2, &stop, |_| Ok(()));
        assert_eq!(result, Err(Refusal::Integrate(IntegrateError::Interrupted)));
    }
}
