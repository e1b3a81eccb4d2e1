//! A piece that is not there as it should be.

use super::Shard;
use saltus_results::shown::path;
use std::fmt;
use std::path::PathBuf;

/// What is wrong with a piece.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lack {
    /// Its number.
    pub piece: u32,
    /// Its file, if it is one.
    pub file: Option<PathBuf>,
    /// What is wrong: "missing", or as "99 bytes of content, not 100".
    pub problem: String,
    /// Which shard makes it, if there were shards and one does.
    pub shard: Option<Shard>,
    /// How many pieces the work has, if this is none of them.
    pub beyond: Option<u32>,
}

impl fmt::Display for Lack {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "piece {}", self.piece)?;
        if let Some(file) = &self.file {
            write!(f, " `{}`", path(file))?;
        }
        write!(f, ": {}", self.problem)?;
        match (self.beyond, self.shard) {
            (Some(pieces), _) => write!(f, "; it is too many, the work has {pieces}: remove it"),
            (None, Some(shard)) => write!(f, "; --shard {shard} makes it"),
            (None, None) => Ok(()),
        }
    }
}
