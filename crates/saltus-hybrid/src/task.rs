//! The words of a run: options, tasks and the segments they are made of, and the samples, steps, switches and ends
//! that tasks see.

use std::sync::atomic::{AtomicBool, Ordering};

use fearless_simd::Level;

use crate::polynomial::{MAX_DEGREE, minima};
use crate::program::Mode;
use crate::structure::Structure;
use crate::system::{Point, System};

/// Method of integration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Taylor series with adaptive step and exact dense output, eight trajectories at a time.
    /// Jorba & Zou, Experiment. Math. 14 (2005).
    Taylor {
        /// Size allowed for the last term of the series, in the units of the state.
        tolerance: f64,
        /// Order of the series, 4 to 30.
        order: usize,
    },
    /// Classical Runge-Kutta of order 4 on a fixed grid, switches located on the method's own
    /// solution within the step: the method of DP section 2.
    Rk4 {
        /// Steps in one period.
        steps_per_period: u32,
    },
}

impl Method {
    /// Taylor at `tolerance` with the order that suits it: about one for each factor e^2 of accuracy
    /// (Jorba & Zou, section 3), and not below 8.
    pub fn taylor(tolerance: f64) -> Self {
        let order = (-0.5 * tolerance.ln()).ceil() as usize + 2;
        Self::Taylor {
            tolerance,
            order: order.clamp(8, 24),
        }
    }

    /// Distance of a guard from zero that the error of the solution may make, relative to its terms: the sum over
    /// some steps, and no more than a clear distance.
    pub(crate) fn error(self) -> f64 {
        match self {
            Self::Taylor { tolerance, .. } => (1000.0 * tolerance).clamp(1e-10, 1e-2),
            Self::Rk4 { .. } => 1e-9,
        }
    }
}

/// Instructions that the series of eight trajectories are computed with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Instructions {
    /// The best of this machine.
    #[default]
    Best,
    /// AVX2 with fused multiply-adds, or the best where there is none: the same bits as AVX-512.
    Avx2,
    /// Those of every machine of this architecture. Without fused multiply-adds results differ from
    /// the others by rounding.
    Baseline,
}

impl Instructions {
    /// Whether a multiply-add of the series is rounded once here. Machines that are equal in this give the same
    /// bits; others differ by rounding.
    pub fn fused(self) -> bool {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        let fused = self.level().as_avx2().is_some();
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        let fused = cfg!(target_arch = "aarch64");
        fused
    }

    pub(crate) fn level(self) -> Level {
        let best = Level::new();
        match self {
            Self::Best => best,
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Self::Avx2 => best.as_avx2().map_or(best, Level::Avx2),
            #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
            Self::Avx2 => best,
            Self::Baseline => Level::baseline(),
        }
    }
}

/// Settings of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Method of integration.
    pub method: Method,
    /// Switches allowed in one period, all units together, before the run ends as
    /// [`Status::Chattering`]. A person switches twice; 100 leaves room for any real motion.
    pub max_switches: u32,
    /// Steps allowed in one period before the run ends as [`Status::TooManySteps`].
    pub max_steps: u32,
    /// Instruction set: for tests, and for results that must be the same on other machines.
    pub instructions: Instructions,
    /// Samples in each period, equally far apart, the last at its end. Steps end on all of them.
    pub samples_per_period: u32,
}

impl Default for Options {
    /// Taylor at 1e-10: errors of an orbit stay below what any figure shows and near 1e-9.
    fn default() -> Self {
        Self {
            method: Method::taylor(1e-10),
            max_switches: 100,
            max_steps: 1_000_000,
            instructions: Instructions::Best,
            samples_per_period: 1,
        }
    }
}

/// One trajectory to run.
#[derive(Clone, Debug)]
pub struct Segment {
    /// The system, with its parameters.
    pub system: System,
    /// First state, at phase 0 of the drive.
    pub start: Point,
    /// Number of periods.
    pub periods: u64,
}

/// The state at a sampling instant, as at the end of a period: after all switches at that instant.
#[derive(Clone, Copy, Debug)]
pub struct Sample<'a> {
    /// The period that it belongs to, from 1; completed at its last sample.
    pub period: u64,
    /// Number of the sample within the period, from 1 to [`Options::samples_per_period`].
    pub part: u32,
    /// Mode of each unit.
    pub modes: &'a [Mode],
    /// State, drive and quadratures included.
    pub x: &'a [f64],
    /// Time spent in each mode of each unit during this period so far: `dwell[unit][mode]`.
    pub dwell: &'a [Vec<f64>],
}

