//! Taylor series on eight asynchronous lanes.
//!
//! Each lane of the vector register is a trajectory with its own parameters, time, step, modes and
//! end; a lane that ends takes the next task. The series of all lanes are computed together;
//! switches and samples, which differ between lanes, take a few scalar operations each. A single trajectory is
//! a run with seven idle lanes: the same code, hence the same bits.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::arith::LANES;
use crate::event::Firing;
use crate::kernel::Kernel;
use crate::lane::{Arrival, Lane, NEAR, Next};
use crate::task::{IntegrateError, Options, Segment, Status, Step, Task, check_stop};

/// Runs all tasks.
pub(crate) fn run<T: Task>(
    options: &Options,
    tolerance: f64,
    order: usize,
    tasks: &mut dyn Iterator<Item = T>,
    stop: &AtomicBool,
    done: &mut dyn FnMut(T),
) -> Result<(), IntegrateError> {
    // The first segment has the structure of all.
    while let Some(mut task) = tasks.next() {
        if let Some(segment) = task.begin() {
            let structure = &segment.system.structure;
            let kernel = Kernel::new(structure, tolerance, order, options.instructions.level());
            return Ensemble::new(kernel).run(options, (task, segment), tasks, stop, done);
        }
        done(task);
    }
    Ok(())
}

/// A step that is shorter than this part of a period does not tell which guards are near zero at its end.
const SHORT: f64 = 1e-6;

