//! How work is cut: which items lie in which piece. It depends on their number alone, so that all who work
//! on them agree.

use super::Job;
use std::ops::Range;

/// Pieces of work, about: each costs a file, and an interruption costs those under way.
const PIECES: usize = 256;
/// Most items in a piece. A piece lost under way must be a part of a day's work also where a pixel
/// takes seconds, as those of the full model do. So 10 000 x 10 000 pixels are 24 415 pieces of some
/// 0.6 MB: no more of them can work at the same time, and file systems bear that many files in a folder.
const MOST: usize = 4096;
/// Items computed together, per thread: enough that lanes seldom wait for the last ones, few enough that pieces
/// with chaotic motions, which end last, do not have to wait long.
const TOGETHER: usize = 2048;

/// Items 0, 1, ... in pieces of neighbours.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    pub(super) items: usize,
    /// Items in a piece; the last one may have fewer.
    pub(super) size: usize,
}

impl Cut {
    pub(super) fn of<J: Job>(job: &J) -> Self {
        let items = job.items();
        let size = items.div_ceil(PIECES).clamp(J::LEAST, MOST);
        Self { items, size }
    }

    /// How many pieces there are.
    pub(super) fn pieces(&self) -> u32 {
        // a study has at most 10^8 items or so; beyond u32 there would be 10^13
        u32::try_from(self.items.div_ceil(self.size)).unwrap_or(u32::MAX)
    }

    /// The items of a piece; none if there is no such piece.
    pub(super) fn of_piece(&self, piece: u32) -> Range<usize> {
        let first = (piece as usize * self.size).min(self.items);
        first..(first + self.size).min(self.items)
    }

    pub(super) fn piece(&self, item: usize) -> u32 {
        (item / self.size) as u32
    }

    /// How many items these pieces have.
    pub(super) fn count(&self, pieces: impl IntoIterator<Item = u32>) -> usize {
        let lengths = pieces.into_iter().map(|piece| self.of_piece(piece).len());
        lengths.sum()
    }

    /// How many pieces are computed together by so many threads.
    pub(super) fn together(&self, threads: usize) -> usize {
        let available = || std::thread::available_parallelism().map_or(1, usize::from);
        let threads = if threads == 0 { available() } else { threads };
        (threads * TOGETHER).div_ceil(self.size).max(1)
    }
}

#[cfg(test)]
mod tests {
    use super::Cut;

    #[test]
    fn every_item_is_in_one_piece() {
        for (items, size) in [(1, 16), (16, 16), (17, 16), (1000, 7), (0, 16)] {
            let cut = Cut { items, size };
            let all: Vec<usize> = (0..cut.pieces()).flat_map(|p| cut.of_piece(p)).collect();
            assert_eq!(all, (0..items).collect::<Vec<_>>());
            assert!((0..items).all(|item| cut.of_piece(cut.piece(item)).contains(&item)));
            assert!(cut.of_piece(cut.pieces()).is_empty());
        }
    }
}
