//! Attractors along a parameter: where each begins and ends, and loops of hysteresis.
//!
//! A motion on an attractor that ends jumps to the one that it leads to there. Hysteresis follows: a motion is carried
//! up to the end of its attractor A and jumps to B; carried down again it stays on B, so that below the jump the two
//! ways differ as far down as A and B both exist.

use saltus_orbits::MotionKind;
use std::collections::{BTreeMap, BTreeSet};

use crate::Range;
use crate::attractor::Attractor;
use crate::census::Row;
use crate::matching::{Links, Node, Way, matches};

/// The attractors along a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct ContinuedAttractors<E> {
    /// One per value, in their order.
    pub rows: Vec<Row<E>>,
    /// Each attractor by its number.
    pub identities: Vec<AttractorRange>,
    /// Loops of hysteresis, in the order of their first value.
    pub loops: Vec<Hysteresis>,
    /// Motions that were still being carried when it had taken too long; 0 but for a model with a great many
    /// attractors. Where there are some, an attractor may have several numbers.
    pub unfinished: usize,
}

/// One attractor along the parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct AttractorRange {
    /// First value at which it was met.
    pub first: f64,
    /// Last value at which it was met.
    pub last: f64,
    /// Its beginning; `None` at the first value with a model.
    pub birth: Option<RangeEnd>,
    /// Its end; `None` at the last value with a model.
    pub death: Option<RangeEnd>,
}

/// A beginning or an end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeEnd {
    /// The two values between which it lies.
    pub between: Range,
    /// Number of the attractor that the motion jumps to when carried beyond; `None` if that stayed undecided.
    pub to: Option<usize>,
}

/// Values at which a motion carried upwards and one carried downwards are on different attractors. Attractors that
/// neither way reaches, those that begin and end within the other's range, are in none.
#[derive(Clone, Debug, PartialEq)]
pub struct Hysteresis {
    /// First of these values.
    pub from: f64,
    /// Last of them.
    pub to: f64,
    /// Number of the attractor on the way up.
    pub up: usize,
    /// Number of the attractor on the way down.
    pub down: usize,
    /// MotionKind of the first on top, where it jumps, and of the second at the bottom.
    pub kinds: (MotionKind, MotionKind),
    /// Between which values the motion on the way up jumps to the other attractor; `None` if it does not.
    pub jump_up: Option<Range>,
    /// Between which values the motion on the way down does; a loop is closed if both jump.
    pub jump_down: Option<Range>,
}

impl<E> ContinuedAttractors<E> {
    /// Numbers the attractors of `rows`, by their first value and then by their share there.
    pub(crate) fn new(mut rows: Vec<Row<E>>, links: &Links, unfinished: usize) -> Self {
        let previous = matches(&rows, links);
        let mut paths: Vec<Vec<Node>> = Vec::new();
        let mut identity_of: BTreeMap<Node, usize> = BTreeMap::new();
        for (at, row) in rows.iter_mut().enumerate() {
            for (place, counted) in row.attractors_mut().iter_mut().enumerate() {
                let node = (at, place);
                let known = previous
                    .get(&node)
                    .and_then(|before| identity_of.get(before));
                counted.identity = known.copied().unwrap_or(paths.len());
                identity_of.insert(node, counted.identity);
                paths.resize_with(paths.len().max(counted.identity + 1), Vec::new);
                paths[counted.identity].push(node);
            }
        }
        let turn = |node: Node, way: Way| {
            let beyond = way
                .beyond(node.0, rows.len())
                .find(|&at| rows[at].census.is_ok())?;
            let [low, high] = [node.0.min(beyond), node.0.max(beyond)].map(|at| rows[at].value);
            let to = links.get(&(node, way)).map(|to| identity_of[to]);
            Some(RangeEnd {
                between: [low, high],
                to,
            })
        };
        let ends = paths
            .iter()
            .filter_map(|path| Some((*path.first()?, *path.last()?)));
        let identities: Vec<AttractorRange> = ends
            .map(|(first, last)| AttractorRange {
                first: rows[first.0].value,
                last: rows[last.0].value,
                birth: turn(first, Way::Down),
                death: turn(last, Way::Up),
            })
            .collect();
        let loops = loops(&rows, &identities, &paths);
        Self {
            rows,
            identities,
            loops,
            unfinished,
        }
    }

    /// The number of the attractor that `motion`, found at one of the values, is on, by the same test that tells
    /// motions apart in a [`AttractorCatalogue`](crate::AttractorCatalogue): so that pictures of basins at several values share their
    /// colours. `None` if it was not met there, or nothing was sought there.
    pub fn identity(&self, value: f64, motion: &Attractor) -> Option<usize> {
        let row = self.rows.iter().find(|row| row.value == value)?;
        let mut there = row.attractors().iter();
        let same = there.find(|counted| counted.entry.holds(motion))?;
        Some(same.identity)
    }
}

