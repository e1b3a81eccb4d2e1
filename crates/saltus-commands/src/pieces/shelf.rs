//! Storage of pieces, and the inventory of it.

use super::Job;
use super::cut::Cut;
use super::fingerprint::Fingerprint;
use crate::context::{Existing, Pieces, PiecesAt, RunContext};
use crate::failure::CommandError;
use crate::shard::{DefectivePiece, Shard};
use saltus_results::pieces::{MANIFEST, pieces_beside};
use saltus_results::shown::path;
use saltus_results::{PieceStore, ResultsError, Seal};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Storage of finished pieces.
pub(super) enum PieceStorage<'a> {
    Nowhere,
    Folder(PieceStore),
    /// Contents of whole pieces. Read only: what is made here is used at once.
    Memory(BTreeMap<u32, &'a [u8]>, BTreeMap<u32, String>),
}

/// Which pieces are there.
#[derive(Default)]
pub(super) struct PieceInventory {
    pub(super) whole: BTreeSet<u32>,
    /// In the order of their numbers; also those that are no piece of this work.
    pub(super) damaged: BTreeMap<u32, String>,
}

/// The pieces after the computation.
pub(crate) struct PieceFolder(Option<PieceStore>);

impl<'a> PieceStorage<'a> {
    pub(super) fn open<J: Job>(job: &J, context: &'a RunContext) -> Result<Self, CommandError> {
        let Some(Pieces { place, found }) = &context.keep else {
            return Ok(Self::Nowhere);
        };
        let fingerprint = Fingerprint::of(job, Cut::of(job));
        Ok(match place {
            PiecesAt::Memory(pieces) => opened(fingerprint.seal(), pieces),
            PiecesAt::Beside(out) => {
                let dir = pieces_beside(out);
                Self::Folder(folder(&dir, *found, &fingerprint.names())?)
            }
        })
    }

    pub(super) fn stock(&self, cut: Cut) -> Result<PieceInventory, CommandError> {
        let mut stock = PieceInventory::default();
        match self {
            Self::Nowhere => {}
            Self::Folder(store) => {
                let survey = store.survey()?;
                stock.whole.extend(survey.whole);
                let damaged = survey.damaged.into_iter();
                stock.damaged.extend(damaged.map(|d| (d.piece, d.problem)));
            }
            Self::Memory(whole, damaged) => {
                stock.whole.extend(whole.keys());
                stock.damaged.clone_from(damaged);
            }
        }
        stock.whole.retain(|&piece| piece < cut.pieces());
        // of two with the same number one may be whole
        let PieceInventory { whole, damaged } = &mut stock;
        damaged.retain(|piece, _| !whole.contains(piece));
        Ok(stock)
    }

    /// The content of a piece that was whole a moment ago.
    pub(super) fn read(&self, piece: u32) -> Result<Option<Vec<u8>>, CommandError> {
        Ok(match self {
            Self::Nowhere => None,
            Self::Folder(store) => store.read(piece)?,
            Self::Memory(whole, _) => whole.get(&piece).map(|content| content.to_vec()),
        })
    }

    pub(super) fn write(&self, piece: u32, content: &[u8]) -> Result<(), CommandError> {
        match self {
            Self::Folder(store) => Ok(store.write(piece, content)?),
            Self::Nowhere | Self::Memory(..) => Ok(()),
        }
    }

    pub(super) fn is_nowhere(&self) -> bool {
        matches!(self, Self::Nowhere)
    }

    /// Faults of these pieces, with the shards that would make them.
    pub(super) fn lacks(
        &self,
        stock: &PieceInventory,
        pieces: &[u32],
        cut: Cut,
    ) -> Vec<DefectivePiece> {
        let store = match self {
            Self::Folder(store) => Some(store),
            _ => None,
        };
        let shards = store.and_then(PieceStore::last_remark);
        let shards: u32 = shards.and_then(|text| text.parse().ok()).unwrap_or(0);
        let lack = |piece| {
            let beyond = (piece >= cut.pieces()).then_some(cut.pieces());
            let problem = stock.damaged.get(&piece);
            DefectivePiece {
                piece,
                file: store.map(|store| store.file(piece)),
                problem: problem.map_or("missing", String::as_str).to_owned(),
                shard: Shard::of_piece(piece, shards).filter(|_| beyond.is_none()),
                beyond,
            }
        };
        pieces.iter().copied().map(lack).collect()
    }

    pub(super) fn close(self) -> PieceFolder {
        match self {
            Self::Folder(store) => PieceFolder(Some(store)),
            Self::Nowhere | Self::Memory(..) => PieceFolder(None),
        }
    }
}

impl PieceFolder {
    /// The folder of pieces, if there is one.
    pub(crate) fn path(&self) -> Option<&Path> {
        self.0.as_ref().map(PieceStore::path)
    }

    /// Removes the pieces: the results are there.
    pub(crate) fn remove(&mut self) -> Result<(), CommandError> {
        Ok(self.0.take().map_or(Ok(()), PieceStore::remove)?)
    }

    /// Error after an interruption.
    pub(super) fn suspended(self) -> CommandError {
        match self.0 {
            Some(store) => CommandError::Suspended {
                folder: store.path().to_path_buf(),
                shard: false,
            },
            None => CommandError::Interrupted,
        }
    }
}

/// Pieces in memory, looked at one by one.
fn opened<'a>(seal: Seal, pieces: &'a [(u32, Vec<u8>)]) -> PieceStorage<'a> {
    let (mut whole, mut damaged) = (BTreeMap::new(), BTreeMap::new());
    for (number, bytes) in pieces {
        match seal.open(*number, bytes) {
            Ok(content) => drop(whole.insert(*number, content)),
            Err(problem) => drop(damaged.insert(*number, problem)),
        }
    }
    PieceStorage::Memory(whole, damaged)
}

/// The folder beside the results. One that is left over is only used if that was asked for, and one that is not there
/// is only made if something is to be computed.
fn folder(dir: &Path, found: Existing, work: &[(&str, &str)]) -> Result<PieceStore, CommandError> {
    match found {
        Existing::Merge => PieceStore::open_to_merge(dir, work).map_err(|error| match error {
            ResultsError::AbsentPieces { .. } => CommandError::work(
                error,
                "make them first, with --shard, or compute all in one run without --merge",
            ),
            error => error.into(),
        }),
        Existing::Refuse if dir.join(MANIFEST).exists() => Err(CommandError::work(
            format!(
                "the work folder `{}` of an interrupted run is still there",
                path(dir)
            ),
            "add --resume to go on with it, or remove it to start anew",
        )),
        Existing::Refuse | Existing::Resume => Ok(PieceStore::open(dir, work)?),
    }
}
