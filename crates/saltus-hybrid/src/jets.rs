//! Guards at a point: Taylor coefficients along the solution, beside bounds on their rounding.
//!
//! The polynomial of a step shows where a guard vanishes within it. It does not show whether a value of
//! 1e-17 at its start is zero: that depends on the size of the terms the value is a difference of. The
//! same program with the absolute values of all its numbers bounds these terms, in every order
//! (a running error analysis; Higham, Accuracy and Stability of Numerical Algorithms (2002), section 3.3).

use crate::arith::{Bounded, Bounds};
use crate::program::Mode;
use crate::series::{Series, expand};
use crate::system::System;

/// A coefficient is zero if it is below this part of the terms it is made of: some thousand units of
/// rounding, for what accumulates on the way to the point.
const ZERO: f64 = 1e-12;

/// A state near zero has rounding of its own size along the way, by this part of [`ZERO`].
const MEMORY: f64 = 1e-3;

/// Highest multiplicity of a zero that is noticed.
const ORDER: usize = 8;

/// A guard just after a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Side {
    /// Coefficients that are zero before the first that is not.
    pub(crate) zeros: u8,
    /// Sign of that one; 0 if there is none.
    pub(crate) sign: f64,
    /// Sign of the next one that is not zero: where a guard that is not zero goes.
    pub(crate) trend: f64,
    /// Whether the guard is as close to zero as the error of the solution.
    pub(crate) close: bool,
}

impl Side {
    /// The side as seen by a mode that lasts while `sign` times the guard is positive.
    pub(crate) fn seen(self, sign: f64) -> Self {
        Self {
            sign: self.sign * sign,
            trend: self.trend * sign,
            ..self
        }
    }

    /// Whether the guard ends its mode: it falls from zero, or lies beyond.
    pub(crate) fn ends(self) -> bool {
        self.sign < 0.0
    }

    /// Whether a guard beyond zero stays there or comes back.
    pub(crate) fn may_be_held(self) -> bool {
        self.zeros == 0 && self.sign < 0.0 && self.trend >= 0.0
    }
}

/// Evaluates guards of a system at points.
pub(crate) struct Jets {
    system: System,
    modes: Option<Vec<Mode>>,
    stream: Vec<Bounded>,
    series: Series<Bounded>,
}

impl Jets {
    /// Jets of the guards of a system without tangents.
    pub(crate) fn new(system: &System) -> Self {
        Self {
            system: system.clone(),
            modes: None,
            stream: Vec::new(),
            series: Series::new(&system.structure, ORDER),
        }
    }

    /// Sides of all guards at the state `x`, whose components have been as large as `sizes` on the way.
    /// `known` are coefficients of each guard that are zero by construction; `close` is the error of the
    /// solution, relative to the terms of a guard.
    pub(crate) fn sides(
        &mut self,
        modes: &[Mode],
        x: &[f64],
        sizes: &[f64],
        known: &[u8],
        close: f64,
    ) -> Vec<Side> {
        if self.modes.as_deref() != Some(modes) {
            self.modes = Some(modes.to_vec());
            let stream = self.system.stream(modes);
            self.stream = stream.into_iter().map(Bounded::new).collect();
        }
        let structure = &self.system.structure;
        for (i, &slot) in structure.state_slots.iter().enumerate() {
            let size = sizes.get(i).copied().unwrap_or(0.0);
            *self.series.value(slot) = Bounded {
                value: x[i],
                bound: x[i].abs() + MEMORY * size,
            };
        }
        expand(Bounds, structure, None, &self.stream, &mut self.series);
        let guards = structure.guard_slots.iter().zip(known);
        guards
            .map(|(&slot, &known)| self.side(slot, known.into(), close))
            .collect()
    }

    fn side(&self, slot: usize, known: usize, close: f64) -> Side {
        let mut signs = [0.0; ORDER + 1];
        for (sign, term) in signs.iter_mut().zip(self.series.of(slot)).skip(known) {
            let Bounded { value, bound } = *term;
            // A bound beyond all numbers says nothing.
            let zero = bound.is_finite() && value.abs() <= ZERO * bound;
            *sign = if zero || value == 0.0 {
                0.0
            } else {
                value.signum()
            };
        }
        let nonzero = |from: usize| (from..=ORDER).find(|&k| signs[k] != 0.0);
        let zeros = nonzero(0).unwrap_or(ORDER + 1);
        let next = nonzero(zeros + 1);
        let now = self.series.at(slot, 0);
        Side {
            zeros: zeros as u8,
            sign: signs.get(zeros).copied().unwrap_or(0.0),
            trend: next.map_or(0.0, |k| signs[k]),
            close: now.value.abs() <= close * now.bound,
        }
    }
}
