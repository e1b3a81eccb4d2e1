//! The bookkeeping of one trajectory, shared by all steppers: time, modes, counters, the task.

use crate::event::{Firing, Guarded, Touches};
use crate::run::{End, IntegrateError, Leg, Options, Sample, Status, Switch, SwitchKind, Task};
use crate::saltation;
use crate::system::{Evaluator, Point, System};

/// A trajectory under way.
pub(crate) struct Lane<T> {
    pub(crate) task: T,
    pub(crate) system: System,
    pub(crate) guarded: Guarded,
    pub(crate) wants_steps: bool,
    /// Time since the start of the period.
    pub(crate) time: f64,
    pub(crate) period: u64,
    periods: u64,
    /// Samples in each period, and how many of them lie behind in this one.
    parts: u32,
    part: u32,
    evaluator: Evaluator,
    dwell: Vec<Vec<f64>>,
    /// Since when, within the period, each unit is in its mode.
    entered: Vec<f64>,
    /// Steps and switches of this period.
    recent_steps: u32,
    recent_switches: u32,
    steps: u64,
    switches: u64,
    tangencies: u64,
}

/// What became of a lane after a step.
pub(crate) enum Next {
    /// It goes on; the state may have been changed.
    Go,
    /// The leg is over.
    Over(Status),
}

impl<T: Task> Lane<T> {
    pub(crate) fn new(task: T, leg: &Leg, options: &Options) -> Result<Self, IntegrateError> {
        let (got, expected) = (leg.start.x.len(), leg.system.state_len());
        if got != expected || leg.start.modes.len() != leg.system.unit_count() {
            return Err(IntegrateError::Start { got, expected });
        }
        let structure = &leg.system.structure;
        Ok(Self {
            wants_steps: task.wants_steps(),
            task,
            system: leg.system.clone(),
            guarded: Guarded::new(structure, &leg.start.modes),
            time: 0.0,
            period: 0,
            periods: leg.periods,
            parts: options.samples_per_period,
            part: 0,
            evaluator: Evaluator::new(&leg.system.base()),
            dwell: structure
                .units
                .iter()
                .map(|modes| vec![0.0; modes.len()])
                .collect(),
            entered: vec![0.0; structure.units.len()],
            recent_steps: 0,
            recent_switches: 0,
            steps: 0,
            switches: 0,
            tangencies: 0,
        })
    }

    /// Time since the start of the run.
    fn total_time(&self) -> f64 {
        self.period as f64 * self.system.period + self.time
    }

    /// Time of the next sample since the start of the period.
    fn next_sample(&self) -> f64 {
        if self.part + 1 == self.parts {
            self.system.period
        } else {
            self.system.period * (f64::from(self.part + 1) / f64::from(self.parts))
        }
    }

    /// Whether a step that ends `slot` of `steps` through the period ends at the next sample.
    pub(crate) fn is_sample(&self, slot: u32, steps: u32) -> bool {
        let [slot, steps, part, parts] = [slot, steps, self.part + 1, self.parts].map(u64::from);
        slot * parts >= part * steps
    }

    /// Time left until the next sample.
    pub(crate) fn left(&self) -> f64 {
        self.next_sample() - self.time
    }

    /// Whether nothing is left to run.
    pub(crate) fn is_over(&self) -> bool {
        self.period >= self.periods
    }

    /// The end of a lane whose step led to the state `x`, which is not finite.
    pub(crate) fn not_finite(&self, x: impl IntoIterator<Item = f64>) -> Status {
        let state = x.into_iter().position(|x| !x.is_finite()).unwrap_or(0);
        Status::NotFinite {
            time: self.total_time(),
            state,
        }
    }

    pub(crate) fn touched(&mut self, touches: Touches, length: f64) {
        if touches.count > 0 {
            self.tangencies += u64::from(touches.count);
            self.task.switch(&Switch {
                period: self.period,
                time: self.time + touches.theta * length,
                unit: touches.unit,
                kind: SwitchKind::Tangency,
                x: &[],
            });
        }
    }

    /// Books a step in which nothing happened; `false` if there have been too many.
    #[inline(always)]
    pub(crate) fn pass(&mut self, options: &Options, length: f64) -> bool {
        self.time += length;
        self.steps += 1;
        self.recent_steps += 1;
        self.recent_steps <= options.max_steps
    }

