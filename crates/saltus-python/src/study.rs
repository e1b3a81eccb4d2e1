//! Studies: checked and resolved as the program does it.

use pyo3::prelude::*;
use saltus_config::{Study, StudyError};
use std::path::PathBuf;

use crate::error::{of, of_study};
use crate::running::{aside, sound};

/// A study in the forms that Python needs: JSON with every default written out, the same as TOML, its hash.
type Resolved = (String, String, String);

fn resolved(
    study: impl FnOnce() -> Result<Study, StudyError>,
    overrides: &[String],
) -> PyResult<Resolved> {
    sound(|| {
        let study = study().map_err(|problem| of_study(&problem, overrides))?;
        Ok((study.to_json(), study.to_toml(), study.hash()))
    })
}

/// Checks the study in a JSON text, with overrides such as `jumper.mass=80`.
#[pyfunction]
pub(crate) fn resolve(json: &str, overrides: Vec<String>) -> PyResult<Resolved> {
    resolved(|| Study::from_json(json, &overrides), &overrides)
}

/// Checks the study in a file, with overrides.
#[pyfunction]
pub(crate) fn load(py: Python<'_>, path: PathBuf, overrides: Vec<String>) -> PyResult<Resolved> {
    aside(py, move || {
        resolved(|| saltus_config::load(path, &overrides), &overrides)
    })
}

/// Checks the study in the text of a study file, with overrides; `name` stands for it in messages.
#[pyfunction]
pub(crate) fn parse(name: &str, text: &str, overrides: Vec<String>) -> PyResult<Resolved> {
    resolved(|| saltus_config::parse(name, text, &overrides), &overrides)
}

/// The study of the paper.
#[pyfunction]
pub(crate) fn paper() -> PyResult<Resolved> {
    resolved(|| Ok(Study::paper()), &[])
}

/// The commented study file of the paper's case.
#[pyfunction]
pub(crate) fn paper_template() -> String {
    saltus_config::paper_template()
}

/// The description of a study in words, and warnings of values that are probably not meant.
#[pyfunction]
pub(crate) fn describe(py: Python<'_>, json: String) -> PyResult<(String, Vec<String>)> {
    aside(py, move || {
        let study = Study::from_json(&json, &[]).map_err(|problem| of_study(&problem, &[]))?;
        let text = saltus_commands::describe(&study).map_err(|failure| of(&failure))?;
        Ok((text, saltus_commands::warnings(&study)))
    })
}

/// The JSON Schema of the study file.
#[pyfunction]
pub(crate) fn schema() -> String {
    saltus_config::schema().to_string()
}
