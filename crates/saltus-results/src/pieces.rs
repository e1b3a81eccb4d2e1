//! Finished pieces of long work, kept so that it can be taken up again after a stop.
//!
//! A [`PieceStore`] is a folder with one file for each numbered piece and a manifest that says which work
//! they belong to. A piece is written aside, brought to the disk and renamed, so it is there whole or not
//! at all; its header and checksum tell if the disk kept it. One process works in a folder at a time.
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
//!
//! # Format of a piece
//! All numbers little-endian: the eight letters `saltuspc`; format version (u32); CRC-32 of the manifest's
//! fingerprint (u32); number of the piece (u32); CRC-32 of the 20 bytes so far and the content (u32);
//! length of the content (u64); the content. CRC-32 is that of PNG and zlib.

use crate::ResultsError;
use std::ffi::OsString;
use std::fs::{self, File, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// Name of the file that says which work the pieces belong to.
pub const MANIFEST: &str = "saltus-pieces.json";

/// Version of the format; pieces of another version are not read.
const FORMAT: u32 = 1;
const MAGIC: &[u8; 8] = b"saltuspc";
/// Bytes before the content.
const HEADER: usize = 32;
/// The lock lives as long as the store; the file stays behind, unlocked, if a process is killed.
const LOCK: &str = "lock";
/// How the names of files in the making end; left by a killed process, they are removed at opening.
const ASIDE: &str = ".part";

/// A folder of numbered pieces, locked against other processes until dropped.
///
/// All methods but [`remove`](Self::remove) take `&self`: threads may share the store and write different
/// pieces at the same time.
#[derive(Debug)]
pub struct PieceStore {
    dir: PathBuf,
    /// CRC-32 of the fingerprint, in each piece: one from other work is told from ours.
    fingerprint: u32,
    lock: File,
}

/// What a store holds.
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
    /// What is wrong, as "104 bytes, not the 2048 it should have".
    pub problem: String,
}

/// The folder beside the result folder `target` in which to keep its pieces: a hidden sibling.
///
/// It is not inside `target`, which stays absent or as it was until all is done.
pub fn pieces_beside(target: &Path) -> PathBuf {
    // `.` and `..` have a name only in full.
    let full = match target.file_name() {
        Some(_) => target.to_path_buf(),
        None => fs::canonicalize(target).unwrap_or(target.to_path_buf()),
    };
    let mut name = OsString::from(".");
    name.push(full.file_name().unwrap_or("results".as_ref()));
    name.push(".saltus-pieces");
    full.with_file_name(name)
}

impl PieceStore {
    /// Opens the folder `dir` for the work described by `fingerprint`, creating it if absent.
    ///
    /// The fingerprint is a list of names and values that must all be the same for pieces to fit: the hash
    /// of the resolved study, the program's version, the number of pieces. Files left in the making by a
    /// killed process are removed.
    ///
    /// # Errors
    /// [`ResultsError::PiecesInUse`] if another store has the folder open, in this process or another;
    /// [`ResultsError::ForeignPieces`], which names what differs, if its pieces belong to other work;
    /// [`ResultsError::NoPieces`] if it holds files and no manifest; [`ResultsError::Io`] if it cannot be
    /// written.
    pub fn open(dir: &Path, fingerprint: &[(&str, &str)]) -> Result<Self, ResultsError> {
        fs::create_dir_all(dir).map_err(ResultsError::io("create the folder", dir))?;
        check_ours(dir)?;
        let store = Self {
            dir: dir.to_path_buf(),
            fingerprint: crc(&[&text_of(fingerprint)]),
            lock: lock(dir)?,
        };
        store.remove_files(|name| name.ends_with(ASIDE))?;
        store.check_manifest(fingerprint)?;
        Ok(store)
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        &self.dir
    }