    /// Books an accepted step to the finite state `x`: time, switch, sample. `x` may be changed by a
    /// reset or by the drive's return to phase 0.
    pub(crate) fn accept(
        &mut self,
        options: &Options,
        length: f64,
        firing: Option<Firing>,
        arrives: bool,
        x: &mut [f64],
    ) -> Next {
        let few_steps = self.pass(options, length);
        if arrives {
            self.time = self.next_sample();
        }
        if let Some(firing) = firing {
            self.switch(firing, x);
        }
        if self.recent_switches > options.max_switches {
            let (time, count) = (self.total_time(), self.recent_switches);
            return Next::Over(Status::Chattering { time, count });
        }
        if !few_steps {
            return Next::Over(self.too_many_steps());
        }
        if arrives { self.sample(x) } else { Next::Go }
    }

    pub(crate) fn too_many_steps(&self) -> Status {
        Status::TooManySteps {
            time: self.total_time(),
            count: self.recent_steps,
        }
    }

    /// Counts the time that a unit spent in its mode.
    fn leave(&mut self, unit: usize) {
        self.dwell[unit][self.guarded.modes[unit]] += self.time - self.entered[unit];
        self.entered[unit] = self.time;
    }

    fn switch(&mut self, firing: Firing, x: &mut [f64]) {
        let unit = firing.unit;
        self.leave(unit);
        let from = self.guarded.modes[unit];
        let structure = std::sync::Arc::clone(&self.system.structure);
        let watch = &structure.units[unit][from][firing.watch];
        let (period, time) = (self.period, self.time);
        let kind = SwitchKind::Mode { from, to: watch.to };
        self.task.switch(&Switch {
            period,
            time,
            unit,
            kind,
            x,
        });
        if let Some(tangents) = &structure.tangents {
            let watch = &tangents.base.units[unit][from][firing.watch];
            let (evaluator, modes) = (&mut self.evaluator, &self.guarded.modes);
            saltation::cross(evaluator, tangents, watch, &firing, modes, x);
        } else if !watch.resets.is_empty() {
            let nodes = self.evaluator.nodes(&self.guarded.modes, x);
            for &(state, node) in &watch.resets {
                x[state] = nodes[node];
            }
        }
        self.guarded.fire(&structure, &firing);
        self.switches += 1;
        self.recent_switches += 1;
    }

    /// Takes a sample of `x`, and begins a new period after the last one.
    fn sample(&mut self, x: &mut [f64]) -> Next {
        for unit in 0..self.entered.len() {
            self.leave(unit);
        }
        self.part += 1;
        let (period, part, ends) = (self.period + 1, self.part, self.part == self.parts);
        if ends {
            if let Some((cos, sin)) = self.system.structure.drive {
                (x[cos], x[sin]) = (1.0, 0.0);
            }
            self.begin_period();
        }
        let sample = Sample {
            period,
            part,
            modes: &self.guarded.modes,
            x,
            dwell: &self.dwell,
        };
        let go_on = self.task.sample(&sample);
        let columns = self.system.columns_mut(x);
        if !columns.is_empty() {
            self.task.tangents(columns);
        }
        if ends {
            self.dwell.iter_mut().for_each(|d| d.fill(0.0));
        }
        if go_on && !self.is_over() {
            Next::Go
        } else {
            Next::Over(Status::Completed)
        }
    }

    fn begin_period(&mut self) {
        self.entered.fill(0.0);
        self.time = 0.0;
        self.part = 0;
        self.period += 1;
        self.recent_steps = 0;
        self.recent_switches = 0;
    }

    /// Reports the end of the leg at state `x`; the task's next one, if any, and the task.
    pub(crate) fn finish(mut self, status: Status, x: &[f64]) -> (T, Option<Leg>) {
        let next = self.task.end(End {
            status,
            point: Point {
                modes: self.guarded.modes,
                x: x.to_vec(),
            },
            periods: self.period,
            steps: self.steps,
            switches: self.switches,
            tangencies: self.tangencies,
        });
        (self.task, next)
    }
}
