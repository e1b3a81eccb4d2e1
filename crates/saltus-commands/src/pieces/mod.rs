//! Long work in numbered pieces: kept while the rest is computed, made by many processes, put together.
//!
//! A piece is a run of neighbouring items, such as pixels, none of which depends on another to the bit. So who makes
//! a piece, when, and beside which others is all the same, and so is making it twice. Its bytes tell whether
//! they are whole and of which work. Three ways lead to them: [`run`] makes an answer and keeps pieces on the
//! way; [`Divided::share`] makes those of one shard, in the same folder; [`Divided::compute`] hands them out for
//! schedulers that carry bytes and no files. [`run`] is also what puts them together.

mod codec;
mod cut;
mod fingerprint;
mod share;
mod shelf;
mod work;

use crate::context::RunContext;
use crate::failure::CommandError;
use crate::shard::Shard;
use cut::Cut;
use saltus::study::Control;
use saltus_config::Study;

pub(crate) use codec::{Reader, Writer};
pub use share::ShardReport;
pub(crate) use shelf::PieceFolder;
pub(crate) use work::run;

/// Work that can be cut: items 0, 1, ... that do not depend on each other.
pub(crate) trait Job: Sync {
    /// Finding of one item.
    type Item: Send;
    /// Least items in a piece: enough for the lanes of a thread, whatever they cost.
    const LEAST: usize;
    /// Name of the items, such as "pixels".
    const ITEMS: &'static str;

    /// Name of the command.
    fn command(&self) -> &'static str;

    /// The study.
    fn study(&self) -> &Study;

    /// How many items there are.
    fn items(&self) -> usize;

    /// How much has been done with so many items, and in which unit progress is counted.
    fn effort(&self, items: usize) -> (u64, &'static str);

    /// Computes these items, each into `sink` in any order, and counts in `control.done`.
    fn compute(
        &self,
        items: &[usize],
        control: &Control,
        sink: Sink<Self::Item>,
    ) -> Result<(), CommandError>;

    /// Appends an item to the content of its piece.
    fn write(&self, item: &Self::Item, out: &mut Writer);

    /// The item with this number; `None` if the bytes are not what [`Self::write`] writes.
    fn read(&self, number: usize, from: &mut Reader) -> Option<Self::Item>;
}

/// Takes items with their numbers.
pub(crate) type Sink<'a, T> = &'a mut (dyn FnMut(usize, T) -> Result<(), CommandError> + Send);

/// Work as those see it who ask for pieces of it.
pub(crate) trait Divided {
    /// How many pieces there are.
    fn pieces(&self) -> u32;

    /// Makes what is missing of a shard, in the folder of pieces.
    fn share(&self, shard: Shard, context: &RunContext) -> Result<ShardReport, CommandError>;

    /// Makes these pieces, as the bytes of their files.
    fn compute(
        &self,
        pieces: &[u32],
        context: &RunContext,
    ) -> Result<Vec<(u32, Vec<u8>)>, CommandError>;
}

impl<J: Job> Divided for J {
    fn pieces(&self) -> u32 {
        Cut::of(self).pieces()
    }

    fn share(&self, shard: Shard, context: &RunContext) -> Result<ShardReport, CommandError> {
        work::share(self, shard, context)
    }

    fn compute(
        &self,
        pieces: &[u32],
        context: &RunContext,
    ) -> Result<Vec<(u32, Vec<u8>)>, CommandError> {
        work::compute(self, pieces, context)
    }
}
