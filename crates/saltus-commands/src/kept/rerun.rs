//! A result computed again, beside the one that was kept.

use super::Kept;
use crate::about::{about, solves};
use crate::context::Context;
use crate::failure::Failure;
use crate::request::{Answer, Request};
use crate::store::{Folder, Store, stream_json};
use saltus_results::{Comparison, compare};
use serde::Serialize;
use std::fs;
use std::io::{self, Write};
use std::path::Path;

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
    /// What was asked.
    pub request: Request,
    /// Whether all files are the same to the bit.
    pub identical: bool,
    /// File by file.
    #[serde(flatten)]
    pub comparison: Comparison,
    /// Why they may differ; empty if they do not, or no reason is known.
    pub reasons: Vec<String>,
    /// Where the new result is; nothing if it was removed.
    pub kept: Option<String>,
    /// Of the program that wrote the result.
    pub version_of_result: String,
    /// Of this program.
    pub version: &'static str,
}

impl Kept {
    /// Asks the same of the same study again and compares. The new result is kept in `out`; without it it lies in a
    /// temporary folder beside the old one until both are compared.
    ///
    /// # Errors
    /// [`Failure::Work`] if a file of the result is missing or altered, or the earlier result it began with is gone;
    /// others as [`Request::ask`] and [`Folder`].
    pub fn rerun(&self, out: Option<&Path>, context: &Context) -> Result<Rerun, Failure> {
        self.intact()?;
        self.origin_is_there()?;
        let Some(out) = out else {
            let beside = beside(&self.folder)?;
            return self.rerun_in(&beside.path().join(RESULT), context);
        };
        let real = |path: &Path| fs::canonicalize(path).ok();
        if real(out).is_some_and(|out| Some(out) == real(&self.folder)) {
            return Err(Failure::refused(
                format!("--out {} is the result itself", out.display()),
                "another folder, or none",
            ));
        }
        let rerun = self.rerun_in(out, context)?;
        let kept = Some(out.display().to_string());
        Ok(Rerun { kept, ..rerun })
    }

    fn rerun_in(&self, dir: &Path, context: &Context) -> Result<Rerun, Failure> {
        let request = &self.request;
        let study = request.study(&self.study)?;
        let stage = || {
            let folder = Folder::stage(dir, Some(request), &study, context)?;
            match self.has_parquet() {
                true => folder.with_parquet(),
                false => Ok(folder),
            }
        };
        // refused before a long computation
        drop(stage()?);
        let answer = request.ask(&study, context)?;
        let mut folder = stage()?;
        answer.store(request, &mut folder)?;
        folder.commit()?;
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

    /// Whether the tables were written as Parquet files too: nothing else in the manifest says so.
    fn has_parquet(&self) -> bool {
        let mut files = self.manifest.files.iter();
        files.any(|file| file.name.ends_with(".parquet"))
    }

    fn origin_is_there(&self) -> Result<(), Failure> {
        match &self.request {
            Request::Continue {
                origin: Some(origin),
            } if !origin.from.is_dir() => Err(Failure::work(
                format!(
                    "`{}` begins at {} of an earlier result, and `{}` is not there",
                    self.folder.display(),
                    origin.at,
                    origin.from.display()
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
        } = &self.request
        {
            let from = origin.from.display();
            reasons.push(format!("`{from}`, where it begins, may have changed since"));
        }
        reasons
    }
}

fn beside(folder: &Path) -> Result<tempfile::TempDir, Failure> {
    // `.` has no parent by name
    let parent = fs::canonicalize(folder).ok();
    let parent = parent.as_deref().and_then(Path::parent).unwrap_or(folder);
    let beside = tempfile::Builder::new()
        .prefix(".saltus-rerun-")
        .tempdir_in(parent);
    beside.map_err(|error| {
        let parent = parent.display();
        Failure::work(
            format!("the new result cannot wait in `{parent}` for its comparison: {error}"),
            "--out says where it may be kept",
        )
    })
}

impl Answer for Rerun {
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

    fn fill(&self, _: &mut dyn Store) -> Result<(), Failure> {
        Ok(())
    }

    fn shortfall(&self) -> Option<Failure> {
        let message = format!("computed again, `{}` is not the same bits", self.result);
        (!self.identical).then(|| Failure::computation(message))
    }
}
