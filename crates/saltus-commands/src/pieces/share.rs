//! The report of a shard.

use crate::answer::{Told, stream_json};
use crate::shard::Shard;
use saltus_results::shown::path;
use serde::Serialize;
use std::io::{self, Write};
use std::path::PathBuf;

/// Work of a shard. It has no parts: those are in the folder of pieces.
#[derive(Clone, Debug, Serialize)]
pub struct ShardReport {
    /// Name of the command.
    pub command: &'static str,
    /// Which shard.
    pub shard: Shard,
    /// Pieces of the whole work.
    pub pieces: u32,
    /// Pieces that were made.
    pub made: Vec<u32>,
    /// Pieces that were there.
    pub found: Vec<u32>,
    /// Their place.
    pub folder: PathBuf,
    /// Of the program.
    pub version: &'static str,
}

impl Told for ShardReport {
    fn summary(&self) -> String {
        let Self { shard, pieces, .. } = self;
        let (made, found) = (self.made.len(), self.found.len());
        let folder = path(&self.folder);
        if made + found == 0 {
            return format!(
                "Shard {shard}: nothing to do, since the work has {pieces} pieces only\n"
            );
        }
        format!(
            "Shard {shard}: {made} of the {pieces} pieces made, {found} there before, in `{folder}`\n"
        )
    }

    fn document(&self, to: &mut dyn Write) -> io::Result<()> {
        stream_json(to, self)
    }
}
