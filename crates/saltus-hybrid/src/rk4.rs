//! Classical Runge-Kutta of order 4 with switches located inside the step.
//!
//! The solution within a step is RK4 itself with a shorter step: of order 4 everywhere, so a switch
//! costs no order. A cubic Hermite interpolant of each guard shows where to look; Newton's method on RK4
//! itself finds the root.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::arith::Scalar;
use crate::event::{Cause, Firing, Spot};
use crate::lane::{Arrival, Lane, Next};
use crate::polynomial::BernsteinTable;
use crate::series::{Series, expand, values};
use crate::structure::{Structure, Watch};
use crate::task::{IntegrateError, Options, Segment, Status, Step, Task, check_stop};

/// Degree of the interpolant.
const HERMITE: usize = 3;

/// Runs a task to its end.
pub(crate) fn run<T: Task>(
    options: &Options,
    steps_per_period: u32,
    mut task: T,
    stop: &AtomicBool,
) -> Result<T, IntegrateError> {
    let mut next = task.begin();
    while let Some(segment) = next {
        (task, next) = run_segment(options, steps_per_period, task, &segment, stop)?;
    }
    Ok(task)
}

fn run_segment<T: Task>(
    options: &Options,
    steps_per_period: u32,
    task: T,
    segment: &Segment,
    stop: &AtomicBool,
) -> Result<(T, Option<Segment>), IntegrateError> {
    let structure = Arc::clone(&segment.system.structure);
    let mut run = Run {
        options,
        steps_per_period,
        table: BernsteinTable::new(HERMITE),
        lane: Lane::new(task, segment, options)?,
        stepper: Stepper::new(&structure, segment.system.period),
        structure,
        x: segment.start.x.clone(),
        sizes: vec![0.0; segment.start.x.len()],
        slot: 1,
        dense: Vec::new(),
    };
    if run.lane.is_over() {
        return Ok(run.lane.finish(Status::Completed, &run.x));
    }
    loop {
        check_stop(stop)?;
        if let Some(status) = run.step() {
            return Ok(run.lane.finish(status, &run.x));
        }
    }
}

/// A segment under way.
struct Run<'a, T> {
    options: &'a Options,
    steps_per_period: u32,
    table: BernsteinTable,
    structure: Arc<Structure>,
    lane: Lane<T>,
    stepper: Stepper,
    x: Vec<f64>,
    /// Largest size of each state in this period.
    sizes: Vec<f64>,
    /// Point of the grid at which the coming step ends, from 1 in each period.
    slot: u32,
    dense: Vec<f64>,
}

