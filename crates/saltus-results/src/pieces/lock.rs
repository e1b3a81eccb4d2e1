//! The lock of a folder of pieces. It refuses a useless run early; nothing else depends on it.

use crate::ResultsError;
use std::fs::{File, TryLockError};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::Path;

/// The lock lives as long as the store; the file stays behind, unlocked, if a process is killed.
pub(super) const LOCK: &str = "lock";

/// Whether other processes may have the folder open too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Access {
    Alone,
    Shared,
}

/// Takes the lock of the folder, which ends with the process that holds it, however that ends. A file
/// system without locks gives none, and none is needed.
pub(super) fn lock(dir: &Path, access: Access) -> Result<File, ResultsError> {
    let path = dir.join(LOCK);
    let mut file = File::options()
        .read(true)
        .write(true)
        .create(true)
        .truncate(false)
        .open(&path)
        .map_err(ResultsError::io("open", &path))?;
    let taken = match access {
        Access::Alone => file.try_lock(),
        Access::Shared => file.try_lock_shared(),
    };
    if let Err(TryLockError::WouldBlock) = taken {
        let mut text = String::new();
        let read = file.read_to_string(&mut text);
        return Err(ResultsError::PiecesInUse {
            path: dir.to_path_buf(),
            process: read.ok().and_then(|_| text.trim().parse().ok()),
        });
    }
    match access {
        Access::Alone => file
            .set_len(0)
            .and_then(|()| file.seek(SeekFrom::Start(0)))
            .and_then(|_| writeln!(file, "{}", std::process::id()))
            .map_err(ResultsError::io("write", &path))?,
        // Those who share are many, so none is named, and no name of the past stays; nor does it matter.
        Access::Shared => drop(file.set_len(0)),
    }
    Ok(file)
}
