//! A result that was kept in a folder, with all of its files in memory.

use super::{SHORTFALL, SUMMARY, SavedResult};
use crate::citations::{bibtex, works};
use crate::failure::CommandError;
use crate::request::Request;
use saltus_config::Study;
use saltus_results::manifest::FileRecord;
use saltus_results::{Dataset, Manifest, ResultFolder, ResultsError, ordinary};
use std::path::Path;

/// A result as it was written: the bytes of its files, and what its manifest says.
#[derive(Clone, Debug)]
pub struct KeptResult {
    manifest: Manifest,
    request: Request,
    study: Study,
    files: Vec<(String, Vec<u8>)>,
}

impl SavedResult {
    /// Reads all files.
    ///
    /// # Errors
    /// [`CommandError::Work`] if a file is missing or altered, [`CommandError::Results`] if one cannot be read.
    pub fn read(self) -> Result<KeptResult, CommandError> {
        self.intact()?;
        let read = |file: &FileRecord| {
            let path = self.folder.join(&file.name);
            let bytes = ordinary::read(&path, file.bytes).map_err(|source| ResultsError::Io {
                action: "read",
                path,
                source,
            })?;
            Ok((file.name.clone(), bytes))
        };
        let files = self
            .manifest
            .files
            .iter()
            .map(read)
            .collect::<Result<_, ResultsError>>()?;
        Ok(KeptResult {
            manifest: self.manifest,
            request: self.request,
            study: self.study,
            files,
        })
    }
}

impl KeptResult {
    /// What was asked.
    pub fn request(&self) -> &Request {
        &self.request
    }

    /// The study it was asked about.
    pub fn study(&self) -> &Study {
        &self.study
    }

    /// Names and bytes of its files, in the order of writing; the manifest is not among them.
    pub fn files(&self) -> &[(String, Vec<u8>)] {
        &self.files
    }

    /// The answer in words; empty in a result of a version that did not keep them.
    pub fn summary(&self) -> &str {
        self.manifest.about[SUMMARY].as_str().unwrap_or_default()
    }

    /// Why a part of the answer is missing, if so.
    pub fn shortfall(&self) -> Option<&str> {
        self.manifest.about[SHORTFALL].as_str()
    }

    /// The JSON document.
    pub fn document(&self) -> &[u8] {
        self.file(&self.request.document())
    }

    /// Everything that was found.
    ///
    /// # Errors
    /// [`CommandError::Results`] if the file of arrays cannot be read.
    pub fn data(&self) -> Result<Dataset, CommandError> {
        Ok(Dataset::from_bytes(
            self.file(&self.request.dataset()).to_vec(),
        )?)
    }

    /// The works that it rests on, as BibTeX. Methods are those of this version.
    pub fn cite(&self) -> String {
        bibtex(&works(&self.request, &self.study, &self.manifest.version))
    }

    /// Writes it to the folder `dir` again, to the same bytes.
    ///
    /// # Errors
    /// [`CommandError::Results`] if the folder cannot be written or holds files of others.
    pub fn save(&self, dir: &Path) -> Result<(), CommandError> {
        let mut folder = ResultFolder::stage(dir)?;
        folder.copy_of(&self.manifest);
        for (name, bytes) in &self.files {
            folder.write(name, bytes)?;
        }
        folder.commit()?;
        Ok(())
    }

    fn file(&self, name: &str) -> &[u8] {
        let known = self.files.iter().find(|file| file.0 == name);
        known.map_or(&[], |file| &file.1)
    }
}