    /// Reads every piece and says which are whole and which are damaged. A damaged one counts as missing
    /// until it is written again.
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
    /// [`ResultsError::DamagedPiece`] if it is not what was written, [`ResultsError::Io`] if it cannot be
    /// read.
    pub fn read(&self, number: u32) -> Result<Option<Vec<u8>>, ResultsError> {
        let path = self.dir.join(file_name(number));
        let mut bytes = match fs::read(&path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(ResultsError::io("read", &path)(error)),
        };
        match self.problem(number, &bytes) {
            None => Ok(Some(bytes.split_off(HEADER))),
            Some(problem) => Err(ResultsError::DamagedPiece { path, problem }),
        }
    }

    /// Keeps `content` as piece `number`, in place of an earlier one. When this returns, the piece is on
    /// the disk.
    ///
    /// # Errors
    /// [`ResultsError::Io`] if not every byte could be written; then the folder is as it was.
    pub fn write(&self, number: u32, content: &[u8]) -> Result<(), ResultsError> {
        let header = self.header(number, content);
        self.place(&file_name(number), &[&header, content])
    }

    /// Removes the pieces, the manifest and the folder. Files of others stay, and then so does the folder.
    ///
    /// # Errors
    /// [`ResultsError::Io`] if a file cannot be removed.
    pub fn remove(self) -> Result<(), ResultsError> {
        let Self { dir, lock, .. } = &self;
        // The manifest goes last: without it what is left would look like a folder of somebody else.
        self.remove_files(|name| name.ends_with(ASIDE) || number_of(name).is_some())?;
        self.remove_files(|name| name == MANIFEST)?;
        let _ = lock.unlock();
        self.remove_files(|name| name == LOCK)?;
        // Fails if someone else put a file there, which is as it should be.
        let _ = fs::remove_dir(dir);
        Ok(())
    }

    /// The 32 bytes before the content; see the module for their meaning.
    fn header(&self, number: u32, content: &[u8]) -> Vec<u8> {
        let mut header = Vec::with_capacity(HEADER);
        header.extend(MAGIC);
        for word in [FORMAT, self.fingerprint, number] {
            header.extend(word.to_le_bytes());
        }
        header.extend(crc(&[&header, content]).to_le_bytes());
        header.extend((content.len() as u64).to_le_bytes());
        header
    }

    /// What is wrong with the file of piece `number`, if anything.
    fn problem(&self, number: u32, bytes: &[u8]) -> Option<String> {
        let Some((header, content)) = bytes.split_at_checked(HEADER) else {
            return Some(format!("{} bytes, less than its header", bytes.len()));
        };
        let word = |at: usize| u32::from_le_bytes([0, 1, 2, 3].map(|i| header[at + i]));
        let length = u64::from(word(24)) | u64::from(word(28)) << 32;
        if !header.starts_with(MAGIC) {
            Some("it does not begin as a piece does".to_owned())
        } else if word(8) != FORMAT {
            Some(format!("format {}, not {FORMAT}", word(8)))
        } else if word(12) != self.fingerprint {
            Some("it belongs to other work".to_owned())
        } else if word(16) != number {
            Some(format!("it is piece {}", word(16)))
        } else if length != content.len() as u64 {
            Some(format!("{} bytes of content, not {length}", content.len()))
        } else if word(20) != crc(&[&header[..20], content]) {
            Some("its checksum does not match".to_owned())
        } else {
            None
        }
    }