/// A loop for each pair of which one jumps to the other, as far as both exist.
fn loops<E>(
    rows: &[Row<E>],
    identities: &[AttractorRange],
    paths: &[Vec<Node>],
) -> Vec<Hysteresis> {
    let jump = |turn: Option<RangeEnd>, to: usize| turn.filter(|turn| turn.to == Some(to));
    let pairs = identities
        .iter()
        .enumerate()
        .flat_map(|(number, identity)| {
            let up = identity.death.and_then(|turn| Some((number, turn.to?)));
            let down = identity.birth.and_then(|turn| Some((turn.to?, number)));
            up.into_iter().chain(down)
        });
    let pairs: BTreeSet<(usize, usize)> = pairs.collect();
    let kind = |&(at, place): &Node| rows[at].attractors()[place].entry.attractor.kind;
    let hysteresis = |(up, down): (usize, usize)| {
        let (above, below) = (&paths[up], &paths[down]);
        let from = above.first()?.0.max(below.first()?.0);
        let to = above.last()?.0.min(below.last()?.0);
        let (on_top, at_bottom) = (
            above.iter().rev().find(|node| node.0 <= to)?,
            below.iter().find(|node| node.0 >= from)?,
        );
        // one is there from below and the other from above
        let reached = (identities[up].birth.is_none() || above.first()?.0 < from)
            && (identities[down].death.is_none() || below.last()?.0 > to);
        (from <= to && reached).then(|| Hysteresis {
            from: rows[from].value,
            to: rows[to].value,
            up,
            down,
            kinds: (kind(on_top), kind(at_bottom)),
            jump_up: jump(identities[up].death, down).map(|turn| turn.between),
            jump_down: jump(identities[down].birth, up).map(|turn| turn.between),
        })
    };
    let mut loops: Vec<Hysteresis> = pairs.into_iter().filter_map(hysteresis).collect();
    loops.sort_by(|a, b| a.from.total_cmp(&b.from));
    loops
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::attractor::Arrival;
    use crate::basins::AttractorCatalogue;
    use crate::census::{AttractorCensus, CountedAttractor};
    use crate::fraction::BasinFraction;
    use saltus_hybrid::{BuildError, Point};

    /// An attractor with these heights, at rest.
    fn counted(kind: MotionKind, heights: &[f64]) -> CountedAttractor {
        let low = heights.iter().copied().fold(f64::INFINITY, f64::min);
        let high = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let motion = Attractor {
            kind,
            contact_ratio: vec![0.5],
            peaks: vec![2.0, 3.0],
            section: vec![heights.to_vec(), vec![0.0; heights.len()]],
            ranges: vec![[low, high], [low, high]],
            rest: 0.0,
            multiplier: None,
            exponent: None,
            confidence: None,
        };
        let mut catalogue = AttractorCatalogue::default();
        catalogue.file(0, motion);
        CountedAttractor {
            identity: 0,
            entry: catalogue.entries()[0].clone(),
            fraction: BasinFraction::default(),
            arrival: Arrival {
                point: Point {
                    modes: vec![],
                    x: vec![],
                },
                section: vec![heights.to_vec(), vec![0.0; heights.len()]],
            },
            survival: None,
        }
    }

    fn cycle(heights: &[f64]) -> CountedAttractor {
        counted(MotionKind::Periodic(heights.len() as u32), heights)
    }

    /// Rows at 0, 1, ... with these attractors.
    fn rows(all: Vec<Vec<CountedAttractor>>) -> Vec<Row<BuildError>> {
        let row = |(at, attractors)| Row {
            value: at as f64,
            census: Ok(AttractorCensus {
                attractors,
                ..AttractorCensus::default()
            }),
        };
        all.into_iter().enumerate().map(row).collect()
    }

    fn links(up: &[(Node, Node)], down: &[(Node, Node)]) -> Links {
        let all = |way, pairs: &[(Node, Node)]| -> Vec<_> {
            pairs.iter().map(|&(from, to)| ((from, way), to)).collect()
        };
        [all(Way::Up, up), all(Way::Down, down)]
            .concat()
            .into_iter()
            .collect()
    }

    fn numbers(found: &ContinuedAttractors<BuildError>) -> Vec<Vec<usize>> {
        let of = |row: &Row<BuildError>| {
            row.attractors()
                .iter()
                .map(|counted| counted.identity)
                .collect()
        };
        found.rows.iter().map(of).collect()
    }

    #[test]
    fn a_fold_on_each_side_makes_a_closed_loop() {
        // A lives at 0 to 2 and B at 1 to 3, their places in the lists changing
        let (a, b) = (cycle(&[0.0]), cycle(&[5.0]));
        let rows = rows(vec![
            vec![a.clone()],
            vec![a.clone(), b.clone()],
            vec![b.clone(), a],
            vec![b],
        ]);
        let found = ContinuedAttractors::new(
            rows,
            &links(
                &[
                    ((0, 0), (1, 0)),
                    ((1, 0), (2, 1)),
                    ((1, 1), (2, 0)),
                    ((2, 1), (3, 0)),
                    ((2, 0), (3, 0)),
                ],
                &[
                    ((3, 0), (2, 0)),
                    ((2, 0), (1, 1)),
                    ((2, 1), (1, 0)),
                    ((1, 1), (0, 0)),
                    ((1, 0), (0, 0)),
                ],
            ),
            0,
        );
        assert_eq!(numbers(&found), [vec![0], vec![0, 1], vec![1, 0], vec![1]]);
        let [one] = &found.loops[..] else {
            panic!("{:?}", found.loops)
        };
        assert_eq!((one.from, one.to, one.up, one.down), (1.0, 2.0, 0, 1));
        assert_eq!(
            (one.jump_up, one.jump_down),
            (Some([2.0, 3.0]), Some([0.0, 1.0]))
        );
        assert_eq!(found.identities[0].birth, None);
        let death = RangeEnd {
            between: [2.0, 3.0],
            to: Some(1),
        };
        assert_eq!(found.identities[0].death, Some(death));
    }

    #[test]
    fn doubling_and_chaos_keep_the_number_and_tripling_does_not() {
        let band: Vec<f64> = (0..64).map(|k| f64::from(k) / 64.0).collect();
        let all = [
            cycle(&[0.5]),
            cycle(&[0.4, 0.6]),
            counted(MotionKind::NotPeriodic, &band),
            cycle(&[0.3, 0.4, 0.6, 0.7]),
            cycle(&[0.3, 0.6, 0.7]),
        ];
        let up: Vec<(Node, Node)> = (0..4).map(|at| ((at, 0), (at + 1, 0))).collect();
        let down: Vec<(Node, Node)> = up.iter().map(|&(low, high)| (high, low)).collect();
        let found = ContinuedAttractors::new(
            rows(all.map(|one| vec![one]).to_vec()),
            &links(&up, &down),
            0,
        );
        assert_eq!(numbers(&found), [[0], [0], [0], [0], [1]]);
        assert_eq!(found.loops, []);
    }

    #[test]
    fn led_to_from_one_side_only_it_is_the_same_if_it_is_near() {
        // the second of two, near 1 and far from 0, loses its way down: it is caught by the first
        let found = |z: f64| {
            let rows = rows(vec![
                vec![cycle(&[0.0]), cycle(&[1.0])],
                vec![cycle(&[0.0]), cycle(&[z])],
            ]);
            let up = [((0, 0), (1, 0)), ((0, 1), (1, 1))];
            let down = [((1, 0), (0, 0)), ((1, 1), (0, 0))];
            numbers(&ContinuedAttractors::new(rows, &links(&up, &down), 0))
        };
        assert_eq!(found(1.15), [[0, 1], [0, 1]]);
        // 0.4 away, and 1.4 from the other: less than four times
        assert_eq!(found(1.4), [[0, 1], [0, 2]]);
    }

    #[test]
    fn an_island_is_no_loop_and_a_gap_is_bridged() {
        // 0 is everywhere but undecided at 2, 1 is at 1 only
        let (a, b) = (cycle(&[0.0]), cycle(&[5.0]));
        let mut rows = rows(vec![vec![a.clone()], vec![a.clone(), b], vec![], vec![a]]);
        rows[2].census = Err(BuildError::Period(0.0));
        let up = [((0, 0), (1, 0)), ((1, 0), (3, 0)), ((1, 1), (3, 0))];
        let down = [((3, 0), (1, 0)), ((1, 0), (0, 0)), ((1, 1), (0, 0))];
        let found = ContinuedAttractors::new(rows, &links(&up, &down), 0);
        assert_eq!(numbers(&found), [vec![0], vec![0, 1], vec![], vec![0]]);
        assert_eq!(found.loops, []);
        let death = found.identities[1]
            .death
            .map(|turn| (turn.between, turn.to));
        assert_eq!(death, Some(([1.0, 3.0], Some(0))));
    }

    #[test]
    fn a_motion_found_elsewhere_is_known_by_its_cycle() {
        let rows = rows(vec![
            vec![cycle(&[0.0])],
            vec![cycle(&[5.0, 6.0]), cycle(&[0.0])],
        ]);
        let pairs = [((0, 0), (1, 1))];
        let found = ContinuedAttractors::new(
            rows,
            &links(&pairs, &pairs.map(|(low, high)| (high, low))),
            0,
        );
        let number =
            |value, heights: &[f64]| found.identity(value, &cycle(heights).entry.attractor);
        assert_eq!(number(1.0, &[6.0, 5.0]), Some(1), "shifts are one cycle");
        assert_eq!(number(1.0, &[0.001]), Some(0));
        assert_eq!(number(1.0, &[1.0]), None);
        assert_eq!(number(0.0, &[5.0, 6.0]), None);
        assert_eq!(number(0.5, &[0.0]), None);
    }
}