/// Events of a lane in the coming step.
#[derive(Clone, Copy, Default)]
struct Plan {
    firing: Option<Firing>,
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
        (task, segment): (T, Segment),
        tasks: &mut dyn Iterator<Item = T>,
        stop: &AtomicBool,
        done: &mut dyn FnMut(T),
    ) -> Result<(), IntegrateError> {
        if let Some(task) = self.occupy(0, task, Some(segment), options)? {
            done(task);
        }
        for slot in 0..LANES {
            if self.lanes[slot].is_none() {
                self.refill(slot, tasks, done, options)?;
            }
        }
        while self.lanes.iter().any(Option::is_some) {
            check_stop(stop)?;
            let looks = self.kernel.expand();
            self.plans = Default::default();
            for (slot, look) in looks.into_iter().enumerate() {
                if look {
                    self.plan(slot);
                }
            }
            self.kernel.advance();
            for slot in 0..LANES {
                if let Some(status) = self.book(slot, options) {
                    self.retire(slot, status, tasks, done, options)?;
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
        options: &Options,
    ) -> Result<(), IntegrateError> {
        for mut task in tasks {
            let first = task.begin();
            match self.occupy(slot, task, first, options)? {
                Some(task) => done(task),
                None => return Ok(()),
            }
        }
        self.kernel.clear(slot);
        Ok(())
    }

    /// Runs `segment` on the lane, or gives the task back if there is none left to run.
    fn occupy(
        &mut self,
        slot: usize,
        mut task: T,
        mut segment: Option<Segment>,
        options: &Options,
    ) -> Result<Option<T>, IntegrateError> {
        while let Some(next) = segment {
            let (ours, theirs) = (&self.kernel.structure, &next.system.structure);
            if !Arc::ptr_eq(ours, theirs) && **ours != **theirs {
                return Err(IntegrateError::Structure);
            }
            let lane = Lane::new(task, &next, options)?;
            if lane.is_over() {
                (task, segment) = lane.finish(Status::Completed, &next.start.x);
                continue;
            }
            self.kernel.begin(slot, &next.system, &next.start.x);
            self.kernel
                .set_system(slot, &next.system, &lane.guarded.modes);
            self.kernel.left.0[slot] = lane.left();
            self.kernel.watch(slot, &lane.guarded, lane.wants_steps);
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
        if !kernel.is_finite(slot) {
            self.plans[slot].failed = true;
            return;
        }
        let whole = kernel.lengths.0[slot];
        let coming = lane.look(
            &kernel.table,
            kernel.order,
            |guarded, watch, power| {
                let safe = kernel.is_safe(slot, watch.guard, watch.sign);
                if safe && !guarded.is_zero(watch.guard) {
                    return false;
                }
                in_fractions(
                    kernel.power(slot, watch.guard_slot(structure)),
                    whole,
                    power,
                );
                true
            },
            || kernel.spot(slot),
        );
        lane.touched(coming.touches, whole);
        let length = if coming.until < 1.0 {
            coming.until * whole
        } else {
            whole
        };
        if length > 0.0 {
            show(kernel, slot, lane, length, &mut self.dense);
        }
        self.plans[slot].firing = coming.firing;
        self.kernel.lengths.0[slot] = length;
        // A switch changes more, and is booked after the step.
        if coming.firing.is_none() {
            self.kernel.watch(slot, &lane.guarded, lane.wants_steps);
        }
    }

    /// Books the step; `Some` if the segment is over. The state at the end of the segment is then in `x`.
    #[inline(always)]
    fn book(&mut self, slot: usize, options: &Options) -> Option<Status> {
        let lane = self.lanes[slot].as_mut()?;
        let length = self.kernel.lengths.0[slot];
        let left = &mut self.kernel.left.0[slot];
        let plan = &self.plans[slot];
        let eventful = plan.firing.is_some() || plan.failed || length >= *left;
        if !eventful && self.kernel.overflow.0[slot] == 0.0 && lane.pass(options, length) {
            *left = lane.left();
            return None;
        }
        self.book_event(slot, options, eventful)
    }

    /// Books a step with a switch, the end of a period or of the trajectory.
    fn book_event(&mut self, slot: usize, options: &Options, eventful: bool) -> Option<Status> {
        let lane = self.lanes[slot].as_mut()?;
        let plan = self.plans[slot];
        let kernel = &mut self.kernel;
        if plan.failed || !kernel.has_finite_state(slot) {
            let mut states = vec![0.0; self.x.len()];
            if plan.failed {
                // The state may be finite while its series is not.
                let slots = &kernel.structure.state_slots;
                let finite = |state: usize| kernel.power(slot, slots[state]).all(f64::is_finite);
                let lost = (0..states.len()).filter(|&state| !finite(state));
                lost.for_each(|state| states[state] = f64::NAN);
            } else {
                kernel.state(slot, &mut states);
            }
            kernel.state_before(slot, &mut self.x);
            return Some(lane.lost(&self.x, states, NEAR * lane.system.period));
        }
        kernel.state(slot, &mut self.x);
        if !eventful {
            return Some(lane.too_many_steps(&self.x));
        }
        let length = kernel.lengths.0[slot];
        let arrival = if length < kernel.left.0[slot] {
            Arrival::No
        } else if length > SHORT * lane.system.period
            && kernel.is_clear(slot, lane.guarded.watches(&kernel.structure))
        {
            Arrival::Clear
        } else {
            Arrival::WithGuardsNearZero
        };
        let (switches, period) = (lane.switches(), lane.period);
        let sizes = || kernel.sizes().of_lane(slot);
        let next = lane.accept(options, length, plan.firing, arrival, &mut self.x, sizes);
        kernel.set_state(slot, &self.x);
        if lane.period > period {
            kernel.sizes().period_begins(slot, &self.x);
        }
        if lane.switches() > switches {
            kernel.set_modes(slot, &lane.system, &lane.guarded.modes);
            kernel.watch(slot, &lane.guarded, lane.wants_steps);
            kernel.sizes().switched(slot);
        }
        kernel.left.0[slot] = lane.left();
        match next {
            Next::Go => None,
            Next::Over(status) => Some(status),
        }
    }

    /// Ends the lane's segment; the task's next segment or the next task takes its place.
    fn retire(
        &mut self,
        slot: usize,
        status: Status,
        tasks: &mut dyn Iterator<Item = T>,
        done: &mut dyn FnMut(T),
        options: &Options,
    ) -> Result<(), IntegrateError> {
        if let Some(lane) = self.lanes[slot].take() {
            self.kernel.clear(slot);
            let (task, next) = lane.finish(status, &self.x);
            if let Some(task) = self.occupy(slot, task, next, options)? {
                done(task);
                self.refill(slot, tasks, done, options)?;
            }
        }
        Ok(())
    }
}

/// Shows the coming step of a lane to its task and to its guards.
fn show<T: Task>(
    kernel: &Kernel,
    slot: usize,
    lane: &mut Lane<T>,
    length: f64,
    dense: &mut Vec<f64>,
) {
    let structure = &kernel.structure;
    if lane.wants_steps {
        dense.clear();
        for &node in structure.state_slots.iter().chain(&structure.guard_slots) {
            dense.extend(kernel.power(slot, node));
        }
        lane.task.step(&Step {
            period: lane.period,
            time: lane.time,
            length,
            modes: &lane.guarded.modes,
            degree: kernel.order,
            power: dense,
            structure,
        });
    }
    lane.guarded.advanced(kernel.order, |guard, power| {
        let slots = &structure.guard_slots;
        in_fractions(kernel.power(slot, slots[guard]), length, power);
    });
}

/// Power coefficients in time as coefficients in the fraction of a step.
fn in_fractions(power: impl Iterator<Item = f64>, length: f64, out: &mut [f64]) {
    let mut scale = 1.0;
    for (out, a) in out.iter_mut().zip(power) {
        *out = a * scale;
        scale *= length;
    }
}
