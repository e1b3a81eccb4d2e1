//! Basins of attraction: which of several attractors a start leads to, judged by the motions themselves.
//!
//! Cycles are the same if they have the same period and their samples agree within [`SAME`] after some
//! rotation: all starts are at phase 0 of the drive, so the n shifts of an n-cycle are one attractor
//! reached with different delays. Motions that do not repeat are the same if the ranges of every channel
//! at the samples overlap by more than half of the shorter one. A finite record of chaos
//! shows its band only roughly, so this joins two such attractors sooner than it invents one.

use crate::attractor::{Attractor, Range};
use saltus_orbits::MotionKind;

/// Samples that differ by no more than this may be of one cycle; twice what
/// a slow transient is allowed to leave of each, and as much again.
const SAME: f64 = 4e-3;

/// The attractors met so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AttractorCatalogue {
    entries: Vec<Entry>,
}

/// One attractor of a [`AttractorCatalogue`].
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The motion that came closest to it.
    pub attractor: Attractor,
    /// Number of starts that led to it.
    pub count: u64,
    /// Number of the first start that led to it.
    pub first: usize,
    /// Number of the start whose motion came closest to it.
    pub closest: usize,
    /// Ranges of all motions joined; of a cycle, its own.
    ranges: Vec<Range>,
}

impl Entry {
    /// Part of all starts that led to it.
    pub fn share(&self, starts: u64) -> f64 {
        self.count as f64 / starts as f64
    }

    /// Whether `motion` is on this attractor.
    pub(crate) fn holds(&self, motion: &Attractor) -> bool {
        match (motion.kind, self.attractor.kind) {
            (MotionKind::Periodic(n), MotionKind::Periodic(m)) if n == m => {
                same_cycle(motion, &self.attractor)
            }
            (a, b) if a.never_repeats() && b.never_repeats() => {
                same_band(&motion.ranges, &self.ranges)
            }
            _ => false,
        }
    }
}

impl AttractorCatalogue {
    /// Files a motion under the attractor it is on and gives that one's number, in order of discovery;
    /// `None` for a motion that is undecided. Numbers depend on the order of the calls, so file motions in
    /// the order of their starts.
    pub fn file(&mut self, start: usize, motion: Attractor) -> Option<usize> {
        let number = self.file_uncounted(start, motion)?;
        self.entries[number].count += 1;
        Some(number)
    }

    /// As [`Self::file`], for a motion from elsewhere that says nothing about shares.
    pub(crate) fn file_uncounted(&mut self, start: usize, motion: Attractor) -> Option<usize> {
        if motion.kind == MotionKind::Undecided {
            return None;
        }
        let known = self.entries.iter().position(|entry| entry.holds(&motion));
        let Some(number) = known else {
            self.entries.push(Entry {
                ranges: motion.ranges.clone(),
                attractor: motion,
                count: 0,
                first: start,
                closest: start,
            });
            return Some(self.entries.len() - 1);
        };
        let entry = &mut self.entries[number];
        for (all, one) in entry.ranges.iter_mut().zip(&motion.ranges) {
            *all = hull(*all, *one);
        }
        // one that Newton's method confirmed stands before all others
        let closeness = |motion: &Attractor| (motion.multiplier.is_none(), motion.rest);
        if closeness(&motion) < closeness(&entry.attractor) {
            entry.attractor = motion;
            entry.closest = start;
        }
        Some(number)
    }

    /// Counts the starts of one entry for another.
    pub(crate) fn count_for(&mut self, number: usize, other: usize) {
        let count = std::mem::take(&mut self.entries[number].count);
        let first = self.entries[number].first;
        let other = &mut self.entries[other];
        other.count += count;
        other.first = other.first.min(first);
    }

    /// The attractors in the order of discovery.
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// The attractors, those with the most starts first, of equals the one found first; and for each
    /// number given by [`Self::file`] its place in that list.
    pub fn ranked(self) -> (Vec<Entry>, Vec<usize>) {
        let mut order: Vec<usize> = (0..self.entries.len()).collect();
        let key = |number: &usize| {
            let entry = &self.entries[*number];
            (std::cmp::Reverse(entry.count), entry.first)
        };
        order.sort_by_key(key);
        let mut rank = vec![0; order.len()];
        for (place, &number) in order.iter().enumerate() {
            rank[number] = place;
        }
        let mut entries: Vec<Option<Entry>> = self.entries.into_iter().map(Some).collect();
        let ranked = order.iter().filter_map(|&number| entries[number].take());
        (ranked.collect(), rank)
    }
}

