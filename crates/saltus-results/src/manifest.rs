//! The manifest of a result folder: the request, the version that answered it, and a checksum of every file.
//!
//! It holds no time and no name of a machine, so that two runs of the same study are the same folder. It
//! shows copies cut short, damage by a disk, and a table that was edited by hand, but not an alteration of a file
//! together with the manifest.

use crate::folder::{MARKER, plain};
use crate::shown::printable;
use crate::{ResultsError, ordinary};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::collections::HashSet;
use std::fmt::{self, Write as _};
use std::fs;
use std::io::{self, Read, Write};
use std::path::Path;

/// Name of the format.
const FORMAT: &str = "saltus-result";
/// Version of the format; a newer one is not read.
const FORMAT_VERSION: u32 = 1;

/// Description of a result folder, from its file [`MARKER`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Manifest {
    format: String,
    format_version: u32,
    /// Version of the program that wrote the folder.
    pub version: String,
    /// Request and method, as given by [`ResultFolder::about`](crate::ResultFolder::about).
    pub about: serde_json::Value,
    /// Every file but the manifest itself, in the order of writing.
    pub files: Vec<FileRecord>,
}

/// One file of a result as it was written.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct FileRecord {
    /// Path within the folder, with `/` between folders.
    pub name: String,
    /// Its length.
    pub bytes: u64,
    /// SHA-256 of its content, as 64 hexadecimal digits.
    pub sha256: String,
}

