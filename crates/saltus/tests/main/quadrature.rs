//! The Gauss-Legendre rule, for comparison with integrals in closed form.
//!
//! Twenty lines instead of a crate: those that have the rule bring a library of linear algebra with them, which was the
//! slowest build of the tests.

use std::f64::consts::PI;

/// Nodes in (-1, 1) and their weights.
pub(crate) struct GaussLegendre(Vec<(f64, f64)>);

impl GaussLegendre {
    /// The rule of `count` nodes: Newton's method from the asymptotic zeros of the Legendre polynomial (NIST DLMF
    /// 18.16.14 to first order), whose slope gives the weight (DLMF 3.5.19).
    pub(crate) fn new(count: u32) -> Self {
        let n = f64::from(count);
        // P_n and its slope at x, by the recurrence in n
        let legendre = |x: f64| {
            let (mut before, mut value) = (1.0, x);
            for k in 1..count {
                let k = f64::from(k);
                (before, value) = (
                    value,
                    ((2.0 * k + 1.0) * x * value - k * before) / (k + 1.0),
                );
            }
            (value, n * (x * value - before) / (x * x - 1.0))
        };
        let node = |index: u32| {
            let mut x = (PI * (f64::from(index) + 0.75) / (n + 0.5)).cos();
            for _ in 0..8 {
                let (value, slope) = legendre(x);
                x -= value / slope;
            }
            let slope = legendre(x).1;
            (x, 2.0 / ((1.0 - x * x) * slope * slope))
        };
        Self((0..count).map(node).collect())
    }

    /// Nodes in (-1, 1) and their weights.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &(f64, f64)> {
        self.0.iter()
    }

    /// The integral of `f` over (`from`, `to`).
    pub(crate) fn integrate(&self, from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        self.iter()
            .map(|(node, weight)| weight * half * f(middle + half * node))
            .sum()
    }
}
