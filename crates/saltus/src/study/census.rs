//! The attractors of one model, as starts from a box lead to them, and what part of the box each draws.

use super::attractor::{Arrival, Found, Kind, Lost};
use super::basins::{Catalogue, Entry};
use super::fraction::Fraction;
use saltus_hybrid::Point;
use saltus_orbits::Closeness;

/// What all starts of a box came to. The counts add up to the number of starts.
///
/// An attractor that no start met is not in the list; [`Fraction::unseen`] bounds its share.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Census {
    /// The attractors, those with the most starts first.
    pub attractors: Vec<Counted>,
    /// Starts still on their way after eight searches; they count for no attractor.
    pub undecided: Fraction,
    /// Starts whose run ended early.
    pub lost: Fraction,
    /// Why the first of them did.
    pub first_lost: Option<Lost>,
}

/// One attractor of a [`Census`].
#[derive(Clone, Debug, PartialEq)]
pub struct Counted {
    /// Its number: the place in the list of a single census, the one that stays along a parameter.
    pub identity: usize,
    /// The motion; `first` and `closest` number the starts of the box, and what was carried here after them.
    pub entry: Entry,
    /// Part of the starts that led to it; 0 for one that was only met from another value of a parameter.
    pub fraction: Fraction,
    /// A state on it, to go on from, and its section.
    pub arrival: Arrival,
}

/// A census under way.
#[derive(Default)]
pub(super) struct Tally {
    catalogue: Catalogue,
    /// Of each entry's closest motion.
    arrivals: Vec<Arrival>,
    /// Motions met, carried ones included.
    met: usize,
    starts: u64,
    undecided: u64,
    lost: u64,
    first_lost: Option<Lost>,
}

impl Tally {
    /// Files what a start of the box led to.
    pub(super) fn count(&mut self, found: Found) {
        self.starts += 1;
        match (found.attractor, found.arrival) {
            (Ok(motion), _) if motion.kind == Kind::Undecided => self.undecided += 1,
            (Ok(motion), Some(arrival)) => {
                let number = self.catalogue.file(self.met, motion);
                self.keep(number, arrival);
            }
            (Ok(_), None) => {}
            (Err(lost), _) => {
                self.lost += 1;
                self.first_lost.get_or_insert(lost);
            }
        }
        self.met += 1;
    }

    /// Files what a motion carried here has become: the number of its attractor. No share changes.
    pub(super) fn meet(&mut self, found: Found) -> Option<usize> {
        let (motion, arrival) = (found.attractor.ok()?, found.arrival?);
        let number = self.catalogue.file_uncounted(self.met, motion);
        self.keep(number, arrival);
        self.met += 1;
        number
    }

    fn keep(&mut self, number: Option<usize>, arrival: Arrival) {
        let Some(number) = number else { return };
        if number == self.arrivals.len() {
            self.arrivals.push(arrival);
        } else if self.catalogue.entries()[number].closest == self.met {
            self.arrivals[number] = arrival;
        }
    }

    /// How many attractors there are.
    pub(super) fn len(&self) -> usize {
        self.arrivals.len()
    }

    /// A state on attractor `number`.
    pub(super) fn point(&self, number: usize) -> &Point {
        &self.arrivals[number].point
    }

    /// Whether attractor `number` is a cycle on which a motion surely was.
    pub(super) fn is_sure(&self, number: usize) -> bool {
        let motion = &self.catalogue.entries()[number].attractor;
        matches!(motion.kind, Kind::Periodic(_)) && motion.rest <= Closeness::TIGHT.rest
    }

    /// The census, and the place in it of each number. What was a transient to `root[number]` is no attractor,
    /// and its starts count for that one.
    pub(super) fn ranked(mut self, root: &[usize]) -> (Census, Vec<usize>) {
        let of = self.starts;
        let fraction = |count| Fraction { count, of };
        for (number, &root) in root
            .iter()
            .enumerate()
            .filter(|(number, root)| number != *root)
        {
            self.catalogue.count_for(number, root);
        }
        let (entries, rank) = self.catalogue.ranked();
        let mut kept: Vec<usize> = (0..root.len())
            .filter(|&number| root[number] == number)
            .collect();
        kept.sort_by_key(|&number| rank[number]);
        let place = |root: &usize| kept.iter().position(|number| number == root).unwrap_or(0);
        let counted = |(identity, &number): (usize, &usize)| {
            let entry = entries[rank[number]].clone();
            Counted {
                identity,
                fraction: fraction(entry.count),
                entry,
                arrival: self.arrivals[number].clone(),
            }
        };
        let census = Census {
            attractors: kept.iter().enumerate().map(counted).collect(),
            undecided: fraction(self.undecided),
            lost: fraction(self.lost),
            first_lost: self.first_lost,
        };
        (census, root.iter().map(place).collect())
    }
}
