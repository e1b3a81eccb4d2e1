//! The attractors of one model, as starts from a box lead to them, and what part of the box each draws.
//!
//! Each comes with the evidence that it is one: a cycle with its Floquet multipliers, a torus with an exponent that is
//! zero, chaos with an exponent and with motions that were watched and did not leave it.

use crate::attractor::{Arrival, Found, Lost};
use crate::basins::{AttractorCatalogue, Entry};
use crate::fraction::BasinFraction;
use crate::survival::Survival;
use saltus_hybrid::Point;
use saltus_orbits::MotionKind;
use std::collections::BTreeSet;

/// Ends of all starts of a box. The counts add up to the number of starts.
///
/// An attractor that no start met is not in the list; [`BasinFraction::unseen`] bounds its share.
#[derive(Clone, Debug, PartialEq)]
pub struct AttractorCensus<E> {
    /// The attractors, those with the most starts first.
    pub attractors: Vec<CountedAttractor>,
    /// Chaos that looked like an attractor and ends.
    pub transients: Vec<Transient>,
    /// Starts still on their way after eight searches, or on a cycle that is not known to be stable; they count for no
    /// attractor.
    pub undecided: BasinFraction,
    /// Starts whose run ended early.
    pub lost: BasinFraction,
    /// Reason why the first of them did.
    pub first_lost: Option<Lost<E>>,
}

impl<E> Default for AttractorCensus<E> {
    fn default() -> Self {
        Self {
            attractors: Vec::new(),
            transients: Vec::new(),
            undecided: BasinFraction::default(),
            lost: BasinFraction::default(),
            first_lost: None,
        }
    }
}

/// One attractor of a [`AttractorCensus`].
#[derive(Clone, Debug, PartialEq)]
pub struct CountedAttractor {
    /// Its number: the place in the list of a single census, the one that stays along a parameter.
    pub identity: usize,
    /// The motion; `first` and `closest` number the starts of the box, and what was carried here after them.
    pub entry: Entry,
    /// Part of the starts that led to it; 0 for one that was only met from another value of a parameter.
    pub fraction: BasinFraction,
    /// A state on it, to go on from, and its section.
    pub arrival: Arrival,
    /// Of chaos: how long it was watched. None of the motions left it.
    pub survival: Option<Survival>,
}

/// Chaos that is no attractor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transient {
    /// Part of the starts that were in it when their search was over. They count for the attractor that it ends on.
    pub fraction: BasinFraction,
    /// Record of how long it lasts.
    pub survival: Survival,
    /// Place in [`AttractorCensus::attractors`] of the one that most of the watched motions ended on.
    pub to: usize,
}

/// The attractors at one value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Row<E> {
    /// The value of the parameter.
    pub value: f64,
    /// The attractors there, or why there is no model.
    pub census: Result<AttractorCensus<E>, E>,
}

impl<E> Row<E> {
    /// The attractors there; none without a model.
    pub fn attractors(&self) -> &[CountedAttractor] {
        self.census
            .as_ref()
            .map_or(&[], |census| &census.attractors)
    }

    pub(crate) fn attractors_mut(&mut self) -> &mut [CountedAttractor] {
        self.census
            .as_mut()
            .map_or(&mut [], |census| &mut census.attractors)
    }
}

/// A census under way.
pub(crate) struct Tally<E> {
    catalogue: AttractorCatalogue,
    /// Of each entry's closest motion.
    arrivals: Vec<Arrival>,
    /// Of each entry that is chaotic, once it was watched.
    survivals: Vec<Option<Survival>>,
    /// Entries that turned out to be no attractors, and lead to none that is known.
    refuted: BTreeSet<usize>,
    /// Motions met, carried ones included.
    met: usize,
    starts: u64,
    undecided: u64,
    lost: u64,
    first_lost: Option<Lost<E>>,
}

