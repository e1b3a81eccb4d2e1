//! Long-term behaviour of maps that depend on parameters: periodic orbits with their Floquet
//! multipliers, branches of them with their bifurcations, Lyapunov exponents.
//!
//! Everything here asks a [`ParametricMap`] of maps; nothing knows whether that is a forced flow seen once per
//! period, which may switch on the way, or two lines of algebra.

mod branches;
mod climb;
mod continuation;
mod crossing;
mod curve;
mod detect;
mod difference_map;
mod differences;
mod events;
mod exponents;
mod flow;
mod follow;
mod follower;
mod grazing;
mod kept;
mod linear;
mod locate;
mod map;
mod matrix;
mod newton;
mod orbit;
mod past_grazing;
mod path;
mod periodicity;
mod sampling_instant;
mod settled;
mod shooting;
mod special;
mod surface;
mod switching;
mod verdict;
mod walk;

pub use branches::{BranchWithOrigin, BranchesOptions, branches};
pub use climb::{Ascent, ClimbError, Climbed, Start, climb};
pub use continuation::{
    Branch, ContinuationError, ContinuationOptions, End, ParameterRange, Point,
};
pub use curve::{Curve, CurvePoint, follow_curve};
pub use difference_map::Differences;
pub use exponents::{Dimension, Exponent, ExponentError, Running, Spectrum, Weighted};
pub use flow::Stroboscopic;
pub use follow::{follow, follow_both};
pub use follower::{Follower, spectrum_of};
pub use map::{Crossing, Image, MapPoint, MapRequest, NoImage, ParametricMap, Touch};
pub use matrix::Matrix;
pub use newton::{NewtonOptions, NotFound};
pub use orbit::{Multiplier, Orbit, Stability, find_orbit};
pub use periodicity::{Closeness, MAX_PERIOD, OnCycle, Samples};
pub use settled::settled;
pub use special::{Special, SpecialKind};
pub use verdict::{Criteria, MotionKind, Recurrence, UndecidedReason, Verdict, judge};
