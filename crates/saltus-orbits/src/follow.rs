//! Following a branch: predict along the tangent, correct, look what happened on the way, choose the step.

use crate::continuation::{
    Along, Branch, ContinuationError, ContinuationOptions, End, Path, Point,
};
use crate::linear::{dot, minus, norm, scaled, unit};
use crate::special::{Special, SpecialKind};
use crate::{Family, Lost, Multiplier, NotFound, Orbit, events};

/// The corrector stays within so many steps of the prediction, or it may have found another branch.
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

/// On the first step of a branch from its birth the critical multiplier moves by less than this.
const BORN: f64 = 0.3;

/// Points before a branch may close.
const ROUND: usize = 5;

/// The same orbit again: both were solved for to far below.
const SAME: f64 = 1e-6;

/// Follows a branch from `start`, at first towards growing parameter or falling.
///
/// `keep_going` sees each point; `false` ends the branch. The end before the first point is
/// [`End::Start`].
///
/// # Errors
/// If the question makes no sense or `start` is no orbit. How the branch ends is an answer.
pub fn follow<F: Family + ?Sized>(
    family: &F,
    start: &Orbit,
    along: &Along,
    growing: bool,
    options: &ContinuationOptions,
    keep_going: &mut dyn FnMut(&Point) -> bool,
) -> Result<Branch, ContinuationError> {
    let path = Path::new(family, start, along, options)?;
    let mut branch = path.walk(path.seed(start, growing)?, false, keep_going);
    Labels::default().name(&mut branch);
    Ok(branch)
}

/// Follows a branch from `start` both ways. Its points are in the order of a walk through `start` towards
/// growing parameter.
///
/// # Errors
/// As [`follow`].
pub fn follow_both<F: Family + ?Sized>(
    family: &F,
    start: &Orbit,
    along: &Along,
    options: &ContinuationOptions,
    keep_going: &mut dyn FnMut(&Point) -> bool,
) -> Result<Branch, ContinuationError> {
    let path = Path::new(family, start, along, options)?;
    let mut branch = path.walk_both(path.seed(start, true)?, false, keep_going);
    Labels::default().name(&mut branch);
    Ok(branch)
}

