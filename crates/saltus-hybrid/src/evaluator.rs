//! Values of all nodes of a system at a point, and their derivatives along a direction.

use crate::program::Mode;
use crate::series::{self, Series};
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

    /// Derivative of every node while the states change at the rates `dx`, at the point that
    /// [`Self::nodes`] was called for last. Nodes that follow adiabatically change as they do in time.
    pub fn along(&mut self, dx: &[f64]) -> &[f64] {
        let structure = &self.system.structure;
        series::along(structure, &self.coefficients, dx, &mut self.series);
        self.series.now()
    }
}
