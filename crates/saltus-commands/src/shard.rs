//! A shard, the part of the pieces that one of several processes makes, and a piece that is not there as it should be.

use saltus_results::shown::path;
use serde::Serialize;
use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

/// A part of the work: every `of`-th piece, so that costs spread evenly, `number` from 1 to `of`.
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
        /// Number of shards.
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

    /// Its number, from 1.
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

/// A fault of a piece.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DefectivePiece {
    /// Its number.
    pub piece: u32,
    /// Its file, if it is one.
    pub file: Option<PathBuf>,
    /// The fault: "missing", or as "99 bytes of content, not 100".
    pub problem: String,
    /// The shard that makes it, if there were shards and one does.
    pub shard: Option<Shard>,
    /// Number of pieces of the work, if this is none of them.
    pub beyond: Option<u32>,
}

impl fmt::Display for DefectivePiece {
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
