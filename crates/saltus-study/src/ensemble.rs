//! Common ground of all studies: running, stopping, reporting progress, and errors.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use saltus_hybrid::{BuildError, IntegrateError, Options};
use saltus_orbits::{ClimbError, ExponentError};

use crate::subject::Subject;

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
    /// Counts a period as done.
    pub fn count_period(&self) {
        self.done.fetch_add(1, Ordering::Relaxed);
    }
}

/// Answer of a study of subjects `S`.
pub type Outcome<T, S> = Result<T, StudyError<<S as Subject>::NoModel>>;

/// Errors of a study that has no answer; `E` is the reason why there is no system.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError<E: std::error::Error + 'static> {
    /// No model.
    #[error(transparent)]
    Model(E),
    /// No integration.
    #[error(transparent)]
    Integrate(#[from] IntegrateError),
    /// No exponents.
    #[error(transparent)]
    Exponents(#[from] ExponentError),
    /// No tangent flow.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// Attractors without anything by which they are told apart.
    #[error("attractors are told apart by the channels of a section, and this one has none")]
    NoSection,
}

impl<E: std::error::Error + 'static> From<ClimbError> for StudyError<E> {
    fn from(error: ClimbError) -> Self {
        match error {
            ClimbError::Exponent(error) => error.into(),
            ClimbError::Build(error) => error.into(),
            ClimbError::Integrate(error) => error.into(),
        }
    }
}

impl<E: std::error::Error + 'static> StudyError<E> {
    /// Whether the study was stopped from outside.
    pub fn is_interrupt(&self) -> bool {
        matches!(self, Self::Integrate(IntegrateError::Interrupted))
    }
}

/// An error of the engine or of the sink.
pub(crate) enum Refused<E> {
    Engine(IntegrateError),
    Sink(E),
}

impl<E> Refused<E> {
    pub(crate) fn into_error<N>(self) -> E
    where
        N: std::error::Error + 'static,
        E: From<StudyError<N>>,
    {
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
