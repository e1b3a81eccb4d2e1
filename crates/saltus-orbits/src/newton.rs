//! Settings of Newton's method, and the reasons why it may find no orbit.

use crate::map::{MapPoint, NoImage};

/// Settings of Newton's method for orbits.
#[derive(Clone, Debug, PartialEq)]
pub struct NewtonOptions {
    /// Largest component of P(x_i) - x_(i+1), relative to the largest state or 1. The default is the least that
    /// flows solved to 1e-13 can reach.
    pub tolerance: f64,
    /// Newton steps at most; from a good guess it takes 3 to 5.
    pub iterations: usize,
    /// Number of pieces that an orbit is cut into, from 1 to its period. `None` cuts at every iterate, which is the
    /// least sensitive and lets all shots run side by side.
    pub segments: Option<usize>,
}

impl Default for NewtonOptions {
    fn default() -> Self {
        Self {
            tolerance: 1e-11,
            iterations: 18,
            segments: None,
        }
    }
}

/// Reason why there is no orbit, with the place that Newton's method came to.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NotFound {
    /// No place to begin with.
    #[error("an orbit needs one place per iterate, and none was given")]
    NoPlaces,
    /// A start that is no state of the map.
    #[error("place {place} of the start must hold {dimension} finite numbers")]
    BadPlace {
        /// Its index, from 0.
        place: usize,
        /// Length of a state.
        dimension: usize,
    },
    /// The residual stopped falling, or fell too slowly.
    #[error(
        "Newton's method came to a residual of {residual:.1e} in {iterations} steps and no further; \
         try a start nearer to the orbit"
    )]
    NotConverged {
        /// Steps taken.
        iterations: usize,
        /// Largest component of P(x_i) - x_(i+1).
        residual: f64,
        /// The last guess.
        places: Vec<MapPoint>,
    },
    /// The equations for a step have no unique solution.
    #[error(
        "the equations of Newton's method are singular at a residual of {residual:.1e}: \
         a fold or a branch point is near, or the derivative overflows"
    )]
    Singular {
        /// Largest component of P(x_i) - x_(i+1).
        residual: f64,
        /// The last guess.
        places: Vec<MapPoint>,
    },
    /// The map keeps a quantity, and an orbit with the value of the start was not found.
    #[error(
        "orbits lie in a family, since a quantity is kept along each motion, and none was found with the value that \
         it has at the start; try a start nearer to the orbit"
    )]
    OtherMember {
        /// An orbit with another value.
        places: Vec<MapPoint>,
    },
    /// The map has no image there.
    #[error("Newton's method left the map at a residual of {residual:.1e}: {reason}")]
    NoImage {
        /// The map's reason.
        reason: NoImage,
        /// Largest component of P(x_i) - x_(i+1); infinite at the start.
        residual: f64,
        /// The last guess that has images, or the start.
        places: Vec<MapPoint>,
    },
}

impl NotFound {
    /// Whether the work was stopped from outside.
    pub(crate) fn is_stop(&self) -> bool {
        let Self::NoImage { reason, .. } = self else {
            return false;
        };
        *reason == NoImage::Interrupted
    }
}
