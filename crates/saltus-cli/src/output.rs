//! Writing: standard output without panics, files whole or not at all.

use crate::exit::Failure;
use serde::Serialize;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Writes text to standard output.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush())
        .map_err(|e| match e.kind() {
            io::ErrorKind::BrokenPipe => Failure::ClosedPipe,
            _ => Failure::write("standard output", &e),
        })
}

/// Writes one JSON document to standard output.
pub(crate) fn print_json(document: &impl Serialize) -> Result<(), Failure> {
    print(&json(document)?)
}

/// A JSON document as text that ends in a newline.
pub(crate) fn json(document: &impl Serialize) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(document).map_err(Failure::computation)?;
    Ok(text + "\n")
}

/// Writes text to a file, or to standard output if there is no file.
pub(crate) fn print_or_write(out: Option<&Path>, text: &str) -> Result<(), Failure> {
    match out {
        Some(path) => write_file(path, text),
        None => print(text),
    }
}

/// The folder of results, made if it is not there.
pub(crate) fn folder(path: &Path) -> Result<PathBuf, Failure> {
    fs::create_dir_all(path).map_err(|e| Failure::write(path, &e))?;
    Ok(path.to_owned())
}

/// Writes a file whole or not at all: beside its place first, then moved there.
pub(crate) fn write_file(path: &Path, text: &str) -> Result<(), Failure> {
    let result = match fs::metadata(path) {
        // a device or a pipe cannot be moved into place
        Ok(there) if !there.is_file() => fs::OpenOptions::new()
            .write(true)
            .open(path)
            .and_then(|mut file| file.write_all(text.as_bytes()).and_then(|()| file.flush())),
        // through a link, to what it points at
        Ok(_) => fs::canonicalize(path).and_then(|target| replace(&target, text)),
        Err(_) => replace(path, text),
    };
    result.map_err(|e| Failure::write(path, &e))
}

fn replace(path: &Path, text: &str) -> io::Result<()> {
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".saltus-");
    // as for any new file; without it only the owner could read the result
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder)?;
    file.write_all(text.as_bytes())?;
    file.as_file().sync_all()?;
    file.persist(path).map_err(|e| e.error)?;
    Ok(())
}
