//! Common ground of all studies: running, stopping, reporting progress, and errors.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use saltus_hybrid::{IntegrateError, Options};
use saltus_orbits::ExponentError;

use crate::model::ModelError;

/// Settings of a run, beside the question it asks.
#[derive(Clone, Debug, Default)]
pub struct Control {
    /// Stepper and its limits.
    pub options: Options,
    /// Threads; 0 for as many as the machine has. Results do not depend on it.
    pub threads: usize,
    /// Raise it to stop the study at its next step.
    pub stop: Arc<AtomicBool>,
    /// Periods done so far by all trajectories, for a progress display.
    pub done: Arc<AtomicU64>,
}

impl Control {
    pub(crate) fn count_period(&self) {
        self.done.fetch_add(1, Ordering::Relaxed);
    }
}

/// Errors of a study that has no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// No model.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// No integration.
    #[error(transparent)]
    Integrate(#[from] IntegrateError),
    /// No exponents.
    #[error(transparent)]
    Exponents(#[from] ExponentError),
    /// Attractors of an empty plate.
    #[error(
        "attractors are told apart by how people move, and nobody is on the plate; it needs a jumper"
    )]
    NobodyMoves,
}

impl From<saltus_orbits::ClimbError> for StudyError {
    fn from(error: saltus_orbits::ClimbError) -> Self {
        match error {
            saltus_orbits::ClimbError::Exponent(error) => error.into(),
            saltus_orbits::ClimbError::Build(error) => ModelError::from(error).into(),
            saltus_orbits::ClimbError::Integrate(error) => error.into(),
        }
    }
}

impl From<crate::physics::PhysicsError> for StudyError {
    fn from(error: crate::physics::PhysicsError) -> Self {
        Self::Model(error.into())
    }
}

impl StudyError {
    /// Whether the study was stopped from outside.
    pub fn is_interrupt(&self) -> bool {
        matches!(self, Self::Integrate(IntegrateError::Interrupted))
    }
}

/// An error of the engine or of the sink.
pub(super) enum Refused<E> {
    Engine(IntegrateError),
    Sink(E),
}

impl<E: From<StudyError>> Refused<E> {
    pub(super) fn into_error(self) -> E {
        match self {
            Self::Engine(error) => StudyError::from(error).into(),
            Self::Sink(error) => error,
        }
    }
}

impl<E> From<IntegrateError> for Refused<E> {
    fn from(error: IntegrateError) -> Self {
        Self::Engine(error)
    }
}
