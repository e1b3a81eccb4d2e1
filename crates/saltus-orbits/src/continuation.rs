//! Branches of periodic orbits over one parameter: pseudo-arclength continuation.
//!
//! A branch is a curve in (x_1, p), the first place of the orbit and the parameter. From a point with unit
//! tangent t the corrector solves the equations of the orbit with t (u - u_predicted) = 0, so it passes
//! folds. The parameter counts in units of its range, divided by [`ContinuationOptions::weight`].

use crate::linear::{self, minus, norm, scaled, unit};
use crate::orbit::check;
use crate::shooting::{Change, Free, Guess, Pass, Shooting};
use crate::{Family, Lost, Matrix, NewtonOptions, NotFound, Orbit, Special};

/// Two branches cross where the equations lose a rank to within this. Derivatives by differences have errors of
/// 1e-11, which turn the tangent by up to 1e-6 where the rest is larger.
const CROSSING: f64 = 1e-5;

/// The parameter that changes, and how far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Along {
    /// Which parameter.
    pub parameter: usize,
    /// One end of its range.
    pub from: f64,
    /// The other end.
    pub to: f64,
}

/// How branches are followed. Steps are lengths in (x_1, parameter).
#[derive(Clone, Debug, PartialEq)]
pub struct ContinuationOptions {
    /// How orbits are solved for.
    pub newton: NewtonOptions,
    /// First step.
    pub initial: f64,
    /// A branch ends where a shorter step would be needed.
    pub smallest: f64,
    /// Longest step. It decides how much can hide between two points.
    pub largest: f64,
    /// Largest angle between tangents of successive points (rad).
    pub angle: f64,
    /// Points of a branch at most, for each direction.
    pub points: usize,
    /// How much the whole range of the parameter counts beside states: 1 where states are of the order of 1.
    pub weight: f64,
}

impl Default for ContinuationOptions {
    fn default() -> Self {
        Self {
            newton: NewtonOptions::default(),
            initial: 0.01,
            smallest: 1e-7,
            largest: 0.05,
            angle: 0.3,
            points: 2000,
            weight: 1.0,
        }
    }
}

/// A point of a branch.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Value of the parameter.
    pub parameter: f64,
    /// The orbit.
    pub orbit: Orbit,
    /// Whether all multipliers lie inside the unit circle.
    pub stable: bool,
    /// How many lie outside.
    pub outside: usize,
    /// Unit tangent of the branch: change of the first place, then of the parameter in units of its range
    /// divided by the weight.
    pub tangent: Vec<f64>,
    /// The tangent at all places.
    pub(crate) spread: Change,
    /// Determinant of the equations with the tangent below them: it changes its sign at branch points.
    pub(crate) side: f64,
}

impl Point {
    /// Change of the parameter along the tangent.
    pub(crate) fn pace(&self) -> f64 {
        self.tangent[self.tangent.len() - 1]
    }

    /// The same point of the branch followed the other way.
    pub(crate) fn reversed(mut self) -> Self {
        let turned = |all: &[f64]| scaled(all, -1.0);
        self.tangent = turned(&self.tangent);
        self.spread.free = turned(&self.spread.free);
        self.spread.x = self.spread.x.iter().map(|x| turned(x)).collect();
        self.side = -self.side;
        self
    }
}

/// Where a branch ends, and why.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum End {
    /// Here it was started.
    Start,
    /// At an end of the range of the parameter.
    RangeEnd,
    /// After as many points as allowed.
    PointLimit,
    /// Back where it began: a closed curve.
    Closed,
    /// Where it meets the branch of half its period.
    Halved,
    /// At a grazing beyond which no orbit was found near.
    Grazing,
    /// Where the map ends.
    NoMap(Lost),
    /// The corrector failed for the smallest step too.
    Failed(NotFound),
    /// The branch bends too much for the smallest step.
    StepTooSmall,
    /// The pair of multipliers that a curve follows became real: a resonance at the angle 0 or pi.
    Resonance,
    /// Stopped from outside.
    Interrupted,
}

impl std::fmt::Display for End {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Start => write!(f, "started here"),
            Self::RangeEnd => write!(f, "end of the range"),
            Self::PointLimit => write!(f, "as many points as allowed"),
            Self::Closed => write!(f, "closed curve: back at the start"),
            Self::Halved => write!(f, "meets the branch of half its period"),
            Self::Grazing => write!(f, "grazing, and no orbit found near beyond it"),
            Self::NoMap(reason) => write!(f, "no map beyond: {reason}"),
            Self::Failed(reason) => write!(f, "lost: {reason}"),
            Self::StepTooSmall => write!(f, "bends too much for the smallest step"),
            Self::Resonance => write!(f, "the pair of multipliers became real: a resonance"),
            Self::Interrupted => write!(f, "interrupted"),
        }
    }
}

/// A branch of periodic orbits.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// Its points in their order along the curve.
    pub points: Vec<Point>,
    /// Its special points, in the same order.
    pub specials: Vec<Special>,
    /// Why it ends before the first point and after the last.
    pub ends: [End; 2],
}

/// Why a branch could not be begun.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ContinuationError {
    /// No such parameter.
    #[error("there is no parameter {index}: the orbit has {count}, counted from 0")]
    NoParameter {
        /// The one asked for.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A range that is none.
    #[error("the range from {from} to {to} must have two different finite ends")]
    BadRange {
        /// One end.
        from: f64,
        /// The other.
        to: f64,
    },
    /// A start outside.
    #[error("the start has the parameter at {value}; it must lie in the range")]
    OutsideRange {
        /// Its value.
        value: f64,
    },
    /// Steps that are none.
    #[error(
        "steps must obey 0 < smallest <= initial <= largest, and weight and angle be positive; all finite"
    )]
    BadSteps,
    /// No curve over two parameters.
    #[error(
        "no curve over two parameters can be followed from {short}: it takes two different parameters and \
         LP, PD, NS or GR"
    )]
    NoCurve {
        /// Kind of the special point.
        short: &'static str,
    },
    /// The start is no orbit.
    #[error("the start is no orbit: {0}")]
    Start(#[from] NotFound),
}

/// Everything a branch is followed with.
pub(crate) struct Path<'a, F: ?Sized> {
    pub(crate) family: &'a F,
    pub(crate) free: [Free; 1],
    /// Least and largest value of the parameter.
    pub(crate) range: [f64; 2],
    pub(crate) options: &'a ContinuationOptions,
}

impl<'a, F: Family + ?Sized> Path<'a, F> {
    pub(crate) fn new(
        family: &'a F,
        start: &Orbit,
        along: &Along,
        options: &'a ContinuationOptions,
    ) -> Result<Self, ContinuationError> {
        let Along {
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
        let pass = self
            .shooting()
            .correct(guess, std::slice::from_ref(&normal.to_vec()))?;
        self.point(&pass, ahead)
    }

    fn point(&self, pass: &Pass, ahead: &[f64]) -> Result<Point, NotFound> {
        let orbit = Orbit::of(pass)?;
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
            spread: pass.spread(&tangent).ok_or_else(singular)?,
            side: linear::determinant(&bordered),
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
