//! Bookkeeping of one trajectory, shared by all steppers: time, modes, counters, the task.

use crate::event::{Coming, Firing, Guarded, Judge, Spot, Touches};
use crate::polynomial::BernsteinTable;
use crate::saltation;
use crate::structure::Watch;
use crate::system::{Point, System};
use crate::task::{
    End, IntegrateError, Options, Sample, Segment, Status, Switch, SwitchKind, Task,
};

/// Part of a period within which a pole is the reason why a series is not finite, or its steps too short.
pub(crate) const NEAR: f64 = 1e-9;

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
    judge: Judge,
    /// Last instant with a switch: period, time, how much later each tangent column comes to it, and how many
    /// switches it has had.
    instant: (u64, f64),
    later: Vec<f64>,
    at_once: u32,
    dwell: Vec<Vec<f64>>,
    /// Time, within the period, at which each unit entered its mode.
    entered: Vec<f64>,
    /// Steps and switches of this period.
    recent_steps: u32,
    recent_switches: u32,
    steps: u64,
    switches: u64,
    tangencies: u64,
}

/// Whether a step ends at a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Arrival {
    No,
    /// All guards in force are clearly on their right sides.
    Clear,
    WithGuardsNearZero,
}

/// Fate of a lane after a step.
pub(crate) enum Next {
    /// It goes on; the state may have been changed.
    Go,
    /// The segment is over.
    Over(Status),
}

