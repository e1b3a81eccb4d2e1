//! Finished pieces of long work, kept so that it can be taken up again after a stop.
//!
//! A [`PieceStore`] is a folder with one file for each numbered piece and a manifest that names the work
//! they belong to. A piece is written aside, brought to the disk and renamed, so it is there whole or not
//! at all; its header and checksum show whether the disk kept it.
//!
//! One process works in a folder at a time, or many do that have it open [shared](PieceStore::open_shared), on
//! as many machines as see the folder. Nothing depends on locks, which network file systems may lack or keep
//! to one machine: two that write the same piece write the same bytes, the first process names the work in
//! the manifest, and each piece says to which work it belongs. Where there are locks, a run of its own in a
//! folder that others fill is refused early.
//!
//! ```
//! use saltus_results::PieceStore;
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let home = tempfile::tempdir()?;
//! let work = [("study", "5f3a9c"), ("version", "0.1.0"), ("pieces", "3")];
//! let store = PieceStore::open(&home.path().join("pieces"), &work)?;
//! let done = store.survey()?.whole;
//! for number in (0..3).filter(|number| !done.contains(number)) {
//!     store.write(number, &[1, 2, 3])?;
//! }
//! assert_eq!(store.read(2)?, Some(vec![1, 2, 3]));
//! store.remove()?;
//! # Ok(())
//! # }
//! ```

mod lock;
mod piece;
mod work;

pub use piece::Seal;
pub use work::{MANIFEST, work_in};

use crate::staging::whole_name;
use crate::{ResultsError, ordinary};
use lock::{Access, LOCK, lock};
use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use work::{compare, read_manifest, text_of};

/// Most bytes of a piece that is read: far more than any has.
const LARGEST: u64 = 1 << 30;

/// Name of the file with the remark.
const REMARK: &str = "remark";
/// Prefix of the names of files in the making; six letters follow.
const ASIDE: &str = ".tmp";
/// Suffix of these names. Left by a killed process, the files are removed at opening.
const PART: &str = ".part";
/// Suffix in a shared folder. The files stay until all is removed, since a process that opens the folder alone
/// cannot rely on a lock to know that their writers are gone.
const PART_SHARED: &str = ".shared.part";
const ALL_PARTS: [&str; 2] = [PART, PART_SHARED];

/// A folder of numbered pieces, locked until dropped: against all other processes, or, if shared, against
/// those that want it for themselves.
///
/// All methods but [`remove`](Self::remove) take `&self`: threads may share the store and write different
/// pieces at the same time.
#[derive(Debug)]
pub struct PieceStore {
    dir: PathBuf,
    /// Mark in each piece by which one of other work is recognised.
    seal: Seal,
    access: Access,
    lock: File,
}

/// Content of a store.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Survey {
    /// Numbers of the whole pieces, ascending.
    pub whole: Vec<u32>,
    /// Pieces that are there but must be made again, in the order of their numbers.
    pub damaged: Vec<Damage>,
}

/// A piece that is there but not as it was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Damage {
    /// Number of the piece.
    pub piece: u32,
    /// The damage, as "104 bytes, not the 2048 it should have".
    pub problem: String,
}

/// The folder beside the result folder `target` in which to keep its pieces: a hidden sibling.
///
/// It is not inside `target`, which stays absent or as it was until all is done.
pub fn pieces_beside(target: &Path) -> PathBuf {
    let full = whole_name(target);
    let mut name = OsString::from(".");
    name.push(full.file_name().unwrap_or("results".as_ref()));
    name.push(".saltus-pieces");
    full.with_file_name(name)
}

impl PieceStore {
    /// Opens the folder `dir` for the work described by `fingerprint`, creating it if absent.
    ///
    /// The fingerprint is a list of names and values that must all be the same for pieces to fit: the hash
    /// of the resolved study, the program's version, the number of pieces. Unfinished files of a killed process
    /// are removed.
    ///
    /// # Errors
    /// [`ResultsError::PiecesInUse`] if another store has the folder open, in this process or another;
    /// [`ResultsError::ForeignPieces`], which names what differs, if its pieces belong to other work;
    /// [`ResultsError::NoPieces`] if it holds files and no manifest; [`ResultsError::Io`] if it cannot be
    /// written.
    pub fn open(dir: &Path, fingerprint: &[(&str, &str)]) -> Result<Self, ResultsError> {
        fs::create_dir_all(dir).map_err(ResultsError::io("create the folder", dir))?;
        let store = Self::join(dir, fingerprint, Access::Alone)?;
        store.remove_files(|name| is_aside(name, &[PART]))?;
        Ok(store)
    }

