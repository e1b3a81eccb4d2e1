//! Failures to draw, to write or to read a result: one enum for the whole crate.

use crate::shown;
use std::io;
use std::path::{Path, PathBuf};

/// Failure to draw or to write a result. Every message names the place and the reason.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ResultsError {
    /// The operating system refused a file operation.
    #[error("cannot {action} `{}`: {}", shown::path(path), reason(source))]
    Io {
        /// The operation, as a verb: "write", "create the folder", ...
        action: &'static str,
        /// The path in question.
        path: PathBuf,
        /// The refusal itself.
        source: io::Error,
    },
    /// The target folder holds files that this program did not write.
    #[error(
        "the folder `{}` is not empty and holds no `{marker}`: \
         choose a new folder, an empty one, or one written by this program",
        shown::path(path)
    )]
    ForeignFolder {
        /// The folder that was left alone.
        path: PathBuf,
        /// The marker file that would have allowed the replacement.
        marker: &'static str,
    },
    /// The target of a folder is a file, or the target of a file is a folder.
    #[error("cannot write {}: it is not a {expected}", shown::path(path))]
    WrongKind {
        /// The path in question.
        path: PathBuf,
        /// The kind that is needed: "folder" or "file".
        expected: &'static str,
    },
    /// A name inside a result folder that is not a plain relative path.
    #[error(
        "`{}` is no name for a file inside a result folder: use a relative path without `..`",
        shown::printable(name)
    )]
    BadName {
        /// The refused name.
        name: String,
    },
    /// A path that should be a result folder and is none.
    #[error("`{}` is no result of saltus: {problem}", shown::path(path))]
    NotAResult {
        /// The path in question.
        path: PathBuf,
        /// The reason.
        problem: String,
    },
    /// The manifest of a result folder is not one that this version reads.
    #[error("the manifest `{}` cannot be used: {problem}", shown::path(path))]
    Manifest {
        /// The manifest.
        path: PathBuf,
        /// The fault, and what would be right.
        problem: String,
    },
    /// A table could not be written to its destination.
    #[error("cannot write the table: {}", reason(source))]
    Table {
        /// The refusal of the destination.
        source: io::Error,
    },
    /// A row has another number of cells than the header.
    #[error("row {row} has {cells} cells, the header has {columns}")]
    RowLength {
        /// Row number, counted from 1.
        row: usize,
        /// Cells in the row.
        cells: usize,
        /// Columns in the header.
        columns: usize,
    },
    /// A dataset whose parts do not fit each other.
    #[error("the dataset cannot be written: `{name}` {problem}")]
    Dataset {
        /// The variable, dimension or attribute in question.
        name: String,
        /// The fault, and what would be right.
        problem: String,
    },
    /// Bytes that should be a dataset and are none that this program writes.
    #[error("the dataset cannot be read: {reason}")]
    Unreadable {
        /// The reader's own words.
        reason: String,
    },
    /// A folder of pieces is in use by another run.
    #[error(
        "the folder `{}` is in use by another run{}: wait for it to end, or choose another folder",
        shown::path(path),
        process.map(|id| format!(" (process {id})")).unwrap_or_default()
    )]
    PiecesInUse {
        /// The folder of pieces.
        path: PathBuf,
        /// The process that holds it, if it could be read.
        process: Option<u32>,
    },
    /// The pieces in a folder belong to other work.
    #[error(
        "the pieces in `{}` belong to other work: {differences}. Choose another folder, or remove this one",
        shown::path(path)
    )]
    ForeignPieces {
        /// The folder of pieces.
        path: PathBuf,
        /// The differences in words: each name with the value found and the value expected.
        differences: String,
    },
    /// A folder meant for pieces holds something else.
    #[error(
        "the folder `{}` is not empty and holds no `{manifest}`: choose a new or an empty folder for the pieces",
        shown::path(path)
    )]
    NoPieces {
        /// The folder that was left alone.
        path: PathBuf,
        /// The file that would have marked it as a folder of pieces.
        manifest: &'static str,
    },
    /// A folder that should hold pieces holds none, or is not there.
    #[error(
        "there are no pieces in `{}`: there is no `{manifest}`",
        shown::path(path)
    )]
    AbsentPieces {
        /// The folder in question.
        path: PathBuf,
        /// The file that would have marked it as a folder of pieces.
        manifest: &'static str,
    },
    /// A piece is there, but not as it was written.
    #[error(
        "the piece `{}` is damaged ({problem}); it will have to be made again",
        shown::path(path)
    )]
    DamagedPiece {
        /// File of the piece.
        path: PathBuf,
        /// The damage, in words.
        problem: String,
    },
    /// A PNG of this size cannot be drawn.
    #[error(
        "a PNG of {width} x {height} at scale {scale} cannot be drawn: choose a scale between 0.3 and 32"
    )]
    PngScale {
        /// Width of the figure (px).
        width: f64,
        /// Height of the figure (px).
        height: f64,
        /// The refused scale (-).
        scale: f32,
    },
    /// A size of figures that is none.
    #[error("the {what} is `{given}`; right is {right}")]
    FigureStyle {
        /// Name of the size.
        what: &'static str,
        /// The refused words.
        given: String,
        /// Words for a right one.
        right: &'static str,
    },
    /// The rasteriser refused the figure.
    #[error("the figure could not be turned into a PNG: {reason}")]
    Png {
        /// The rasteriser's own words.
        reason: String,
    },
}

impl ResultsError {
    /// An [`ResultsError::Io`] that remembers what was attempted and where.
    pub(crate) fn io(action: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_path_buf();
        move |source| Self::Io {
            action,
            path,
            source,
        }
    }
}

/// The common refusals in words a person can act on; anything else in the system's own.
fn reason(source: &io::Error) -> String {
    let words = match source.kind() {
        io::ErrorKind::PermissionDenied => "permission denied",
        io::ErrorKind::NotFound => "no such file or folder",
        io::ErrorKind::NotADirectory => "a part of the path is a file, not a folder",
        io::ErrorKind::IsADirectory => "it is a folder",
        io::ErrorKind::StorageFull => "no space left on the device",
        io::ErrorKind::QuotaExceeded => "the disk quota is used up",
        io::ErrorKind::ReadOnlyFilesystem => "the file system is read-only",
        io::ErrorKind::BrokenPipe => "the reader closed the pipe",
        _ => return source.to_string(),
    };
    words.to_owned()
}
