//! Periodic orbits of a map and their Floquet multipliers.

use crate::events::{Switch, switches};
use crate::kept::{Kept, kept};
use crate::linear::{self, minus, size};
use crate::map::{Crossing, MapPoint, ParametricMap, Touch};
use crate::matrix::Matrix;
use crate::newton::{NewtonOptions, NotFound};
use crate::shooting::{Guess, Pass, Shooting};

/// Two places of an orbit nearer than this, relative to the largest state or 1, are one place: a residual
/// at the default tolerance leaves places uncertain by less, except within 1e-13 of a period doubling.
const SAME: f64 = 1e-7;

/// A multiplier so near to 1 may be that of a kept quantity: there the equations are singular, and Newton's method
/// comes to an orbit with half of the digits only.
const NEAR_ONE: f64 = 1e-3;

/// An eigenvalue of the derivative of the map once around an orbit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Multiplier {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
    /// Bound on its error: the accuracy of the derivative ([`NewtonOptions::tolerance`] of each iterate) times the
    /// condition of the eigenvalue.
    pub error: f64,
}

impl Multiplier {
    /// Its absolute value: the factor by which a disturbance grows in one period of the orbit.
    pub fn modulus(self) -> f64 {
        self.re.hypot(self.im)
    }

    /// Its distance from 1.
    fn off_one(self) -> f64 {
        (self.re - 1.0).hypot(self.im)
    }

    /// Its angle, from -pi to pi (rad).
    pub fn argument(self) -> f64 {
        self.im.atan2(self.re)
    }
}

/// Whether an orbit is stable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stability {
    /// All multipliers lie inside the unit circle.
    Stable,
    /// Some lie outside.
    Unstable,
    /// None lies outside, and some are so near to the circle that rounding decides on which side: at a bifurcation, or
    /// with a conserved quantity, which makes a multiplier 1.
    Neutral,
}

impl Stability {
    /// "stable", "unstable" or "neutral".
    pub fn name(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Unstable => "unstable",
            Self::Neutral => "neutral",
        }
    }

    /// Whether it is stable; `None` if neutral.
    pub fn is_stable(self) -> Option<bool> {
        match self {
            Self::Stable => Some(true),
            Self::Unstable => Some(false),
            Self::Neutral => None,
        }
    }
}

/// A periodic orbit.
#[derive(Clone, Debug, PartialEq)]
pub struct Orbit {
    /// Value of each parameter.
    pub parameters: Vec<f64>,
    /// Its places, one per iterate: as many as the period.
    pub places: Vec<MapPoint>,
    /// Floquet multipliers, by falling modulus.
    pub multipliers: Vec<Multiplier>,
    /// Derivative of the map once around, at the first place.
    pub monodromy: Matrix,
    /// Switches on the way from each place to the next, in time order.
    pub crossings: Vec<Vec<Crossing>>,
    /// Extrema of guards without a switch on the way from each place to the next.
    pub touches: Vec<Vec<Touch>>,
    /// Largest component of P(x_i) - x_(i+1).
    pub residual: f64,
    /// Newton steps that were taken.
    pub iterations: usize,
}

impl Orbit {
    /// Number of iterates.
    pub fn period(&self) -> usize {
        self.places.len()
    }

    /// Number of multipliers outside the unit circle, by more than their errors.
    pub fn outside(&self) -> usize {
        let grows = |m: &&Multiplier| m.modulus() - 1.0 > m.error;
        self.multipliers.iter().filter(grows).count()
    }

    /// Whether the multipliers lie inside the unit circle.
    pub fn stability(&self) -> Stability {
        let inside = |m: &Multiplier| 1.0 - m.modulus() > m.error;
        if self.outside() > 0 {
            Stability::Unstable
        } else if self.multipliers.iter().all(inside) {
            Stability::Stable
        } else {
            Stability::Neutral
        }
    }

    /// Whether all multipliers lie inside the unit circle, by more than their errors.
    pub fn stable(&self) -> bool {
        self.stability() == Stability::Stable
    }

    /// Whether a multiplier is 1 to its error: other orbits lie beside this one, as many as a conserved quantity has
    /// values, or it is at a fold or a branch point.
    pub fn in_family(&self) -> bool {
        let one = |m: &Multiplier| m.off_one() <= m.error;
        self.multipliers.iter().any(one)
    }

    /// All switches of one period in time order.
    pub(crate) fn switches(&self) -> Vec<Switch> {
        self.crossings
            .iter()
            .flat_map(|all| switches(all))
            .collect()
    }

    /// Number of switches in one period.
    pub(crate) fn switch_count(&self) -> usize {
        self.crossings.iter().map(Vec::len).sum()
    }

    /// The touch with the smallest value, among those that `counts` lets through, and its iterate.
    pub(crate) fn nearest_touch(
        &self,
        counts: impl Fn(usize, &Touch) -> bool,
    ) -> Option<(usize, Touch)> {
        let all = self.touches.iter().enumerate();
        all.flat_map(|(iterate, touches)| touches.iter().map(move |touch| (iterate, *touch)))
            .filter(|(iterate, touch)| touch.value.is_finite() && counts(*iterate, touch))
            .min_by(|a, b| a.1.value.total_cmp(&b.1.value))
    }

