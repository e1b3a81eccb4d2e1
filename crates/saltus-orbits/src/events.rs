//! Sequences of switches, and how they differ.

use crate::map::Crossing;

/// One switch: unit, mode left, mode entered.
pub(crate) type Switch = (usize, usize, usize);

/// The switches of one iterate.
pub(crate) fn switches(crossings: &[Crossing]) -> Vec<Switch> {
    let switch = |crossing: &Crossing| (crossing.unit, crossing.from, crossing.to);
    crossings.iter().map(switch).collect()
}

/// Whether two sequences are the same up to where the period begins: a switch that wanders through the
/// sampling instant changes nothing.
pub(crate) fn same(a: &[Switch], b: &[Switch]) -> bool {
    let n = a.len();
    let rotated = |by| (0..n).all(|i| a[(i + by) % n] == b[i]);
    n == b.len() && (n == 0 || (0..n).any(rotated))
}

/// The units of which one sequence has more switches than the other; none if they differ in order only.
pub(crate) fn units_apart(a: &[Switch], b: &[Switch]) -> Vec<usize> {
    let count = |all: &[Switch], switch: &Switch| all.iter().filter(|s| *s == switch).count();
    let uneven = |s: &&Switch| count(a, s) != count(b, s);
    let mut units: Vec<usize> = a.iter().chain(b).filter(uneven).map(|s| s.0).collect();
    units.sort_unstable();
    units.dedup();
    units
}
