//! Why a question has no answer.

use crate::shard::DefectivePiece;
use saltus::hybrid::IntegrateError;
use saltus::model::ModelError;
use saltus::physics::PhysicsError;
use saltus::study::{OrbitError, StudyError as RunError};
use saltus_config::StudyError;
use saltus_results::ResultsError;
use saltus_results::shown::path;
use std::fmt;
use std::path::PathBuf;

/// Why a command did not do what was asked.
#[derive(Debug, thiserror::Error)]
pub enum CommandError {
    /// Something wrong with the study.
    #[error("{0}")]
    Study(#[from] StudyError),
    /// The study is sound in itself, but cannot be used for what was asked.
    #[error("{message}")]
    Refused {
        /// Description of the fault.
        message: String,
        /// Advice: a value that would be right.
        help: Option<String>,
    },
    /// The study is sound, but the computation did not get through.
    #[error("{message}")]
    Computation {
        /// Description of the failure.
        message: String,
        /// Advice: something to try.
        help: Option<String>,
    },
    /// A result that could not be drawn or stored.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// Stopped from outside.
    #[error("interrupted; nothing was written")]
    Interrupted,
    /// Stopped from outside during work that can go on later.
    #[error("interrupted; what is finished is kept in `{}`", path(folder))]
    Suspended {
        /// The work folder.
        folder: PathBuf,
        /// Whether it was a shard, which goes on by itself.
        shard: bool,
    },
    /// Pieces to be put together are not all there and whole.
    #[error("{}:{}", counted(lacks, *pieces), list(lacks))]
    Incomplete {
        /// Faults, piece by piece.
        lacks: Vec<DefectivePiece>,
        /// How many pieces there should be.
        pieces: u32,
    },
    /// A folder of work or results that is in the way, or not what it should be.
    #[error("{message}")]
    Work {
        /// Description of the fault.
        message: String,
        /// Advice.
        help: &'static str,
    },
    /// All parts of a long computation failed; the reason is that of the first.
    #[error(transparent)]
    Lost(Box<CommandError>),
    /// The place for an answer failed when it was there. It is kept whole in another.
    #[error("{reason}; the whole answer is kept in `{}` instead", path(folder))]
    Elsewhere {
        /// Why it is not where it should be.
        reason: Box<CommandError>,
        /// Its folder.
        folder: PathBuf,
    },
}

impl CommandError {
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

    /// Advice, where there is some.
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
            Self::Incomplete { lacks, .. } if lacks.iter().all(|lack| lack.beyond.is_some()) => Some(
                "remove what is too many, or give --resume instead of --merge: it is then left aside"
                    .to_owned(),
            ),
            Self::Incomplete { .. } => Some(
                "run these shards again, or give --resume instead of --merge to compute them here"
                    .to_owned(),
            ),
            Self::Study(error) => error.advice().map(str::to_owned),
            Self::Lost(reason) => reason.help(),
            Self::Elsewhere { .. } => Some(
                "move it to where it belongs; `saltus cite` and `saltus rerun` take it from there too"
                    .to_owned(),
            ),
            Self::Results(_) | Self::Interrupted => None,
        }
    }
}

fn counted(lacks: &[DefectivePiece], pieces: u32) -> String {
    match lacks.iter().filter(|lack| lack.beyond.is_none()).count() {
        0 => format!("not every file is one of the {pieces} pieces"),
        lacking => format!("{lacking} of {pieces} pieces are not there as they should be"),
    }
}

/// One line each.
fn list(lacks: &[DefectivePiece]) -> String {
    lacks.iter().map(|lack| format!("\n  {lack}")).collect()
}

/// Most problems in a list: one for people has an end.
const TOLD: usize = 20;

/// One line each, and how many more there are.
pub(crate) fn told<T: fmt::Display>(problems: &[T]) -> String {
    let mut text: String = problems
        .iter()
        .take(TOLD)
        .map(|p| format!("\n  {p}"))
        .collect();
    if let more @ 1.. = problems.len().saturating_sub(TOLD) {
        text += &format!("\n  and {more} more");
    }
    text
}

impl From<RunError> for CommandError {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Integrate(IntegrateError::Interrupted) => Self::Interrupted,
            RunError::Model(error) => error.into(),
            other => Self::computation(other),
        }
    }
}

impl From<OrbitError> for CommandError {
    fn from(error: OrbitError) -> Self {
        match error {
            error if error.is_interrupt() => Self::Interrupted,
            OrbitError::Study(error) => error.into(),
            other => Self::computation(other),
        }
    }
}

impl From<PhysicsError> for CommandError {
    fn from(error: PhysicsError) -> Self {
        match error {
            PhysicsError::Interrupted => Self::Interrupted,
            other => Self::computation(other),
        }
    }
}

impl From<ModelError> for CommandError {
    /// Algebra that fails is a failed computation; all else is a study that says something impossible.
    fn from(error: ModelError) -> Self {
        let message = error.to_string();
        match error {
            ModelError::Physics(PhysicsError::Interrupted) => Self::Interrupted,
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