    /// The orbit of a converged pass, unless its derivative overflows. Derivatives of one iterate are as accurate as
    /// `tolerance`.
    pub(crate) fn of(pass: &Pass, tolerance: f64) -> Result<Self, NotFound> {
        let solved = pass
            .around()
            .and_then(|(m, _)| Some((linear::eigenvalues(&m)?, m)));
        let Some((values, monodromy)) = solved else {
            return Err(NotFound::Singular {
                residual: pass.residual,
                places: pass.places.clone(),
            });
        };
        let off = tolerance * pass.growth();
        let (size, power) = (linear::whole_norm(&monodromy), 1.0 / values.len() as f64);
        // where the condition says nothing, the bound of Elsner (1985)
        let most = (2.0 * size + off).powf(1.0 - power) * off.powf(power);
        let mut multipliers: Vec<Multiplier> = values
            .into_iter()
            .map(|(re, im, condition)| Multiplier {
                re,
                im,
                error: (condition * off).min(most),
            })
            .collect();
        multipliers.sort_by(|a, b| {
            let falling = b.modulus().total_cmp(&a.modulus());
            falling.then(b.im.total_cmp(&a.im))
        });
        Ok(Self {
            parameters: pass.parameters.clone(),
            places: pass.places.clone(),
            multipliers,
            monodromy,
            crossings: pass.images.iter().map(|i| i.crossings.clone()).collect(),
            touches: pass.images.iter().map(|i| i.touches.clone()).collect(),
            residual: pass.residual,
            iterations: pass.iterations,
        })
    }

    pub(crate) fn guess(&self) -> Guess {
        Guess {
            parameters: self.parameters.clone(),
            places: self.places.clone(),
        }
    }
}

/// The periodic orbit near `start`, which has one place per iterate.
///
/// Newton's method with multiple shooting; a step is cut as long as it makes the residual grow. The
/// orbit has the shortest period: a start of four places that leads to a 2-cycle gives two. The first
/// place of the orbit is the one near `start[0]`. If orbits lie in a family, since the map keeps a quantity, it is
/// the one with the value of the start: exactly if the quantity is quadratic, else to first order in the distance
/// between the two. Modes of a start that contradict the motion are replaced.
///
/// # Errors
/// If the start is no orbit's start, or no orbit was found: see [`NotFound`].
pub fn find_orbit<F: ParametricMap + ?Sized>(
    family: &F,
    parameters: &[f64],
    start: &[MapPoint],
    options: &NewtonOptions,
) -> Result<Orbit, NotFound> {
    check(family, start)?;
    let guess = |places: &[MapPoint]| Guess {
        parameters: parameters.to_vec(),
        places: places.to_vec(),
    };
    let solve = |places: &[MapPoint], kept: &[Kept]| {
        let once = |places: &[MapPoint]| {
            let pass = plain(family, options, kept).correct(&guess(places), &[])?;
            Orbit::of(&pass, options.tolerance)
        };
        let orbit = once(places)?;
        match shortest_period(&orbit.places) {
            period if period == orbit.period() => Ok(orbit),
            period => once(&orbit.places[..period]),
        }
    };
    let first = solve(start, &[]);
    let places = match &first {
        Ok(orbit) if orbit.multipliers.iter().any(|m| m.off_one() <= NEAR_ONE) => &orbit.places,
        Err(NotFound::Singular { places, .. }) => places,
        _ => return first,
    };
    // The member of a family that is meant has the kept value of the start.
    let linear = || {
        let slope = plain(family, options, &[])
            .pass(&guess(places))
            .ok()?
            .best_kept()?;
        Some(vec![Kept::linear(slope, &start[0].x)])
    };
    let quadratic = kept(family, parameters, &start[0]).filter(|all| !all.is_empty());
    let alone = first.as_ref().is_ok_and(|orbit| !orbit.in_family());
    let Some(all) = quadratic.or_else(|| if alone { None } else { linear() }) else {
        return first;
    };
    let member = |places: &[MapPoint]| {
        let orbit = solve(places, &all)?;
        let x = &orbit.places[0].x;
        if all.iter().all(|kept| kept.holds(x)) {
            Ok(orbit)
        } else {
            Err(NotFound::OtherMember {
                places: orbit.places,
            })
        }
    };
    match (member(start).or_else(|_| member(places)), &first) {
        (Err(_), Err(_)) => first,
        (found, _) => found,
    }
}

/// The equations of an orbit without free parameters.
fn plain<'a, F: ?Sized>(
    family: &'a F,
    newton: &'a NewtonOptions,
    kept: &'a [Kept],
) -> Shooting<'a, F> {
    Shooting {
        family,
        free: &[],
        newton,
        keep_switches: false,
        kept,
    }
}

/// Whether Newton's method can begin at a start.
pub(crate) fn check<F: ParametricMap + ?Sized>(
    family: &F,
    start: &[MapPoint],
) -> Result<(), NotFound> {
    let dimension = family.dimension();
    let bad =
        |place: &MapPoint| place.x.len() != dimension || place.x.iter().any(|x| !x.is_finite());
    match start.iter().position(bad) {
        Some(place) => Err(NotFound::BadPlace { place, dimension }),
        None if start.is_empty() => Err(NotFound::NoPlaces),
        None => Ok(()),
    }
}

/// Number of iterates after which the places repeat.
pub(crate) fn shortest_period(places: &[MapPoint]) -> usize {
    let n = places.len();
    let scale = places.iter().map(|p| size(&p.x)).fold(1.0, f64::max);
    let repeats = |m: &usize| {
        let same = |i: usize| size(&minus(&places[i].x, &places[(i + m) % n].x)) <= SAME * scale;
        n.is_multiple_of(*m) && (0..n).all(same)
    };
    (1..n).find(repeats).unwrap_or(n)
}
