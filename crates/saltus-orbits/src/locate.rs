//! Where between two points of a branch something happens.

use crate::continuation::{Path, Point};
use crate::shooting::Guess;
use crate::special::{Special, SpecialKind, Test, changes};
use crate::{Family, Lost, NotFound, Orbit, events, linear};

/// Brackets are narrowed to this length, relative to the largest coordinate or 1: what rounding allows.
const NARROW: f64 = 1e-10;

/// A test function this small is zero: it is not known better from an orbit with the default tolerance.
const ZERO: f64 = 1e-11;

/// A branch point is interpolated from points at this distance and twice that on both sides, relative to the
/// largest coordinate or 1. Nearer to it orbits cannot be trusted: a residual of 1e-11 is the product of the
/// distances to both branches. Farther, interpolation by cubics is off by more than 1e-10.
const ASIDE: f64 = 1e-3;

/// Special points between two points at most, so that noise cannot keep the search busy.
const MOST: usize = 16;

/// Rounds of a search at most; bisection of a step of 1 needs 34.
const ROUNDS: usize = 60;

impl<F: Family + ?Sized> Path<'_, F> {
    /// All special points between two points of a branch, in their order.
    pub(crate) fn specials(
        &self,
        a: &Point,
        b: &Point,
        near: usize,
    ) -> Result<Vec<Special>, NotFound> {
        let (mut found, mut from) = (Vec::new(), a.clone());
        while found.len() < MOST && !changes(&from, b).is_empty() {
            let (special, next) = self.first(from, b.clone(), near)?;
            found.extend(special);
            from = next;
        }
        Ok(found)
    }

    /// The first special point between two points, and the point behind it.
    fn first(
        &self,
        mut a: Point,
        mut b: Point,
        near: usize,
    ) -> Result<(Option<Special>, Point), NotFound> {
        let mut aim = Aim::default();
        for round in 0..ROUNDS {
            let tests = changes(&a, &b);
            let values = |test: Test| Some([test.value(&a)?, test.value(&b)?]);
            let zero = match tests[..] {
                [test] => values(test).is_some_and(|v| v[0].abs().min(v[1].abs()) <= ZERO),
                _ => false,
            };
            let size = linear::size(&self.coordinates(&a.orbit)).max(1.0);
            let length = self.distance(&a, &b);
            let crossing = matches!(
                tests[..],
                [Test::BranchPoint] | [Test::BranchPoint, Test::Fold]
            );
            if crossing && length <= 4.0 * ASIDE * size {
                let special = self.crossing(&a, &b, ASIDE * size, near);
                return Ok((special.or_else(|| self.special(&a, &b, near)), b));
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
                Err(
                    stop @ NotFound::Lost {
                        reason: Lost::Interrupted,
                        ..
                    },
                ) => return Err(stop),
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
            if changes(&a, &middle).is_empty() {
                a = middle;
                aim.moved(0);
            } else {
                b = middle;
                aim.moved(1);
            }
        }
        Ok((self.special(&a, &b, near), b))
    }

    /// The special point between two points that are next to each other.
    fn special(&self, a: &Point, b: &Point, near: usize) -> Option<Special> {
        let test = *changes(a, b).first()?;
        let best = match (test.value(a), test.value(b)) {
            (Some(before), Some(behind)) if behind.abs() < before.abs() => b,
            // A grazing orbit is the one without the additional switches.
            (None, _) if switches(b) < switches(a) => b,
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
            remark: jumps.then(|| {
                "stability changes here without a multiplier on the unit circle".to_owned()
            }),
            tangent: best.tangent.clone(),
        })
    }

    /// The branch point between two points: where the cubic through four determinants is zero, on the cubics
    /// through the four orbits.
    fn crossing(&self, a: &Point, b: &Point, aside: f64, near: usize) -> Option<Special> {
        let length = self.distance(a, b);
        let middle = length * a.side / (a.side - b.side);
        let at = [-2.0, -1.0, 1.0, 2.0].map(|times| middle + times * aside);
        let mut points = Vec::new();
        for at in at {
            points.push(self.between(a, b, at / length).ok()?);
        }
        let cubic = |value: &dyn Fn(&Point) -> f64, s: f64| -> f64 {
            let weight = |i: usize| {
                let others = (0..4).filter(|&j| j != i);
                others
                    .map(|j| (s - at[j]) / (at[i] - at[j]))
                    .product::<f64>()
            };
            (0..4).map(|i| weight(i) * value(&points[i])).sum()
        };
        let (mut low, mut high) = (at[0], at[3]);
        let falling = points[0].side > 0.0;
        for _ in 0..ROUNDS {
            let s = f64::midpoint(low, high);
            if (cubic(&|point| point.side, s) > 0.0) == falling {
                low = s;
            } else {
                high = s;
            }
        }
        let mut guess: Guess = points[0].orbit.guess();
        for (i, place) in guess.places.iter_mut().enumerate() {
            for (j, x) in place.x.iter_mut().enumerate() {
                *x = cubic(&|point| point.orbit.places[i].x[j], low);
            }
        }
        let parameter = cubic(&|point| point.parameter, low);
        guess.parameters[self.free[0].index] = parameter;
        let orbit = Orbit::of(&self.shooting().pass(&guess).ok()?).ok()?;
        Some(Special {
            label: String::new(),
            kind: SpecialKind::BranchPoint,
            parameter,
            orbit,
            near,
            outside: [a.outside, b.outside],
            remark: None,
            tangent: linear::unit(&self.apart(&points[1], &points[2])),
        })
    }

    /// Where between two points the guard that tells their switches apart comes to zero: its value on the
    /// side without the switches is extrapolated, alternately a little further and less far, so that
    /// the bracket shrinks from both sides. Every third round bisects, whatever the values say.
    fn touching(&self, a: &Point, b: &Point, aim: &mut Aim, round: usize) -> Option<f64> {
        let [first, second] = [&a.orbit, &b.orbit].map(events::sequence);
        let units = events::units_apart(&first, &second);
        let forwards = switches(a) < switches(b);
        let quiet = if forwards { a } else { b };
        let touch = events::nearest_touch(&quiet.orbit, |_, t| units.contains(&t.unit))?.1;
        if aim.quiet.last().is_none_or(|(last, _)| last != quiet) {
            aim.quiet.push((quiet.clone(), touch.value));
        }
        let [.., (earlier, value), _] = &aim.quiet[..] else {
            return None;
        };
        let closing = (value - touch.value) / self.distance(earlier, quiet);
        let margin = [1.01, 0.99, f64::NAN][round % 3];
        let part = margin * touch.value / closing / self.distance(a, b);
        let part = if forwards { part } else { 1.0 - part };
        (part > 0.0 && part < 1.0).then_some(part)
    }

    /// Where no orbits are found between two points, moves the one without the additional switches along its
    /// tangent to where its touch comes to zero.
    fn approach(&self, a: &mut Point, b: &mut Point) {
        let [first, second] = [&a.orbit, &b.orbit].map(events::sequence);
        let units = events::units_apart(&first, &second);
        let width = self.distance(a, b);
        let (quiet, sign) = if switches(a) < switches(b) {
            (a, 1.0)
        } else {
            (b, -1.0)
        };
        let touch = |point: &Point| {
            let touch = events::nearest_touch(&point.orbit, |_, t| units.contains(&t.unit));
            touch.map(|(_, touch)| touch.value)
        };
        let mut step = 1e-3 * width;
        for _ in 0..ROUNDS {
            let guess = quiet
                .orbit
                .guess()
                .moved(&self.free, sign * step, &quiet.spread);
            let next = self.solve(&guess, &quiet.tangent, &quiet.tangent);
            let next = next.ok().filter(|next| {
                let [before, now] = [&quiet.orbit, &next.orbit].map(events::sequence);
                events::same(&before, &now)
            });
            let values = next
                .as_ref()
                .and_then(|next| Some((touch(quiet)?, touch(next)?)));
            step = match (next, values) {
                (Some(next), Some((before, now))) if now < before => {
                    let ahead = now * self.distance(quiet, &next) / (before - now);
                    *quiet = next;
                    0.95 * ahead
                }
                _ => step / 2.0,
            };
            if step < NARROW {
                break;
            }
        }
    }
}

fn switches(point: &Point) -> usize {
    point.orbit.crossings.iter().map(Vec::len).sum()
}

/// What a search remembers.
#[derive(Default)]
struct Aim {
    /// Which end moved last, and how often in a row.
    last: Option<(usize, i32)>,
    /// The points without the additional switches, each with its touch.
    quiet: Vec<(Point, f64)>,
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
