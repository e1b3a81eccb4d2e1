//! Sections whose samples connect along the parameter: where a cycle was met says nothing.

use saltus::study::ContinuedAttractors;
use std::collections::BTreeMap;

/// Samples of each channel.
type Section = Vec<Vec<f64>>;

/// Rotates the section of each cycle so that it begins where it is nearest to the same attractor at the last value at
/// which that was a cycle too; the first one begins with its lowest sample of the first jumper.
pub(super) fn connect(found: &mut ContinuedAttractors) {
    let mut before: BTreeMap<usize, Section> = BTreeMap::new();
    let rows = found.rows.iter_mut().flat_map(|row| &mut row.census);
    for counted in rows.flat_map(|census| &mut census.attractors) {
        if counted.entry.attractor.kind.period().is_none() {
            continue;
        }
        let section = &mut counted.arrival.section;
        let turn = match before.get(&counted.identity) {
            Some(before) => nearest(before, section),
            None => lowest(section),
        };
        section
            .iter_mut()
            .for_each(|samples| samples.rotate_left(turn));
        before.insert(counted.identity, section.clone());
    }
}

fn samples(section: &Section) -> usize {
    section.first().map_or(0, Vec::len)
}

fn lowest(section: &Section) -> usize {
    let heights = section.iter().take(1).flatten().copied();
    heights
        .enumerate()
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map_or(0, |(place, _)| place)
}

/// The rotation with the least sum of squares of distances; the shorter of two cycles is run through again.
fn nearest(before: &Section, section: &Section) -> usize {
    let whole = samples(before).max(samples(section));
    let apart = |turn: usize| -> f64 {
        let pairs = before.iter().zip(section).flat_map(|(before, samples)| {
            let there = samples.iter().cycle().skip(turn);
            before.iter().cycle().zip(there).take(whole)
        });
        pairs.map(|(a, b)| (a - b).powi(2)).sum()
    };
    (0..samples(section))
        .map(|turn| (turn, apart(turn)))
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map_or(0, |(turn, _)| turn)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn section(heights: &[f64]) -> Section {
        vec![heights.to_vec(), heights.iter().map(|z| -z).collect()]
    }

    #[test]
    fn a_cycle_begins_where_the_one_before_did() {
        let before = section(&[5.0, 1.0, 3.0]);
        assert_eq!(nearest(&before, &section(&[1.1, 3.1, 4.9])), 2);
        assert_eq!(lowest(&before), 1);
    }

    #[test]
    fn a_doubled_cycle_connects_and_so_does_a_halved_one() {
        let (two, four) = (section(&[1.0, 5.0]), section(&[5.1, 0.9, 4.9, 1.2]));
        // low, high, low, high; the sum is the same for two rotations, and the first is taken
        assert_eq!(nearest(&two, &four), 1);
        assert_eq!(nearest(&four, &two), 1);
    }

    #[test]
    fn nothing_is_not_turned() {
        for none in [vec![], vec![vec![], vec![]]] {
            assert_eq!(lowest(&none), 0);
            assert_eq!(nearest(&none, &none), 0);
            assert_eq!(nearest(&none, &section(&[1.0, 2.0])), 0);
        }
    }
}
