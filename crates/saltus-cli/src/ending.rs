//! Endings of the program: each failure, its exit code, and its message on standard error.
//!
//! | code | meaning |
//! |---|---|
//! | 0 | done |
//! | 1 | the computation failed |
//! | 2 | wrong usage, or a study file that says something impossible |
//! | 3 | a file, folder or standard output cannot be read or written; an answer is then kept elsewhere |
//! | 130 | interrupted (Ctrl-C) |
//! | 141 | the reader of standard output closed it (as `head` does); nothing is said |

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme};
use saltus_commands::CommandError;
use saltus_config::StudyErrorKind;
use saltus_results::ResultsError;
use saltus_results::shown::{path, printable_lines};
use std::fmt;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};

/// Shown below the help text.
pub(crate) const HELP: &str = "\
Start with:
  saltus reproduce                      every figure of the paper into ./results
  saltus init paper --out paper.toml    a study file of your own

Exit codes:
  0    done
  1    the computation failed; the message says where and what to try
  2    wrong usage, or something wrong in the study file or an override
  3    a file, folder or standard output cannot be read or written; an answer
       that was computed is then kept elsewhere, and the message says where
  130  interrupted (Ctrl-C); no half-written file is left
  141  the reader of standard output closed it (as `head` does); nothing is said";

/// Reasons why the program did not do its work.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Ending {
    /// Wrong usage, reported by the command line parser.
    #[error("wrong usage")]
    Usage,
    /// There is no answer.
    #[error(transparent)]
    CommandError(#[from] CommandError),
    /// Standard output refused.
    #[error("cannot write standard output: {0}")]
    Output(String),
    /// Standard output refused an answer that is nowhere else, and the folder where it is kept, if anywhere.
    #[error("cannot write standard output: {why}{}", kept(folder.as_deref()))]
    OutputElsewhere {
        /// The reason.
        why: String,
        /// Folder of the answer.
        folder: Option<PathBuf>,
    },
    /// The reader of standard output closed it.
    #[error("standard output was closed")]
    ClosedPipe,
}

impl From<ResultsError> for Ending {
    fn from(error: ResultsError) -> Self {
        CommandError::from(error).into()
    }
}

impl Ending {
    fn code(&self) -> u8 {
        match self {
            Self::Usage => 2,
            Self::CommandError(failure) => code(failure),
            Self::Output(_) | Self::OutputElsewhere { .. } => 3,
            Self::ClosedPipe => 141,
        }
    }
}

fn code(failure: &CommandError) -> u8 {
    match failure {
        CommandError::Lost(reason) | CommandError::Elsewhere { reason, .. } => code(reason),
        CommandError::Study(error) if error.kind() == StudyErrorKind::Unreadable => 3,
        CommandError::Computation { .. } | CommandError::Results(ResultsError::Png { .. }) => 1,
        CommandError::Study(_) | CommandError::Refused { .. } => 2,
        CommandError::Work { .. } | CommandError::Incomplete { .. } | CommandError::Results(_) => 3,
        CommandError::Interrupted | CommandError::Suspended { .. } => 130,
    }
}

fn kept(folder: Option<&Path>) -> String {
    folder.map_or(String::new(), |folder| {
        format!("; the whole answer is kept in `{}`", path(folder))
    })
}

/// A message, fit for a terminal: it may hold names and texts of others.
#[derive(Debug, thiserror::Error)]
#[error("{message}")]
struct Told {
    message: String,
    help: Option<String>,
}

impl Diagnostic for Told {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(self.help.as_ref()?))
    }
}

impl From<&Ending> for Told {
    fn from(ending: &Ending) -> Self {
        let help = match ending {
            Ending::CommandError(failure) => failure.help(),
            _ => None,
        };
        Self {
            message: printable_lines(&ending.to_string()),
            help: help.as_deref().map(printable_lines),
        }
    }
}

/// Reports a failure on standard error and gives the exit code.
pub(crate) fn finish(outcome: Result<(), Ending>) -> u8 {
    let Err(ending) = outcome else {
        return 0;
    };
    match &ending {
        Ending::Usage | Ending::ClosedPipe => {}
        // with the line of the file
        Ending::CommandError(CommandError::Study(error)) => tell(error),
        other => tell(&Told::from(other)),
    }
    ending.code()
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
    use super::{Ending, HELP};
    use saltus_commands::CommandError;

    #[test]
    fn every_code_is_in_the_help() {
        let computation = CommandError::Computation {
            message: "x".to_owned(),
            help: None,
        };
        for ending in [
            Ending::Usage,
            computation.into(),
            CommandError::refused("x", "y").into(),
            Ending::Output("x".to_owned()),
            CommandError::Interrupted.into(),
            CommandError::Suspended {
                folder: "x".into(),
                shard: true,
            }
            .into(),
            Ending::ClosedPipe,
        ] {
            assert!(
                HELP.contains(&format!("\n  {:<5}", ending.code())),
                "{ending}"
            );
        }
    }
}