/// Kind of a switch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SwitchKind {
    /// The unit left a mode for another (or for the same one, with a reset).
    Mode {
        /// The mode left.
        from: Mode,
        /// The mode entered.
        to: Mode,
    },
    /// A guard touched zero to rounding and did not cross it.
    Tangency,
}

/// A switch, or a tangency, with its place in time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Switch<'a> {
    /// Periods completed before.
    pub period: u64,
    /// Time since the start of the period.
    pub time: f64,
    /// Unit that switched.
    pub unit: usize,
    /// Mode change or tangency.
    pub kind: SwitchKind,
    /// State just before any reset; empty for a tangency.
    pub x: &'a [f64],
}

/// One accepted step with its dense output.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// Periods completed before.
    pub period: u64,
    /// Start since the start of the period.
    pub time: f64,
    /// Length.
    pub length: f64,
    /// Mode of each unit throughout the step.
    pub modes: &'a [Mode],
    pub(crate) degree: usize,
    /// Power coefficients in time since the start, state by state and then guard by guard.
    pub(crate) power: &'a [f64],
    pub(crate) structure: &'a Structure,
}

/// A minimum of a guard in force: it came near to zero and turned back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Minimum {
    /// Unit whose guard it is.
    pub unit: usize,
    /// Transition of the present mode of that unit.
    pub transition: usize,
    /// Time since the start of the step.
    pub since: f64,
    /// Value of the guard there, positive while the mode lasts.
    pub value: f64,
}

impl Step<'_> {
    /// State at `time` + `since`, 0 <= since <= length, to the accuracy of the method.
    pub fn state(&self, since: f64, out: &mut [f64]) {
        for (out, power) in out.iter_mut().zip(self.power.chunks_exact(self.degree + 1)) {
            *out = power.iter().rev().fold(0.0, |sum, &a| sum * since + a);
        }
    }

    /// The minima of the guards in force within the step. One that reaches zero is a grazing.
    pub fn minima(&self) -> Vec<Minimum> {
        let mut out = Vec::new();
        for (unit, modes) in self.structure.units.iter().enumerate() {
            for (transition, watch) in modes[self.modes[unit]].iter().enumerate() {
                let first = (self.structure.states + watch.guard) * (self.degree + 1);
                let mut scale = watch.sign;
                let mut power = [0.0; MAX_DEGREE + 1];
                for (out, a) in power
                    .iter_mut()
                    .zip(&self.power[first..=first + self.degree])
                {
                    *out = a * scale;
                    scale *= self.length;
                }
                out.extend(minima(&power).map(|(theta, value)| Minimum {
                    unit,
                    transition,
                    since: theta * self.length,
                    value,
                }));
            }
        }
        out
    }
}

/// The end of a trajectory. Every variant but the first names what stopped it.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Status {
    /// All periods were run, or the task stopped.
    #[error("completed")]
    Completed,
    /// More switches in one period than allowed: they accumulate (Zeno) or the guard chatters.
    #[error("{}", chattering(*time, *count, *at_once))]
    Chattering {
        /// Time since the start of the run.
        time: f64,
        /// Switches in this period.
        count: u32,
        /// Whether they follow each other at one instant: nothing moves on from there.
        at_once: bool,
    },
    /// A state grew beyond all numbers or became NaN; the last good state is in [`End::point`].
    #[error("state {state} is not finite after t = {time}")]
    NotFinite {
        /// Time of the last good state.
        time: f64,
        /// First state that is not finite.
        state: usize,
    },
    /// A quotient, root, power or function is asked for where it is not defined, or too near to that for a series.
    #[error("{operation} {argument:e} at t = {time}: the motion leaves the domain of the system")]
    OutOfDomain {
        /// Time of the last good state.
        time: f64,
        /// The operation, such as "the logarithm of".
        operation: &'static str,
        /// The number that it was to be of.
        argument: f64,
    },
    /// More steps in one period than allowed: it might never end.
    #[error(
        "{count} steps within one period by t = {time}: loosen the tolerance or look for a singularity"
    )]
    TooManySteps {
        /// Time since the start of the run.
        time: f64,
        /// Steps in this period.
        count: u32,
    },
}