impl<T: Task> Run<'_, T> {
    /// Steps to the next point of the grid, sample or switch; `Some` if the segment is over. `x` is then its last state.
    fn step(&mut self) -> Option<Status> {
        let period = self.lane.system.period;
        let grid = period * f64::from(self.slot) / f64::from(self.steps_per_period);
        let target = grid.min(self.lane.next_sample());
        let h = target - self.lane.time;
        let sized = self.sizes.iter_mut().zip(&self.x);
        sized.for_each(|(size, x)| *size = size.max(x.abs()));
        let (part, firing) = self.advance(h);
        if self.x.iter().any(|x| !x.is_finite()) {
            let before = self.stepper.opened(&self.structure);
            let states = std::mem::replace(&mut self.x, before);
            return Some(self.lane.lost(&self.x, states, h));
        }
        let length = if part < 1.0 { part * h } else { h };
        if length > 0.0 {
            self.show(length);
        }
        let whole = part == 1.0;
        let arrival = if whole && target == self.lane.next_sample() {
            Arrival::WithGuardsNearZero
        } else {
            Arrival::No
        };
        let (period, on_grid) = (self.lane.period, whole && target == grid);
        let (x, sizes) = (&mut self.x, || self.sizes.clone());
        let next = self
            .lane
            .accept(self.options, length, firing, arrival, x, sizes);
        if self.lane.period > period {
            self.sizes.fill(0.0);
            self.slot = 1;
        } else if on_grid {
            self.slot += 1;
        }
        match next {
            Next::Go => None,
            Next::Over(status) => Some(status),
        }
    }

    /// Moves `x` by a step of `h`, or up to a switch within it; gives the part of the step that was made, and the
    /// switch.
    fn advance(&mut self, h: f64) -> (f64, Option<Firing>) {
        let Self {
            structure,
            lane,
            stepper,
            x,
            ..
        } = self;
        stepper.stream = lane.system.stream(&lane.guarded.modes);
        stepper.open(structure, x);
        stepper.step(structure, lane.time, h, x);
        stepper.close(structure, x);
        let coming = lane.look(
            &self.table,
            HERMITE,
            |_, watch, power| {
                power.copy_from_slice(&stepper.cubic(watch.guard_slot(structure), h));
                true
            },
            || stepper.spot(structure, &self.sizes),
        );
        lane.touched(coming.touches, h);
        if let Some(found) = coming.firing {
            let watch = lane.guarded.watch(structure, &found);
            let firing = stepper.polish(structure, watch, lane.time, h, found, x);
            // Without a firing the root lies beyond the step.
            return (firing.map_or(1.0, |firing| firing.theta), firing);
        }
        if coming.until < 1.0 {
            stepper.step(structure, lane.time, coming.until * h, x);
            stepper.close(structure, x);
        }
        (coming.until, None)
    }

    /// Shows the step to the task and to the guards.
    fn show(&mut self, length: f64) {
        let Self {
            structure,
            lane,
            stepper,
            ..
        } = self;
        if lane.wants_steps {
            stepper.interpolate(structure, length, &mut self.dense);
            lane.task.step(&Step {
                period: lane.period,
                time: lane.time,
                length,
                modes: &lane.guarded.modes,
                degree: HERMITE,
                power: &self.dense,
                structure,
            });
        }
        lane.guarded.advanced(HERMITE, |guard, power| {
            power.copy_from_slice(&stepper.cubic(structure.guard_slots[guard], length));
        });
    }
}

/// Buffers of one trajectory: states and guards with their first time derivative.
struct Stepper {
    omega: f64,
    stream: Vec<f64>,
    start: Series<f64>,
    end: Series<f64>,
    stage: Series<f64>,
    rate: Vec<f64>,
    sum: Vec<f64>,
}

impl Stepper {
    fn new(structure: &Structure, period: f64) -> Self {
        let states = structure.states;
        Self {
            omega: std::f64::consts::TAU / period,
            stream: Vec::new(),
            start: Series::new(structure, 1),
            end: Series::new(structure, 1),
            stage: Series::new(structure, 0),
            rate: vec![0.0; states],
            sum: vec![0.0; states],
        }
    }

    fn open(&mut self, structure: &Structure, x: &[f64]) {
        linearize(structure, &self.stream, x, &mut self.start);
    }

    /// The opened point, as the rules of events see it.
    fn spot(&self, structure: &Structure, sizes: &[f64]) -> Spot {
        let mut x = self.opened(structure);
        x.truncate(structure.base_states());
        Spot {
            x,
            sizes: sizes.to_vec(),
        }
    }

    /// The opened point.
    fn opened(&self, structure: &Structure) -> Vec<f64> {
        structure
            .state_slots
            .iter()
            .map(|&slot| *self.start.at(slot, 0))
            .collect()
    }

    fn close(&mut self, structure: &Structure, x: &[f64]) {
        linearize(structure, &self.stream, x, &mut self.end);
    }

    /// The drive's states are known exactly at every time.
    fn drive(&self, structure: &Structure, time: f64) -> Option<[(usize, f64); 2]> {
        let (sin, cos) = (self.omega * time).sin_cos();
        structure.drive.map(|(c, s)| [(c, cos), (s, sin)])
    }