/// A file that is not as its manifest says.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct Problem {
    /// Path within the folder.
    pub name: String,
    /// The difference, as "is missing".
    pub problem: String,
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` {}", printable(&self.name), self.problem)
    }
}

impl Manifest {
    pub(crate) fn new(about: serde_json::Value, files: Vec<FileRecord>) -> Self {
        Self {
            format: FORMAT.to_owned(),
            format_version: FORMAT_VERSION,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            about,
            files,
        }
    }

    /// The content of the manifest's file.
    pub(crate) fn to_text(&self) -> String {
        let json = serde_json::json!(self);
        format!("{json:#}\n")
    }

    /// Reads the manifest of the result folder `dir`.
    ///
    /// # Errors
    /// [`ResultsError::NotAResult`] if `dir` is no folder or has no manifest, [`ResultsError::Manifest`] if
    /// that is damaged or written by a version with another format, [`ResultsError::Io`] if it cannot be
    /// read.
    pub fn read(dir: &Path) -> Result<Self, ResultsError> {
        let path = dir.join(MARKER);
        let text = ordinary::read(&path, ordinary::TEXT).map_err(|error| match why_not(dir) {
            Some(problem) => ResultsError::NotAResult {
                path: dir.to_path_buf(),
                problem,
            },
            None => ResultsError::io("read", &path)(error),
        })?;
        parse(&text).map_err(|problem| ResultsError::Manifest { path, problem })
    }

    /// Reads every file of the folder `dir` and lists those that are no longer as they were written. Files that
    /// are not in the manifest are of no concern.
    pub fn verify(&self, dir: &Path) -> Vec<Problem> {
        let problem = |record: &FileRecord| {
            Some(Problem {
                name: record.name.clone(),
                problem: record.problem(dir)?,
            })
        };
        self.files.iter().filter_map(problem).collect()
    }
}

impl FileRecord {
    /// The difference from the file as it was written, if there is one.
    pub(crate) fn problem(&self, dir: &Path) -> Option<String> {
        match self.check(&dir.join(&self.name)) {
            Ok(problem) => problem,
            Err(error) if error.kind() == io::ErrorKind::NotFound => Some("is missing".to_owned()),
            Err(error) => Some(format!("cannot be read: {error}")),
        }
    }

    fn check(&self, path: &Path) -> io::Result<Option<String>> {
        let file = ordinary::open(path)?;
        let length = file.metadata()?.len();
        if length != self.bytes {
            return Ok(Some(format!("has {length} bytes, not {}", self.bytes)));
        }
        // it may grow meanwhile
        let altered = sha256_of(file.take(length))? != self.sha256;
        Ok(altered.then(|| "was altered: its checksum is another".to_owned()))
    }
}

/// SHA-256 of `bytes`, as 64 hexadecimal digits.
pub fn sha256(bytes: impl AsRef<[u8]>) -> String {
    hexadecimal(&Sha256::digest(bytes))
}

fn sha256_of(mut file: impl Read) -> io::Result<String> {
    let mut hash = Sha256::new();
    let mut buffer = vec![0; 1 << 16];
    loop {
        match file.read(&mut buffer) {
            Ok(0) => return Ok(hexadecimal(&hash.finalize())),
            Ok(count) => hash.update(&buffer[..count]),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

/// Reason why the folder `dir` has no manifest, if it is not one of the file system.
fn why_not(dir: &Path) -> Option<String> {
    match fs::metadata(dir) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            Some("there is no such folder".to_owned())
        }
        Ok(data) if !data.is_dir() => Some("it is a file, not a folder".to_owned()),
        Ok(_) if !dir.join(MARKER).exists() => Some(format!("it holds no `{MARKER}`")),
        _ => None,
    }
}

fn parse(text: &[u8]) -> Result<Manifest, String> {
    let json: Value =
        serde_json::from_slice(text).map_err(|error| format!("it is damaged ({error})"))?;
    if json["format"] != FORMAT {
        let given = printable(&json["format"].to_string());
        return Err(format!("its `format` is {given}, not \"{FORMAT}\""));
    }
    let writer = match &json["version"] {
        Value::String(version) if is_version(version) => version.as_str(),
        Value::Null => "of an unknown version",
        other => {
            let given = printable(&other.to_string());
            return Err(format!(
                "its `version` is {given}, which is none; it would be as 0.1.0"
            ));
        }
    };
    match json["format_version"].as_u64() {
        Some(version) if version == u64::from(FORMAT_VERSION) => {}
        Some(version) => {
            return Err(format!(
                "it was written by saltus {writer} in format {version}; \
                 this is saltus {}, which reads format {FORMAT_VERSION}",
                env!("CARGO_PKG_VERSION")
            ));
        }
        // The first versions kept names of files only.
        None if json["files"][0].is_string() => {
            return Err(format!(
                "it was written by saltus {writer}, before manifests had checksums: \
                 compute the result again"
            ));
        }
        None => return Err("it is damaged (no `format_version`)".to_owned()),
    }
    let manifest: Manifest =
        serde_json::from_value(json).map_err(|error| format!("it is damaged ({error})"))?;
    let mut names = HashSet::new();
    for FileRecord { name, .. } in &manifest.files {
        let shown = printable(name);
        if plain(name).is_err() {
            return Err(format!("`{shown}` is no name for a file in it"));
        }
        if !names.insert(name) {
            return Err(format!("it names `{shown}` twice"));
        }
    }
    Ok(manifest)
}

/// Whether a text is a version as Cargo has them, such as 0.1.0-beta.2: it goes into other texts as it is.
fn is_version(text: &str) -> bool {
    let letter = |c: char| c.is_ascii_alphanumeric() || ".-+".contains(c);
    text.starts_with(|c: char| c.is_ascii_digit()) && text.len() <= 64 && text.chars().all(letter)
}

/// A writer that counts its bytes and computes their checksum.
pub(crate) struct Digesting<W> {
    inner: W,
    hash: Sha256,
    bytes: u64,
}

impl<W> Digesting<W> {
    pub(crate) fn new(inner: W) -> Self {
        Self {
            inner,
            hash: Sha256::new(),
            bytes: 0,
        }
    }

    pub(crate) fn get_ref(&self) -> &W {
        &self.inner
    }

    pub(crate) fn finish(self, name: &str) -> FileRecord {
        FileRecord {
            name: name.to_owned(),
            bytes: self.bytes,
            sha256: hexadecimal(&self.hash.finalize()),
        }
    }
}

impl<W: Write> Write for Digesting<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.inner.write(bytes)?;
        self.hash.update(&bytes[..count]);
        self.bytes += count as u64;
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}
