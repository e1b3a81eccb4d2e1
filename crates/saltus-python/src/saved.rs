//! Results that were kept in folders: cited, and asked again.

use crate::error;
use crate::running::{Board, Listener, aside, attended};
use pyo3::prelude::*;
use saltus_commands::{RunContext, SavedResult, Told, bibtex};
use std::path::PathBuf;
use std::sync::Arc;

/// The works that a result rests on, as BibTeX.
#[pyfunction]
pub(crate) fn cite(py: Python<'_>, path: PathBuf) -> PyResult<String> {
    aside(py, move || {
        let kept = SavedResult::open(&path).map_err(|failure| error::of(&failure))?;
        Ok(bibtex(&kept.citations()))
    })
}

/// Computes a result again: whether it is the same to the bit, that in words, and the JSON document.
#[pyfunction]
#[pyo3(signature = (path, *, out=None, threads=0, progress=None))]
pub(crate) fn rerun(
    py: Python<'_>,
    path: PathBuf,
    out: Option<PathBuf>,
    threads: usize,
    progress: Listener,
) -> PyResult<(bool, String, String)> {
    let board: Arc<Board> = Arc::default();
    let watch = Arc::clone(&board);
    attended(py, &progress, &board, move |stop| {
        let context = RunContext {
            threads,
            stop: stop.clone(),
            watch: &*watch,
            keep: None,
            ..RunContext::default()
        };
        let rerun = SavedResult::open(&path).and_then(|kept| kept.rerun(out.as_deref(), &context));
        let rerun = rerun.map_err(|failure| error::of(&failure))?;
        let mut document = Vec::new();
        // a vector takes everything
        let _ = rerun.document(&mut document);
        let document = String::from_utf8(document).map_err(error::of_computation)?;
        Ok((rerun.identical, rerun.summary(), document))
    })
}
