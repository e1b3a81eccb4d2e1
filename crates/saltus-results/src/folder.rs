//! Result folders and files that appear whole or not at all.
//!
//! Everything is written to a staging place on the same file system first; only when all of it is on
//! disk does it move to its name. A run that fails, or is interrupted, leaves the target as it was.
//!
//! A folder holds one result. Where it takes the place of an earlier one, files that only the earlier one has are
//! removed.

use crate::manifest::{Digesting, FileRecord, Manifest};
use crate::staging::{self, STAGING, Staging};
use crate::{Dataset, ResultsError};
use std::collections::HashSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Component, Path, PathBuf};

/// Name of the file that marks a folder as written by this program: its [`Manifest`].
pub const MARKER: &str = "saltus-result.json";

/// Name of the page that links the other files; it moves last.
pub const INDEX: &str = "index.html";

/// A folder of results in the making. Dropping it without [`commit`](Self::commit) leaves no trace.
#[derive(Debug)]
pub struct ResultFolder {
    target: PathBuf,
    staging: Staging,
    /// Parents that did not exist before, outermost first; removed again if nothing is committed.
    parents: Vec<PathBuf>,
    about: serde_json::Value,
    files: Vec<FileRecord>,
    /// Manifest of an earlier result that this is a copy of.
    copied: Option<Manifest>,
}

impl ResultFolder {
    /// Prepares the folder `dir`, which may be absent, empty, or one written by this program.
    ///
    /// The staging place is a sibling of `dir`, or lies inside `dir` if that exists: it may be a mount
    /// point, from which a sibling could not be moved. Staging places of killed processes are removed.
    ///
    /// # Errors
    /// [`ResultsError::ForeignFolder`] if `dir` holds files of others, [`ResultsError::WrongKind`] if it
    /// is a file, [`ResultsError::Io`] if the place cannot be written.
    pub fn stage(dir: &Path) -> Result<Self, ResultsError> {
        let exists = check_target(dir)?;
        let home = if exists {
            dir.to_path_buf()
        } else {
            parent(dir)
        };
        let parents = missing_ancestors(&home);
        let staging = fs::create_dir_all(&home)
            .map_err(ResultsError::io("create the folder", &home))
            .and_then(|()| {
                let staging = Staging::folder(&home, dir);
                staging.map_err(ResultsError::io("write in the folder", &home))
            })
            .inspect_err(|_| remove_empty(&parents))?;
        staging::remove_left_beside(dir);
        let folder = Self {
            target: dir.to_path_buf(),
            staging,
            parents,
            about: serde_json::json!({}),
            files: Vec::new(),
            copied: None,
        };
        // The temporary folder is private to its owner; files inside follow the user's own rules.
        fs::create_dir(folder.content())
            .map_err(ResultsError::io("create the folder", &folder.target))?;
        Ok(folder)
    }

    /// Says in the manifest what the result is: the request, the hash of its study, methods, accuracy. No
    /// time and no name of a machine, or equal runs would not be equal folders.
    pub fn about(&mut self, about: serde_json::Value) {
        self.about = about;
    }

    /// Says one thing more in the manifest, as the answer in words.
    pub fn note(&mut self, name: &str, text: &str) {
        self.about[name] = text.into();
    }

    /// Keeps the manifest of the result whose files are staged, as it was written.
    pub fn copy_of(&mut self, manifest: &Manifest) {
        self.copied = Some(manifest.clone());
    }

    /// Stages `bytes` as the file `name`, a relative path with `/` between folders.
    ///
    /// # Errors
    /// [`ResultsError::BadName`], or [`ResultsError::Io`] if not every byte could be written.
    pub fn write(&mut self, name: &str, bytes: impl AsRef<[u8]>) -> Result<(), ResultsError> {
        self.write_with(name, |file| file.write_all(bytes.as_ref()))
    }

    /// Stages the file `name` through a buffered writer, for tables too long to hold in memory.
    ///
    /// # Errors
    /// As [`write`](Self::write); errors of the closure count as errors of the file.
    pub fn write_with(
        &mut self,
        name: &str,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), ResultsError> {
        self.stage_file(name, |file| fill(file))
    }

