//! Classical RK4 on a fixed grid, as a careful C programmer writes it.
//!
//! Sine and cosine of the drive at the grid come from a table. A switch shows as the wrong sign of F at
//! the end of a step; bisection on the cubic through F and F' at both ends says where it was, the step
//! is redone up to there and the rest of it done in the other phase. The field is continuous, so an
//! error d of that time costs O(d^2). Two switches within one step are not seen.

use std::f64::consts::TAU;

use crate::Program;
use crate::problem::Field;

/// Halvings of the bracket.
const HALVINGS: usize = 40;
/// Parts of one step between which the body switches, at most.
const PARTS: usize = 8;

/// cos and sin at the start, the middle and the end of a step.
type Drive = [(f64, f64); 3];

pub struct Rk4<const P: usize, const S: usize> {
    field: Field<P, S>,
    steps: usize,
    /// cos and sin at half steps through one period.
    drive: Vec<(f64, f64)>,
    x: [f64; S],
    floor: bool,
}

fn cos_sin(t: f64) -> (f64, f64) {
    let (sin, cos) = t.sin_cos();
    (cos, sin)
}

impl<const P: usize, const S: usize> Rk4<P, S> {
    /// With so many steps in one period of the body on rigid ground, and so the same step in seconds at
    /// any drive frequency.
    pub fn new(field: Field<P, S>, steps: f64) -> Self {
        let steps = (steps * field.body_frequency()).round() as usize;
        let half = TAU / (2 * steps) as f64;
        let (x, floor) = field.start();
        Self {
            field,
            steps,
            drive: (0..=2 * steps).map(|i| cos_sin(i as f64 * half)).collect(),
            x,
            floor,
        }
    }

    #[inline(always)]
    fn step(&self, x: &[f64; S], drive: Drive, h: f64) -> [f64; S] {
        let field = |x: &[f64; S], (cos, sin): (f64, f64)| {
            let mut k = [0.0; S];
            self.field.rates(self.floor, x, cos, sin, &mut k);
            k
        };
        let along =
            |k: &[f64; S], h: f64| -> [f64; S] { std::array::from_fn(|i| k[i].mul_add(h, x[i])) };
        let k1 = field(x, drive[0]);
        let k2 = field(&along(&k1, 0.5 * h), drive[1]);
        let k3 = field(&along(&k2, 0.5 * h), drive[1]);
        let k4 = field(&along(&k3, h), drive[2]);
        std::array::from_fn(|i| {
            let sum = k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i];
            sum.mul_add(h / 6.0, x[i])
        })
    }

    /// F and h F' at a point.
    fn guard(&self, x: &[f64; S], (cos, sin): (f64, f64), h: f64) -> (f64, f64) {
        let mut dx = [0.0; S];
        self.field.rates(self.floor, x, cos, sin, &mut dx);
        let rate = self.field.force_rate(&dx, cos, sin);
        (self.field.force(x, cos, sin), h * rate)
    }

    /// Where in 0..1 the cubic of F changes sign.
    fn locate(&self, (f0, d0): (f64, f64), (f1, d1): (f64, f64)) -> f64 {
        let cubic = |s: f64| {
            let curve = 3.0 * (f1 - f0) - 2.0 * d0 - d1;
            let twist = d0 + d1 - 2.0 * (f1 - f0);
            f0 + s * (d0 + s * (curve + s * twist))
        };
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if (cubic(middle) > 0.0) == self.floor {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }

    /// The rest of a step that ends in the wrong phase, in parts.
    #[cold]
    fn switch(&mut self, mut t: f64, mut h: f64, mut end: [f64; S]) {
        for _ in 0..PARTS {
            let (start, stop) = (cos_sin(t), cos_sin(t + h));
            let part = h * self.locate(self.guard(&self.x, start, h), self.guard(&end, stop, h));
            let drive = [start, cos_sin(t + 0.5 * part), cos_sin(t + part)];
            self.x = self.step(&self.x, drive, part);
            self.floor = !self.floor;
            (t, h) = (t + part, h - part);
            end = self.step(&self.x, [drive[2], cos_sin(t + 0.5 * h), stop], h);
            if (self.field.force(&end, stop.0, stop.1) > 0.0) == self.floor {
                break;
            }
        }
        self.x = end;
    }

    fn period(&mut self) {
        let h = TAU / self.steps as f64;
        for i in 0..self.steps {
            let drive = [
                self.drive[2 * i],
                self.drive[2 * i + 1],
                self.drive[2 * i + 2],
            ];
            let end = self.step(&self.x, drive, h);
            if (self.field.force(&end, drive[2].0, drive[2].1) > 0.0) == self.floor {
                self.x = end;
            } else {
                self.switch(i as f64 * h, h, end);
            }
        }
    }
}

impl<const P: usize, const S: usize> Program for Rk4<P, S> {
    fn advance(&mut self, periods: u32) {
        for _ in 0..periods {
            self.period();
        }
    }

    fn state(&self) -> &[f64] {
        &self.x
    }
}
