//! What a map that depends on parameters can do in the long run: periodic orbits with their Floquet
//! multipliers, branches of them with their bifurcations, Lyapunov exponents.
//!
//! Everything here asks a [`Family`] of maps; nothing knows whether that is a forced flow seen once per
//! period, which may switch on the way, or two lines of algebra.

mod exponents;
mod flow;
mod follow;
mod map;
mod nature;

pub use exponents::{Dimension, Exponent, ExponentError, Running, Spectrum, Weighted};
pub use flow::Stroboscopic;
pub use follow::{Follower, spectrum_of};
pub use map::{Crossing, Family, Image, Lost, Matrix, Place, Shot, Touch};
pub use nature::{Criteria, Doubt, Nature, Recurrence, Verdict, judge};
