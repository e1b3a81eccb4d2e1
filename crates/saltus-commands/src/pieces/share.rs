//! A shard: the part of the pieces that one of several processes makes.

use crate::failure::Failure;
use crate::request::Answer;
use crate::store::{Store, stream_json};
use saltus_results::shown::path;
use serde::Serialize;
use std::fmt;
use std::io::{self, Write};
use std::path::PathBuf;
use std::str::FromStr;

/// Which part of the work: every `of`-th piece, so that costs spread evenly, `number` from 1 to `of`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Shard {
    number: u32,
    of: u32,
}

/// Why there is no such shard.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ShardError {
    /// Not two numbers.
    #[error("give a shard as number/count, such as 3/64")]
    Form,
    /// No shards.
    #[error("there is no shard of none; the first of one is 1/1")]
    None,
    /// Not one of them.
    #[error("shards of {of} are counted from 1: 1/{of} to {of}/{of}")]
    Beyond {
        /// How many there are.
        of: u32,
    },
}

impl Shard {
    /// Shard `number` of `of`.
    ///
    /// # Errors
    /// [`ShardError`] unless `number` is from 1 to `of`.
    pub fn new(number: u32, of: u32) -> Result<Self, ShardError> {
        match (number, of) {
            (_, 0) => Err(ShardError::None),
            (number, of) if number == 0 || number > of => Err(ShardError::Beyond { of }),
            (number, of) => Ok(Self { number, of }),
        }
    }

    /// Which, from 1.
    pub fn number(self) -> u32 {
        self.number
    }

    /// Of how many.
    pub fn of(self) -> u32 {
        self.of
    }

    /// The shard of `of` that makes `piece`; `None` if `of` is 0.
    pub fn of_piece(piece: u32, of: u32) -> Option<Self> {
        let number = piece.checked_rem(of)? + 1;
        Some(Self { number, of })
    }

    /// Its pieces among `pieces`.
    pub fn pieces(self, pieces: u32) -> impl Iterator<Item = u32> {
        (self.number - 1..pieces).step_by(self.of as usize)
    }
}

impl FromStr for Shard {
    type Err = ShardError;

    fn from_str(text: &str) -> Result<Self, ShardError> {
        let (number, of) = text.split_once('/').ok_or(ShardError::Form)?;
        let whole = |text: &str| text.parse().map_err(|_| ShardError::Form);
        Self::new(whole(number)?, whole(of)?)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

/// What a shard has done. As an answer it has no parts: those are in the folder of pieces.
#[derive(Clone, Debug, Serialize)]
pub struct Share {
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
    /// Where they are.
    pub folder: PathBuf,
    /// Of the program.
    pub version: &'static str,
}

impl Answer for Share {
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

    fn fill(&self, _: &mut dyn Store) -> Result<(), Failure> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{Shard, ShardError};

    #[test]
    fn every_piece_is_in_one_shard() {
        for (of, pieces) in [(1, 7), (3, 7), (7, 7), (9, 7), (4, 0)] {
            let mut all = Vec::new();
            for number in 1..=of {
                let shard = Shard::new(number, of).expect("it is one of them");
                let own = shard.pieces(pieces);
                all.extend(own.inspect(|&p| assert_eq!(Shard::of_piece(p, of), Some(shard))));
            }
            all.sort_unstable();
            assert_eq!(all, (0..pieces).collect::<Vec<_>>());
        }
    }

    #[test]
    fn what_is_no_shard_is_told_what_would_be() {
        let beyond = Err(ShardError::Beyond { of: 4 });
        for (text, expected) in [
            ("4/4", Shard::new(4, 4)),
            ("0/4", beyond.clone()),
            ("5/4", beyond),
            ("0/0", Err(ShardError::None)),
            ("3", Err(ShardError::Form)),
            ("-1/4", Err(ShardError::Form)),
            ("1/4/2", Err(ShardError::Form)),
            ("1/99999999999", Err(ShardError::Form)),
        ] {
            assert_eq!(text.parse(), expected, "{text}");
        }
    }
}
