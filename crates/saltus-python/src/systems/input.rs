//! What Python hands over: the definition of a system, and how it is to be integrated.

use pyo3::prelude::*;
use saltus_hybrid::{Instructions, Method, Options};

use super::blueprint::{Clock, Leave};
use super::formula::Op;

/// A system as formulas; every `usize` is the place of an operation.
pub(crate) struct Definition {
    pub(crate) ops: Vec<Op>,
    pub(crate) rates: Vec<usize>,
    pub(crate) clock: Clock<usize>,
    pub(crate) units: Vec<Vec<Vec<Leave<usize>>>>,
}

impl Definition {
    /// How often each operation is read.
    pub(crate) fn uses(&self) -> Vec<usize> {
        let mut uses = vec![0; self.ops.len()];
        let mut read = |at: usize| uses[at] += 1;
        self.ops.iter().flat_map(Op::reads).for_each(&mut read);
        self.rates.iter().copied().for_each(&mut read);
        let (Clock::Forcing(at) | Clock::Interval(at)) = self.clock;
        read(at);
        for leave in self.units.iter().flatten().flatten() {
            read(leave.guard);
            leave.resets.iter().for_each(|&(_, at)| read(at));
            leave.vanishing.iter().for_each(|&(at, _)| read(at));
        }
        uses
    }
}

impl<'a, 'py> FromPyObject<'a, 'py> for Leave<usize> {
    type Error = PyErr;

    /// From (guard, sign, mode that follows, resets, guards that vanish).
    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let (guard, sign, to, resets, vanishing) = object.extract()?;
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
