//! The manifest of a folder of pieces: the work to which they belong.

use crate::shown::printable;
use crate::{ResultsError, ordinary};
use std::io;
use std::path::Path;

/// Name of the file that describes the work of the pieces.
pub const MANIFEST: &str = "saltus-pieces.json";

/// Version of the format; pieces of another version are not read.
pub(super) const FORMAT: u32 = 2;

/// Names and values that describe the work of the pieces in `dir`, as given at its first opening.
///
/// # Errors
/// [`ResultsError::AbsentPieces`] if `dir` is no folder of pieces, [`ResultsError::ForeignPieces`] if its manifest
/// is damaged or of another format, [`ResultsError::Io`] if it cannot be read.
pub fn work_in(dir: &Path) -> Result<Vec<(String, String)>, ResultsError> {
    let foreign = |differences| ResultsError::ForeignPieces {
        path: dir.to_path_buf(),
        differences,
    };
    let manifest = parse(&read_manifest(dir)?).map_err(foreign)?;
    let owned = |(name, value): (&str, &str)| (name.to_owned(), value.to_owned());
    Ok(entries(&manifest).map(owned).collect())
}

pub(super) fn read_manifest(dir: &Path) -> Result<Vec<u8>, ResultsError> {
    let path = dir.join(MANIFEST);
    ordinary::read(&path, ordinary::TEXT).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => ResultsError::AbsentPieces {
            path: dir.to_path_buf(),
            manifest: MANIFEST,
        },
        _ => ResultsError::io("read", &path)(error),
    })
}

/// The manifest: format and fingerprint as JSON, in the order given.
pub(super) fn text_of(fingerprint: &[(&str, &str)]) -> Vec<u8> {
    let fingerprint: Vec<_> = fingerprint
        .iter()
        .map(|(name, value)| serde_json::json!({ "name": name, "value": value }))
        .collect();
    // Sorted by key, whether or not serde_json does so: the checksum of this text is in each piece.
    let manifest = serde_json::json!({
        "fingerprint": fingerprint,
        "format": "saltus-pieces",
        "format_version": FORMAT,
    });
    format!("{manifest:#}\n").into_bytes()
}

fn parse(manifest: &[u8]) -> Result<serde_json::Value, String> {
    let found: serde_json::Value = serde_json::from_slice(manifest)
        .map_err(|error| format!("`{MANIFEST}` cannot be read ({error})"))?;
    match &found["format_version"] {
        version if *version == FORMAT => Ok(found),
        version => Err(format!("their format is {version}, not {FORMAT}")),
    }
}

/// Names and values of a fingerprint.
fn entries(manifest: &serde_json::Value) -> impl Iterator<Item = (&str, &str)> {
    let list = manifest["fingerprint"].as_array().into_iter().flatten();
    list.filter_map(|entry| Some((entry["name"].as_str()?, entry["value"].as_str()?)))
}

/// Differences between a manifest and the fingerprint that is wanted, in words.
pub(super) fn compare(manifest: &[u8], wanted: &[(&str, &str)]) -> Result<(), String> {
    let found = parse(manifest)?;
    let theirs: Vec<(&str, &str)> = entries(&found).collect();
    let value = |list: &[(&str, &str)], name: &str| {
        let entry = list.iter().find(|entry| entry.0 == name);
        entry.map_or("absent".to_owned(), |entry| {
            format!("`{}`", printable(entry.1))
        })
    };
    let mut names: Vec<&str> = wanted.iter().map(|entry| entry.0).collect();
    names.extend(
        theirs
            .iter()
            .map(|entry| entry.0)
            .filter(|&name| wanted.iter().all(|w| w.0 != name)),
    );
    let differences: Vec<String> = names
        .into_iter()
        .map(|name| (name, value(&theirs, name), value(wanted, name)))
        .filter(|(_, theirs, wanted)| theirs != wanted)
        .map(|(name, theirs, wanted)| {
            format!("{} is {theirs} there and {wanted} here", printable(name))
        })
        .collect();
    if !differences.is_empty() {
        Err(differences.join(", "))
    } else if theirs != wanted {
        Err("the entries of its fingerprint are the same in another order".to_owned())
    } else {
        Ok(())
    }
}
