//! Failures in Rust, as the exceptions of `saltus._errors`.

use std::any::Any;

use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::import_exception;
use pyo3::prelude::*;
use saltus_commands::CommandError;
use saltus_config::StudyError as Problem;
use saltus_results::ResultsError;

import_exception!(saltus._errors, StudyError);
import_exception!(saltus._errors, DefinitionError);
import_exception!(saltus._errors, ComputationError);
import_exception!(saltus._errors, ResultError);
import_exception!(saltus._errors, InternalError);

/// The exception of a question that has no answer.
pub(crate) fn of(failure: &CommandError) -> PyErr {
    let text = match failure.help() {
        Some(help) => format!("{failure} ({help})"),
        None => failure.to_string(),
    };
    match failure {
        CommandError::Study(problem) => of_study(problem, &[]),
        CommandError::Lost(reason) => of(reason),
        CommandError::Refused { help, .. } => {
            StudyError::new_err((text, None::<String>, help.clone(), None::<usize>))
        }
        CommandError::Computation { .. } | CommandError::Results(ResultsError::Png { .. }) => {
            of_computation(text)
        }
        CommandError::Results(_)
        | CommandError::Work { .. }
        | CommandError::Incomplete { .. }
        | CommandError::Elsewhere { .. } => ResultError::new_err((text,)),
        CommandError::Interrupted | CommandError::Suspended { .. } => {
            PyKeyboardInterrupt::new_err((text,))
        }
    }
}

/// A fault of a study with its key, advice and line; further ones follow in the text.
///
/// A message about an override begins with the option of the program; in Python it was an argument.
pub(crate) fn of_study(problem: &Problem, overrides: &[String]) -> PyErr {
    let mut text = sentence(problem, overrides);
    for other in problem.others() {
        text.push('\n');
        text.push_str(&sentence(other, overrides));
    }
    let key = problem.key().map(str::to_owned);
    let advice = problem.advice().map(str::to_owned);
    StudyError::new_err((text, key, advice, problem.line()))
}

fn sentence(problem: &Problem, overrides: &[String]) -> String {
    let said = problem.to_string();
    let option = |set: &String| said.strip_prefix(&format!("--set {set}: "));
    let said = overrides.iter().find_map(option).unwrap_or(&said);
    let line = problem.line().map(|line| format!("line {line}: "));
    let advice = problem.advice().map(|advice| format!(" ({advice})"));
    format!(
        "{}{said}{}",
        line.unwrap_or_default(),
        advice.unwrap_or_default()
    )
}

/// A system that cannot be, or numbers that do not fit it.
pub(crate) fn of_definition(reason: impl ToString) -> PyErr {
    DefinitionError::new_err((reason.to_string(),))
}

/// A question without an answer.
pub(crate) fn of_computation(reason: impl ToString) -> PyErr {
    ComputationError::new_err((reason.to_string(),))
}

/// The exception of a panic, with its message. PyO3's own is no subclass of `Exception`, so nobody would catch it.
pub(crate) fn broken(panic: &(dyn Any + Send)) -> PyErr {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let said = text.or(panic.downcast_ref::<&str>().copied());
    let text = format!(
        "saltus broke down ({}). This is an error of the program, not of your input: please report it with what \
         you called",
        said.unwrap_or("no message")
    );
    InternalError::new_err((text,))
}
