//! Orbits beyond a grazing at which the map has no derivative, so that no small step leads there.

use crate::continuation::Point;
use crate::linear::{dot, norm};
use crate::orbit::shortest_period;
use crate::path::Path;
use crate::shooting::{Guess, Shooting};
use crate::special::JUMP;
use crate::{MapRequest, ParametricMap, Special, SpecialKind, Touch, events};

/// Offsets of the parameter from the grazing, in units of its range: with a square root in the map an
/// orbit may lie as far as the root of the first.
const OFFSETS: [f64; 6] = [1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2];

/// Starts by iteration of the map, beside the grazing orbit itself.
const ITERATES: usize = 4;

/// An orbit found beyond must lie within this many square roots of the offset.
const NEAR: f64 = 10.0;

impl<F: ParametricMap + ?Sized> Path<'_, F> {
    /// Unit whose touch comes to zero ahead, if the last two points go on like that, and the distance to it.
    pub(crate) fn to_touch(&self, points: &[Point]) -> Option<(usize, f64)> {
        let [.., before, last] = points else {
            return None;
        };
        let length = self.distance(before, last);
        let ahead = |i: usize, touch: &Touch| {
            let same = |t: &&Touch| t.unit == touch.unit && t.guard == touch.guard;
            let off = |t: &Touch| (t.at - touch.at).abs();
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
    pub(crate) fn grazing(
        &self,
        points: &[Point],
        unit: usize,
        ahead: f64,
        behind: Option<&Point>,
    ) -> Special {
        let last = &points[points.len() - 1];
        let outside = [
            last.outside,
            behind.map_or(last.outside, |point| point.outside),
        ];
        let remark = match behind {
            None => "no orbit was found near beyond it",
            Some(_) if outside[0] != outside[1] => JUMP,
            Some(_) => "the branch goes on with other switches",
        };
        Special {
            label: String::new(),
            kind: SpecialKind::Grazing { unit },
            parameter: last.parameter + ahead * last.parameter_rate() * self.free[0].unit,
            orbit: last.orbit.clone(),
            near: points.len() - 1,
            outside,
            remark: Some(remark.to_owned()),
            tangent: last.tangent.clone(),
        }
    }

    /// The nearest orbit with other switches beyond a grazing that lies `ahead` of `last`, oriented away
    /// from it. The branch may go on, or come back on the same side of the parameter. It had better lead
    /// on: very near a square root derivatives are too large to be known well.
    pub(crate) fn beyond(&self, last: &Point, ahead: f64) -> Option<Point> {
        let grazing = last
            .orbit
            .guess()
            .moved(&self.free, ahead, &last.full_tangent);
        let onwards = if last.parameter_rate() < 0.0 {
            -1.0
        } else {
            1.0
        };
        let range = self.range[1] - self.range[0];
        let offsets = OFFSETS
            .iter()
            .flat_map(|offset| [onwards * offset, -onwards * offset]);
        let tries = offsets.flat_map(|offset| [(offset * range, true), (offset * range, false)]);
        let mut nearest = None;
        for (offset, keep_switches) in tries {
            let Some(point) = self.near(last, &grazing, offset, keep_switches) else {
                continue;
            };
            if self.next(&point, self.onwards(last, &point)).is_ok() {
                return Some(point);
            }
            nearest.get_or_insert(point);
        }
        nearest
    }

    /// The first step from a point beyond a grazing.
    pub(crate) fn onwards(&self, last: &Point, beyond: &Point) -> f64 {
        self.distance(last, beyond).max(self.options.smallest)
    }

    fn near(
        &self,
        last: &Point,
        grazing: &Guess,
        offset: f64,
        keep_switches: bool,
    ) -> Option<Point> {
        let index = self.free[0].index;
        let mut guess = grazing.clone();
        guess.parameters[index] += offset;
        let [low, high] = self.range;
        if !(low..=high).contains(&guess.parameters[index]) {
            return None;
        }
        let reach = NEAR * (offset / (high - low)).abs().sqrt();
        let old = last.orbit.switches();
        let shooting = Shooting {
            keep_switches,
            ..self.shooting()
        };
        let up = self.upwards();
        for _ in 0..=ITERATES {
            let found = shooting.correct(&guess, std::slice::from_ref(&up));
            if let Ok(point) = found.and_then(|pass| self.point(&pass, &up)) {
                let way = self.apart(last, &point);
                let new = !events::same(&old, &point.orbit.switches())
                    && shortest_period(&point.orbit.places) == point.orbit.period();
                if new && norm(&way) <= reach {
                    let away = dot(&point.tangent, &way) >= 0.0;
                    return Some(if away { point } else { point.reversed() });
                }
            }
            guess = self.iterated(&guess)?;
        }
        None
    }

    /// One period of the motion from the last place of a guess.
    fn iterated(&self, guess: &Guess) -> Option<Guess> {
        let mut next = guess.clone();
        let mut at = guess.places[guess.places.len() - 1].clone();
        for place in &mut next.places {
            let shot = MapRequest {
                parameters: &guess.parameters,
                start: &at,
                derivative: false,
            };
            at = self.family.images(&[shot]).pop()?.ok()?.place;
            *place = at.clone();
        }
        Some(next)
    }
}
