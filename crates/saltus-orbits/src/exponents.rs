//! Lyapunov exponents with their errors.
//!
//! Tangent columns follow a trajectory, are made orthonormal after every iterate, and the logarithms of the
//! factors by which that shortened them are kept [Benettin, Galgani, Giorgilli & Strelcyn 1980, Meccanica 15,
//! 9 and 21]. An exponent is their mean. The accuracy of a finite record is given in two ways: by a standard
//! error from batches, and by the weighted Birkhoff average, which on a torus is far better.

mod batches;
mod birkhoff;
mod orthonormal;
mod spectrum;
mod student;

pub use batches::Exponent;
pub use birkhoff::Weighted;
pub use spectrum::{Dimension, Running, Spectrum};

use crate::NoImage;

/// Reason why exponents cannot be measured.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ExponentError {
    /// More columns than directions, or none.
    #[error("{columns} tangent columns in dimension {dimension}: 1 to {dimension} would do")]
    Columns {
        /// Columns asked for.
        columns: usize,
        /// Length of the state.
        dimension: usize,
    },
    /// Numbers of the wrong count.
    #[error(
        "{got} numbers where {want} were expected: columns of the length of the state, one after another"
    )]
    Length {
        /// Number given.
        got: usize,
        /// Number needed.
        want: usize,
    },
    /// A tangent vector with an infinity or a NaN.
    #[error(
        "a tangent vector is not finite: the motion or its derivative has left the range of f64"
    )]
    NotFinite,
    /// Records that do not belong together.
    #[error("a record of {other} cannot be merged into one of {own}: both must be equal")]
    Unlike {
        /// Number and length of the columns of the record merged into.
        own: String,
        /// The same of the one to be merged.
        other: String,
    },
    /// The family answered without the derivative that was asked for.
    #[error("the family gave no derivative with {dimension} rows and columns")]
    NoDerivative {
        /// Length of the state.
        dimension: usize,
    },
    /// The trajectory ended.
    #[error("no image at iterate {iterate}")]
    NoImage {
        /// Iterates made before, transient included.
        iterate: usize,
        /// The reason.
        #[source]
        lost: NoImage,
    },
}
