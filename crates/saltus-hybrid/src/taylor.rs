//! Taylor series on eight asynchronous lanes.
//!
//! Each lane of the vector register is a trajectory with its own parameters, time, step, modes and
//! end; a lane that ends takes the next task. The series of all lanes are computed together; what
//! differs between lanes (switches, samples) is a few scalar operations each. A single trajectory is
//! a run with seven idle lanes: the same code, hence the same bits.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::arith::LANES;
use crate::event::Firing;
use crate::kernel::Kernel;
use crate::lane::{Lane, Next};
use crate::run::{IntegrateError, Leg, Options, Status, Step, Task, check_stop};

/// Runs all tasks.
pub(crate) fn run<T: Task>(
    options: &Options,
    tolerance: f64,
    order: usize,
    tasks: &mut dyn Iterator<Item = T>,
    stop: &AtomicBool,
    done: &mut dyn FnMut(T),
) -> Result<(), IntegrateError> {
    // The first leg there is says what structure all have.
    while let Some(mut task) = tasks.next() {
        if let Some(leg) = task.begin() {
            let structure = &leg.system.structure;
            let kernel = Kernel::new(structure, leg.system.coefficients.len(), tolerance, order);
            return Ensemble::new(kernel).run(options, (task, leg), tasks, stop, done);
        }
        done(task);
    }
    Ok(())
}

/// What a lane does in the coming step.
#[derive(Clone, Copy, Default)]
struct Plan {
    length: f64,
    firing: Option<Firing>,
    period_ends: bool,
    failed: bool,
}

struct Ensemble<T> {
    kernel: Kernel,
    lanes: [Option<Lane<T>>; LANES],
    plans: [Plan; LANES],
    x: Vec<f64>,
    dense: Vec<f64>,
}

impl<T: Task> Ensemble<T> {
    fn new(kernel: Kernel) -> Self {
        Self {
            lanes: std::array::from_fn(|_| None),
            plans: [Plan::default(); LANES],
            x: vec![0.0; kernel.structure.states],
            dense: Vec::new(),
            kernel,
        }
    }

    fn run(
        mut self,
        options: &Options,
        (task, leg): (T, Leg),
        tasks: &mut dyn Iterator<Item = T>,
        stop: &AtomicBool,
        done: &mut dyn FnMut(T),
    ) -> Result<(), IntegrateError> {
        if let Some(task) = self.occupy(0, task, Some(leg))? {
            done(task);
        }
        for slot in 0..LANES {
            if self.lanes[slot].is_none() {
                self.refill(slot, tasks, done)?;
            }
        }
        while self.lanes.iter().any(Option::is_some) {
            check_stop(stop)?;
            self.kernel.expand();
            for slot in 0..LANES {
                self.plan(slot);
            }
            self.kernel.advance();
            for slot in 0..LANES {
                if let Some(status) = self.book(slot, options) {
                    self.retire(slot, status, tasks, done)?;
                }
            }
        }
        Ok(())
    }

    /// Gives an idle lane its next task, skipping those with nothing to do.
    fn refill(
        &mut self,
        slot: usize,
        tasks: &mut dyn Iterator<Item = T>,
        done: &mut dyn FnMut(T),
    ) -> Result<(), IntegrateError> {
        for mut task in tasks {
            let first = task.begin();
            match self.occupy(slot, task, first)? {
                Some(task) => done(task),
                None => return Ok(()),
            }
        }
        self.kernel.clear(slot);
        Ok(())
    }

    /// Runs `leg` on the lane, or gives the task back if there is none left to run.
    fn occupy(
        &mut self,
        slot: usize,
        mut task: T,
        mut leg: Option<Leg>,
    ) -> Result<Option<T>, IntegrateError> {
        while let Some(next) = leg {
            let (ours, theirs) = (&self.kernel.structure, &next.system.structure);
            if !Arc::ptr_eq(ours, theirs) && **ours != **theirs {
                return Err(IntegrateError::Structure);
            }
            let lane = Lane::new(task, &next)?;
            if lane.is_over() {
                (task, leg) = lane.finish(Status::Completed);
                continue;
            }
            self.kernel.set_state(slot, &next.start.x);
            self.kernel
                .set_coefficients(slot, &next.system.coefficients_in(&lane.guarded.modes));
            self.kernel.left.0[slot] = lane.left();
            self.lanes[slot] = Some(lane);
            return Ok(None);
        }
        Ok(Some(task))
    }

