//! A piece that is not there as it should be.

use super::Shard;
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
    /// Which shard makes it, if there were shards.
    pub shard: Option<Shard>,
}

impl fmt::Display for Lack {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "piece {}", self.piece)?;
        if let Some(file) = &self.file {
            write!(f, " `{}`", file.display())?;
        }
        write!(f, ": {}", self.problem)?;
        self.shard
            .map_or(Ok(()), |shard| write!(f, "; --shard {shard} makes it"))
    }
}