    fn stage_file(
        &mut self,
        name: &str,
        fill: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
    ) -> Result<(), ResultsError> {
        let relative = plain(name)?;
        let staged = self.content().join(&relative);
        let shown = self.target.join(&relative);
        let folder = staged.parent().unwrap_or(&staged);
        fs::create_dir_all(folder).map_err(ResultsError::io("create the folder of", &shown))?;
        let file = File::create(&staged).map_err(ResultsError::io("create", &shown))?;
        let mut file = Digesting::new(file);
        fill_file(&mut file, fill).map_err(ResultsError::io("write", &shown))?;
        let record = file.finish(name);
        match self.files.iter_mut().find(|known| known.name == name) {
            Some(known) => *known = record,
            None => self.files.push(record),
        }
        Ok(())
    }

    /// Stages `dataset` as the NetCDF-4 file `name`.
    ///
    /// # Errors
    /// As [`write`](Self::write), and [`ResultsError::Dataset`] if its parts do not fit each other.
    pub fn write_dataset(&mut self, name: &str, dataset: Dataset) -> Result<(), ResultsError> {
        self.write(name, dataset.to_bytes()?)
    }

    /// Moves everything into place and returns the folder's path.
    ///
    /// A new folder appears in one step. In an existing one, files that only the earlier result has are removed, unless
    /// somebody changed them since. Then files of the same name are replaced one by one, each in one step, the marker
    /// first and the index page last. All other files stay.
    ///
    /// # Errors
    /// As [`stage`](Self::stage), if the target changed in between or a move fails.
    pub fn commit(mut self) -> Result<PathBuf, ResultsError> {
        let about = std::mem::take(&mut self.about);
        let copied = self.copied.take();
        let manifest = copied.unwrap_or_else(|| Manifest::new(about, self.files.clone()));
        self.write(MARKER, manifest.to_text())?;
        if check_target(&self.target)? {
            self.move_files()?;
        } else if let Err(error) = fs::rename(self.content(), &self.target) {
            // somebody else's may have come first
            if !check_target(&self.target)? {
                return Err(ResultsError::io("create the folder", &self.target)(error));
            }
            self.move_files()?;
        }
        self.parents.clear();
        Ok(self.target.clone())
    }

    fn content(&self) -> PathBuf {
        self.staging.path().join("content")
    }

    /// Removes files of an earlier result that would be taken for a part of this one. A manifest that cannot be
    /// read names none.
    fn remove_others(&self) -> Result<(), ResultsError> {
        let earlier = Manifest::read(&self.target).map_or(Vec::new(), |manifest| manifest.files);
        let mine: HashSet<&str> = self.files.iter().map(|file| file.name.as_str()).collect();
        for record in earlier
            .iter()
            .filter(|file| !mine.contains(file.name.as_str()))
        {
            let path = self.target.join(&record.name);
            if !self.is_inside(&path) || record.problem(&self.target).is_some() {
                continue;
            }
            fs::remove_file(&path).map_err(ResultsError::io("remove", &path))?;
            let folders = path.ancestors().skip(1);
            for folder in folders.take_while(|&folder| folder != self.target) {
                // fails if something is left in it, which is as it should be
                let _ = fs::remove_dir(folder);
            }
        }
        Ok(())
    }

    /// Whether a file of the target is one, and no link on the way leads elsewhere.
    fn is_inside(&self, path: &Path) -> bool {
        let real = |path: &Path| fs::canonicalize(path).ok();
        let (Some(root), Ok(name)) = (real(&self.target), path.strip_prefix(&self.target)) else {
            return false;
        };
        real(path) == Some(root.join(name))
    }

    fn move_files(&self) -> Result<(), ResultsError> {
        // Two that end at the same time must not leave a mixture. Without locks they might, and the checksums of the
        // manifest show it.
        let _alone = File::open(&self.target).and_then(|dir| dir.lock().map(|()| dir));
        self.remove_others()?;
        let mut files: Vec<&str> = self.files.iter().map(|file| file.name.as_str()).collect();
        files.sort_by_key(|&file| match file {
            MARKER => 0,
            INDEX => 2,
            _ => 1,
        });
        for file in files {
            let target = self.target.join(file);
            let folder = target.parent().unwrap_or(&self.target);
            fs::create_dir_all(folder)
                .map_err(ResultsError::io("create the folder of", &target))?;
            fs::rename(self.content().join(file), &target)
                .map_err(ResultsError::io("replace", &target))?;
        }
        Ok(())
    }
}

impl Drop for ResultFolder {
    fn drop(&mut self) {
        // The staging folder goes first, or its parents would not be empty.
        if !self.parents.is_empty() {
            let _ = fs::remove_dir_all(self.staging.path());
            remove_empty(&self.parents);
        }
    }
}