impl<T: Task> Lane<T> {
    pub(crate) fn new(
        task: T,
        segment: &Segment,
        options: &Options,
    ) -> Result<Self, IntegrateError> {
        let (got, expected) = (segment.start.x.len(), segment.system.state_len());
        if got != expected || segment.start.modes.len() != segment.system.unit_count() {
            return Err(IntegrateError::Start { got, expected });
        }
        let structure = &segment.system.structure;
        Ok(Self {
            wants_steps: task.wants_steps(),
            task,
            system: segment.system.clone(),
            guarded: Guarded::new(structure, &segment.start.modes),
            time: 0.0,
            period: 0,
            periods: segment.periods,
            parts: options.samples_per_period,
            part: 0,
            judge: Judge::new(&segment.system, options.method.error()),
            instant: (0, f64::NAN),
            later: Vec::new(),
            at_once: 0,
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
    pub(crate) fn next_sample(&self) -> f64 {
        if self.part + 1 == self.parts {
            self.system.period
        } else {
            self.system.period * (f64::from(self.part + 1) / f64::from(self.parts))
        }
    }

    /// Time left until the next sample.
    pub(crate) fn left(&self) -> f64 {
        self.next_sample() - self.time
    }

    /// Looks for a switch in the coming step.
    pub(crate) fn look(
        &mut self,
        table: &BernsteinTable,
        degree: usize,
        poly: impl FnMut(&Guarded, &Watch, &mut [f64]) -> bool,
        spot: impl Fn() -> Spot,
    ) -> Coming {
        let structure = &self.system.structure;
        let judge = &mut self.judge;
        self.guarded
            .next(structure, table, degree, judge, poly, spot)
    }

    /// Whether nothing is left to run.
    pub(crate) fn is_over(&self) -> bool {
        self.period >= self.periods
    }

    /// The end of a lane whose step led from `before` to the state `x`, which is not finite. What a function asks of a
    /// state within the time `reach` counts as its reason.
    pub(crate) fn lost(
        &mut self,
        before: &[f64],
        x: impl IntoIterator<Item = f64>,
        reach: f64,
    ) -> Status {
        self.out_of_domain(before, reach).unwrap_or_else(|| {
            let state = x.into_iter().position(|x| !x.is_finite()).unwrap_or(0);
            Status::NotFinite {
                time: self.total_time(),
                state,
            }
        })
    }

    /// The end of a lane that leaves the domain of its functions within the time `reach` from the state `x`.
    fn out_of_domain(&mut self, x: &[f64], reach: f64) -> Option<Status> {
        let base = self.system.structure.base_states();
        let evaluator = &mut self.judge.evaluator;
        let modes = &self.guarded.modes;
        let (operation, argument) = evaluator.out_of_domain(modes, &x[..base], reach)?;
        Some(Status::OutOfDomain {
            time: self.total_time(),
            operation,
            argument,
        })
    }

    /// Switches so far.
    pub(crate) fn switches(&self) -> u64 {
        self.switches
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
    /// reset or by the exact values of the drive at a sample. `sizes` are the largest sizes of the states so far.
    pub(crate) fn accept(
        &mut self,
        options: &Options,
        length: f64,
        firing: Option<Firing>,
        arrival: Arrival,
        x: &mut [f64],
        sizes: impl FnOnce() -> Vec<f64>,
    ) -> Next {
        let few_steps = self.pass(options, length);
        let arrives = arrival != Arrival::No;
        if arrives {
            self.time = self.next_sample();
        }
        if let Some(firing) = firing {
            self.switch(firing, x);
        }
        if arrives {
            self.set_drive(x);
            // The sample is the state after all switches at its instant, even if rounding or the error of the
            // solution puts them behind it.
            if firing.is_some() || arrival == Arrival::WithGuardsNearZero {
                let base = x.len().min(self.system.structure.base_states());
                let mut spot = Spot {
                    x: x[..base].to_vec(),
                    sizes: sizes(),
                };
                while self.recent_switches <= options.max_switches {
                    let structure = &self.system.structure;
                    let Some(due) = self.guarded.due(structure, &mut self.judge, &spot) else {
                        break;
                    };
                    self.switch(due, x);
                    spot.x.copy_from_slice(&x[..base]);
                }
            }
        }
        if self.recent_switches > options.max_switches {
            return Next::Over(self.chattering());
        }
        if !few_steps {
            return Next::Over(self.too_many_steps(x));
        }
        if arrives { self.sample(x) } else { Next::Go }
    }

    /// Sets the drive to its exact values at the next sample: its own error does not add up, and a guard of time
    /// alone switches at its sample.
    fn set_drive(&self, x: &mut [f64]) {
        if let Some((cos, sin)) = self.system.structure.drive {
            (x[cos], x[sin]) = phase(self.part + 1, self.parts);
        }
    }

    fn chattering(&self) -> Status {
        Status::Chattering {
            time: self.total_time(),
            count: self.recent_switches,
            at_once: 10 * self.at_once >= 9 * self.recent_switches,
        }
    }

    /// The end of a lane whose steps are too many, which are at the state `x`.
    pub(crate) fn too_many_steps(&mut self, x: &[f64]) -> Status {
        let reach = NEAR * self.system.period;
        self.out_of_domain(x, reach)
            .unwrap_or(Status::TooManySteps {
                time: self.total_time(),
                count: self.recent_steps,
            })
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
        if self.instant != (period, time) {
            self.instant = (period, time);
            self.later.clear();
            self.at_once = 0;
        }
        let modes = &self.guarded.modes;
        if let Some(tangents) = &structure.tangents {
            let watch = &tangents.base.units[unit][from][firing.watch];
            let (evaluator, later) = (&mut self.judge.evaluator, &mut self.later);
            saltation::cross(evaluator, tangents, watch, &firing, modes, x, later);
        } else {
            self.judge.reset(modes, watch, x);
        }
        self.guarded.fire(&structure, &firing);
        self.switches += 1;
        self.recent_switches += 1;
        self.at_once += 1;
    }

    /// Takes a sample of `x`, and begins a new period after the last one.
    fn sample(&mut self, x: &mut [f64]) -> Next {
        for unit in 0..self.entered.len() {
            self.leave(unit);
        }
        self.part += 1;
        let (period, part, ends) = (self.period + 1, self.part, self.part == self.parts);
        if ends {
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

    /// Reports the end of the segment at state `x`; the task's next one, if any, and the task.
    pub(crate) fn finish(mut self, status: Status, x: &[f64]) -> (T, Option<Segment>) {
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

/// Cosine and sine of 2 pi part/parts, exact where they are 0 or 1: a guard of time alone vanishes there.
fn phase(part: u32, parts: u32) -> (f64, f64) {
    let quarters = 4 * u64::from(part);
    match (quarters % u64::from(parts), quarters / u64::from(parts) % 4) {
        (0, 0) => (1.0, 0.0),
        (0, 1) => (0.0, 1.0),
        (0, 2) => (-1.0, 0.0),
        (0, _) => (0.0, -1.0),
        _ => {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(part) / f64::from(parts)).sin_cos();
            (cos, sin)
        }
    }
}
