//! Branches of periodic orbits over one parameter: pseudo-arclength continuation.
//!
//! A branch is a curve in (x_1, p), the first place of the orbit and the parameter. From a point with unit
//! tangent t the corrector solves the equations of the orbit with t (u - u_predicted) = 0, so it passes
//! folds. The parameter counts in units of its range, divided by [`ContinuationOptions::weight`].

use crate::linear::scaled;
use crate::shooting::Change;
use crate::{NewtonOptions, NoImage, NotFound, Orbit, Special};

/// The parameter that changes, and how far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParameterRange {
    /// Index of the parameter.
    pub parameter: usize,
    /// One end of its range.
    pub from: f64,
    /// The other end.
    pub to: f64,
}

/// Settings for following branches. Steps are lengths in (x_1, parameter).
#[derive(Clone, Debug, PartialEq)]
pub struct ContinuationOptions {
    /// Settings for the corrector. Fewer steps than for an orbit from afar: a shorter step along the branch costs
    /// less than a Newton iteration that struggles.
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
    /// Weight of the whole range of the parameter beside states: 1 where states are of the order of 1.
    pub weight: f64,
    /// Points in a row with unstable orbits, beyond which a branch ends.
    pub unstable: usize,
}

impl Default for ContinuationOptions {
    fn default() -> Self {
        Self {
            newton: NewtonOptions {
                iterations: 8,
                ..NewtonOptions::default()
            },
            initial: 0.01,
            smallest: 1e-7,
            largest: 0.05,
            angle: 0.3,
            points: 2000,
            weight: 1.0,
            unstable: usize::MAX,
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
    /// Number of multipliers outside it.
    pub outside: usize,
    /// Unit tangent of the branch: change of the first place, then of the parameter in units of its range
    /// divided by the weight.
    pub tangent: Vec<f64>,
    /// The tangent at all places.
    pub(crate) full_tangent: Change,
    /// Determinant of the equations with the tangent below them: it changes its sign at branch points.
    pub(crate) branch_test: f64,
}

impl Point {
    /// Change of the parameter along the tangent.
    pub(crate) fn parameter_rate(&self) -> f64 {
        self.tangent[self.tangent.len() - 1]
    }

    /// The same point of the branch followed the other way.
    pub(crate) fn reversed(mut self) -> Self {
        let turned = |all: &[f64]| scaled(all, -1.0);
        self.tangent = turned(&self.tangent);
        self.full_tangent.free = turned(&self.full_tangent.free);
        self.full_tangent.x = self.full_tangent.x.iter().map(|x| turned(x)).collect();
        self.branch_test = -self.branch_test;
        self
    }
}

/// An end of a branch.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum End {
    /// The start of the walk.
    Start,
    /// An end of the range of the parameter.
    RangeEnd,
    /// As many points as allowed.
    PointLimit,
    /// As many points in a row with unstable orbits as allowed.
    Unstable,
    /// Return to the start: a closed curve.
    Closed,
    /// A meeting with the branch of half its period.
    Halved,
    /// A grazing beyond which no orbit was found near.
    Grazing,
    /// A switch at the sampling instant, which makes the sampled state jump, with no orbit found beyond.
    SamplingInstant,
    /// The end of the map.
    NoMap(NoImage),
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
            Self::Unstable => write!(f, "unstable for as many points as allowed"),
            Self::Closed => write!(f, "closed curve: back at the start"),
            Self::Halved => write!(f, "meets the branch of half its period"),
            Self::Grazing => write!(f, "grazing, and no orbit found near beyond it"),
            Self::SamplingInstant => write!(
                f,
                "a switch comes to the sampling instant, where the sampled state may jump, and no orbit was found \
                 near beyond it; sampled at another phase of the drive the branch may go on"
            ),
            Self::NoMap(reason) => write!(f, "no map beyond: {reason}"),
            Self::Failed(reason) => write!(f, "lost: {reason}"),
            Self::StepTooSmall => write!(f, "bends too much for the smallest step"),
            Self::Resonance => write!(f, "the pair of multipliers became real: a resonance"),
            Self::Interrupted => write!(f, "interrupted"),
        }
    }
}

impl From<NotFound> for End {
    fn from(reason: NotFound) -> Self {
        match reason {
            NotFound::NoImage {
                reason: NoImage::Interrupted,
                ..
            } => Self::Interrupted,
            NotFound::NoImage {
                reason: reason @ NoImage::NoMap(_),
                ..
            } => Self::NoMap(reason),
            reason => Self::Failed(reason),
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
    /// Its ends, before the first point and after the last.
    pub ends: [End; 2],
}

/// Reason why a branch could not be begun.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ContinuationError {
    /// No such parameter.
    #[error("there is no parameter {index}: the orbit has {count}, counted from 0")]
    NoParameter {
        /// The one asked for.
        index: usize,
        /// Number of parameters.
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
    /// A curve that cannot be begun.
    #[error(
        "the curve of this {short} cannot be begun: either what makes it one cannot be told from its orbit, such \
         as the touch of a grazing or the pair of multipliers, or it does not change with the parameters, or no \
         orbits were found beside it"
    )]
    NoDirection {
        /// Kind of the special point.
        short: &'static str,
    },
    /// The start is no orbit.
    #[error("the start is no orbit: {0}")]
    Start(#[from] NotFound),
}
