//! The curve that a branch is: points on it, tangents, chords.

use crate::continuation::{ContinuationError, ContinuationOptions, ParameterRange, Point};
use crate::differences::Free;
use crate::linear::{self, minus, norm, unit};
use crate::orbit::check;
use crate::shooting::{Change, Guess, Pass, Shooting};
use crate::{Matrix, NotFound, Orbit, ParametricMap};

/// Two branches cross where the equations lose a rank to within this. Derivatives by differences have errors of
/// 1e-11, which turn the tangent by up to 1e-6 where the rest is larger.
const CROSSING: f64 = 1e-5;

/// Everything a branch is followed with.
pub(crate) struct Path<'a, F: ?Sized> {
    pub(crate) family: &'a F,
    pub(crate) free: [Free; 1],
    /// Least and largest value of the parameter.
    pub(crate) range: [f64; 2],
    pub(crate) options: &'a ContinuationOptions,
}

impl<'a, F: ParametricMap + ?Sized> Path<'a, F> {
    pub(crate) fn new(
        family: &'a F,
        start: &Orbit,
        along: &ParameterRange,
        options: &'a ContinuationOptions,
    ) -> Result<Self, ContinuationError> {
        let ParameterRange {
            parameter: index,
            from,
            to,
        } = *along;
        check(family, &start.places)?;
        let count = start.parameters.len();
        let value = *start
            .parameters
            .get(index)
            .ok_or(ContinuationError::NoParameter { index, count })?;
        let (low, high) = (from.min(to), from.max(to));
        let steps = [options.smallest, options.initial, options.largest];
        if !(low < high && (high - low).is_finite()) {
            return Err(ContinuationError::BadRange { from, to });
        }
        if !(low..=high).contains(&value) {
            return Err(ContinuationError::OutsideRange { value });
        }
        if !(steps.is_sorted() && steps[0] > 0.0 && steps[2].is_finite())
            || [options.weight, options.angle]
                .iter()
                .any(|x| !(*x > 0.0 && x.is_finite()))
        {
            return Err(ContinuationError::BadSteps);
        }
        let unit = (high - low) / options.weight;
        Ok(Self {
            family,
            free: [Free { index, unit }],
            range: [low, high],
            options,
        })
    }

    pub(crate) fn shooting(&self) -> Shooting<'_, F> {
        Shooting {
            family: self.family,
            free: &self.free,
            newton: &self.options.newton,
            keep_switches: false,
            kept: &[],
        }
    }

    /// u = (x_1, parameter in its unit).
    pub(crate) fn coordinates(&self, orbit: &Orbit) -> Vec<f64> {
        let mut u = orbit.places[0].x.clone();
        u.push(orbit.parameters[self.free[0].index] / self.free[0].unit);
        u
    }

    /// u_b - u_a.
    pub(crate) fn apart(&self, a: &Point, b: &Point) -> Vec<f64> {
        minus(&self.coordinates(&b.orbit), &self.coordinates(&a.orbit))
    }

    /// (0, 1): the direction of the parameter alone.
    pub(crate) fn upwards(&self) -> Vec<f64> {
        let mut direction = vec![0.0; self.family.dimension() + 1];
        direction[self.family.dimension()] = 1.0;
        direction
    }

    /// The point near a guess in the plane through it that is normal to `normal`, with its tangent
    /// oriented to the side of `ahead`.
    pub(crate) fn solve(
        &self,
        guess: &Guess,
        normal: &[f64],
        ahead: &[f64],
    ) -> Result<Point, NotFound> {
        let pass = self.shooting().correct(guess, &[normal.to_vec()])?;
        self.point(&pass, ahead)
    }

    pub(crate) fn point(&self, pass: &Pass, ahead: &[f64]) -> Result<Point, NotFound> {
        let orbit = Orbit::of(pass, self.options.newton.tolerance)?;
        let singular = || NotFound::Singular {
            residual: pass.residual,
            places: pass.places.clone(),
        };
        let equations = pass.equations().ok_or_else(singular)?;
        let tangent = linear::tangent(&equations, CROSSING, ahead).ok_or_else(singular)?;
        let n = equations.nrows();
        let bordered = Matrix::from_fn(n + 1, n + 1, |row, col| {
            if row < n {
                equations[(row, col)]
            } else {
                tangent[col]
            }
        });
        Ok(Point {
            parameter: orbit.parameters[self.free[0].index],
            stable: orbit.stable(),
            outside: orbit.outside(),
            full_tangent: pass.spread(&tangent).ok_or_else(singular)?,
            branch_test: bordered.determinant(),
            tangent,
            orbit,
        })
    }

    /// The point of the branch at a part of the way from `a` to `b`, in the plane normal to that way.
    pub(crate) fn between(&self, a: &Point, b: &Point, part: f64) -> Result<Point, NotFound> {
        let way = unit(&self.apart(a, b));
        self.solve(&self.mixed(a, b, part), &way, &way)
    }

    /// The orbit of `a` moved by a part of the difference to `b`.
    pub(crate) fn mixed(&self, a: &Point, b: &Point, part: f64) -> Guess {
        let (from, to) = (&a.orbit.places, &b.orbit.places);
        let change = Change {
            x: from
                .iter()
                .zip(to)
                .map(|(a, b)| minus(&b.x, &a.x))
                .collect(),
            free: vec![(b.parameter - a.parameter) / self.free[0].unit],
        };
        a.orbit.guess().moved(&self.free, part, &change)
    }

    /// A start with its tangent towards growing parameter, or falling.
    pub(crate) fn seed(&self, start: &Orbit, growing: bool) -> Result<Point, NotFound> {
        let up = self.upwards();
        let point = self.solve(&start.guess(), &up, &up)?;
        Ok(if growing { point } else { point.reversed() })
    }

    /// Length of the chord between two points.
    pub(crate) fn distance(&self, a: &Point, b: &Point) -> f64 {
        norm(&self.apart(a, b))
    }
}
