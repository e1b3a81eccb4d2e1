//! Values of all nodes of a system at a point, and their derivatives along a direction.

use crate::function;
use crate::program::Mode;
use crate::series::{self, Series};
use crate::structure::Op;
use crate::system::System;

/// Values of all nodes at a point. Keeps its buffers.
#[derive(Clone, Debug)]
pub struct Evaluator {
    system: System,
    modes: Vec<Mode>,
    coefficients: Vec<f64>,
    series: Series<f64>,
}

impl Evaluator {
    /// An evaluator for this system.
    pub fn new(system: &System) -> Self {
        let modes = vec![0; system.unit_count()];
        Self {
            coefficients: system.stream(&modes),
            modes,
            series: Series::new(&system.structure, 1),
            system: system.clone(),
        }
    }

    /// Every node at (modes, x), states first; see [`System::index`].
    pub fn nodes(&mut self, modes: &[Mode], x: &[f64]) -> &[f64] {
        if self.modes != modes {
            self.modes.copy_from_slice(modes);
            self.coefficients = self.system.stream(modes);
        }
        let structure = &self.system.structure;
        for (i, &value) in x[..structure.states].iter().enumerate() {
            *self.series.value(structure.state_slots[i]) = value;
        }
        series::values(structure, &self.coefficients, &mut self.series);
        self.series.now()
    }

    /// The operation that is not defined at (modes, x), or is the first to be so within the time `reach` from there, and
    /// the number that it is asked of.
    pub(crate) fn out_of_domain(
        &mut self,
        modes: &[Mode],
        x: &[f64],
        reach: f64,
    ) -> Option<(&'static str, f64)> {
        let nodes = self.nodes(modes, x).to_vec();
        let rates = self.system.structure.derivative.iter();
        let flow: Vec<f64> = rates.map(|&rate| nodes[rate]).collect();
        self.along(&flow);
        let series = &self.series;
        let steps = self.system.structure.program.iter();
        let left = steps.filter_map(|step| {
            let at = |slot: usize| *series.at(slot, 0);
            let (active, slot, (room, operation)) = match step.op {
                Op::Quotient {
                    divisor, active, ..
                } => (active, divisor, (at(divisor).abs(), "a division by")),
                Op::Power {
                    base,
                    exponent,
                    active,
                    ..
                } => {
                    let room = function::room_of_base(at(base), self.coefficients[exponent]);
                    (active, base, (room, "a root or power of"))
                }
                Op::Function {
                    function,
                    of,
                    active,
                    ..
                } => (active, of, function.room(at(of))?),
                _ => return None,
            };
            // Time until there is no room; a rate that is no number says nothing.
            let time = match series.at(slot, 1).abs() {
                _ if room <= 0.0 => 0.0,
                rate if rate > 0.0 => room / rate,
                _ => f64::INFINITY,
            };
            let counts = self.coefficients[active] != 0.0 && time <= reach;
            counts.then_some((time, operation, at(slot)))
        });
        let first = left.min_by(|a, b| a.0.total_cmp(&b.0));
        first.map(|(_, operation, argument)| (operation, argument))
    }

    /// Derivative of every node while the states change at the rates `dx`, at the point that
    /// [`Self::nodes`] was called for last. Nodes that follow adiabatically change as they do in time.
    pub fn along(&mut self, dx: &[f64]) -> &[f64] {
        let structure = &self.system.structure;
        series::along(structure, &self.coefficients, dx, &mut self.series);
        self.series.now()
    }
}
