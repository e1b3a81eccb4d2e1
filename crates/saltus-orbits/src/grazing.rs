//! Location of a grazing: a guard that is only touched on one side of it comes to zero.

use crate::continuation::Point;
use crate::locate::{Aim, NARROW, ROUNDS};
use crate::path::Path;
use crate::{Orbit, ParametricMap, events};

impl<F: ParametricMap + ?Sized> Path<'_, F> {
    /// Part of the way between two points at which the guard that makes their switches differ comes to zero: its value on
    /// the side without the switches is extrapolated, alternately a little further and less far, so that
    /// the bracket shrinks from both sides. Every third round bisects in any case.
    pub(crate) fn touching(
        &self,
        a: &Point,
        b: &Point,
        aim: &mut Aim,
        round: usize,
    ) -> Option<f64> {
        let [first, second] = [&a.orbit, &b.orbit].map(Orbit::switches);
        let units = events::units_apart(&first, &second);
        let forwards = a.orbit.switch_count() < b.orbit.switch_count();
        let quiet = if forwards { a } else { b };
        let touch = quiet.orbit.nearest_touch(|_, t| units.contains(&t.unit))?.1;
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

    /// Moves the point without the additional switches along its tangent to where its touch comes to zero, if no orbits
    /// are found between two points.
    pub(crate) fn approach(&self, a: &mut Point, b: &mut Point) {
        let [first, second] = [&a.orbit, &b.orbit].map(Orbit::switches);
        let units = events::units_apart(&first, &second);
        let width = self.distance(a, b);
        let (quiet, sign) = if a.orbit.switch_count() < b.orbit.switch_count() {
            (a, 1.0)
        } else {
            (b, -1.0)
        };
        let touch = |point: &Point| {
            let touch = point.orbit.nearest_touch(|_, t| units.contains(&t.unit));
            touch.map(|(_, touch)| touch.value)
        };
        let mut step = 1e-3 * width;
        for _ in 0..ROUNDS {
            let guess = quiet
                .orbit
                .guess()
                .moved(&self.free, sign * step, &quiet.full_tangent);
            let next = self.solve(&guess, &quiet.tangent, &quiet.tangent);
            let next = next.ok().filter(|next| {
                let [before, now] = [&quiet.orbit, &next.orbit].map(Orbit::switches);
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
