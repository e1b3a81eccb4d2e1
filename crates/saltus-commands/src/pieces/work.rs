//! Making pieces, and putting them together.
//!
//! Items come in any order and leave in theirs: pieces that are complete wait until all before them are, so results
//! do not depend on who was first, and what is held in memory is the pieces under way and not the whole.

use super::cut::Cut;
use super::fingerprint::Fingerprint;
use super::shelf::{PieceFolder, PieceInventory, PieceStorage};
use super::{Job, Reader, ShardReport, Writer};
use crate::context::{Existing, Pieces, PiecesAt, RunContext};
use crate::failure::CommandError;
use crate::shard::Shard;
use saltus::study::Control;
use saltus_results::pieces::pieces_beside;
use saltus_results::{PieceStore, ResultsError};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicU64;

/// Takes complete pieces.
type Gather<'a, T> = &'a mut (dyn FnMut(u32, Vec<T>) -> Result<(), CommandError> + Send);

/// Computes the work, or what is missing of it, and hands it item by item to `gather`, in their order. The pieces
/// kept until then are there until somebody removes them.
pub(crate) fn run<J: Job>(
    job: &J,
    context: &RunContext,
    gather: &mut (dyn FnMut(usize, J::Item) + Send),
) -> Result<PieceFolder, CommandError> {
    let cut = Cut::of(job);
    let shelf = PieceStorage::open(job, context)?;
    let stock = shelf.stock(cut)?;
    let all = 0..cut.pieces();
    let missing: Vec<u32> = all.filter(|piece| !stock.whole.contains(piece)).collect();
    complete(&shelf, &stock, &missing, cut, context)?;
    let mut queue = Queue {
        job,
        cut,
        shelf: &shelf,
        stock: &stock,
        gather,
        waiting: BTreeMap::new(),
        next: 0,
    };
    let computed = watched(
        job,
        cut,
        context,
        stock.whole.iter().copied(),
        cut.items,
        |control| {
            produce(job, &missing, control, &mut |piece, items| {
                queue.put(piece, items)
            })?;
            queue.hand_on()
        },
    );
    let kept = shelf.close();
    match computed.and_then(|()| context.check()) {
        Ok(()) => Ok(kept),
        Err(CommandError::Interrupted) => Err(kept.suspended()),
        Err(failure) => Err(failure),
    }
}

/// Makes what is missing of a shard, beside others that make theirs. Nobody puts pieces together here.
pub(super) fn share<J: Job>(
    job: &J,
    shard: Shard,
    context: &RunContext,
) -> Result<ShardReport, CommandError> {
    let Some(Pieces {
        place: PiecesAt::Beside(out),
        ..
    }) = &context.keep
    else {
        return Err(CommandError::refused(
            "a shard leaves its pieces beside the folder of results, and there is none",
            "say where the results are to be",
        ));
    };
    let cut = Cut::of(job);
    let work = Fingerprint::of(job, cut);
    let store = PieceStore::open_shared(&pieces_beside(out), &work.names())?;
    store.remark(&shard.of().to_string())?;
    let mut share = ShardReport {
        command: job.command(),
        shard,
        pieces: cut.pieces(),
        made: Vec::new(),
        found: Vec::new(),
        folder: store.path().to_path_buf(),
        version: env!("CARGO_PKG_VERSION"),
    };
    let mut missing = Vec::new();
    for piece in shard.pieces(cut.pieces()) {
        match store.read(piece) {
            Ok(Some(_)) => share.found.push(piece),
            Ok(None) => missing.push(piece),
            Err(error @ ResultsError::DamagedPiece { .. }) => {
                context.watch.note(&error.to_string());
                missing.push(piece);
            }
            Err(error) => return Err(error.into()),
        }
    }
    let found = share.found.clone();
    let total = cut.count(shard.pieces(cut.pieces()));
    let made = &mut share.made;
    watched(job, cut, context, found.into_iter(), total, |control| {
        produce(job, &missing, control, &mut |piece, items| {
            store.write(piece, &content(job, &items))?;
            made.push(piece);
            Ok(())
        })
    })
    .map_err(|failure| match failure {
        CommandError::Interrupted => suspended(store.path()),
        other => other,
    })?;
    share.made.sort_unstable();
    Ok(share)
}

fn suspended(folder: &Path) -> CommandError {
    CommandError::Suspended {
        folder: folder.to_path_buf(),
        shard: true,
    }
}

/// These pieces as the bytes of their files.
pub(super) fn compute<J: Job>(
    job: &J,
    pieces: &[u32],
    context: &RunContext,
) -> Result<Vec<(u32, Vec<u8>)>, CommandError> {
    let cut = Cut::of(job);
    let count = cut.pieces();
    if let Some(piece) = pieces.iter().find(|&&piece| piece >= count) {
        return Err(CommandError::refused(
            format!("there is no piece {piece}"),
            format!(
                "this work has {count} pieces, 0 to {}",
                count.saturating_sub(1)
            ),
        ));
    }
    let pieces: Vec<u32> = BTreeSet::from_iter(pieces).into_iter().copied().collect();
    let seal = Fingerprint::of(job, cut).seal();
    let mut made = BTreeMap::new();
    let total = cut.count(pieces.iter().copied());
    watched(job, cut, context, std::iter::empty(), total, |control| {
        produce(job, &pieces, control, &mut |piece, items| {
            made.insert(piece, seal.close(piece, &content(job, &items)));
            Ok(())
        })
    })?;
    Ok(made.into_iter().collect())
}