/// Writes `bytes` to the file at `path`, which keeps its old content until all of the new is on disk.
///
/// A device or a pipe, such as `/dev/stdout`, is written through: replacing it would break it.
///
/// # Errors
/// [`ResultsError::WrongKind`] if `path` is a folder, [`ResultsError::Io`] if not every byte could be
/// written.
pub fn write_file_atomically(path: &Path, bytes: impl AsRef<[u8]>) -> Result<(), ResultsError> {
    let fill = |file: &mut dyn Write| file.write_all(bytes.as_ref());
    match fs::metadata(path) {
        Ok(data) if data.is_dir() => Err(ResultsError::WrongKind {
            path: path.to_path_buf(),
            expected: "file",
        }),
        Ok(data) if !data.is_file() => {
            let open = fs::OpenOptions::new().write(true).open(path);
            let mut file = open.map_err(ResultsError::io("open", path))?;
            fill(&mut file)
                .and_then(|()| file.flush())
                .map_err(ResultsError::io("write", path))
        }
        // Behind a link the file is replaced, not the link.
        Ok(_) => {
            let real = fs::canonicalize(path).map_err(ResultsError::io("find", path))?;
            replace(&real, fill).map_err(ResultsError::io("write", path))
        }
        Err(_) => replace(path, fill).map_err(ResultsError::io("write", path)),
    }
}

fn replace(path: &Path, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let staged = staging::file(&parent(path), path)?;
    fill_file(staged.as_file(), |file| fill(file))?;
    staged.persist(path).map_err(|error| error.error)?;
    Ok(())
}

/// Fills a file and makes sure that every byte arrived: a full disk may only show at the last flush.
fn fill_file<F: Write + Synced + Send>(
    file: F,
    fill: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
) -> io::Result<()> {
    let mut writer = BufWriter::with_capacity(1 << 16, file);
    fill(&mut writer)?;
    writer.flush()?;
    writer.get_ref().synced()
}

/// Files whose late write errors can be asked for; closing one cannot report them.
trait Synced {
    fn synced(&self) -> io::Result<()>;
}

impl Synced for &mut Digesting<File> {
    fn synced(&self) -> io::Result<()> {
        self.get_ref().sync_data()
    }
}

impl Synced for &File {
    fn synced(&self) -> io::Result<()> {
        self.sync_data()
    }
}

/// Whether the folder exists; an error if it may not be written to.
fn check_target(dir: &Path) -> Result<bool, ResultsError> {
    let data = match fs::metadata(dir) {
        Ok(data) => data,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(false),
        Err(error) => return Err(ResultsError::io("read", dir)(error)),
    };
    if !data.is_dir() {
        return Err(ResultsError::WrongKind {
            path: dir.to_path_buf(),
            expected: "folder",
        });
    }
    let names = fs::read_dir(dir).map_err(ResultsError::io("read the folder", dir))?;
    let foreign = names
        .filter_map(Result::ok)
        .any(|entry| !entry.file_name().to_string_lossy().starts_with(STAGING));
    if foreign && !dir.join(MARKER).is_file() {
        return Err(ResultsError::ForeignFolder {
            path: dir.to_path_buf(),
            marker: MARKER,
        });
    }
    Ok(true)
}

/// The folder a path lies in; the current one for a bare name.
fn parent(path: &Path) -> PathBuf {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_path_buf(),
        _ => PathBuf::from("."),
    }
}

fn missing_ancestors(dir: &Path) -> Vec<PathBuf> {
    let missing = dir
        .ancestors()
        .take_while(|a| !a.as_os_str().is_empty() && !a.exists());
    let mut missing: Vec<_> = missing.map(Path::to_path_buf).collect();
    missing.reverse();
    missing
}

fn remove_empty(parents: &[PathBuf]) {
    for parent in parents.iter().rev() {
        // Fails if someone else put a file there, which is as it should be.
        let _ = fs::remove_dir(parent);
    }
}

/// A relative path of ordinary names only.
pub(crate) fn plain(name: &str) -> Result<PathBuf, ResultsError> {
    let path = Path::new(name);
    let ordinary = path
        .components()
        .all(|part| matches!(part, Component::Normal(_)));
    if name.is_empty() || name.ends_with('/') || !ordinary {
        return Err(ResultsError::BadName {
            name: name.to_owned(),
        });
    }
    Ok(path.to_path_buf())
}