/// Whether some rotation brings the samples of two n-cycles together, for all channels at once.
fn same_cycle(a: &Attractor, b: &Attractor) -> bool {
    let n = a.section.first().map_or(0, Vec::len);
    let agree = |shift: usize| {
        let lists = a.section.iter().zip(&b.section);
        lists
            .flat_map(|(a, b)| (0..n).map(move |i| (a[i], b[(i + shift) % n])))
            .all(|(a, b)| (a - b).abs() <= SAME)
    };
    (0..n).any(agree)
}

fn same_band(a: &[Range], b: &[Range]) -> bool {
    a.iter().zip(b).all(|(a, b)| overlap(*a, *b))
}

/// By more than half of the shorter one.
fn overlap(a: Range, b: Range) -> bool {
    let common = a[1].min(b[1]) - a[0].max(b[0]);
    2.0 * common > (a[1] - a[0]).min(b[1] - b[0])
}

fn hull(a: Range, b: Range) -> Range {
    [a[0].min(b[0]), a[1].max(b[1])]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cycle(z: &[f64], rest: f64) -> Attractor {
        let range = z.iter().fold([f64::MAX, f64::MIN], |r, &z| hull(r, [z, z]));
        Attractor {
            kind: MotionKind::Periodic(z.len() as u32),
            contact_ratio: vec![0.5],
            peaks: vec![2.0, 3.0],
            section: vec![z.to_vec(), z.iter().map(|z| 2.0 * z).collect()],
            ranges: vec![range, range],
            rest,
            multiplier: None,
            exponent: None,
            confidence: None,
        }
    }

    fn band(low: f64, high: f64) -> Attractor {
        Attractor {
            kind: MotionKind::NotPeriodic,
            ranges: vec![[low, high], [low, high]],
            section: vec![vec![], vec![]],
            ..cycle(&[0.0], 0.0)
        }
    }

    #[test]
    fn shifts_of_a_cycle_are_one_attractor() {
        let mut all = AttractorCatalogue::default();
        assert_eq!(all.file(0, cycle(&[1.0, 2.0, 4.0], 1e-4)), Some(0));
        assert_eq!(all.file(1, cycle(&[2.0, 4.0, 1.0], 0.0)), Some(0));
        assert_eq!(all.file(2, cycle(&[4.001, 1.0, 2.0], 1e-3)), Some(0));
        // another order, another period, other values
        assert_eq!(all.file(3, cycle(&[2.0, 1.0, 4.0], 0.0)), Some(1));
        assert_eq!(all.file(4, cycle(&[1.0, 2.0, 4.0, 4.0], 0.0)), Some(2));
        assert_eq!(all.file(5, cycle(&[1.0, 2.0, 4.1], 0.0)), Some(3));
        let (entries, _) = all.ranked();
        assert_eq!(entries[0].count, 3);
        assert_eq!(
            entries[0].attractor.rest, 0.0,
            "the closest one stands for all"
        );
        assert_eq!(entries[0].closest, 1);
    }

    #[test]
    fn bands_are_joined_rather_than_told_apart() {
        let mut all = AttractorCatalogue::default();
        assert_eq!(all.file(0, band(0.0, 1.0)), Some(0));
        assert_eq!(all.file(1, band(0.1, 0.9)), Some(0));
        assert_eq!(all.file(2, band(0.4, 1.4)), Some(0));
        assert_eq!(all.file(3, band(1.3, 1.35)), Some(0), "the band has grown");
        assert_eq!(all.file(4, band(3.0, 4.0)), Some(1));
    }

    #[test]
    fn order_is_by_share_and_then_by_the_first_start() {
        let mut all = AttractorCatalogue::default();
        let starts = [1.0, 2.0, 3.0, 3.0, 2.0];
        for (start, z) in starts.iter().enumerate() {
            all.file(start, cycle(&[*z], 0.0));
        }
        let lost = Attractor {
            kind: MotionKind::Undecided,
            ..cycle(&[9.0], 0.0)
        };
        assert_eq!(all.file(5, lost), None);
        let (entries, rank) = all.ranked();
        let z: Vec<f64> = entries.iter().map(|e| e.attractor.section[0][0]).collect();
        assert_eq!(z, [2.0, 3.0, 1.0]);
        assert_eq!(rank, [2, 0, 1]);
        assert_eq!(entries[0].share(6), 1.0 / 3.0);
    }
}