    /// Opens the folder `dir` as [`open`](Self::open) does, but together with others that do the same.
    ///
    /// Of several that open an absent folder at once, the first names the work; the others find it named,
    /// and are refused if theirs is another. Unfinished files of a killed process stay until the folder is removed.
    ///
    /// # Errors
    /// As [`open`](Self::open); [`ResultsError::PiecesInUse`] only if another process has it open alone.
    pub fn open_shared(dir: &Path, fingerprint: &[(&str, &str)]) -> Result<Self, ResultsError> {
        fs::create_dir_all(dir).map_err(ResultsError::io("create the folder", dir))?;
        Self::join(dir, fingerprint, Access::Shared)
    }

    /// Opens the folder `dir`, which must be there, to put its pieces together. The work is that of
    /// [`work_in`], after the caller has checked that it is the right one.
    ///
    /// A piece is whole or absent, so this is right even where no lock shows that others still write: pieces that
    /// they have not finished are missing from the [`survey`](Self::survey). Files in the making stay.
    ///
    /// # Errors
    /// As [`open`](Self::open); [`ResultsError::PiecesInUse`] also while it is open as shared, where the
    /// file system knows of that; [`ResultsError::AbsentPieces`] if `dir` has no manifest.
    pub fn open_to_merge(dir: &Path, fingerprint: &[(&str, &str)]) -> Result<Self, ResultsError> {
        read_manifest(dir)?;
        Self::join(dir, fingerprint, Access::Alone)
    }

    fn join(dir: &Path, work: &[(&str, &str)], access: Access) -> Result<Self, ResultsError> {
        check_ours(dir)?;
        let store = Self {
            dir: dir.to_path_buf(),
            seal: Seal::of(work),
            access,
            lock: lock(dir, access)?,
        };
        store.agree(work)?;
        Ok(store)
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        &self.dir
    }

    /// Reads every piece and lists the whole and the damaged ones. A damaged one counts as missing until it is
    /// written again.
    ///
    /// # Errors
    /// [`ResultsError::Io`] if the folder or a file cannot be read.
    pub fn survey(&self) -> Result<Survey, ResultsError> {
        let mut numbers: Vec<u32> = names(&self.dir)?
            .iter()
            .filter_map(|name| number_of(name))
            .collect();
        numbers.sort_unstable();
        let mut survey = Survey::default();
        for piece in numbers {
            match self.read(piece) {
                Ok(Some(_)) => survey.whole.push(piece),
                Ok(None) => {}
                Err(ResultsError::DamagedPiece { problem, .. }) => {
                    survey.damaged.push(Damage { piece, problem });
                }
                Err(error) => return Err(error),
            }
        }
        Ok(survey)
    }

