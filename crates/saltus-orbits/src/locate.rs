//! Location of special points between two points of a branch.

use crate::continuation::Point;
use crate::detect::{Test, changes, pair_passes};
use crate::path::Path;
use crate::special::{JUMP, Special};
use crate::{NotFound, ParametricMap, linear};

/// Brackets are narrowed to this length, relative to the largest coordinate or 1: what rounding allows.
pub(crate) const NARROW: f64 = 1e-10;

/// A test function this small is zero: it is not known better from an orbit with the default tolerance.
const ZERO: f64 = 1e-11;

/// Special points between two points at most, so that noise cannot keep the search busy.
const MOST: usize = 16;

/// Rounds of a search at most; bisection of a step of 1 needs 34.
pub(crate) const ROUNDS: usize = 60;

impl<F: ParametricMap + ?Sized> Path<'_, F> {
    /// All special points between two points of a branch, in their order.
    pub(crate) fn specials(
        &self,
        a: &Point,
        b: &Point,
        near: usize,
    ) -> Result<Vec<Special>, NotFound> {
        let (mut found, mut from) = (Vec::<Special>::new(), a.clone());
        let mut behind = None;
        while found.len() < MOST && !changes(&from, b, pair_passes(&from, b)).is_empty() {
            let (special, [before, next]) = self.first(from, b.clone(), near)?;
            if let Some(mut special) = special {
                if let (Some(last), Some(behind)) = (found.last_mut(), &behind)
                    && let Some(outside) = self.outside_between(behind, &before)
                {
                    (last.outside[1], special.outside[0]) = (outside, outside);
                }
                found.push(special);
                behind = Some(next.clone());
            }
            from = next;
        }
        if let Some(first) = found.first_mut() {
            first.outside[0] = a.outside;
        }
        if let Some(last) = found.last_mut() {
            last.outside[1] = b.outside;
        }
        Ok(found)
    }

    /// Number of multipliers outside the unit circle between two special points. Next to one of them rounding decides
    /// on which side its multiplier is, so they are counted midway.
    fn outside_between(&self, behind: &Point, before: &Point) -> Option<usize> {
        let apart = self.distance(behind, before) > 0.0;
        let midway = apart.then(|| self.between(behind, before, 0.5))?;
        Some(midway.ok()?.outside)
    }

    /// The first special point between two points, and the points next to it.
    fn first(
        &self,
        mut a: Point,
        mut b: Point,
        near: usize,
    ) -> Result<(Option<Special>, [Point; 2]), NotFound> {
        let (mut aim, pairs) = (Aim::default(), pair_passes(&a, &b));
        for round in 0..ROUNDS {
            let tests = changes(&a, &b, pairs);
            let values = |test: Test| Some([test.value(&a)?, test.value(&b)?]);
            let zero = match tests[..] {
                [test] => values(test).is_some_and(|v| v[0].abs().min(v[1].abs()) <= ZERO),
                _ => false,
            };
            let size = linear::size(&self.coordinates(&a.orbit)).max(1.0);
            let length = self.distance(&a, &b);
            if let [Test::BranchPoint] | [Test::BranchPoint, Test::Fold] = tests[..]
                && let Some(special) = self.crossing(&a, &b, near)
            {
                return Ok((Some(special), [a, b]));
            }
            if zero || length <= NARROW * size {
                break;
            }
            let part = match tests[..] {
                [Test::Events] => self.touching(&a, &b, &mut aim, round),
                // The end of this search lies aside of the point, so the bracket need only be short.
                [Test::BranchPoint] => None,
                [test] => values(test).and_then(|values| aim.part(values)),
                _ => None,
            };
            let middle = match self.between(&a, &b, part.unwrap_or(0.5)) {
                Ok(point) => point,
                Err(stop) if stop.is_stop() => return Err(stop),
                Err(_) => match self.between(&a, &b, 0.5) {
                    Ok(point) => point,
                    Err(_) => {
                        if tests.contains(&Test::Events) {
                            self.approach(&mut a, &mut b);
                        }
                        break;
                    }
                },
            };
            if changes(&a, &middle, pairs).is_empty() {
                a = middle;
                aim.moved(0);
            } else {
                b = middle;
                aim.moved(1);
            }
        }
        Ok((self.special(&a, &b, pairs, near), [a, b]))
    }

    /// The grazing between the last point of a branch and the first one beyond, with none in between.
    pub(crate) fn gap(&self, last: &Point, beyond: &Point, near: usize) -> Option<Special> {
        let (mut a, mut b) = (last.clone(), beyond.clone());
        self.approach(&mut a, &mut b);
        self.special(&a, &b, false, near)
    }

    /// The special point between two points that are next to each other.
    fn special(&self, a: &Point, b: &Point, pairs: bool, near: usize) -> Option<Special> {
        let test = *changes(a, b, pairs).first()?;
        let best = match (test.value(a), test.value(b)) {
            (Some(before), Some(behind)) if behind.abs() < before.abs() => b,
            // A grazing orbit is the one without the additional switches.
            (None, _) if b.orbit.switch_count() < a.orbit.switch_count() => b,
            _ => a,
        };
        let other = if std::ptr::eq(best, a) { b } else { a };
        let jumps = test == Test::Events && a.outside != b.outside;
        Some(Special {
            label: String::new(),
            kind: test.kind(&best.orbit, &other.orbit)?,
            parameter: best.parameter,
            orbit: best.orbit.clone(),
            near,
            outside: [a.outside, b.outside],
            remark: jumps.then(|| JUMP.to_owned()),
            tangent: best.tangent.clone(),
        })
    }
}

/// Memory of a search.
#[derive(Default)]
pub(crate) struct Aim {
    /// The end that moved last, and how often in a row.
    last: Option<(usize, i32)>,
    /// The points without the additional switches, each with its touch.
    pub(crate) quiet: Vec<(Point, f64)>,
}

impl Aim {
    fn moved(&mut self, end: usize) {
        let times = match self.last {
            Some((last, times)) if last == end => times + 1,
            _ => 0,
        };
        self.last = Some((end, times));
    }

    /// False position, where the value of an end that stays is halved each time it stays again (the
    /// Illinois method).
    fn part(&self, mut values: [f64; 2]) -> Option<f64> {
        if let Some((end, times)) = self.last {
            values[1 - end] *= 0.5_f64.powi(times);
        }
        let part = values[0] / (values[0] - values[1]);
        (part > 0.0 && part < 1.0).then_some(part)
    }
}
