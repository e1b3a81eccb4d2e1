//! Classical Runge-Kutta of order 4 with switches located inside the step.
//!
//! The solution within a step is RK4 itself with a shorter step: of order 4 everywhere, so a switch
//! costs no order. A cubic Hermite interpolant of each guard says where to look; Newton on the
//! method's own solution says where it is.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::arith::Scalar;
use crate::compile::{Structure, Watch};
use crate::event::Firing;
use crate::lane::{Lane, Next};
use crate::polynomial::BernsteinTable;
use crate::run::{IntegrateError, Leg, Options, Step, Task, check_stop};
use crate::series::{Series, expand, values};

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
    while let Some(leg) = next {
        (task, next) = run_leg(options, steps_per_period, task, &leg, stop)?;
    }
    Ok(task)
}

fn run_leg<T: Task>(
    options: &Options,
    steps_per_period: u32,
    task: T,
    leg: &Leg,
    stop: &AtomicBool,
) -> Result<(T, Option<Leg>), IntegrateError> {
    let table = BernsteinTable::new(HERMITE);
    let structure = Arc::clone(&leg.system.structure);
    let mut lane = Lane::new(task, leg, options)?;
    let mut stepper = Stepper::new(&structure, leg.system.period);
    let mut x = leg.start.x.clone();
    let mut slot = 1;
    let mut dense = Vec::new();
    if lane.is_over() {
        return Ok(lane.finish(crate::Status::Completed, &x));
    }
    loop {
        check_stop(stop)?;
        let target = leg.system.period * f64::from(slot) / f64::from(steps_per_period);
        let h = target - lane.time;
        stepper.stream = leg.system.stream(&lane.guarded.modes);
        stepper.open(&structure, &x);
        stepper.step(&structure, lane.time, h, &mut x);
        stepper.close(&structure, &x);
        let (mut firing, touches) =
            lane.guarded
                .next(&structure, &table, HERMITE, |watch, power| {
                    power.copy_from_slice(&stepper.cubic(watch.guard_slot(&structure), h));
                    true
                });
        lane.touched(touches, h);
        if let Some(found) = firing {
            let watch = &structure.units[found.unit][lane.guarded.modes[found.unit]][found.watch];
            firing = stepper.polish(&structure, watch, lane.time, h, found, &mut x);
        }
        if x.iter().any(|x| !x.is_finite()) {
            let status = lane.not_finite(x);
            return Ok(lane.finish(status, &stepper.opened(&structure)));
        }
        let length = firing.map_or(h, |f| f.theta * h);
        if length > 0.0 {
            if lane.wants_steps {
                stepper.interpolate(&structure, length, &mut dense);
                let (period, time) = (lane.period, lane.time);
                let modes = &lane.guarded.modes;
                lane.task.step(&Step {
                    period,
                    time,
                    length,
                    modes,
                    degree: HERMITE,
                    power: &dense,
                    structure: &structure,
                });
            }
            lane.guarded.advanced(HERMITE, |guard, power| {
                power.copy_from_slice(&stepper.cubic(structure.guard_slots[guard], length));
            });
        }
        let on_grid = firing.is_none_or(|f| f.theta == 1.0);
        let arrives = on_grid && lane.is_sample(slot, steps_per_period);
        match lane.accept(options, length, firing, arrives, &mut x) {
            Next::Over(status) => return Ok(lane.finish(status, &x)),
            Next::Go if arrives && slot == steps_per_period => slot = 1,
            Next::Go if on_grid => slot += 1,
            Next::Go => {}
        }
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
        if theta > 0.0 {
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
