//! Other branches that meet at a special point.

use crate::continuation::Point;
use crate::detect::flip;
use crate::linear::{self, dot, plus, scaled, unit};
use crate::locate::NARROW;
use crate::path::Path;
use crate::shooting::Guess;
use crate::{Orbit, ParametricMap, Special, find_orbit};

/// Steps of the secant method at most.
const SECANT: usize = 12;

/// Offset, as a part of the range, at which the secant method looks for its slope: a halving is known to
/// some 1e-7.
const ASIDE: f64 = 1e-4;

impl<F: ParametricMap + ?Sized> Path<'_, F> {
    /// First point of the branch of twice the period: the orbit taken twice, with the tangent (v, -v) in its two
    /// halves, where v is the eigenvector of the multiplier -1.
    pub(crate) fn doubled(&self, special: &Special) -> Option<Point> {
        let mut tangent = linear::eigenvector(&special.orbit.monodromy, -1.0)?;
        tangent.push(0.0);
        let mut guess = special.orbit.guess();
        guess.places.extend_from_within(..);
        self.birth(&guess, |_| Some(tangent))
    }

    /// The branch of half the period, where one of its doubled branches ends, a step aside: on it nothing special happens
    /// to the equations, but at the doubling itself rounding decides on which side of the circle the multiplier is.
    pub(crate) fn half(&self, special: &Special) -> Option<Point> {
        let orbit = self.at(special, special.parameter)?;
        let seed = self.seed(&orbit, true).ok()?;
        // The first step back is to lead across the doubling, and not onto it.
        let aside = |from: &Point| self.next(from, 0.6 * self.options.initial).ok();
        let back = || Some(aside(&seed.clone().reversed())?.reversed());
        Some(aside(&seed).or_else(back).unwrap_or(seed))
    }

    /// Moves a halving to where it is known best: the period doubling on the branch of half the period, found there
    /// by the secant method. It stays where it was if that is not near.
    pub(crate) fn at_doubling(&self, special: &mut Special) {
        let range = self.range[1] - self.range[0];
        let inwards = if special.parameter > self.range[0] + range / 2.0 {
            -1.0
        } else {
            1.0
        };
        let mut known: Option<(f64, f64)> = None;
        let mut parameter = special.parameter;
        for _ in 0..SECANT {
            let Some(orbit) = self.at(special, parameter) else {
                return;
            };
            let Some(value) = flip(&orbit) else { return };
            let change = match known {
                None => inwards * ASIDE * range,
                Some((before, value_before)) => {
                    -value * (parameter - before) / (value - value_before)
                }
            };
            if known.is_some() && change.abs() <= NARROW * range || value == 0.0 {
                special.parameter = parameter;
                special.orbit.parameters[self.free[0].index] = parameter;
                let twice = [orbit.places.clone(), orbit.places].concat();
                special.orbit.places = twice;
                return;
            }
            known = Some((parameter, value));
            parameter += change;
            if (parameter - special.parameter).abs() > 10.0 * ASIDE * range
                || !parameter.is_finite()
            {
                return;
            }
        }
    }

    /// The orbit of half the period near a halving.
    fn at(&self, special: &Special, parameter: f64) -> Option<Orbit> {
        let places = &special.orbit.places;
        let mut parameters = special.orbit.parameters.clone();
        parameters[self.free[0].index] = parameter;
        let (half, newton) = (&places[..places.len() / 2], &self.options.newton);
        find_orbit(self.family, &parameters, half, newton).ok()
    }

    /// First point of the other branch through a branch point, along the direction normal to the branch at hand in the
    /// plane of directions in which the equations hold to first order. The other branch has a part of it, and the
    /// corrector finds the rest.
    pub(crate) fn crossed(&self, special: &Special) -> Option<Point> {
        self.birth(&special.orbit.guess(), |equations| {
            let plane = linear::null_space(equations, 2)?;
            let [a, b] = [&plane[0], &plane[1]].map(|v| dot(v, &special.tangent));
            Some(unit(&plus(&scaled(&plane[0], b), -a, &plane[1])))
        })
    }

    /// The first point of a branch, at an orbit that is known to be one.
    fn birth(
        &self,
        guess: &Guess,
        tangent: impl FnOnce(&crate::Matrix) -> Option<Vec<f64>>,
    ) -> Option<Point> {
        let pass = self.shooting().pass(guess).ok()?;
        let orbit = Orbit::of(&pass, self.options.newton.tolerance).ok()?;
        let tangent = tangent(&pass.equations()?)?;
        Some(Point {
            parameter: orbit.parameters[self.free[0].index],
            stable: orbit.stable(),
            outside: orbit.outside(),
            full_tangent: pass.spread(&tangent)?,
            branch_test: 0.0,
            tangent,
            orbit,
        })
    }
}
