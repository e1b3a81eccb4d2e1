//! Results that were kept in folders: cited, and asked again.

use crate::error;
use crate::running::{Board, Listener, attended};
use pyo3::prelude::*;
use saltus_commands::{Answer, Context, Failure, Kept, bibtex};
use std::path::PathBuf;

/// The works that a result rests on, as BibTeX.
#[pyfunction]
pub(crate) fn cite(path: PathBuf) -> PyResult<String> {
    let kept = Kept::open(&path).map_err(|failure| error::of(&failure))?;
    Ok(bibtex(&kept.citations()))
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
    let board = Board::default();
    let rerun = attended(py, &progress, &board, |stop| {
        let context = Context {
            threads,
            stop: stop.clone(),
            watch: &board,
            keep: None,
        };
        let rerun = Kept::open(&path)?.rerun(out.as_deref(), &context)?;
        let mut document = Vec::new();
        // a vector takes everything
        let _ = rerun.document(&mut document);
        Ok((rerun, document))
    })?;
    let (rerun, document) = rerun.map_err(|failure: Failure| error::of(&failure))?;
    let document = String::from_utf8(document).map_err(error::of_computation)?;
    Ok((rerun.identical, rerun.summary(), document))
}