/// Refuses to go on with pieces missing if nothing is to be computed; otherwise names those that are made again.
fn complete(
    shelf: &PieceStorage,
    stock: &PieceInventory,
    missing: &[u32],
    cut: Cut,
    context: &RunContext,
) -> Result<(), CommandError> {
    let merge = context
        .keep
        .as_ref()
        .is_some_and(|keep| keep.found == Existing::Merge);
    let strange = stock.damaged.keys().filter(|&&piece| piece >= cut.pieces());
    let lacking: Vec<u32> = missing.iter().copied().chain(strange.copied()).collect();
    let lacks = shelf.lacks(stock, &lacking, cut);
    if merge && !lacks.is_empty() {
        let pieces = cut.pieces();
        return Err(CommandError::Incomplete { lacks, pieces });
    }
    // a run that was killed lacks what it had not come to; that is no news
    let shards = lacks.iter().any(|lack| lack.shard.is_some());
    for lack in lacks.iter().filter(|lack| lack.beyond.is_some()) {
        context.watch.note(&lack.to_string());
    }
    for &piece in missing {
        if let Some(problem) = stock.damaged.get(&piece) {
            let note = format!("piece {piece} is damaged ({problem}) and is made again");
            context.watch.note(&note);
        } else if shards {
            context
                .watch
                .note(&format!("piece {piece} is missing and is made here"));
        }
    }
    Ok(())
}

/// Does `work` while someone watches; the items of `found` are done already.
fn watched<J: Job>(
    job: &J,
    cut: Cut,
    context: &RunContext,
    found: impl Iterator<Item = u32>,
    total: usize,
    work: impl FnOnce(&Control) -> Result<(), CommandError>,
) -> Result<(), CommandError> {
    let (total, unit) = job.effort(total);
    let (done, _) = job.effort(cut.count(found));
    let control = Control {
        done: Arc::new(AtomicU64::new(done)),
        ..context.control(job.study())
    };
    context.follow(total, unit, &control.done, || work(&control))
}

/// Computes these pieces, some together, and hands on each when it is complete.
fn produce<J: Job>(
    job: &J,
    pieces: &[u32],
    control: &Control,
    sink: Gather<J::Item>,
) -> Result<(), CommandError> {
    let cut = Cut::of(job);
    for some in pieces.chunks(cut.together(control.threads)) {
        let items: Vec<usize> = some.iter().flat_map(|&piece| cut.of_piece(piece)).collect();
        let mut under_way = BTreeMap::new();
        job.compute(&items, control, &mut |number, item| {
            let piece = cut.piece(number);
            let own = cut.of_piece(piece);
            let open: &mut Open<_> = under_way
                .entry(piece)
                .or_insert_with(|| Open::new(own.len()));
            if !open.put(number - own.start, item) {
                return Ok(());
            }
            let complete = under_way.remove(&piece);
            sink(piece, complete.map_or(Vec::new(), Open::items))
        })?;
    }
    Ok(())
}

/// A piece under way.
struct Open<T> {
    left: usize,
    items: Vec<Option<T>>,
}

impl<T> Open<T> {
    fn new(items: usize) -> Self {
        Self {
            left: items,
            items: (0..items).map(|_| None).collect(),
        }
    }

    /// Takes an item, and says whether it was the last one.
    fn put(&mut self, place: usize, item: T) -> bool {
        if self.items[place].replace(item).is_none() {
            self.left -= 1;
        }
        self.left == 0
    }

    fn items(self) -> Vec<T> {
        self.items.into_iter().flatten().collect()
    }
}

/// Pieces on their way to `gather`.
struct Queue<'a, J: Job> {
    job: &'a J,
    cut: Cut,
    shelf: &'a PieceStorage<'a>,
    stock: &'a PieceInventory,
    gather: &'a mut (dyn FnMut(usize, J::Item) + Send),
    /// Complete pieces that wait for one before them.
    waiting: BTreeMap<u32, Vec<J::Item>>,
    /// First piece that was not handed on.
    next: u32,
}

impl<J: Job> Queue<'_, J> {
    /// Takes a piece. It is kept when this returns.
    fn put(&mut self, piece: u32, items: Vec<J::Item>) -> Result<(), CommandError> {
        if !self.shelf.is_nowhere() {
            self.shelf.write(piece, &content(self.job, &items))?;
        }
        self.waiting.insert(piece, items);
        self.hand_on()
    }

    /// Hands on all pieces whose turn has come.
    fn hand_on(&mut self) -> Result<(), CommandError> {
        while self.next < self.cut.pieces() {
            let items = match self.waiting.remove(&self.next) {
                Some(items) => items,
                None if self.stock.whole.contains(&self.next) => self.read(self.next)?,
                None => return Ok(()),
            };
            for (number, item) in self.cut.of_piece(self.next).zip(items) {
                (self.gather)(number, item);
            }
            self.next += 1;
        }
        Ok(())
    }

    fn read(&self, piece: u32) -> Result<Vec<J::Item>, CommandError> {
        let bytes = self.shelf.read(piece)?.unwrap_or_default();
        let mut from = Reader::new(&bytes);
        let numbers = self.cut.of_piece(piece);
        let items: Option<Vec<_>> = numbers.map(|n| self.job.read(n, &mut from)).collect();
        items.filter(|_| from.is_empty()).ok_or_else(|| {
            CommandError::work(
                format!("piece {piece} was changed during the run, or made by another build"),
                "remove the pieces and start anew",
            )
        })
    }
}

/// Content of a piece.
fn content<J: Job>(job: &J, items: &[J::Item]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut out = Writer::new(&mut bytes);
    items.iter().for_each(|item| job.write(item, &mut out));
    bytes
}
