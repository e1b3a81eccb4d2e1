//! Quantities that a map keeps. Orbits lie in families then, one for each value, and a start means one of them.
//!
//! The gradient g of a kept quantity obeys g(P(x)) DP(x) = g(x). For quadratic quantities, such as the square of a
//! length, g = a + B x, and these equations along some iterates of the start are linear in a and B.

use crate::linear::{self, dot, minus, norm, plus, scaled, size, times, whole_norm};
use crate::{MapPoint, MapRequest, Matrix, ParametricMap};

/// A vector solves the equations if no more than this part of them is left: derivatives have errors of some 1e-12.
const SOLVED: f64 = 1e-9;

/// A value that is nearer than this, relative to its terms, is the same.
const HELD: f64 = 1e-8;

/// States for which quadratic quantities are looked for: the work grows as the fifth power of their number.
const STATES: usize = 16;

/// a x + x B x / 2 and its value.
#[derive(Clone, Debug)]
pub(crate) struct Kept {
    a: Vec<f64>,
    b: Matrix,
    value: f64,
}

impl Kept {
    /// The quantity with its value at `x`.
    fn at(a: Vec<f64>, b: Matrix, x: &[f64]) -> Self {
        let kept = Self { a, b, value: 0.0 };
        Self {
            value: -kept.missing(x),
            ..kept
        }
    }

    /// A linear one.
    pub(crate) fn linear(a: Vec<f64>, x: &[f64]) -> Self {
        let n = a.len();
        Self::at(a, Matrix::zeros(n, n), x)
    }

    /// Its gradient at `x`.
    pub(crate) fn slope(&self, x: &[f64]) -> Vec<f64> {
        plus(&self.a, 1.0, &times(&self.b, x))
    }

    /// Whether its value is that at `x`, to rounding and the errors of an orbit.
    pub(crate) fn holds(&self, x: &[f64]) -> bool {
        let scale = (norm(&self.a) + norm(&times(&self.b, x))) * norm(x);
        self.missing(x).abs() <= HELD * scale.max(self.value.abs())
    }

    /// Its value less that at `x`.
    pub(crate) fn missing(&self, x: &[f64]) -> f64 {
        self.value - dot(&self.a, x) - 0.5 * dot(x, &times(&self.b, x))
    }
}

/// The quadratic quantities that a map keeps along the way from `start`, with their values there.
pub(crate) fn kept<F: ParametricMap + ?Sized>(
    family: &F,
    parameters: &[f64],
    start: &MapPoint,
) -> Option<Vec<Kept>> {
    let n = start.x.len();
    if n > STATES {
        return None;
    }
    let pairs: Vec<(usize, usize)> = (0..n).flat_map(|i| (i..n).map(move |j| (i, j))).collect();
    let unknown = n + pairs.len();
    let (mut rows, mut place, mut unit) = (Vec::new(), start.clone(), 0.0);
    while rows.len() < unknown + 2 * n {
        let shot = MapRequest {
            parameters,
            start: &place,
            derivative: true,
        };
        let image = family.images(&[shot]).pop()?.ok()?;
        let (d, next) = (image.derivative?, image.place);
        if unit == 0.0 {
            unit = size(&place.x).max(size(&next.x));
        }
        let [x, y] = [&place.x, &next.x].map(|x| scaled(x, 1.0 / unit));
        let same = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
        for j in 0..n {
            let linear = (0..n).map(|i| d[(i, j)] - same(i, j));
            let quadratic = pairs.iter().map(|&(i, k)| {
                let one = |i: usize, k: usize| y[k] * d[(i, j)] - x[k] * same(i, j);
                one(i, k) + if i == k { 0.0 } else { one(k, i) }
            });
            rows.push(linear.chain(quadratic).collect::<Vec<f64>>());
        }
        // at a fixed point the equations are always the same
        if size(&minus(&x, &y)) == 0.0 {
            return None;
        }
        place = next;
    }
    let equations = Matrix::from_fn(rows.len(), unknown, |row, col| rows[row][col]);
    let most = SOLVED * whole_norm(&equations);
    let solves = |u: &Vec<f64>| norm(&times(&equations, u)) <= most;
    let solutions = linear::null_space(&equations, unknown)?;
    let quantity = |u: Vec<f64>| {
        let entry = |i: usize, j: usize| pairs.iter().position(|&p| p == (i.min(j), i.max(j)));
        let b = |i, j| entry(i, j).map_or(0.0, |at| u[n + at] / unit);
        Kept::at(u[..n].to_vec(), Matrix::from_fn(n, n, b), &start.x)
    };
    Some(solutions.into_iter().filter(solves).map(quantity).collect())
}
