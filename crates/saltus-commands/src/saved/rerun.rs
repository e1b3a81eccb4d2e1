//! A result computed again, beside the one that was kept.

use super::SavedResult;
use crate::about::{about, solves};
use crate::answer::{Answer, Told, stream_json};
use crate::context::RunContext;
use crate::destination::Destination;
use crate::failure::CommandError;
use crate::request::Request;
use saltus_results::shown::{path, printable};
use saltus_results::{Comparison, Staging, compare};
use serde::Serialize;
use std::fs;
use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;

/// Name of the new result in its temporary folder.
const RESULT: &str = "result";

/// How a result compares with the same question asked again. As an answer it has no parts: those are in the folders.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct Rerun {
    /// `rerun`.
    pub command: &'static str,
    /// Folder of the result.
    pub result: String,
    /// The question.
    pub request: Request,
    /// Whether all files are the same to the bit.
    pub identical: bool,
    /// File by file.
    #[serde(flatten)]
    pub comparison: Comparison,
    /// Why they may differ; empty if they do not, or no reason is known.
    pub reasons: Vec<String>,
    /// Folder of the new result; nothing if it was removed.
    pub kept: Option<String>,
    /// Of the program that wrote the result.
    pub version_of_result: String,
    /// Of this program.
    pub version: &'static str,
}

impl SavedResult {
    /// Asks the same of the same study again and compares. The new result is kept in `out`; without it it lies in a
    /// temporary folder beside the old one until both are compared.
    ///
    /// # Errors
    /// [`CommandError::Work`] if a file of the result is missing or altered, or the earlier result it began with is gone;
    /// others as [`Request::ask`] and [`Destination`].
    pub fn rerun(&self, out: Option<&Path>, context: &RunContext) -> Result<Rerun, CommandError> {
        self.intact()?;
        self.origin_is_there()?;
        let Some(out) = out else {
            let beside = beside(&self.folder)?;
            let dir = &beside.path().join(RESULT);
            // what is kept beside it would go away with it
            let temporary = std::env::temp_dir();
            let keep = [temporary.as_path()];
            return self.rerun_in(dir, context, |place, answer| {
                place.store_or_keep_in(&keep, dir, answer)
            });
        };
        let real = |folder: &Path| fs::canonicalize(folder).ok();
        if real(out).is_some_and(|out| Some(out) == real(&self.folder)) {
            return Err(CommandError::refused(
                format!("--out {} is the result itself", path(out)),
                "another folder, or none",
            ));
        }
        let rerun = self.rerun_in(out, context, |place, answer| place.store(out, answer))?;
        let kept = Some(out.display().to_string());
        Ok(Rerun { kept, ..rerun })
    }

    fn rerun_in(
        &self,
        dir: &Path,
        context: &RunContext,
        store: impl Fn(&Destination, &dyn Answer) -> Result<(), CommandError>,
    ) -> Result<Rerun, CommandError> {
        let request = &self.request;
        let study = request.study(&self.study)?;
        // figures are drawn as they were
        let figures = serde_json::from_value(self.manifest.about["figures"].clone());
        let context = &RunContext {
            threads: context.threads,
            stop: Arc::clone(&context.stop),
            watch: context.watch,
            keep: context.keep.clone(),
            figures: figures.unwrap_or_default(),
        };
        let destination = Destination {
            request,
            study: &study,
            context,
        };
        destination.try_out(dir)?;
        let answer = request.ask(&study, context)?;
        store(&destination, answer.as_ref())?;
        let comparison = compare(&self.folder, dir)?;
        let identical = comparison.identical();
        Ok(Rerun {
            command: "rerun",
            result: self.folder.display().to_string(),
            request: request.clone(),
            identical,
            comparison,
            reasons: if identical { vec![] } else { self.reasons() },
            kept: None,
            version_of_result: self.manifest.version.clone(),
            version: env!("CARGO_PKG_VERSION"),
        })
    }

    fn origin_is_there(&self) -> Result<(), CommandError> {
        match &self.request {
            Request::Continue {
                origin: Some(origin),
                ..
            } if !origin.from.is_dir() => Err(CommandError::work(
                format!(
                    "`{}` begins at {} of an earlier result, and `{}` is not there",
                    path(&self.folder),
                    printable(&origin.at),
                    path(&origin.from)
                ),
                "a path that does not begin with / is sought from the folder in which this runs",
            )),
            _ => Ok(()),
        }
    }

    /// Why the bits may not be the same.
    fn reasons(&self) -> Vec<String> {
        let mut reasons = Vec::new();
        let (then, now) = (&self.manifest.version, env!("CARGO_PKG_VERSION"));
        if then != now {
            reasons.push(format!("the result is of saltus {then}, this is {now}"));
        }
        let arithmetic = |about: &serde_json::Value| {
            let word = |key: &str| about["arithmetic"][key].as_str().map(str::to_owned);
            let fused = word("multiply_adds")?;
            Some(format!(
                "{} with multiply-adds {fused}",
                word("architecture")?
            ))
        };
        let now = arithmetic(&about(&self.request, &self.study));
        if let (Some(then), Some(now)) = (arithmetic(&self.manifest.about), now)
            && then != now
        {
            reasons.push(format!(
                "the result was computed on {then}, now it was on {now}"
            ));
        }
        if solves(&self.request) {
            let name = self.request.name();
            reasons.push(format!(
                "with another number of threads `{name}` agrees to rounding only"
            ));
        }
        if let Request::Continue {
            origin: Some(origin),
            ..
        } = &self.request
        {
            let from = path(&origin.from);
            reasons.push(format!("`{from}`, where it begins, may have changed since"));
        }
        reasons
    }
}

fn beside(folder: &Path) -> Result<Staging, CommandError> {
    // `.` has no parent by name
    let parent = fs::canonicalize(folder).ok();
    let parent = parent.as_deref().and_then(Path::parent).unwrap_or(folder);
    Staging::folder(parent, folder).map_err(|error| {
        let parent = path(parent);
        CommandError::work(
            format!("the new result cannot wait in `{parent}` for its comparison: {error}"),
            "--out says where it may be kept",
        )
    })
}

impl Told for Rerun {
    fn summary(&self) -> String {
        let Self {
            version_of_result: then,
            version: now,
            ..
        } = self;
        let (name, result) = (self.request.name(), &self.result);
        let mut text = format!("`{result}`: {name} by saltus {then}, again by saltus {now}\n");
        if self.identical {
            let count = self.comparison.files.len();
            text += &format!("Same bits: all {count} files.\n");
        } else {
            text += &self.comparison.text();
            text += "Known reasons for differences:\n";
            for reason in &self.reasons {
                text += &format!("- {reason}\n");
            }
            if self.reasons.is_empty() {
                text += "- none: same version, same arithmetic. Please report it\n";
            }
        }
        if let Some(kept) = &self.kept {
            text += &format!("The new result is in `{kept}`.\n");
        }
        text
    }

    fn document(&self, to: &mut dyn Write) -> io::Result<()> {
        stream_json(to, self)
    }
}

impl Rerun {
    /// Why the result is not what it was, if so.
    pub fn shortfall(&self) -> Option<CommandError> {
        let message = format!("computed again, `{}` is not the same bits", self.result);
        (!self.identical).then(|| CommandError::computation(message))
    }
}
