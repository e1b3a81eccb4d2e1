//! Input from Python: the definition of a system, and the settings of the integration.

use pyo3::prelude::*;
use saltus_hybrid::{Instructions, Method, Options};

use super::blueprint::{Clock, Leave};
use super::formula::Op;
use crate::error::of_definition;

/// Modes and units are numbers of one byte each.
const MAX_MODES: usize = 256;
const MAX_UNITS: usize = 256;

/// A system as formulas; every `usize` is the place of an operation.
pub(crate) struct Definition {
    pub(crate) ops: Vec<Op>,
    /// Number of parameters.
    pub(crate) parameters: usize,
    pub(crate) rates: Vec<usize>,
    /// The scale of each state, where one is given.
    pub(crate) scales: Vec<Option<usize>>,
    pub(crate) clock: Clock<usize>,
    pub(crate) units: Vec<Vec<Vec<Leave<usize>>>>,
    /// Units that follow the sign of the guard of their first mode.
    pub(crate) signs: Vec<usize>,
}

/// Fault of lists that are no definition: they were not made by this version of saltus, or were altered.
#[derive(Clone, Debug, thiserror::Error)]
#[error("no system: {what} {index} is named, and there are {count} at that point")]
pub(crate) struct Astray {
    what: &'static str,
    index: usize,
    count: usize,
}

/// Whether `index` is one of `count`.
fn within(what: &'static str, index: usize, count: usize) -> Result<(), Astray> {
    match index < count {
        true => Ok(()),
        false => Err(Astray { what, index, count }),
    }
}

impl Definition {
    /// Whether everything that is named is there, operations only after those that they read.
    pub(crate) fn check(&self) -> Result<(), Astray> {
        within("state", 0, self.rates.len())?;
        within("scale", self.scales.len(), self.rates.len() + 1)?;
        for (place, op) in self.ops.iter().enumerate() {
            op.reads()
                .into_iter()
                .try_for_each(|at| within("operation", at, place))?;
            self.check_name(op)?;
        }
        for at in self.named() {
            within("operation", at, self.ops.len())?;
        }
        for modes in &self.units {
            within("mode", 0, modes.len())?;
            within("mode", modes.len() - 1, MAX_MODES)?;
            for leave in modes.iter().flatten() {
                within("mode", leave.to, modes.len())?;
                let mut resets = leave.resets.iter();
                resets.try_for_each(|&(state, _)| within("state", state, self.rates.len()))?;
            }
        }
        for &unit in &self.signs {
            within("unit", unit, self.units.len())?;
            within("mode", 1, self.units[unit].len())?;
        }
        within("unit", self.units.len().saturating_sub(1), MAX_UNITS)
    }

    /// Whether an operation stands for something that is there.
    fn check_name(&self, op: &Op) -> Result<(), Astray> {
        let forcings = usize::from(matches!(self.clock, Clock::Forcing(_)));
        match op {
            Op::Parameter(index) => within("parameter", *index, self.parameters),
            Op::State(index) => within("state", *index, self.rates.len()),
            Op::Cos | Op::Sin => within("forcing", 0, forcings),
            Op::Choice { unit, by_mode } => {
                within("unit", *unit, self.units.len())?;
                let modes = self.units[*unit].len();
                within(
                    "mode",
                    by_mode.len().max(modes) - 1,
                    by_mode.len().min(modes),
                )
            }
            Op::Number(_) | Op::Unary(..) | Op::Binary(..) => Ok(()),
        }
    }

    /// The operations that stand for something of the system.
    fn named(&self) -> Vec<usize> {
        let (Clock::Forcing(at) | Clock::Interval(at)) = self.clock;
        let mut named = [self.rates.clone(), vec![at]].concat();
        named.extend(self.scales.iter().flatten());
        for leave in self.units.iter().flatten().flatten() {
            named.push(leave.guard);
            named.extend(leave.resets.iter().map(|&(_, at)| at));
            named.extend(leave.vanishing.iter().map(|&(at, _)| at));
        }
        named
    }

    /// Number of times that each operation is read.
    pub(crate) fn uses(&self) -> Vec<usize> {
        let mut uses = vec![0; self.ops.len()];
        let read = self.ops.iter().flat_map(Op::reads).chain(self.named());
        read.for_each(|at| uses[at] += 1);
        uses
    }
}

impl<'a, 'py> FromPyObject<'a, 'py> for Leave<usize> {
    type Error = PyErr;

    /// From (guard, sign, mode that follows, resets, guards that vanish).
    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let (guard, sign, to, resets, vanishing) = object.extract()?;
        if ![1.0, -1.0].contains(&sign) {
            return Err(of_definition(format!(
                "a transition of the sign {sign}: 1 or -1 is needed"
            )));
        }
        Ok(Self {
            guard,
            sign,
            to,
            resets,
            vanishing,
        })
    }
}

/// `saltus.systems.Taylor` or `saltus.systems.RungeKutta4`.
#[derive(FromPyObject)]
enum Stepper {
    Taylor {
        tolerance: f64,
        order: Option<usize>,
        instructions: String,
    },
    RungeKutta4 {
        steps_per_period: u32,
    },
}

/// `saltus.systems.Options`.
#[derive(FromPyObject)]
pub(crate) struct Settings {
    method: Stepper,
    max_switches: u32,
    max_steps: u32,
    pub(crate) threads: usize,
}

impl Settings {
    pub(crate) fn options(&self) -> Options {
        let mut options = Options {
            max_switches: self.max_switches,
            max_steps: self.max_steps,
            ..Options::default()
        };
        match &self.method {
            Stepper::Taylor {
                tolerance,
                order,
                instructions,
            } => {
                options.method = match *order {
                    Some(order) => Method::Taylor {
                        tolerance: *tolerance,
                        order,
                    },
                    None => Method::taylor(*tolerance),
                };
                options.instructions = match instructions.as_str() {
                    "avx2" => Instructions::Avx2,
                    "baseline" => Instructions::Baseline,
                    _ => Instructions::Best,
                };
            }
            &Stepper::RungeKutta4 { steps_per_period } => {
                options.method = Method::Rk4 { steps_per_period };
            }
        }
        options
    }
}
