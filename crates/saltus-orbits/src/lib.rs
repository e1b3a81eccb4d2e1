//! Long-term behaviour of maps that depend on parameters: periodic orbits with their Floquet
//! multipliers, branches of them with their bifurcations, Lyapunov exponents.
//!
//! Everything here asks a [`Family`] of maps; nothing knows whether that is a forced flow seen once per
//! period, which may switch on the way, or two lines of algebra.

mod beyond;
mod branches;
mod climb;
mod continuation;
mod crossing;
mod curve;
mod derived;
mod detect;
mod differences;
mod events;
mod exponents;
mod flow;
mod follow;
mod follower;
mod instant;
mod kept;
mod linear;
mod locate;
mod map;
mod matrix;
mod newton;
mod orbit;
mod path;
mod samples;
mod settled;
mod shooting;
mod special;
mod surface;
mod switching;
mod touching;
mod verdict;
mod walk;

pub use branches::{BranchesOptions, Limb, branches};
pub use climb::{Ascent, ClimbError, Climbed, Start, climb};
pub use continuation::{Along, Branch, ContinuationError, ContinuationOptions, End, Point};
pub use curve::{Curve, CurvePoint, follow_curve};
pub use derived::Differences;
pub use exponents::{Dimension, Exponent, ExponentError, Running, Spectrum, Weighted};
pub use flow::Stroboscopic;
pub use follow::{follow, follow_both};
pub use follower::{Follower, spectrum_of};
pub use map::{Crossing, Family, Image, Lost, Place, Shot, Touch};
pub use matrix::Matrix;
pub use newton::{NewtonOptions, NotFound};
pub use orbit::{Multiplier, Orbit, Stability, find_orbit};
pub use samples::{Closeness, MAX_PERIOD, OnCycle, Samples};
pub use settled::settled;
pub use special::{Special, SpecialKind};
pub use verdict::{Criteria, Doubt, MotionKind, Recurrence, Verdict, judge};
