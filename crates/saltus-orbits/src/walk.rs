//! One walk along a branch: predict along the tangent, correct, look for special points on the way, choose the
//! step.

use crate::continuation::{Branch, End, Point};
use crate::linear::{dot, minus, norm, scaled, unit};
use crate::orbit::shortest_period;
use crate::path::Path;
use crate::sampling_instant::at_instant;
use crate::special::{Special, SpecialKind};
use crate::{Multiplier, ParametricMap, events};

/// The corrector stays within this many steps of the prediction, or it may have found another branch.
const NEAR: f64 = 2.0;

/// Newton steps that let the next step of the branch grow, and that make it shrink.
const EASY: usize = 3;
const HARD: usize = 6;

/// Steps grow by this factor at most.
const GROWTH: f64 = 1.6;

/// A touch this far ahead is reached: nearer, residuals blur its value.
const AT_TOUCH: f64 = 1e-9;

/// The part of the way to a touch that one step covers.
const APPROACH: f64 = 0.95;

/// The critical multiplier moves by less than this on the first step of a branch from its birth.
const BORN: f64 = 0.3;

/// Points before a branch may close.
const ROUND: usize = 5;

/// The same orbit again: both were solved for to far below.
const SAME: f64 = 1e-6;

impl<F: ParametricMap + ?Sized> Path<'_, F> {
    /// A branch from a point along its tangent. Its `origin`, if it has one, is a special point of another branch and none
    /// of its own; where the branch comes back there it is closed.
    pub(crate) fn walk(
        &self,
        seed: Point,
        origin: Option<&Special>,
        keep_going: &mut dyn FnMut(&Point) -> bool,
    ) -> Branch {
        let mut go_on = keep_going(&seed);
        let mut branch = Branch {
            points: vec![seed],
            specials: Vec::new(),
            ends: [End::Start, End::Interrupted],
        };
        let mut step = self.options.initial;
        branch.ends[1] = loop {
            if let Some(end) = self.limit(&branch.points, go_on) {
                break end;
            }
            let mut closed = false;
            let point = match self.seen(&branch.points, origin.is_some(), step) {
                Ok((point, specials)) => {
                    step = self.next_step(&branch.points[branch.points.len() - 1], &point, step);
                    branch.specials.extend(specials);
                    let meets = |s: &Special| s.kind == SpecialKind::Halving;
                    if branch.specials.last().is_some_and(meets) {
                        break End::Halved;
                    }
                    closed = self.back_at(origin, &mut branch.specials);
                    point
                }
                Err(obstacle) => match self.past(&mut branch, step, obstacle) {
                    Ok((next, from_there)) => {
                        step = from_there;
                        let Some(point) = next else { continue };
                        point
                    }
                    Err(end) => break end,
                },
            };
            closed = closed || self.closed(&branch.points, &point);
            go_on = keep_going(&point);
            branch.points.push(point);
            if closed {
                break End::Closed;
            }
        };
        branch
    }

    /// The end of a branch that goes no further than these points.
    fn limit(&self, points: &[Point], go_on: bool) -> Option<End> {
        let unstable = points.iter().rev().take_while(|point| !point.stable);
        if !go_on {
            Some(End::Interrupted)
        } else if points.len() >= self.options.points.max(1) {
            Some(End::PointLimit)
        } else if unstable.count() > self.options.unstable {
            Some(End::Unstable)
        } else if self.leaves(&points[points.len() - 1]) {
            Some(End::RangeEnd)
        } else {
            None
        }
    }

    /// Passes an obstacle: a point behind it and the step from there, or no point and a shorter step to try.
    fn past(
        &self,
        branch: &mut Branch,
        step: f64,
        obstacle: End,
    ) -> Result<(Option<Point>, f64), End> {
        match self.shorter(&branch.points, step, &obstacle) {
            Shorter::Step(shorter) => Ok((None, shorter)),
            Shorter::Grazing(unit, ahead) => {
                let last = &branch.points[branch.points.len() - 1];
                let behind = self.beyond(last, ahead);
                let special = self.grazing(&branch.points, unit, ahead, behind.as_ref());
                branch.specials.push(special);
                let point = behind.ok_or(End::Grazing)?;
                let next = self.onwards(last, &point);
                Ok((Some(point), next))
            }
            Shorter::End => {
                let (point, next, special) = self.further(&branch.points, obstacle)?;
                branch.specials.extend(special);
                Ok((Some(point), next))
            }
        }
    }

    /// The point `step` ahead and the special points before it, up to one where the branch ends.
    fn seen(
        &self,
        points: &[Point],
        origin: bool,
        step: f64,
    ) -> Result<(Point, Vec<Special>), End> {
        let last = &points[points.len() - 1];
        let point = self.next(last, step)?;
        if origin && points.len() == 1 {
            return match critical(&point) {
                true => Ok((point, Vec::new())),
                false => Err(End::StepTooSmall),
            };
        }
        let mut specials = self.specials(last, &point, points.len() - 1)?;
        let crossing = |s: &Special| s.kind == SpecialKind::BranchPoint;
        if halved(last, &point)
            && let Some(met) = specials.iter().position(crossing)
        {
            specials.truncate(met + 1);
            specials[met].kind = SpecialKind::Halving;
            self.at_doubling(&mut specials[met]);
        }
        Ok((point, specials))
    }

    /// Passes an obstacle that stays with the smallest step, if it is the sampling instant or a grazing: the next
    /// point, the step from there, and the special point in between.
    fn further(
        &self,
        points: &[Point],
        obstacle: End,
    ) -> Result<(Point, f64, Option<Special>), End> {
        let last = &points[points.len() - 1];
        if !matches!(obstacle, End::Failed(_) | End::StepTooSmall) {
            return Err(obstacle);
        }
        if let Some(point) = self.across_instant(last) {
            return Ok((point, self.options.initial, None));
        }
        // No touch announces a grazing from the side with the switches.
        let beyond = self.beyond(last, 0.0).filter(|_| points.len() > 1);
        if let Some(point) = beyond
            && let Some(special) = self.gap(last, &point, points.len() - 1)
        {
            let step = self.onwards(last, &point);
            return Ok((point, step, Some(special)));
        }
        Err(if at_instant(&last.orbit) {
            End::SamplingInstant
        } else {
            obstacle
        })
    }

    /// Whether a point is at an end of the range and the branch leads out.
    fn leaves(&self, point: &Point) -> bool {
        let [low, high] = self.range;
        let rate = point.parameter_rate();
        (point.parameter >= high && rate > 0.0) || (point.parameter <= low && rate < 0.0)
    }

    fn inside(&self, parameter: f64) -> f64 {
        parameter.clamp(self.range[0], self.range[1])
    }

    /// The point `step` ahead, or that at the end of the range before it.
    pub(crate) fn next(&self, last: &Point, step: f64) -> Result<Point, End> {
        let ahead = last.parameter + step * last.parameter_rate() * self.free[0].unit;
        let mut point = if self.inside(ahead) == ahead {
            let guess = last
                .orbit
                .guess()
                .moved(&self.free, step, &last.full_tangent);
            let point = self.solve(&guess, &last.tangent, &last.tangent)?;
            let aside = minus(&self.apart(last, &point), &scaled(&last.tangent, step));
            if norm(&aside) > NEAR * step {
                return Err(End::StepTooSmall);
            }
            point
        } else {
            let edge = self.inside(ahead);
            let step = step * (edge - last.parameter) / (ahead - last.parameter);
            let mut guess = last
                .orbit
                .guess()
                .moved(&self.free, step, &last.full_tangent);
            guess.parameters[self.free[0].index] = edge;
            self.solve(&guess, &self.upwards(), &last.tangent)?
        };
        let edge = self.inside(point.parameter);
        if edge != point.parameter {
            let part = (edge - last.parameter) / (point.parameter - last.parameter);
            let mut guess = self.mixed(last, &point, part);
            guess.parameters[self.free[0].index] = edge;
            point = self.solve(&guess, &self.upwards(), &point.tangent)?;
        }
        // The corrector finds the orbit of half the period as easily at a kink, and at a birth close to one.
        if shortest_period(&point.orbit.places) < point.orbit.period() {
            return Err(End::StepTooSmall);
        }
        if events::same(&last.orbit.switches(), &point.orbit.switches()) {
            if angle(&last.tangent, &point.tangent) > self.options.angle {
                return Err(End::StepTooSmall);
            }
        } else if dot(&point.tangent, &self.apart(last, &point)) < 0.0 {
            // A kink of the map is one of the branch, and the old direction is worth little there.
            point = point.reversed();
        }
        Ok(point)
    }

    /// The step after one that led from `last` to `point`.
    fn next_step(&self, last: &Point, point: &Point, step: f64) -> f64 {
        let bend = angle(&last.tangent, &point.tangent).max(f64::MIN_POSITIVE);
        let by_bend = 0.5 * self.options.angle / bend;
        let by_newton = match point.orbit.iterations {
            0..=EASY => GROWTH,
            HARD.. => 0.5,
            _ => 1.0,
        };
        let factor = by_bend.min(by_newton).clamp(0.5, GROWTH);
        (factor * step).clamp(self.options.smallest, self.options.largest)
    }

    /// The response to an obstacle.
    fn shorter(&self, points: &[Point], step: f64, obstacle: &End) -> Shorter {
        match self.to_touch(points) {
            _ if *obstacle == End::Interrupted => Shorter::End,
            Some((unit, ahead)) if ahead < AT_TOUCH => Shorter::Grazing(unit, ahead),
            // Rounding leaves nothing to try below.
            Some((_, ahead)) if ahead < 2.0 * step && step > 1e-3 * AT_TOUCH => {
                Shorter::Step((APPROACH * ahead).min(step / 2.0))
            }
            _ if step / 2.0 < self.options.smallest => Shorter::End,
            _ => Shorter::Step(step / 2.0),
        }
    }

    /// Whether the last special points are those from the birth of a branch on, which are dropped. There the orbits
    /// are too uncertain to be compared with the first one.
    fn back_at(&self, origin: Option<&Special>, specials: &mut Vec<Special>) -> bool {
        let back = origin.and_then(|origin| {
            let again = |s: &Special| s.kind == origin.kind && self.same(origin, s);
            specials.iter().position(again)
        });
        back.is_some_and(|back| {
            specials.truncate(back);
            true
        })
    }

    /// Whether the step to `point` passes the first point of the branch.
    fn closed(&self, points: &[Point], point: &Point) -> bool {
        let (start, last) = (&points[0], &points[points.len() - 1]);
        if points.len() < ROUND || dot(&start.tangent, &point.tangent) < 0.0 {
            return false;
        }
        let length = self.distance(last, point);
        let part = dot(&self.apart(last, start), &unit(&self.apart(last, point))) / length;
        if !(0.0..=1.0).contains(&part) || self.distance(last, start) > NEAR * length {
            return false;
        }
        let again = self.between(last, point, part);
        again.is_ok_and(|again| self.distance(&again, start) <= SAME)
    }
}

enum Shorter {
    Step(f64),
    /// A unit grazes at this distance ahead.
    Grazing(usize, f64),
    End,
}

/// Angle between two unit vectors.
fn angle(a: &[f64], b: &[f64]) -> f64 {
    // The chord is used since the cosine hardly changes at small angles.
    2.0 * (norm(&minus(a, b)) / 2.0).min(1.0).asin()
}

/// Whether a multiplier is near +1, as it is where a branch is born. What happens on the first step cannot be
/// seen, so it must be short.
fn critical(point: &Point) -> bool {
    let off = |mu: &Multiplier| (mu.re - 1.0).hypot(mu.im);
    point.orbit.multipliers.iter().any(|mu| off(mu) < BORN)
}

/// Whether the two halves of an orbit change sides from `a` to `b`: in between they are one.
fn halved(a: &Point, b: &Point) -> bool {
    let n = a.orbit.period();
    let across = |point: &Point| {
        let places = &point.orbit.places;
        minus(&places[n / 2].x, &places[0].x)
    };
    n.is_multiple_of(2) && dot(&across(a), &across(b)) < 0.0
}
