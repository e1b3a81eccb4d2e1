//! A result that was kept in a folder: what was asked in it, whose methods it rests on, and whether it comes out again.

mod kept;
mod rerun;

pub use kept::KeptResult;
pub use rerun::Rerun;

use crate::citations::{Citation, works};
use crate::failure::{CommandError, told};
use crate::request::Request;
use saltus_config::Study;
use saltus_results::folder::MARKER;
use saltus_results::manifest::sha256;
use saltus_results::shown::path;
use saltus_results::{Manifest, ResultsError, ordinary};
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// Name of the study in the folder of a result.
const STUDY: &str = "study.toml";

/// What the manifest says of the answer: its text for people, and why a part of it is missing.
pub(crate) const SUMMARY: &str = "summary";
pub(crate) const SHORTFALL: &str = "shortfall";

/// Advice where a folder is not as it was.
const AGAIN: &str = "put the files back as they were, or compute the result anew";

/// A folder of results, read.
#[derive(Debug)]
pub struct SavedResult {
    folder: PathBuf,
    manifest: Manifest,
    request: Request,
    study: Study,
}

impl SavedResult {
    /// Reads the manifest and the study of a result: `result` is its folder, or a file in that.
    ///
    /// # Errors
    /// [`CommandError::Results`] if there is no result, or its manifest cannot be read; [`CommandError::Work`] if it is damaged,
    /// the study in it was altered, or is not one of this version; [`CommandError::Refused`] if no question was asked.
    pub fn open(result: &Path) -> Result<Self, CommandError> {
        let folder = home(result);
        let manifest = Manifest::read(&folder)?;
        let shown = path(&folder);
        let asked = &manifest.about["request"];
        if asked.is_null() {
            return Err(CommandError::refused(
                format!("`{shown}` answers no question: it holds a study alone"),
                "commands such as simulate and map write results by --out",
            ));
        }
        let request = Request::deserialize(asked).map_err(|error| {
            let version = &manifest.version;
            CommandError::work(
                format!("what was asked in `{shown}` by saltus {version} cannot be read: {error}"),
                "the version that wrote it can",
            )
        })?;
        let study = study(&folder, &manifest)?;
        Ok(Self {
            folder,
            manifest,
            request,
            study,
        })
    }

    /// Works that the result rests on. Methods are those of this version, which may not be the one that wrote it.
    pub fn citations(&self) -> Vec<Citation> {
        works(&self.request, &self.study, &self.manifest.version)
    }

    /// Its folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Version of the program that wrote it.
    pub fn version(&self) -> &str {
        &self.manifest.version
    }

    /// Whether all files are as they were written.
    fn intact(&self) -> Result<(), CommandError> {
        let problems = self.manifest.verify(&self.folder);
        if problems.is_empty() {
            return Ok(());
        }
        let list = told(&problems);
        let shown = path(&self.folder);
        Err(CommandError::work(
            format!(
                "`{shown}` is not as it was written, so it is not the result that was asked for:{list}"
            ),
            AGAIN,
        ))
    }
}

/// The folder of a result by the name of it or of a file in it.
fn home(path: &Path) -> PathBuf {
    let mut above = path.ancestors().skip(1).filter(|_| path.is_file());
    match above.find(|folder| folder.join(MARKER).is_file()) {
        Some(here) if here.as_os_str().is_empty() => PathBuf::from("."),
        Some(folder) => folder.to_path_buf(),
        None => path.to_path_buf(),
    }
}

/// The study of a result, if it is still that: another comment does no harm, another number does.
fn study(folder: &Path, manifest: &Manifest) -> Result<Study, CommandError> {
    let file = folder.join(STUDY);
    let bytes = ordinary::read(&file, ordinary::TEXT).map_err(|source| ResultsError::Io {
        action: "read",
        path: file.clone(),
        source,
    })?;
    let mut records = manifest.files.iter().filter(|file| file.name == STUDY);
    let same_bits = records.any(|record| record.sha256 == sha256(&bytes));
    let study = saltus_config::read(&file.display().to_string(), &bytes[..], &[]);
    match study {
        Ok(study) if same_bits || manifest.about["study_sha256"] == study.hash() => Ok(study),
        Err(error) if same_bits => Err(CommandError::work(
            format!(
                "`{}`, by saltus {}, is no study of this version: {error}",
                path(&file),
                manifest.version
            ),
            "the version that wrote it reads it",
        )),
        _ => Err(CommandError::work(
            format!(
                "`{}` was altered: it is not the study of this result",
                path(&file)
            ),
            AGAIN,
        )),
    }
}