fn chattering(time: f64, count: u32, at_once: bool) -> String {
    if at_once {
        format!(
            "{count} switches at one instant, t = {time}, and nothing moves on: either a guard is beyond zero \
             after its own switch (let the switch move it back, or enter a mode with another guard), or the \
             motion stays where it switches (rest, sticking, sliding), which needs a mode of its own"
        )
    } else {
        format!("{count} switches within one period by t = {time}: chattering; see max_switches")
    }
}

impl Status {
    /// The word for it in tables.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Completed => "completed",
            Self::Chattering { .. } => "chattering",
            Self::NotFinite { .. } => "not-finite",
            Self::OutOfDomain { .. } => "out-of-domain",
            Self::TooManySteps { .. } => "too-many-steps",
        }
    }
}

/// The end of one segment, with the work done.
#[derive(Clone, Debug, PartialEq)]
pub struct End {
    /// Completed, or the reason why not.
    pub status: Status,
    /// Last state.
    pub point: Point,
    /// Periods completed.
    pub periods: u64,
    /// Steps taken.
    pub steps: u64,
    /// Switches made.
    pub switches: u64,
    /// Tangencies met.
    pub tangencies: u64,
}

/// The work of one lane: a segment, or a chain of segments each of which may start where the last ended.
pub trait Task: Send {
    /// The first segment; `None` if there is nothing to do.
    fn begin(&mut self) -> Option<Segment>;
    /// Called at each sample, as at the end of each period; return `false` to end the segment here.
    fn sample(&mut self, sample: &Sample<'_>) -> bool;
    /// Called after [`Self::sample`] with the tangent columns, one after the other, if the system has
    /// any; they may be changed, such as to be kept apart from each other.
    fn tangents(&mut self, columns: &mut [f64]) {
        let _ = columns;
    }
    /// Called at each switch and tangency, in time order.
    fn switch(&mut self, switch: &Switch<'_>) {
        let _ = switch;
    }
    /// Whether [`Self::step`] is to be called.
    fn wants_steps(&self) -> bool {
        false
    }
    /// Called for each accepted step.
    fn step(&mut self, step: &Step<'_>) {
        let _ = step;
    }
    /// Called at the end of a segment; the next segment if there is one. All segments of a run share one structure.
    fn end(&mut self, end: End) -> Option<Segment>;
}

/// Reason why a run did not begin, or did not finish. The fate of a trajectory is a [`Status`] instead.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum IntegrateError {
    /// An option outside its range.
    #[error("{option} = {value}: {expected}")]
    Option {
        /// Its name.
        option: &'static str,
        /// The value given.
        value: f64,
        /// Numbers that are possible.
        expected: &'static str,
    },
    /// A segment whose system has another program than those it would share lanes with.
    #[error("the systems of one run must have the same structure; only their numbers may differ")]
    Structure,
    /// A start of the wrong length.
    #[error("the start has {got} states and the system {expected}")]
    Start {
        /// Length given.
        got: usize,
        /// Length needed.
        expected: usize,
    },
    /// The stop flag was raised.
    #[error("interrupted")]
    Interrupted,
}

impl Options {
    pub(crate) fn check(&self) -> Result<(), IntegrateError> {
        let fail = |option, value, expected| {
            Err(IntegrateError::Option {
                option,
                value,
                expected,
            })
        };
        match self.method {
            Method::Taylor { tolerance, .. } if !(1e-16..=1e-2).contains(&tolerance) => fail(
                "tolerance",
                tolerance,
                "a number from 1e-16 to 1e-2 is needed",
            ),
            Method::Taylor { order, .. } if !(4..=MAX_DEGREE).contains(&order) => fail(
                "order",
                order as f64,
                "a whole number from 4 to 30 is needed",
            ),
            Method::Rk4 {
                steps_per_period: 0,
            } => fail("steps_per_period", 0.0, "at least one step is needed"),
            _ if self.samples_per_period == 0 => {
                fail("samples_per_period", 0.0, "at least one is needed")
            }
            _ if self.max_switches == 0 => fail("max_switches", 0.0, "at least one is needed"),
            _ if self.max_steps == 0 => fail("max_steps", 0.0, "at least one is needed"),
            _ => Ok(()),
        }
    }
}

/// `Err` if the stop flag is up.
pub(crate) fn check_stop(stop: &AtomicBool) -> Result<(), IntegrateError> {
    if stop.load(Ordering::Relaxed) {
        Err(IntegrateError::Interrupted)
    } else {
        Ok(())
    }
}