    /// The content of piece `number`; `None` if it is not there.
    ///
    /// # Errors
    /// [`ResultsError::DamagedPiece`] if it is not as it was written, [`ResultsError::Io`] if it cannot be
    /// read.
    pub fn read(&self, number: u32) -> Result<Option<Vec<u8>>, ResultsError> {
        let path = self.file(number);
        let bytes = match ordinary::read(&path, LARGEST) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(ResultsError::io("read", &path)(error)),
        };
        match self.seal.open(number, &bytes) {
            Ok(content) => Ok(Some(content.to_vec())),
            Err(problem) => Err(ResultsError::DamagedPiece { path, problem }),
        }
    }

    /// Keeps `content` as piece `number`, in place of an earlier one. When this returns, the piece is on
    /// the disk.
    ///
    /// # Errors
    /// [`ResultsError::Io`] if not every byte could be written; then the folder is as it was.
    pub fn write(&self, number: u32, content: &[u8]) -> Result<(), ResultsError> {
        let header = self.seal.header(number, content);
        self.place(&file_name(number), &[&header, content], Place::Anew)
    }

    /// File of piece `number`, there or not.
    pub fn file(&self, number: u32) -> PathBuf {
        self.dir.join(file_name(number))
    }

    /// Leaves a line for later runs, in place of the last one. It does not describe the pieces.
    ///
    /// # Errors
    /// [`ResultsError::Io`] if it cannot be written.
    pub fn remark(&self, line: &str) -> Result<(), ResultsError> {
        self.place(REMARK, &[line.as_bytes()], Place::Anew)
    }

    /// The line that a run left last; `None` if none did or it cannot be read.
    pub fn last_remark(&self) -> Option<String> {
        let text = ordinary::read(&self.dir.join(REMARK), ordinary::TEXT).ok()?;
        String::from_utf8(text).ok()
    }

    /// Removes the pieces, the manifest and the folder. Files of others stay, and then so does the folder.
    ///
    /// # Errors
    /// [`ResultsError::Io`] if a file cannot be removed.
    pub fn remove(self) -> Result<(), ResultsError> {
        let Self { dir, lock, .. } = &self;
        // The manifest goes last: without it the rest would look like a folder of somebody else.
        self.remove_files(|name| {
            is_aside(name, &ALL_PARTS) || name == REMARK || number_of(name).is_some()
        })?;
        self.remove_files(|name| name == MANIFEST)?;
        let _ = lock.unlock();
        self.remove_files(|name| name == LOCK)?;
        // Fails if someone else put a file there, which is as it should be.
        let _ = fs::remove_dir(dir);
        Ok(())
    }

    /// Names the work in the manifest, unless that was done before, and compares what it says.
    fn agree(&self, fingerprint: &[(&str, &str)]) -> Result<(), ResultsError> {
        let path = self.dir.join(MANIFEST);
        if !path.exists() {
            self.place(MANIFEST, &[&text_of(fingerprint)], Place::First)?;
        }
        // Read in any case: another may have been first.
        let found = ordinary::read(&path, ordinary::TEXT);
        let found = found.map_err(ResultsError::io("read", &path))?;
        compare(&found, fingerprint).map_err(|differences| {
            let path = self.dir.clone();
            ResultsError::ForeignPieces { path, differences }
        })
    }

    /// Writes the file `name` aside, brings it to the disk and renames it.
    fn place(&self, name: &str, parts: &[&[u8]], place: Place) -> Result<(), ResultsError> {
        let path = self.dir.join(name);
        let suffix = match self.access {
            Access::Alone => PART,
            Access::Shared => PART_SHARED,
        };
        let staged = tempfile::Builder::new()
            .prefix(ASIDE)
            .suffix(suffix)
            .tempfile_in(&self.dir);
        staged
            .and_then(|mut file| {
                parts.iter().try_for_each(|part| file.write_all(part))?;
                file.as_file().sync_all()?;
                let placed = match place {
                    Place::Anew => file.persist(&path),
                    Place::First => file.persist_noclobber(&path),
                };
                match (place, placed.map_err(|error| error.error)) {
                    (Place::First, Err(error)) if error.kind() == io::ErrorKind::AlreadyExists => {}
                    (_, placed) => drop(placed?),
                }
                sync_folder(&self.dir)
            })
            .map_err(ResultsError::io("write", &path))
    }

    fn remove_files(&self, unwanted: impl Fn(&str) -> bool) -> Result<(), ResultsError> {
        for name in names(&self.dir)?.iter().filter(|name| unwanted(name)) {
            let path = self.dir.join(name);
            fs::remove_file(&path).map_err(ResultsError::io("remove", &path))?;
        }
        Ok(())
    }
}

/// Rule for a file that has the name already.
#[derive(Clone, Copy)]
enum Place {
    /// It is replaced.
    Anew,
    /// It stays: the first one counts.
    First,
}

/// A name on the disk survives a power cut only if its folder was brought there too.
#[cfg(unix)]
fn sync_folder(dir: &Path) -> io::Result<()> {
    File::open(dir)?.sync_all()
}

/// Windows keeps names with the files and opens no folder.
#[cfg(not(unix))]
fn sync_folder(_: &Path) -> io::Result<()> {
    Ok(())
}

/// An empty folder may become one of pieces; one with other files and no manifest may not.
fn check_ours(dir: &Path) -> Result<(), ResultsError> {
    let foreign = |name: &String| name != LOCK && !is_aside(name, &ALL_PARTS);
    // Looked for last: by then whoever put a piece into the list has put the manifest before it.
    if names(dir)?.iter().any(foreign) && !dir.join(MANIFEST).exists() {
        return Err(ResultsError::NoPieces {
            path: dir.to_path_buf(),
            manifest: MANIFEST,
        });
    }
    Ok(())
}

fn names(dir: &Path) -> Result<Vec<String>, ResultsError> {
    fs::read_dir(dir)
        .and_then(Iterator::collect::<io::Result<Vec<_>>>)
        .map(|entries| {
            let name = |entry: &fs::DirEntry| entry.file_name().to_string_lossy().into_owned();
            entries.iter().map(name).collect()
        })
        .map_err(ResultsError::io("read the folder", dir))
}

fn file_name(number: u32) -> String {
    format!("piece-{number:06}.bin")
}

/// Whether this is a file in the making: another that happens to end so is somebody's own.
fn is_aside(name: &str, parts: &[&str]) -> bool {
    let letters = name.strip_prefix(ASIDE).unwrap_or_default();
    let mut letters = parts.iter().filter_map(|part| letters.strip_suffix(part));
    letters.any(|six| six.len() == 6 && six.bytes().all(|b| b.is_ascii_alphanumeric()))
}

/// The number in a file name that [`file_name`] made.
fn number_of(name: &str) -> Option<u32> {
    let digits = name.strip_prefix("piece-")?.strip_suffix(".bin")?;
    let number = digits.parse().ok()?;
    (file_name(number) == name).then_some(number)
}
