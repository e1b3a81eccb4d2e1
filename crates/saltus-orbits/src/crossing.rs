//! Branch points: orbits at which two branches cross.

use crate::continuation::Point;
use crate::locate::ROUNDS;
use crate::path::Path;
use crate::shooting::Guess;
use crate::{Orbit, ParametricMap, Special, SpecialKind, linear};

/// A branch point is interpolated from points at this distance and twice that on both sides, relative to the
/// largest coordinate or 1. Nearer to it orbits cannot be trusted: a residual of 1e-11 is the product of the
/// distances to both branches. Farther, interpolation by cubics is off by more than 1e-10.
const ASIDE: f64 = 1e-3;

impl<F: ParametricMap + ?Sized> Path<'_, F> {
    /// The branch point between two points: where the cubic through four determinants is zero, on the cubics
    /// through the four orbits. None if the two are too far from each other for that.
    pub(crate) fn crossing(&self, a: &Point, b: &Point, near: usize) -> Option<Special> {
        let length = self.distance(a, b);
        let aside = ASIDE * linear::size(&self.coordinates(&a.orbit)).max(1.0);
        if length > 4.0 * aside {
            return None;
        }
        let middle = length * a.branch_test / (a.branch_test - b.branch_test);
        let at = [-2.0, -1.0, 1.0, 2.0].map(|times| middle + times * aside);
        let mut points = Vec::new();
        for at in at {
            points.push(self.between(a, b, at / length).ok()?);
        }
        let cubic = |value: &dyn Fn(&Point) -> f64, s: f64| -> f64 {
            let weight = |i: usize| {
                let others = (0..4).filter(|&j| j != i);
                others
                    .map(|j| (s - at[j]) / (at[i] - at[j]))
                    .product::<f64>()
            };
            (0..4).map(|i| weight(i) * value(&points[i])).sum()
        };
        let (mut low, mut high) = (at[0], at[3]);
        let falling = points[0].branch_test > 0.0;
        for _ in 0..ROUNDS {
            let s = f64::midpoint(low, high);
            if (cubic(&|point| point.branch_test, s) > 0.0) == falling {
                low = s;
            } else {
                high = s;
            }
        }
        let mut guess: Guess = points[0].orbit.guess();
        for (i, place) in guess.places.iter_mut().enumerate() {
            for (j, x) in place.x.iter_mut().enumerate() {
                *x = cubic(&|point| point.orbit.places[i].x[j], low);
            }
        }
        let parameter = cubic(&|point| point.parameter, low);
        guess.parameters[self.free[0].index] = parameter;
        let orbit = Orbit::of(
            &self.shooting().pass(&guess).ok()?,
            self.options.newton.tolerance,
        )
        .ok()?;
        Some(Special {
            label: String::new(),
            kind: SpecialKind::BranchPoint,
            parameter,
            orbit,
            near,
            outside: [a.outside, b.outside],
            remark: None,
            tangent: linear::unit(&self.apart(&points[1], &points[2])),
        })
    }
}
