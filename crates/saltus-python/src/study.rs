//! Study files: checked as the program checks them.

use pyo3::prelude::*;

use crate::error::of_study;

/// Checks the text of a study file with overrides such as `jumper.mass=80`; `name` stands for it in messages.
#[pyfunction]
pub(crate) fn check_study(name: &str, text: &str, overrides: Vec<String>) -> PyResult<()> {
    match saltus_config::parse(name, text, &overrides) {
        Ok(_) => Ok(()),
        Err(problem) => Err(of_study(&problem)),
    }
}

/// The study of the paper, as the text of a study file.
#[pyfunction]
pub(crate) fn paper_template() -> String {
    saltus_config::paper_template()
}

/// The JSON schema of the study file.
#[pyfunction]
pub(crate) fn schema() -> String {
    saltus_config::schema().to_string()
}
