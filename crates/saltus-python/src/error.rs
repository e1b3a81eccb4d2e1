//! What goes wrong in Rust, as the exceptions of `saltus._errors`.

use pyo3::import_exception;
use pyo3::prelude::*;
use saltus_config::StudyError as Problem;

import_exception!(saltus._errors, StudyError);
import_exception!(saltus._errors, DefinitionError);
import_exception!(saltus._errors, ComputationError);
import_exception!(saltus._errors, InternalError);

/// A study's problem with the key, what would be right, and the line; further ones follow in the text.
pub(crate) fn of_study(problem: &Problem) -> PyErr {
    let mut text = sentence(problem);
    for other in problem.others() {
        text.push('\n');
        text.push_str(&sentence(other));
    }
    let key = problem.key().map(str::to_owned);
    let advice = problem.advice().map(str::to_owned);
    StudyError::new_err((text, key, advice, problem.line()))
}

fn sentence(problem: &Problem) -> String {
    let line = problem.line().map(|line| format!("line {line}: "));
    let advice = problem.advice().map(|advice| format!(" ({advice})"));
    format!(
        "{}{problem}{}",
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
