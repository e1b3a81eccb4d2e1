//! Reading of files that somebody else may have put there: ordinary files only, up to a bound.
//!
//! A pipe in place of a file would be waited for without end, a device would fill the memory.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

/// Most bytes of a file that people could have written, such as a study or a manifest.
pub const TEXT: u64 = 4 << 20;

/// The content of the ordinary file at `path`, of at most `most` bytes.
///
/// # Errors
/// Those of the system; [`io::ErrorKind::InvalidInput`] if it is no file or a pipe or a device, or is larger.
pub fn read(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    // it may grow meanwhile, or lie where files have no length
    open(path)?.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        let larger = format!("it is larger than {} MiB", most >> 20);
        return Err(io::Error::new(io::ErrorKind::InvalidInput, larger));
    }
    Ok(bytes)
}

/// Opens an ordinary file. Its kind is checked first, since opening a pipe waits for a writer.
pub(crate) fn open(path: &Path) -> io::Result<File> {
    let data = fs::metadata(path)?;
    if data.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    if !data.is_file() {
        return Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            "it is a pipe or a device, not an ordinary file",
        ));
    }
    File::open(path)
}