impl<E> Default for Tally<E> {
    fn default() -> Self {
        Self {
            catalogue: AttractorCatalogue::default(),
            arrivals: Vec::new(),
            survivals: Vec::new(),
            refuted: BTreeSet::new(),
            met: 0,
            starts: 0,
            undecided: 0,
            lost: 0,
            first_lost: None,
        }
    }
}

impl<E> Tally<E> {
    /// Files what a start of the box led to.
    pub(crate) fn count(&mut self, found: Found<E>) {
        self.starts += 1;
        match (found.attractor, found.arrival) {
            (Ok(motion), _) if motion.kind == MotionKind::Undecided => self.undecided += 1,
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
    pub(crate) fn meet(&mut self, found: Found<E>) -> Option<usize> {
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
            self.survivals.push(None);
        } else if self.catalogue.entries()[number].closest == self.met {
            self.arrivals[number] = arrival;
        }
    }

    /// Number of attractors.
    pub(crate) fn len(&self) -> usize {
        self.arrivals.len()
    }

    /// A state on attractor `number`.
    pub(crate) fn point(&self, number: usize) -> &Point {
        &self.arrivals[number].point
    }

    /// Kind of motion of attractor `number`.
    pub(crate) fn kind(&self, number: usize) -> MotionKind {
        self.catalogue.entries()[number].attractor.kind
    }

    /// Whether there is evidence that attractor `number` is one.
    pub(crate) fn is_proved(&self, number: usize) -> bool {
        match self.kind(number) {
            MotionKind::Periodic(_) => {
                let motion = &self.catalogue.entries()[number].attractor;
                motion.multiplier.is_some()
            }
            MotionKind::Chaotic | MotionKind::NotPeriodic => self.survivals[number].is_some(),
            MotionKind::QuasiPeriodic | MotionKind::Undecided => true,
        }
    }

    /// Notes how long the chaos of attractor `number` lasted.
    pub(crate) fn watched(&mut self, number: usize, survival: Survival) {
        self.survivals[number] = Some(survival);
    }

    /// Notes that attractor `number` is none.
    pub(crate) fn refute(&mut self, number: usize) {
        self.refuted.insert(number);
    }

    /// The census, and the place in it of each number; `None` for one that is no attractor. What was a transient to
    /// `root[number]` is none either, and its starts count for that one.
    pub(crate) fn ranked(mut self, root: &[usize]) -> (AttractorCensus<E>, Vec<Option<usize>>) {
        let of = self.starts;
        let fraction = |count| BasinFraction { count, of };
        let mut transients = Vec::new();
        for (number, &root) in root.iter().enumerate() {
            let count = self.catalogue.entries()[number].count;
            if self.refuted.contains(&root) {
                self.undecided += count;
            } else if number != root {
                let chaos = self.survivals[number].filter(|survival| survival.ended > 0);
                transients.extend(chaos.map(|survival| (fraction(count), survival, root)));
                self.catalogue.count_for(number, root);
            }
        }
        let (entries, rank) = self.catalogue.ranked();
        let mut kept: Vec<usize> = (0..root.len())
            .filter(|number| root[*number] == *number && !self.refuted.contains(number))
            .collect();
        kept.sort_by_key(|&number| rank[number]);
        let place = |root: &usize| kept.iter().position(|number| number == root);
        let counted = |(identity, &number): (usize, &usize)| {
            let entry = entries[rank[number]].clone();
            CountedAttractor {
                identity,
                fraction: fraction(entry.count),
                entry,
                arrival: self.arrivals[number].clone(),
                survival: self.survivals[number],
            }
        };
        let transient = |(fraction, survival, root): (BasinFraction, Survival, usize)| {
            let to = place(&root)?;
            Some(Transient {
                fraction,
                survival,
                to,
            })
        };
        let census = AttractorCensus {
            attractors: kept.iter().enumerate().map(counted).collect(),
            transients: transients.into_iter().filter_map(transient).collect(),
            undecided: fraction(self.undecided),
            lost: fraction(self.lost),
            first_lost: self.first_lost,
        };
        (census, root.iter().map(place).collect())
    }
}
