//! Two results side by side: files of the same bits, and the largest differences of the others.
//!
//! A result that is computed again on another machine may round otherwise. So a table, a dataset or a
//! report that is not the same is read, and its largest difference is reported with its place. The reader
//! judges whether it matters.

mod json;
mod lines;
mod netcdf;
mod table;
mod tally;

pub use tally::{Difference, Largest, Mismatch};

use crate::folder::MARKER;
use crate::{Manifest, ResultsError};
use serde::Serialize;
use std::fmt;
use std::fs::{self, File};
use std::io::{self, BufRead, BufReader};
use std::path::Path;

/// Comparison of two result folders.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Comparison {
    /// Every file of either result, in the order of the first one; the manifest comes last.
    pub files: Vec<FileComparison>,
}

/// One file of two results.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct FileComparison {
    /// Path within the folders.
    pub name: String,
    /// Outcome of the comparison.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// Outcome of the comparison of one file.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "outcome", rename_all = "snake_case")]
#[non_exhaustive]
pub enum Outcome {
    /// The same bits.
    Identical,
    /// It is not in the second result.
    Missing,
    /// It is not in the first result.
    Extra,
    /// Other bits that say the same: the numbers and texts within are all equal.
    WrittenDifferently,
    /// Other numbers or texts: the differences of each part of the file. A table or a report is one part, a
    /// dataset has one for each variable.
    Different {
        /// The parts that differ.
        differences: Vec<Difference>,
    },
    /// A figure with other bits.
    DrawnDifferently,
    /// A file with other bits that cannot be looked into, and why.
    OtherBytes {
        /// The reason, as "not a table: ..."; empty for files of an unknown kind.
        reason: String,
    },
}

/// Compares the result folder `second` with the result folder `first`, file by file.
///
/// The files are those that the manifests name. NaN equals NaN. Tables are read side by side, line by line;
/// a report and a variable of a dataset are in memory twice while they are compared.
///
/// # Errors
/// As [`Manifest::read`], for either folder, and [`ResultsError::Io`] if a file is there and cannot be read.
pub fn compare(first: &Path, second: &Path) -> Result<Comparison, ResultsError> {
    let (ours, theirs) = (Manifest::read(first)?, Manifest::read(second)?);
    let mut names: Vec<&str> = Vec::new();
    for file in ours.files.iter().chain(&theirs.files) {
        if !names.contains(&file.name.as_str()) {
            names.push(&file.name);
        }
    }
    let file = |name: &str| {
        Ok(FileComparison {
            name: name.to_owned(),
            outcome: outcome(name, first, second)?,
        })
    };
    let mut files: Vec<FileComparison> = names.into_iter().map(file).collect::<Result<_, _>>()?;
    files.push(FileComparison {
        name: MARKER.to_owned(),
        outcome: manifests(&ours, &theirs),
    });
    Ok(Comparison { files })
}

impl Comparison {
    /// Whether every file is the same to the bit.
    pub fn identical(&self) -> bool {
        let same = |file: &FileComparison| file.outcome == Outcome::Identical;
        self.files.iter().all(same)
    }

    /// In words: a line for each file that is not the same, and the number of those that are.
    pub fn text(&self) -> String {
        self.to_string()
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count = self.files.len();
        let others = self
            .files
            .iter()
            .filter(|file| file.outcome != Outcome::Identical);
        let same = count - others.clone().count();
        if same == count {
            return writeln!(f, "All {count} files are the same to the bit.");
        }
        writeln!(
            f,
            "{same} of {count} files are the same to the bit; the others:"
        )?;
        others
            .into_iter()
            .try_for_each(|file| writeln!(f, "{}: {}", file.name, file.outcome))
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Identical => f.write_str("the same bits"),
            Self::Missing => f.write_str("missing in the second result"),
            Self::Extra => f.write_str("only in the second result"),
            Self::WrittenDifferently => f.write_str("the same values, written differently"),
            Self::DrawnDifferently => f.write_str("drawn differently"),
            Self::OtherBytes { reason } if reason.is_empty() => f.write_str("other bytes"),
            Self::OtherBytes { reason } => write!(f, "other bytes ({reason})"),
            Self::Different { differences } => {
                for (index, difference) in differences.iter().enumerate() {
                    write!(f, "{}{difference}", if index > 0 { ";\n  " } else { "" })?;
                }
                Ok(())
            }
        }
    }
}

fn outcome(name: &str, first: &Path, second: &Path) -> Result<Outcome, ResultsError> {
    let (first, second) = (first.join(name), second.join(name));
    let (Some(ours), Some(theirs)) = (open(&first)?, open(&second)?) else {
        return Ok(if second.exists() {
            Outcome::Extra
        } else {
            Outcome::Missing
        });
    };
    if same_bits(ours, theirs).map_err(ResultsError::io("read", &first))? {
        return Ok(Outcome::Identical);
    }
    let extension = Path::new(name)
        .extension()
        .and_then(|extension| extension.to_str());
    let found = match extension.unwrap_or_default() {
        "svg" | "png" => return Ok(Outcome::DrawnDifferently),
        "csv" => table::differences(&first, &second),
        "nc" => netcdf::differences(&first, &second),
        "json" => json::differences(&first, &second),
        "html" | "txt" | "md" | "toml" | "bib" => lines::differences(&first, &second),
        _ => Err(String::new()),
    };
    Ok(match found {
        Err(reason) => Outcome::OtherBytes { reason },
        Ok(differences) if differences.is_empty() => Outcome::WrittenDifferently,
        Ok(differences) => Outcome::Different { differences },
    })
}

/// Manifests without their checksums, which say no more than the comparison of each file.
fn manifests(ours: &Manifest, theirs: &Manifest) -> Outcome {
    let about = |manifest: &Manifest| serde_json::json!({ "version": manifest.version, "about": manifest.about });
    let differences = json::values(&about(ours), &about(theirs));
    match (differences.is_empty(), ours == theirs) {
        (true, true) => Outcome::Identical,
        (true, false) => Outcome::WrittenDifferently,
        (false, _) => Outcome::Different { differences },
    }
}

/// The file, or nothing if it is not there.
fn open(path: &Path) -> Result<Option<File>, ResultsError> {
    match fs::metadata(path).and_then(|_| File::open(path)) {
        Ok(file) => Ok(Some(file)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(ResultsError::io("read", path)(error)),
    }
}

fn same_bits(ours: File, theirs: File) -> io::Result<bool> {
    let (mut ours, mut theirs) = (BufReader::new(ours), BufReader::new(theirs));
    loop {
        let (a, b) = (ours.fill_buf()?, theirs.fill_buf()?);
        let count = a.len().min(b.len());
        if a[..count] != b[..count] {
            return Ok(false);
        }
        if count == 0 {
            return Ok(a.len() == b.len());
        }
        ours.consume(count);
        theirs.consume(count);
    }
}
