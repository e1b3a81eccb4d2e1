//! Why a question has no answer.

use crate::pieces::Lack;
use saltus::hybrid::IntegrateError;
use saltus::model::ModelError;
use saltus::physics::PhysicsError;
use saltus::study::{OrbitError, StudyError as RunError};
use saltus_config::StudyError;
use saltus_results::ResultsError;
use std::fmt;
use std::path::PathBuf;

/// Why a command did not do what was asked.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// Something wrong with the study.
    #[error("{0}")]
    Study(#[from] StudyError),
    /// The study is sound in itself, but cannot be used for what was asked.
    #[error("{message}")]
    Refused {
        /// What is wrong.
        message: String,
        /// What would be right.
        help: Option<String>,
    },
    /// The study is sound, but the computation did not get through.
    #[error("{message}")]
    Computation {
        /// What failed.
        message: String,
        /// What to try.
        help: Option<String>,
    },
    /// A result that could not be drawn or stored.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// Stopped from outside.
    #[error("interrupted; nothing was written")]
    Interrupted,
    /// Stopped from outside during work that can go on later.
    #[error("interrupted; what is finished is kept in `{}`", folder.display())]
    Suspended {
        /// The work folder.
        folder: PathBuf,
        /// Whether it was a shard, which goes on by itself.
        shard: bool,
    },
    /// Pieces that shall be put together are not all there and whole.
    #[error("{} of {pieces} pieces are not there as they should be:{}", lacks.len(), list(lacks))]
    Incomplete {
        /// What is wrong, piece by piece.
        lacks: Vec<Lack>,
        /// How many pieces there should be.
        pieces: u32,
    },
    /// A folder of work or results that is in the way, or not what it should be.
    #[error("{message}")]
    Work {
        /// What is wrong with it.
        message: String,
        /// What to do.
        help: &'static str,
    },
    /// All parts of a long computation failed; the reason is that of the first.
    #[error(transparent)]
    Lost(Box<Failure>),
}

impl Failure {
    /// A failed computation.
    pub(crate) fn computation(message: impl fmt::Display) -> Self {
        Self::Computation {
            message: message.to_string(),
            help: None,
        }
    }

    /// A study that does not fit the command.
    pub fn refused(message: impl fmt::Display, help: impl Into<String>) -> Self {
        Self::Refused {
            message: message.to_string(),
            help: Some(help.into()),
        }
    }

    /// A folder that is in the way.
    pub(crate) fn work(message: impl fmt::Display, help: &'static str) -> Self {
        Self::Work {
            message: message.to_string(),
            help,
        }
    }

    /// The same with what to try, if it is a computation that failed.
    pub(crate) fn advise(self, advice: impl Into<String>) -> Self {
        match self {
            Self::Computation { message, .. } => Self::Computation {
                message,
                help: Some(advice.into()),
            },
            other => other,
        }
    }

    /// What to try, where something is known.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Computation { help, .. } | Self::Refused { help, .. } => help.clone(),
            Self::Work { help, .. } => Some((*help).to_owned()),
            Self::Suspended { shard: true, .. } => {
                Some("the same command goes on with it".to_owned())
            }
            Self::Suspended { shard: false, .. } => {
                Some("the same command with --resume goes on with it".to_owned())
            }
            Self::Incomplete { .. } => Some(
                "run these shards again, or give --resume instead of --merge to compute them here"
                    .to_owned(),
            ),
            Self::Study(error) => error.advice().map(str::to_owned),
            Self::Lost(reason) => reason.help(),
            Self::Results(_) | Self::Interrupted => None,
        }
    }
}

/// One line each.
fn list(lacks: &[Lack]) -> String {
    lacks.iter().map(|lack| format!("\n  {lack}")).collect()
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Integrate(IntegrateError::Interrupted) => Self::Interrupted,
            RunError::Model(error) => error.into(),
            other => Self::computation(other),
        }
    }
}

impl From<OrbitError> for Failure {
    fn from(error: OrbitError) -> Self {
        match error {
            error if error.is_interrupt() => Self::Interrupted,
            OrbitError::Study(error) => error.into(),
            other => Self::computation(other),
        }
    }
}

impl From<ModelError> for Failure {
    /// Algebra that fails is a failed computation; all else is a study that says something impossible.
    fn from(error: ModelError) -> Self {
        let message = error.to_string();
        match error {
            ModelError::Physics(
                PhysicsError::Algebra { .. } | PhysicsError::NotConverged { .. },
            ) => Self::computation(message),
            _ => Self::Refused {
                message,
                help: None,
            },
        }
    }
}