/// Numbers each kind of special point on its own.
#[derive(Default)]
pub(crate) struct Labels(Vec<&'static str>);

impl Labels {
    /// Labels in the order of the branch.
    pub(crate) fn name(&mut self, branch: &mut Branch) {
        for special in &mut branch.specials {
            let short = special.kind.short();
            self.0.push(short);
            let number = self.0.iter().filter(|known| **known == short).count();
            special.label = format!("{short}{number}");
        }
    }
}

impl Branch {
    /// This branch, walked away from its start, continued before its start by another walk.
    fn after(self, back: Branch) -> Self {
        let shift = back.points.len() - 1;
        let turned = |mut special: Special| {
            special.near = shift - special.near;
            special.outside.reverse();
            special.tangent.iter_mut().for_each(|t| *t = -*t);
            special
        };
        let mut points: Vec<Point> = back.points.into_iter().map(Point::reversed).collect();
        points.reverse();
        points.extend(self.points.into_iter().skip(1));
        let mut specials: Vec<Special> = back.specials.into_iter().map(turned).collect();
        specials.reverse();
        specials.extend(self.specials.into_iter().map(|mut special| {
            special.near += shift;
            special
        }));
        let [_, first] = back.ends;
        let [_, last] = self.ends;
        Self {
            points,
            specials,
            ends: [first, last],
        }
    }
}

/// Why there is no next point.
enum Obstacle {
    Corrector(NotFound),
    Bend,
}

impl Obstacle {
    fn end(self) -> End {
        match self {
            Self::Bend => End::StepTooSmall,
            Self::Corrector(NotFound::Lost {
                reason: Lost::Interrupted,
                ..
            }) => End::Interrupted,
            Self::Corrector(NotFound::Lost {
                reason: reason @ Lost::NoMap(_),
                ..
            }) => End::NoMap(reason),
            Self::Corrector(reason) => End::Failed(reason),
        }
    }
}

impl From<NotFound> for Obstacle {
    fn from(reason: NotFound) -> Self {
        Self::Corrector(reason)
    }
}

impl<F: Family + ?Sized> Path<'_, F> {
    /// Both ways from a point, unless the first way closes or is stopped. `born` as in [`Self::walk`].
    pub(crate) fn walk_both(
        &self,
        seed: Point,
        born: bool,
        keep_going: &mut dyn FnMut(&Point) -> bool,
    ) -> Branch {
        let forth = self.walk(seed.clone(), born, keep_going);
        if matches!(forth.ends[1], End::Closed | End::Interrupted) {
            return forth;
        }
        let mut first = true;
        let back = self.walk(seed.reversed(), born, &mut |point| {
            std::mem::take(&mut first) || keep_going(point)
        });
        forth.after(back)
    }

    /// A branch from a point along its tangent. A branch is `born` at a special point of another one, which
    /// is none of its own.
    pub(crate) fn walk(
        &self,
        seed: Point,
        born: bool,
        keep_going: &mut dyn FnMut(&Point) -> bool,
    ) -> Branch {
        let mut go_on = keep_going(&seed);
        let mut branch = Branch {
            points: vec![seed],
            specials: Vec::new(),
            ends: [End::Start, End::Interrupted],
        };
        let mut step = self.options.initial;
        while go_on {
            let last = &branch.points[branch.points.len() - 1];
            if branch.points.len() >= self.options.points.max(1) {
                branch.ends[1] = End::PointLimit;
                break;
            }
            if self.leaves(last) {
                branch.ends[1] = End::RangeEnd;
                break;
            }
            let next = self.next(last, step).and_then(|point| {
                let unseen = born && branch.points.len() == 1;
                if unseen && !critical(&point) {
                    return Err(Obstacle::Bend);
                }
                let after = branch.points.len() - 1;
                let specials = if unseen {
                    Vec::new()
                } else {
                    self.specials(last, &point, after)?
                };
                Ok((point, specials))
            });
            match next {
                Ok((point, specials)) => {
                    let known = branch.specials.len();
                    step = self.next_step(last, &point, step);
                    let closed = self.closed(&branch.points, &point);
                    let met = specials
                        .iter()
                        .position(|s| s.kind == SpecialKind::BranchPoint);
                    let met = met.filter(|_| halved(last, &point));
                    branch.specials.extend(specials);
                    if let Some(met) = met {
                        branch.specials.truncate(known + met + 1);
                        branch.specials[known + met].kind = SpecialKind::Halving;
                        branch.ends[1] = End::Halved;
                        break;
                    }
                    go_on = keep_going(&point);
                    branch.points.push(point);
                    if closed {
                        branch.ends[1] = End::Closed;
                        break;
                    }
                }
                Err(obstacle) => match self.shorter(&branch.points, step, &obstacle) {
                    Shorter::Step(shorter) => step = shorter,
                    Shorter::End => {
                        branch.ends[1] = obstacle.end();
                        break;
                    }
                    Shorter::Grazing(unit, ahead) => {
                        let behind = self.beyond(last, ahead);
                        branch
                            .specials
                            .push(self.grazing(&branch.points, unit, ahead, &behind));
                        let Some(point) = behind else {
                            branch.ends[1] = End::Grazing;
                            break;
                        };
                        step = (self.distance(last, &point)).max(self.options.smallest);
                        go_on = keep_going(&point);
                        branch.points.push(point);
                    }
                },
            }
        }
        branch
    }

    /// Whether a point is at an end of the range and the branch leads out.
    fn leaves(&self, point: &Point) -> bool {
        let [low, high] = self.range;
        let pace = point.pace();
        (point.parameter >= high && pace > 0.0) || (point.parameter <= low && pace < 0.0)
    }

    fn inside(&self, parameter: f64) -> f64 {
        parameter.clamp(self.range[0], self.range[1])
    }

    /// The point `step` ahead, or that at the end of the range before it.
    fn next(&self, last: &Point, step: f64) -> Result<Point, Obstacle> {
        let ahead = last.parameter + step * last.pace() * self.free[0].unit;
        let mut point = if self.inside(ahead) == ahead {
            let guess = last.orbit.guess().moved(&self.free, step, &last.spread);
            let point = self.solve(&guess, &last.tangent, &last.tangent)?;
            let aside = minus(&self.apart(last, &point), &scaled(&last.tangent, step));
            if norm(&aside) > NEAR * step {
                return Err(Obstacle::Bend);
            }
            point
        } else {
            let edge = self.inside(ahead);
            let step = step * (edge - last.parameter) / (ahead - last.parameter);
            let mut guess = last.orbit.guess().moved(&self.free, step, &last.spread);
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
        if events::same(
            &events::sequence(&last.orbit),
            &events::sequence(&point.orbit),
        ) {
            if angle(&last.tangent, &point.tangent) > self.options.angle {
                return Err(Obstacle::Bend);
            }
        } else if dot(&point.tangent, &self.apart(last, &point)) < 0.0 {
            // Where the map has a kink so has the branch, and its old direction says little.
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

    /// What to do about an obstacle.
    fn shorter(&self, points: &[Point], step: f64, obstacle: &Obstacle) -> Shorter {
        let interrupted = matches!(
            obstacle,
            Obstacle::Corrector(NotFound::Lost {
                reason: Lost::Interrupted,
                ..
            })
        );
        match self.to_touch(points) {
            _ if interrupted => Shorter::End,
            Some((unit, ahead)) if ahead < AT_TOUCH => Shorter::Grazing(unit, ahead),
            // Rounding leaves nothing to try below.
            Some((_, ahead)) if ahead < 2.0 * step && step > 1e-3 * AT_TOUCH => {
                Shorter::Step((APPROACH * ahead).min(step / 2.0))
            }
            _ if step / 2.0 < self.options.smallest => Shorter::End,
            _ => Shorter::Step(step / 2.0),
        }
    }

    /// How far ahead a touch comes to zero, if the last two points go on like that, and of which unit.
    fn to_touch(&self, points: &[Point]) -> Option<(usize, f64)> {
        let [.., before, last] = points else {
            return None;
        };
        let length = self.distance(before, last);
        let ahead = |i: usize, touch: &crate::Touch| {
            let same = |t: &&crate::Touch| t.unit == touch.unit && t.guard == touch.guard;
            let off = |t: &crate::Touch| (t.at - touch.at).abs();
            let earlier = before.orbit.touches[i].iter().filter(same);
            let earlier = earlier.min_by(|a, b| off(a).total_cmp(&off(b)))?;
            let closing = (earlier.value - touch.value) / length;
            (closing > 0.0).then(|| (touch.unit, touch.value / closing))
        };
        let touches = last.orbit.touches.iter().enumerate();
        touches
            .flat_map(|(i, all)| all.iter().filter_map(move |touch| ahead(i, touch)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The label of a grazing that no orbit passes smoothly.
    fn grazing(
        &self,
        points: &[Point],
        unit: usize,
        ahead: f64,
        behind: &Option<Point>,
    ) -> Special {
        let last = &points[points.len() - 1];
        let outside = [Some(last), behind.as_ref()].map(|p| p.map_or(last.outside, |p| p.outside));
        let remark = match behind {
            None => "no orbit was found near beyond it",
            Some(_) if outside[0] != outside[1] => {
                "stability changes here without a multiplier on the unit circle"
            }
            Some(_) => "the branch goes on with other switches",
        };
        Special {
            label: String::new(),
            kind: SpecialKind::Grazing { unit },
            parameter: last.parameter + ahead * last.pace() * self.free[0].unit,
            orbit: last.orbit.clone(),
            near: points.len() - 1,
            outside,
            remark: Some(remark.to_owned()),
            tangent: last.tangent.clone(),
        }
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
    /// Of a unit, so far ahead.
    Grazing(usize, f64),
    End,
}

/// Angle between two unit vectors.
fn angle(a: &[f64], b: &[f64]) -> f64 {
    // From the chord: the cosine says nothing about small angles.
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