    /// Looks for a switch in the lane's step and shortens the step to it.
    fn plan(&mut self, slot: usize) {
        let Some(lane) = &mut self.lanes[slot] else {
            return;
        };
        let (kernel, structure) = (&self.kernel, &self.kernel.structure);
        let plan = &mut self.plans[slot];
        *plan = Plan {
            failed: !kernel.is_finite(slot),
            ..Plan::default()
        };
        if plan.failed {
            return;
        }
        let length = kernel.lengths.0[slot];
        plan.length = length;
        plan.period_ends = length >= kernel.left.0[slot];
        let guarded = &lane.guarded;
        let (firing, touches) =
            guarded.next(structure, &kernel.table, kernel.order, |watch, power| {
                let safe = kernel.is_safe(slot, watch.guard, watch.sign);
                if safe && !guarded.is_zero(watch.guard) {
                    return false;
                }
                in_fractions(
                    kernel.power(slot, watch.guard_node(structure)),
                    length,
                    power,
                );
                true
            });
        lane.touched(touches, length);
        if let Some(firing) = firing {
            plan.firing = Some(firing);
            plan.length = firing.theta * length;
            plan.period_ends &= firing.theta == 1.0;
        }
        if plan.length > 0.0 {
            if lane.wants_steps {
                self.dense.clear();
                for state in 0..structure.states {
                    self.dense.extend(kernel.power(slot, state));
                }
                let step = Step {
                    period: lane.period,
                    time: lane.time,
                    length: plan.length,
                    modes: &lane.guarded.modes,
                    degree: kernel.order,
                    power: &self.dense,
                };
                lane.task.step(&step);
            }
            lane.guarded.advanced(kernel.order, |guard, power| {
                in_fractions(
                    kernel.power(slot, structure.guards[guard]),
                    plan.length,
                    power,
                );
            });
        }
        self.kernel.lengths.0[slot] = plan.length;
    }

    /// Books the step; `Some` if the leg is over.
    fn book(&mut self, slot: usize, options: &Options) -> Option<Status> {
        let lane = self.lanes[slot].as_mut()?;
        let plan = self.plans[slot];
        if plan.failed {
            let finite = |state: &usize| self.kernel.power(slot, *state).all(f64::is_finite);
            let bad = (0..self.x.len()).find(|state| !finite(state)).unwrap_or(0);
            return Some(lane.not_finite(bad));
        }
        self.kernel.state(slot, &mut self.x);
        let next = lane.accept(
            options,
            plan.length,
            plan.firing,
            plan.period_ends,
            &mut self.x,
        );
        // Most steps neither switch nor end a period and leave the state as it is.
        if plan.firing.is_some() || plan.period_ends {
            self.kernel.set_state(slot, &self.x);
        }
        if plan.firing.is_some() {
            let values = lane.system.coefficients_in(&lane.guarded.modes);
            self.kernel.set_coefficients(slot, &values);
        }
        self.kernel.left.0[slot] = lane.left();
        match next {
            Next::Go => None,
            Next::Over(status) => Some(status),
        }
    }

    /// Ends the lane's leg; the task's next leg or the next task takes its place.
    fn retire(
        &mut self,
        slot: usize,
        status: Status,
        tasks: &mut dyn Iterator<Item = T>,
        done: &mut dyn FnMut(T),
    ) -> Result<(), IntegrateError> {
        if let Some(lane) = self.lanes[slot].take() {
            self.kernel.clear(slot);
            let (task, next) = lane.finish(status);
            if let Some(task) = self.occupy(slot, task, next)? {
                done(task);
                self.refill(slot, tasks, done)?;
            }
        }
        Ok(())
    }
}

/// Power coefficients in time as coefficients in the fraction of a step.
fn in_fractions(power: impl Iterator<Item = f64>, length: f64, out: &mut [f64]) {
    let mut scale = 1.0;
    for (out, a) in out.iter_mut().zip(power) {
        *out = a * scale;
        scale *= length;
    }
}
