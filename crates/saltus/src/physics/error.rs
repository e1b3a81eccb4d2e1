//! Faults of a physical description.

/// A physical quantity that makes no sense, named as in the study file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PhysicsError {
    /// A number outside its range.
    #[error("{field} = {value}: {expected}")]
    OutOfRange {
        /// Key as in the study file, such as `plate.thickness` or `jumper.0.mass`.
        field: String,
        /// The value given.
        value: f64,
        /// Numbers that would be right, in words.
        expected: &'static str,
    },
    /// A list of modes that no plate can be built from.
    #[error("plate.modes: {reason}")]
    Modes {
        /// Fault, and the remedy.
        reason: String,
    },
    /// A jumper that is not on the plate.
    #[error(
        "jumper.{index}: the position ({x}, {y}) m is outside the plate, \
         0 < x < {length}, 0 < y < {width}"
    )]
    OffThePlate {
        /// Number of the jumper, from 0.
        index: usize,
        /// Position (m).
        x: f64,
        /// Position (m).
        y: f64,
        /// Plate length a (m).
        length: f64,
        /// Plate width b (m).
        width: f64,
    },
    /// A frequency that exists only with a person on the plate.
    #[error(
        "base: the {reference} frequency is that of the first jumper, and there is none; \
         add a jumper, or give the frequency in hertz or relative to the plate"
    )]
    NeedsJumper {
        /// The reference asked for, as in the study file.
        reference: &'static str,
    },
    /// An iteration that did not reach its tolerance.
    #[error(
        "the {what} did not converge: after {iterations} iterations it had reached {reached} \
         of the load; is the load in SI units?"
    )]
    NotConverged {
        /// Name of the computation.
        what: &'static str,
        /// Newton iterations spent.
        iterations: u32,
        /// Largest fraction of the load for which an equilibrium was found (-).
        reached: f64,
    },
    /// More people than one plate is computed with.
    #[error("jumper: {count} were given, at most {most} are possible")]
    TooManyJumpers {
        /// Number given.
        count: usize,
        /// Largest number possible.
        most: usize,
    },
    /// Stopped from outside.
    #[error("interrupted")]
    Interrupted,
    /// A linear-algebra step that failed on this input.
    #[error("the {what} could not be computed: {reason}")]
    Algebra {
        /// Name of the computation.
        what: &'static str,
        /// Report of the solver.
        reason: String,
    },
}

impl PhysicsError {
    /// `Ok` if `value` is finite and `ok`, else an [`PhysicsError::OutOfRange`].
    pub(crate) fn require(
        ok: bool,
        field: impl Into<String>,
        value: f64,
        expected: &'static str,
    ) -> Result<(), Self> {
        if ok && value.is_finite() {
            Ok(())
        } else {
            Err(Self::OutOfRange {
                field: field.into(),
                value,
                expected,
            })
        }
    }
}