    /// One step of length `h` from the opened point at time `t`.
    fn step(&mut self, structure: &Structure, t: f64, h: f64, x: &mut [f64]) {
        let states = structure.states;
        for i in 0..states {
            self.rate[i] = *self.start.at(structure.state_slots[i], 1);
            self.sum[i] = self.rate[i];
        }
        for (fraction, weight) in [(0.5, 2.0), (0.5, 2.0), (1.0, 1.0)] {
            for i in 0..states {
                let slot = structure.state_slots[i];
                *self.stage.value(slot) = self.start.at(slot, 0) + fraction * h * self.rate[i];
            }
            for (i, value) in self
                .drive(structure, t + fraction * h)
                .into_iter()
                .flatten()
            {
                *self.stage.value(structure.state_slots[i]) = value;
            }
            values(structure, &self.stream, &mut self.stage);
            for i in 0..states {
                self.rate[i] = self.stage.now()[structure.derivative[i]];
                self.sum[i] += weight * self.rate[i];
            }
        }
        for (i, x) in x.iter_mut().enumerate() {
            *x = self.start.at(structure.state_slots[i], 0) + h / 6.0 * self.sum[i];
        }
        for (i, value) in self.drive(structure, t + h).into_iter().flatten() {
            x[i] = value;
        }
    }

    /// Power coefficients, in the fraction of the step, of the cubic through both ends.
    fn cubic(&self, slot: usize, h: f64) -> [f64; HERMITE + 1] {
        let [g0, d0] = [0, 1].map(|k| *self.start.at(slot, k));
        let [g1, d1] = [0, 1].map(|k| *self.end.at(slot, k));
        let (d0, d1) = (h * d0, h * d1);
        [
            g0,
            d0,
            3.0 * (g1 - g0) - 2.0 * d0 - d1,
            2.0 * (g0 - g1) + d0 + d1,
        ]
    }

    /// Moves a switch from the interpolant's root to the root of the guard along RK4 itself; `x`
    /// becomes the state there. `None` if that root lies beyond the step.
    fn polish(
        &mut self,
        structure: &Structure,
        watch: &Watch,
        t: f64,
        h: f64,
        found: Firing,
        x: &mut [f64],
    ) -> Option<Firing> {
        let slot = watch.guard_slot(structure);
        let mut theta = found.theta;
        if theta > 0.0 && found.cause == Cause::Crossing {
            for _ in 0..20 {
                self.step(structure, t, theta * h, x);
                self.close(structure, x);
                let [g, rate] = [0, 1].map(|k| *self.end.at(slot, k));
                let newton = g / (h * rate);
                if !newton.is_finite() || newton.abs() > 0.5 || theta - newton <= 0.0 {
                    break; // nearly tangent: the interpolant's root is as good
                }
                theta -= newton;
                if newton.abs() <= 2.0 * f64::EPSILON {
                    break;
                }
            }
            if theta > 1.0 + 1e-12 {
                self.step(structure, t, h, x);
                self.close(structure, x);
                return None;
            }
            theta = theta.min(1.0);
        }
        self.step(structure, t, theta * h, x);
        self.close(structure, x);
        Some(Firing { theta, ..found })
    }

    /// Cubics in time of all states and guards over a step of length `h`.
    fn interpolate(&self, structure: &Structure, h: f64, out: &mut Vec<f64>) {
        out.clear();
        for &slot in structure.state_slots.iter().chain(&structure.guard_slots) {
            let mut power = self.cubic(slot, h);
            let mut scale = 1.0;
            for a in &mut power {
                *a *= scale;
                scale /= h;
            }
            out.extend(power);
        }
    }
}

/// All nodes at `x` with their first time derivative where the guards and the states need it.
fn linearize(structure: &Structure, stream: &[f64], x: &[f64], out: &mut Series<f64>) {
    for (i, &value) in x.iter().enumerate() {
        *out.value(structure.state_slots[i]) = value;
    }
    expand(Scalar, structure, None, stream, out);
}
