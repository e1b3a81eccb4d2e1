//! Special points by a second method, which shares neither the arclength nor the tangent flow with the first.
//!
//! Orbits are solved for at given values of the parameter, with the derivative of the map by differences of
//! plain trajectories, and the special point is where their critical multiplier passes the unit circle: found by
//! the secant method for period doubling, Neimark-Sacker and branch points. A fold has orbits on one side only,
//! where the square of the multiplier's distance from 1 falls linearly to zero: it is extrapolated. A grazing is where
//! the number of switches changes, by bisection.

use saltus_orbits::{
    Branch, Crossing, Differences, MapPoint, Multiplier, NewtonOptions, Orbit, ParametricMap,
    Special, SpecialKind, find_orbit,
};

/// Step of the differences: 4e-12 of curvature, and 1e-14 of noise over 2e-6. Longer ones reach across grazings that
/// lie beside a special point.
const STEP: f64 = 2e-6;

/// Distance at which the secant method begins, as a part of the range; nearer where a fold leaves no orbits there. It
/// may go as many times as far as the second number says, or it has found another point.
const ASIDE: [f64; 2] = [1e-6, 1e-8];
const ASTRAY: f64 = 30.0;

/// Distances from a fold at which orbits are taken, as parts of the range, and factors to them: what else is near says
/// which is best.
const NEAR_FOLD: [f64; 3] = [1e-6, 4e-6, 9e-6];
const NEARER: [f64; 3] = [1.0, 1e-2, 1e-4];

/// Half the first bracket around a grazing, as a part of the range, and when it is narrow enough.
const BRACKET: f64 = 1e-5;
const NARROW: f64 = 1e-11;

const ROUNDS: usize = 40;

/// The parameter `index` at which what `special` of `branch` says happens, as the second method finds it near that point;
/// `range` is the length of the range. `None` where it finds nothing near, and for switches that change order.
pub fn second_opinion<F: ParametricMap>(
    family: &F,
    branch: &Branch,
    special: &Special,
    index: usize,
    range: f64,
) -> Option<f64> {
    let scene = Scene {
        family,
        branch,
        special,
        index,
        range,
    };
    match special.kind {
        SpecialKind::Fold => scene.fold(),
        SpecialKind::Grazing { .. } => scene.grazing(),
        SpecialKind::PeriodDoubling => scene.crossing(1, |mu| nearest(mu, -1.0).map(|m| m + 1.0)),
        SpecialKind::BranchPoint => scene.crossing(1, |mu| nearest(mu, 1.0).map(|m| m - 1.0)),
        SpecialKind::Halving => scene.crossing(2, |mu| nearest(mu, -1.0).map(|m| m + 1.0)),
        SpecialKind::NeimarkSacker { .. } => scene.crossing(1, |mu| {
            let pairs = mu.iter().filter(|m| m.im > 0.0).map(|m| m.modulus() - 1.0);
            pairs.min_by(|a, b| a.abs().total_cmp(&b.abs()))
        }),
        _ => None,
    }
}

struct Scene<'a, F> {
    family: &'a F,
    branch: &'a Branch,
    special: &'a Special,
    index: usize,
    range: f64,
}

