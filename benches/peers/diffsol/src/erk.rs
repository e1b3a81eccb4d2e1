//! dopri5 and dop853 of the crate `differential-equations`, switches by bisection on their dense output.

use std::f64::consts::TAU;

use differential_equations::interpolate::Interpolation;
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use differential_equations::status::Status;

use crate::Program;
use crate::problem::Field;

/// Halvings of the bracket, from a step of at most 1 down to rounding.
const HALVINGS: usize = 50;

struct Phase<'a, const P: usize, const S: usize> {
    field: &'a Field<P, S>,
    floor: bool,
}

impl<const P: usize, const S: usize> ODE<f64, [f64; S]> for Phase<'_, P, S> {
    fn diff(&self, t: f64, x: &[f64; S], dx: &mut [f64; S]) {
        let (sin, cos) = t.sin_cos();
        self.field.rates(self.floor, x, cos, sin, dx);
    }
}

pub struct Erk<const P: usize, const S: usize, M> {
    field: Field<P, S>,
    method: M,
    periods: u32,
    t: f64,
    x: [f64; S],
    floor: bool,
    /// Step to try first after a switch.
    step: f64,
}

impl<const P: usize, const S: usize, M> Erk<P, S, M>
where
    M: OrdinaryNumericalMethod<f64, [f64; S]> + Interpolation<f64, [f64; S]>,
{
    pub fn new(field: Field<P, S>, method: M) -> Self {
        let (x, floor) = field.start();
        Self {
            field,
            method,
            periods: 0,
            t: 0.0,
            x,
            floor,
            step: 1e-3,
        }
    }

    fn guard(&self, t: f64, x: &[f64; S]) -> f64 {
        let (sin, cos) = t.sin_cos();
        self.field.force(x, cos, sin)
    }

    /// Integrates one phase, up to `end` or the switch that ends it.
    fn phase(&mut self, end: f64) {
        let field = self.field.clone();
        let phase = Phase {
            field: &field,
            floor: self.floor,
        };
        // `init` wants room for its own first step; the steps below end on `end`.
        self.method
            .init(&phase, self.t, end + 1.0, &self.x)
            .expect("a start");
        self.method.set_h(self.step.min(end - self.t));
        loop {
            let tried = self.method.h();
            self.method.step(&phase).expect("a step");
            if matches!(self.method.status(), Status::RejectedStep) {
                continue;
            }
            let (t, x) = (self.method.t(), *self.method.y());
            if (self.guard(t, &x) > 0.0) != self.floor {
                self.step = tried;
                return self.switch(&phase, t);
            }
            let left = end - t;
            if left < 1e-13 * end {
                (self.t, self.x) = (end, x);
                self.step = self.step.max(tried);
                return;
            }
            self.step = self.method.h();
            if self.step > left {
                self.method.set_h(left);
            }
        }
    }

    /// Goes back to the switch within the last step, which ended at `high`.
    fn switch(&mut self, phase: &Phase<'_, P, S>, mut high: f64) {
        let mut low = self.method.t_prev();
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let x = self
                .method
                .interpolate(middle)
                .expect("a time within the step");
            if (self.guard(middle, &x) > 0.0) == self.floor {
                low = middle;
            } else {
                high = middle;
            }
            if high - low < 1e-12 {
                break;
            }
        }
        // One step of the method itself: its dense output is less accurate.
        let (low, x) = (self.method.t_prev(), *self.method.y_prev());
        self.method
            .init(phase, low, high + 1.0, &x)
            .expect("a start");
        self.method.set_h(high - low);
        self.method.step(phase).expect("a step");
        self.x = *self.method.y();
        self.t = high;
        self.floor = !self.floor;
    }
}

impl<const P: usize, const S: usize, M> Program for Erk<P, S, M>
where
    M: OrdinaryNumericalMethod<f64, [f64; S]> + Interpolation<f64, [f64; S]>,
{
    fn advance(&mut self, periods: u32) {
        self.periods += periods;
        let end = f64::from(self.periods) * TAU;
        while self.t < end {
            self.phase(end);
        }
    }

    fn state(&self) -> &[f64] {
        &self.x
    }
}
