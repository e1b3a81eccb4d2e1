//! Matching of attractors at different values of a parameter: which of them are the same.
//!
//! An attractor carried to the next value leads to an attractor there. Two are the same
//! - if each leads to the other; or
//! - if only one leads to the other, since a basin is small or stability was lost in between, and their sections
//!   lie closer together than a quarter of the distance of either to any other attractor at the other's value.
//!
//! In both cases only if a continuous change can turn one into the other: the periods of two cycles differ by a
//! power of two. So a cycle that doubles its period keeps its number, through a whole cascade and chaos and back, and
//! a motion that jumps to another one does not. A loop that lies between two neighbouring values is not
//! seen: what jumps there and back keeps its number, if the periods allow it.

use saltus_orbits::MotionKind;
use std::collections::{BTreeMap, BTreeSet};

use crate::census::{CountedAttractor, Row};

/// An attractor: place of the value, and place in the census there.
pub(crate) type Node = (usize, usize);

/// Attractors that each attractor leads to when it is carried.
pub(crate) type Links = BTreeMap<(Node, Way), Node>;

/// The way through the values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Way {
    Up,
    Down,
}

impl Way {
    /// The places beyond `at`, of `count` in all, the next first.
    pub(crate) fn beyond(self, at: usize, count: usize) -> impl Iterator<Item = usize> {
        let (up, down) = match self {
            Self::Up => (at + 1..count, 0..0),
            Self::Down => (0..0, 0..at),
        };
        up.chain(down.rev())
    }
}

/// Sections of one attractor at two values are this many times closer than those of different ones.
const CLOSER: f64 = 4.0;

/// For each attractor the one that it was at an earlier value, if any.
pub(crate) fn matches<E>(rows: &[Row<E>], links: &Links) -> BTreeMap<Node, Node> {
    let at = |node: Node| &rows[node.0].attractors()[node.1];
    let possible = |low: Node, high: Node| may_become(at(low), at(high));
    // a link from either side, as (lower, higher)
    let pairs = links.iter().map(|(&(from, way), &to)| match way {
        Way::Up => (from, to),
        Way::Down => (to, from),
    });
    let pairs: BTreeSet<(Node, Node)> = pairs.filter(|&(low, high)| possible(low, high)).collect();
    let leads = |from: Node, way: Way, to: Node| links.get(&(from, way)) == Some(&to);
    let mutual =
        |&(low, high): &(Node, Node)| leads(low, Way::Up, high) && leads(high, Way::Down, low);
    let alone = |node: Node, other: Node| {
        let apart = distance(at(node), at(other));
        let mut places = (0..rows[other.0].attractors().len()).filter(|&place| place != other.1);
        places.all(|place| CLOSER * apart < distance(at(node), at((other.0, place))))
    };
    // neighbours first, and of these the surest
    let mut pairs: Vec<_> = pairs.into_iter().collect();
    pairs.sort_by_key(|pair| (pair.1.0 - pair.0.0, !mutual(pair)));
    let mut previous = BTreeMap::new();
    let mut continued = BTreeSet::new();
    for (low, high) in pairs {
        let free = !previous.contains_key(&high) && !continued.contains(&low);
        if free && (mutual(&(low, high)) || alone(low, high) && alone(high, low)) {
            previous.insert(high, low);
            continued.insert(low);
        }
    }
    previous
}

/// Whether one can turn into the other without a jump.
fn may_become(a: &CountedAttractor, b: &CountedAttractor) -> bool {
    match (a.entry.attractor.kind, b.entry.attractor.kind) {
        (MotionKind::Periodic(n), MotionKind::Periodic(m)) => {
            let (short, long) = (n.min(m), n.max(m));
            long.is_multiple_of(short) && (long / short).is_power_of_two()
        }
        _ => true,
    }
}

/// Hausdorff distance of two sections, in the largest of all channels.
fn distance(a: &CountedAttractor, b: &CountedAttractor) -> f64 {
    let (a, b) = (&a.arrival.section, &b.arrival.section);
    let count = |section: &[Vec<f64>]| section.first().map_or(0, Vec::len);
    let points = |i: usize, j: usize| {
        let channels = a.iter().zip(b).map(|(a, b)| (a[i] - b[j]).abs());
        channels.fold(0.0, f64::max)
    };
    let nearest =
        |distances: &mut dyn Iterator<Item = f64>| distances.fold(f64::INFINITY, f64::min);
    let (rows, columns) = (count(a), count(b));
    let there = (0..rows).map(|i| nearest(&mut (0..columns).map(|j| points(i, j))));
    let back = (0..columns).map(|j| nearest(&mut (0..rows).map(|i| points(i, j))));
    there.chain(back).fold(0.0, f64::max)
}