impl<F: ParametricMap> Scene<'_, F> {
    /// The orbit at a value of the parameter, near `places`.
    fn solve<G: ParametricMap>(
        &self,
        family: &G,
        value: f64,
        places: &[MapPoint],
    ) -> Option<Orbit> {
        let mut parameters = self.special.orbit.parameters.clone();
        parameters[self.index] = value;
        find_orbit(family, &parameters, places, &NewtonOptions::default()).ok()
    }

    /// Zero of a function of the multipliers, for the orbit of the period over `share`.
    fn crossing(&self, share: usize, test: impl Fn(&[Multiplier]) -> Option<f64>) -> Option<f64> {
        let differences = Differences::new(self.family, STEP);
        let places = &self.special.orbit.places;
        let places = &places[..places.len() / share];
        let value = |at: f64| test(&self.solve(&differences, at, places)?.multipliers);
        ASIDE
            .into_iter()
            .find_map(|aside| self.secant(&value, aside * self.range))
    }

    /// Zero of a function of the parameter, begun `aside` of the special point, so as not to start at the
    /// answer.
    fn secant(&self, value: &impl Fn(f64) -> Option<f64>, aside: f64) -> Option<f64> {
        let mut a = self.special.parameter - aside;
        let mut b = self.special.parameter + 0.7 * aside;
        let (mut at_a, mut at_b) = (value(a)?, value(b)?);
        for _ in 0..ROUNDS {
            let next = b - at_b * (b - a) / (at_b - at_a);
            if !next.is_finite() || (next - self.special.parameter).abs() > ASTRAY * aside {
                return None;
            }
            if (next - b).abs() <= NARROW * self.range {
                return Some(next);
            }
            (a, at_a) = (b, at_b);
            (b, at_b) = (next, value(next)?);
        }
        None
    }

    /// By the parabola through (multiplier - 1)^2 at three values on the side where there are orbits, at the distance where
    /// it is nearest to the straight line through two of them. Orbits are sought on the way to the neighbouring points of
    /// the branch, which goes as the root of the distance.
    fn fold(&self) -> Option<f64> {
        let differences = Differences::new(self.family, STEP);
        let special = self.special;
        let neighbours = self.branch.points[special.near..].iter().take(2);
        let tries = neighbours.flat_map(|point| NEARER.map(|scale| (point, scale)));
        let found = tries.filter_map(|(point, scale)| {
            let away = point.parameter - special.parameter;
            let at =
                NEAR_FOLD.map(|part| special.parameter + away.signum() * scale * part * self.range);
            let square = |at: f64| {
                let part = ((at - special.parameter) / away).sqrt();
                let guess = mixed(&special.orbit.places, &point.orbit.places, part);
                let orbit = self.solve(&differences, at, &guess)?;
                // one that Newton's method found elsewhere
                let near = nearest(&orbit.multipliers, 1.0).filter(|m| (m - 1.0).abs() < 0.1)?;
                Some((near - 1.0).powi(2))
            };
            let squares = [square(at[0])?, square(at[1])?, square(at[2])?];
            let [line, parabola] = [2, 3].map(|n| at_zero(&squares[..n], &at[..n]));
            Some((parabola, (parabola - line).abs()))
        });
        let best = found.min_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(best.0)
    }

    /// Parameter at which orbits change the number of their switches.
    fn grazing(&self) -> Option<f64> {
        let places = &self.special.orbit.places;
        let solve = |at: f64| {
            let orbit = self.solve(self.family, at, places)?;
            let switches = |period: &Vec<Crossing>| period.len();
            Some(orbit.crossings.iter().map(switches).sum::<usize>())
        };
        let mut low = self.special.parameter - BRACKET * self.range;
        let mut high = self.special.parameter + 0.7 * BRACKET * self.range;
        let (before, behind) = (solve(low)?, solve(high)?);
        if before == behind {
            return None;
        }
        while high - low > NARROW * self.range {
            let middle = f64::midpoint(low, high);
            if solve(middle)? == before {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(f64::midpoint(low, high))
    }
}

/// Value at zero of the polynomial with these values at these places (Lagrange).
fn at_zero(places: &[f64], values: &[f64]) -> f64 {
    let weight = |i: usize| {
        let others = (0..places.len()).filter(|&j| j != i);
        let factors = others.map(|j| places[j] / (places[j] - places[i]));
        factors.product::<f64>()
    };
    (0..places.len()).map(|i| weight(i) * values[i]).sum()
}

/// Places a part of the way from some to others.
fn mixed(from: &[MapPoint], to: &[MapPoint], part: f64) -> Vec<MapPoint> {
    let between = |(a, b): (&MapPoint, &MapPoint)| MapPoint {
        modes: a.modes.clone(),
        x: a.x
            .iter()
            .zip(&b.x)
            .map(|(a, b)| a + part * (b - a))
            .collect(),
    };
    from.iter().zip(to).map(between).collect()
}

/// The real multiplier nearest to a number.
fn nearest(multipliers: &[Multiplier], to: f64) -> Option<f64> {
    let real = multipliers.iter().filter(|m| m.im == 0.0).map(|m| m.re);
    real.min_by(|a, b| (a - to).abs().total_cmp(&(b - to).abs()))
}
