//! How the program ends: what can go wrong, the exit code of each, and how it is told.
//!
//! | code | meaning |
//! |---|---|
//! | 0 | done |
//! | 1 | the computation failed |
//! | 2 | wrong usage, or a study file that says something impossible |
//! | 3 | a file, folder or standard output cannot be read or written |
//! | 130 | interrupted (Ctrl-C) |
//! | 141 | the reader of standard output closed it (as `head` does); nothing is said |

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme};
use saltus::hybrid::IntegrateError;
use saltus::model::ModelError;
use saltus::physics::PhysicsError;
use saltus::study::{OrbitError, StudyError as RunError};
use saltus_config::{StudyError, StudyErrorKind};
use saltus_results::ResultsError;
use std::fmt;
use std::io::{self, IsTerminal, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// Shown below the help text.
pub(crate) const HELP: &str = "\
Start with:
  saltus reproduce                      every figure of the paper into ./results
  saltus init paper --out paper.toml    a study file of your own

Exit codes:
  0    done
  1    the computation failed; the message says where and what to try
  2    wrong usage, or something wrong in the study file or an override
  3    a file, folder or standard output cannot be read or written
  130  interrupted (Ctrl-C); no half-written file is left
  141  standard output was closed by its reader (as `head` does); nothing is said";

/// Why a command did not do what was asked.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// Told by the command line parser.
    #[error("wrong usage")]
    Usage,
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
    /// A path or stream refused.
    #[error("cannot write {}: {reason}", path.display())]
    Write {
        /// Which.
        path: PathBuf,
        /// What the system said.
        reason: String,
    },
    /// A result that could not be drawn or stored.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// Whoever read standard output has stopped to.
    #[error("standard output was closed")]
    ClosedPipe,
    /// Ctrl-C.
    #[error("interrupted; nothing was written")]
    Interrupted,
    /// Ctrl-C during work that can go on later.
    #[error("interrupted; what is finished is kept in `{}`", folder.display())]
    Suspended {
        /// The work folder.
        folder: PathBuf,
    },
    /// A work folder that is in the way.
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
    pub(crate) fn refused(message: impl fmt::Display, help: impl Into<String>) -> Self {
        Self::Refused {
            message: message.to_string(),
            help: Some(help.into()),
        }
    }

    /// A path or stream that refused to be written.
    pub(crate) fn write(path: impl Into<PathBuf>, error: &io::Error) -> Self {
        let reason = match error.kind() {
            // of a file about to be made, so what is missing is the folder
            io::ErrorKind::NotFound => "there is no such folder".to_owned(),
            io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
            _ => error.to_string(),
        };
        Self::Write {
            path: path.into(),
            reason,
        }
    }

    /// A work folder that is in the way.
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

    fn code(&self) -> u8 {
        match self {
            Self::Lost(reason) => reason.code(),
            Self::Study(error) if error.kind() == StudyErrorKind::Unreadable => 3,
            Self::Computation { .. } | Self::Results(ResultsError::Png { .. }) => 1,
            Self::Usage | Self::Study(_) | Self::Refused { .. } => 2,
            Self::Write { .. } | Self::Work { .. } | Self::Results(_) => 3,
            Self::Interrupted | Self::Suspended { .. } => 130,
            Self::ClosedPipe => 141,
        }
    }
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

impl Diagnostic for Failure {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        match self {
            Self::Computation {
                help: Some(help), ..
            }
            | Self::Refused {
                help: Some(help), ..
            } => Some(Box::new(help)),
            Self::Work { help, .. } => Some(Box::new(help)),
            Self::Suspended { .. } => {
                Some(Box::new("the same command with --resume goes on with it"))
            }
            Self::Lost(reason) => reason.help(),
            _ => None,
        }
    }
}

/// Tells a failure on standard error and gives the exit code.
pub(crate) fn finish(outcome: Result<(), Failure>) -> ExitCode {
    let Err(failure) = outcome else {
        return ExitCode::SUCCESS;
    };
    match &failure {
        Failure::Usage | Failure::ClosedPipe => {}
        Failure::Study(error) => tell(error),
        other => tell(other),
    }
    ExitCode::from(failure.code())
}

/// Drawn on a terminal; plain, unwrapped and without colour for a file or a log.
fn tell(diagnostic: &dyn Diagnostic) {
    let terminal = io::stderr().is_terminal();
    let colour = terminal && std::env::var_os("NO_COLOR").is_none();
    let theme = match (terminal, colour) {
        (true, true) => GraphicalTheme::unicode(),
        (true, false) => GraphicalTheme::unicode_nocolor(),
        (false, _) => GraphicalTheme::none(),
    };
    let handler = GraphicalReportHandler::new_themed(theme).with_links(false);
    let handler = if terminal {
        handler.with_width(100)
    } else {
        handler.with_wrap_lines(false)
    };
    let mut text = String::from("Error:\n");
    if handler.render_report(&mut text, diagnostic).is_err() {
        text = format!("Error: {diagnostic}\n");
    }
    if !text.ends_with('\n') {
        text.push('\n');
    }
    // nobody is left to tell if standard error is closed
    let _ = io::stderr().write_all(text.as_bytes());
}

#[cfg(test)]
mod tests {
    use super::{Failure, HELP};

    #[test]
    fn every_code_is_in_the_help() {
        for failure in [
            Failure::Usage,
            Failure::computation("x"),
            Failure::refused("x", "y"),
            Failure::write("x", &std::io::Error::other("y")),
            Failure::work("x", "y"),
            Failure::Interrupted,
            Failure::Suspended { folder: "x".into() },
            Failure::Lost(Box::new(Failure::refused("x", "y"))),
            Failure::ClosedPipe,
        ] {
            assert!(
                HELP.contains(&format!("\n  {:<5}", failure.code())),
                "{failure}"
            );
        }
    }
}
