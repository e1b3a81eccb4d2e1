//! Tasks run on one thread, by the method that the options name.

use std::sync::atomic::AtomicBool;

use crate::task::{IntegrateError, Method, Options, Task};
use crate::{rk4, taylor};

/// Runs all tasks on this thread and gives each to `done` when it has ended, in no particular order.
/// The numbers that a task sees do not depend on its neighbours, to the bit.
///
/// # Errors
/// [`IntegrateError`] for options out of range, segments that do not fit together, and a raised `stop`.
pub fn integrate<T: Task>(
    options: &Options,
    tasks: impl IntoIterator<Item = T>,
    stop: &AtomicBool,
    mut done: impl FnMut(T),
) -> Result<(), IntegrateError> {
    options.check()?;
    let mut tasks = tasks.into_iter();
    match options.method {
        Method::Taylor { tolerance, order } => {
            taylor::run(options, tolerance, order, &mut tasks, stop, &mut done)
        }
        Method::Rk4 { steps_per_period } => tasks
            .try_for_each(|task| rk4::run(options, steps_per_period, task, stop).map(&mut done)),
    }
}
