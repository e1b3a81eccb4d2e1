//! The place of an answer: the folder that was asked for, or another one if that fails when the answer is there.
//!
//! A disk fills up, is mounted anew for reading only, or somebody makes a folder of that name while hours of work are
//! under way. The answer is then written beside the folder or, if that fails too, where the system keeps temporary
//! files, and the failure says where.

use crate::about::about;
use crate::answer::Answer;
use crate::context::RunContext;
use crate::failure::CommandError;
use crate::request::Request;
use crate::store::Folder;
use saltus_config::Study;
use saltus_results::ResultsError;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// A folder of results to be.
pub struct Destination<'a> {
    /// The question.
    pub request: &'a Request,
    /// Its study, as [`Request::study`] gives it.
    pub study: &'a Study,
    /// The run.
    pub context: &'a RunContext<'a>,
}

impl Destination<'_> {
    /// Refuses `dir` before a long computation if it cannot be written, and leaves it as it was.
    ///
    /// # Errors
    /// As [`Folder::stage`].
    pub fn try_out(&self, dir: &Path) -> Result<(), CommandError> {
        self.stage(dir).map(drop)
    }

    /// Writes all of `answer` to `dir`.
    ///
    /// # Errors
    /// [`CommandError::Elsewhere`] if that is not possible but another place was; what is wrong with `dir` if none was;
    /// [`CommandError::Interrupted`] or [`CommandError::Suspended`] if the work must stop.
    pub fn store(&self, dir: &Path, answer: &dyn Answer) -> Result<(), CommandError> {
        let beside = dir.parent().unwrap_or(dir);
        let here = beside.as_os_str().is_empty();
        let beside = if here { Path::new(".") } else { beside };
        self.store_or_keep_in(&[beside, &std::env::temp_dir()], dir, answer)
    }

    /// As [`Self::store`] with other places to try, in this order.
    pub(crate) fn store_or_keep_in(
        &self,
        places: &[&Path],
        dir: &Path,
        answer: &dyn Answer,
    ) -> Result<(), CommandError> {
        let Err(failure) = self.write(dir, answer) else {
            return Ok(());
        };
        match (failure, answer.pieces()) {
            (CommandError::Interrupted, Some(pieces)) => Err(CommandError::Suspended {
                folder: pieces.to_path_buf(),
                shard: false,
            }),
            (CommandError::Results(reason), _) if is_of_place(&reason) => {
                let mut name = dir.file_name().unwrap_or("results".as_ref()).to_owned();
                name.push("-kept-");
                let mut kept = places
                    .iter()
                    .filter_map(|place| self.keep_in(place, &name, answer).ok());
                let reason = CommandError::Results(reason);
                Err(match kept.next() {
                    Some(folder) => CommandError::Elsewhere {
                        reason: Box::new(reason),
                        folder,
                    },
                    None => reason,
                })
            }
            (failure, _) => Err(failure),
        }
    }

    /// Writes all of `answer` to a new folder among the temporary files of the system, and says where.
    ///
    /// # Errors
    /// [`CommandError`] if that is not possible.
    pub fn keep(&self, answer: &dyn Answer) -> Result<PathBuf, CommandError> {
        let name = format!("saltus-{}-kept-", self.request.name());
        self.keep_in(&std::env::temp_dir(), &name.into(), answer)
    }

    fn keep_in(
        &self,
        home: &Path,
        name: &OsString,
        answer: &dyn Answer,
    ) -> Result<PathBuf, CommandError> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(name);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // as readable as any folder of the user
            builder.permissions(std::fs::Permissions::from_mode(0o777));
        }
        let folder = builder
            .tempdir_in(home)
            .map_err(|source| ResultsError::Io {
                action: "write in the folder",
                path: home.to_path_buf(),
                source,
            })?;
        self.write(folder.path(), answer)?;
        Ok(folder.keep())
    }

    fn write(&self, dir: &Path, answer: &dyn Answer) -> Result<(), CommandError> {
        let mut folder = self.stage(dir)?;
        answer.store(self.request, &mut folder)?;
        folder.commit().map(drop)
    }

    fn stage(&self, dir: &Path) -> Result<Folder, CommandError> {
        let about = about(self.request, self.study);
        Folder::stage(dir, Some(about), self.study, self.context)
    }
}

/// Whether another place may do what this one did not.
fn is_of_place(reason: &ResultsError) -> bool {
    matches!(
        reason,
        ResultsError::Io { .. }
            | ResultsError::ForeignFolder { .. }
            | ResultsError::WrongKind { .. }
            | ResultsError::Table { .. }
    )
}