    /// Compares the manifest with `fingerprint`, or writes it if there is none yet.
    fn check_manifest(&self, fingerprint: &[(&str, &str)]) -> Result<(), ResultsError> {
        let path = self.dir.join(MANIFEST);
        match fs::read(&path) {
            Ok(found) => compare(&found, fingerprint).map_err(|differences| {
                let path = self.dir.clone();
                ResultsError::ForeignPieces { path, differences }
            }),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                self.place(MANIFEST, &[&text_of(fingerprint)])
            }
            Err(error) => Err(ResultsError::io("read", &path)(error)),
        }
    }

    /// Writes the file `name` aside, brings it to the disk and renames it.
    fn place(&self, name: &str, parts: &[&[u8]]) -> Result<(), ResultsError> {
        let path = self.dir.join(name);
        let staged = tempfile::Builder::new()
            .suffix(ASIDE)
            .tempfile_in(&self.dir);
        staged
            .and_then(|mut file| {
                parts.iter().try_for_each(|part| file.write_all(part))?;
                file.as_file().sync_all()?;
                file.persist(&path).map_err(|error| error.error)?;
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

/// Takes the lock of the folder, which ends with the process that holds it, however that ends.
fn lock(dir: &Path) -> Result<File, ResultsError> {
    let path = dir.join(LOCK);
    let mut file = File::options()
        .read(true)
        .write(true)
        .create(true)
        .truncate(false)
        .open(&path)
        .map_err(ResultsError::io("open", &path))?;
    match file.try_lock() {
        Ok(()) => {}
        Err(TryLockError::WouldBlock) => {
            let mut text = String::new();
            let read = file.read_to_string(&mut text);
            return Err(ResultsError::PiecesInUse {
                path: dir.to_path_buf(),
                process: read.ok().and_then(|_| text.trim().parse().ok()),
            });
        }
        Err(TryLockError::Error(error)) => return Err(ResultsError::io("lock", &path)(error)),
    }
    file.set_len(0)
        .and_then(|()| file.seek(SeekFrom::Start(0)))
        .and_then(|_| writeln!(file, "{}", std::process::id()))
        .map_err(ResultsError::io("write", &path))?;
    Ok(file)
}

/// An empty folder may become one of pieces; one with other files and no manifest may not.
fn check_ours(dir: &Path) -> Result<(), ResultsError> {
    let names = names(dir)?;
    let foreign = |name: &String| name != LOCK && !name.ends_with(ASIDE);
    if names.iter().any(foreign) && !names.iter().any(|name| name == MANIFEST) {
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

/// The number in a file name that [`file_name`] made.
fn number_of(name: &str) -> Option<u32> {
    let digits = name.strip_prefix("piece-")?.strip_suffix(".bin")?;
    let number = digits.parse().ok()?;
    (file_name(number) == name).then_some(number)
}

/// CRC-32 of the parts, one after the other.
fn crc(parts: &[&[u8]]) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    parts.iter().for_each(|part| hasher.update(part));
    hasher.finalize()
}

/// The manifest: format and fingerprint as JSON, in the order given.
fn text_of(fingerprint: &[(&str, &str)]) -> Vec<u8> {
    let fingerprint: Vec<_> = fingerprint
        .iter()
        .map(|(name, value)| serde_json::json!({ "name": name, "value": value }))
        .collect();
    let manifest = serde_json::json!({
        "format": "saltus-pieces",
        "format_version": FORMAT,
        "fingerprint": fingerprint,
    });
    format!("{manifest:#}\n").into_bytes()
}

/// In words, what differs between a manifest and the fingerprint that is wanted.
fn compare(manifest: &[u8], wanted: &[(&str, &str)]) -> Result<(), String> {
    let found: serde_json::Value = serde_json::from_slice(manifest)
        .map_err(|error| format!("`{MANIFEST}` cannot be read ({error})"))?;
    if found["format_version"] != FORMAT {
        let version = &found["format_version"];
        return Err(format!("their format is {version}, not {FORMAT}"));
    }
    let entries = found["fingerprint"]
        .as_array()
        .map_or(&[][..], Vec::as_slice);
    let theirs: Vec<(&str, &str)> = entries
        .iter()
        .filter_map(|entry| Some((entry["name"].as_str()?, entry["value"].as_str()?)))
        .collect();
    let value = |list: &[(&str, &str)], name: &str| {
        let entry = list.iter().find(|entry| entry.0 == name);
        entry.map_or("absent".to_owned(), |entry| format!("`{}`", entry.1))
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
        .map(|(name, theirs, wanted)| format!("{name} is {theirs} there and {wanted} here"))
        .collect();
    if !differences.is_empty() {
        Err(differences.join(", "))
    } else if theirs != wanted {
        Err("the entries of its fingerprint are the same in another order".to_owned())
    } else {
        Ok(())
    }
}
