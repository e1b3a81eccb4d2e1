//! Staging places: unfinished files and folders, beside the target that they will move to.
//!
//! A staging place is locked as long as its process lives, however that ends. One that is not locked was left by a
//! process that was killed; the next process with the same target removes it. On a file system without locks
//! nothing is removed.

use crate::ordinary;
use std::ffi::OsStr;
use std::fs::{self, DirEntry, File};
use std::io;
use std::path::{Path, PathBuf};
use tempfile::{NamedTempFile, TempDir};

/// Prefix of the names of staging places; one left by a killed process does not make a folder foreign.
pub(crate) const STAGING: &str = ".saltus-staging-";

/// The file in a staging folder that is locked.
const ALIVE: &str = "alive";

/// Attempts to make a folder: before it is locked, another process may take it for left over and remove it.
const TRIES: usize = 8;

/// A folder whose content will go to a target. Dropping it removes it.
#[derive(Debug)]
pub struct Staging {
    // closed before the folder goes: some systems remove no open file
    _alive: File,
    dir: TempDir,
}

impl Staging {
    /// Makes a folder in `home` for the content of `target`, and removes staging places that killed processes with
    /// this target left there.
    ///
    /// # Errors
    /// Those of the system, if `home` cannot be written.
    pub fn folder(home: &Path, target: &Path) -> io::Result<Self> {
        let prefix = prefix(target);
        remove_left(home, &prefix);
        retried(|| {
            let dir = tempfile::Builder::new().prefix(&prefix).tempdir_in(home)?;
            let path = dir.path().join(ALIVE);
            let alive = locked(File::create(&path)?, &path)?;
            Ok(Self { _alive: alive, dir })
        })
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        self.dir.path()
    }
}

/// A file that will replace `target`, as readable as any file of the user.
pub(crate) fn file(home: &Path, target: &Path) -> io::Result<NamedTempFile> {
    let prefix = prefix(target);
    remove_left(home, &prefix);
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    retried(|| {
        let file = builder.tempfile_in(home)?;
        let _ = locked(file.as_file(), file.path())?;
        Ok(file)
    })
}

/// Locks a new file. Until then another process may take it for left over and remove it; then it is made again.
fn locked<F: std::borrow::Borrow<File>>(file: F, path: &Path) -> io::Result<F> {
    // a file system may have no locks
    let _ = file.borrow().lock();
    fs::metadata(path).map(|_| file)
}

fn retried<T>(mut make: impl FnMut() -> io::Result<T>) -> io::Result<T> {
    for _ in 1..TRIES {
        match make() {
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            made => return made,
        }
    }
    make()
}

/// The target with a name: `.` and `..` have one only in full.
pub(crate) fn whole_name(target: &Path) -> PathBuf {
    match target.file_name() {
        Some(_) => target.to_path_buf(),
        None => fs::canonicalize(target).unwrap_or(target.to_path_buf()),
    }
}

/// Removes staging places that killed processes left beside `target`.
pub(crate) fn remove_left_beside(target: &Path) {
    let target = whole_name(target);
    if let Some(home) = target.parent() {
        let here = home.as_os_str().is_empty();
        remove_left(if here { Path::new(".") } else { home }, &prefix(&target));
    }
}

/// Prefix of its own for each target, so that staging places for other targets stay.
fn prefix(target: &Path) -> String {
    let name = whole_name(target);
    let name = name.file_name().unwrap_or(OsStr::new("results"));
    let hash = crc32fast::hash(name.as_encoded_bytes());
    format!("{STAGING}{hash:08x}-")
}

/// Nothing depends on it, so a place that cannot be removed stays.
fn remove_left(home: &Path, prefix: &str) {
    let Ok(entries) = fs::read_dir(home) else {
        return;
    };
    let ours = |entry: &DirEntry| entry.file_name().to_string_lossy().starts_with(prefix);
    for entry in entries.filter_map(Result::ok).filter(ours) {
        let path = entry.path();
        let _ = match entry.file_type() {
            Ok(kind) if kind.is_dir() => match ordinary::open(&path.join(ALIVE)) {
                Ok(alive) if alive.try_lock().is_ok() => fs::remove_dir_all(&path),
                Ok(_) => Ok(()),
                // killed before there was a lock: then it is empty
                Err(_) => fs::remove_dir(&path),
            },
            Ok(kind) if kind.is_file() => match File::open(&path) {
                Ok(file) if file.try_lock().is_ok() => fs::remove_file(&path),
                _ => Ok(()),
            },
            _ => Ok(()),
        };
    }
}
