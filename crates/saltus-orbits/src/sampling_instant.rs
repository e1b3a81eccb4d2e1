//! Orbits across the sampling instant: a switch that resets states makes the sampled state jump when it wanders
//! through.

use crate::continuation::Point;
use crate::events::Switch;
use crate::path::Path;
use crate::shooting::Guess;
use crate::{MapPoint, MapRequest, Orbit, ParametricMap, events};

/// A switch this near to the sampling instant is at it (parts of a period). The last point before a jump lies
/// within the smallest step of it.
const AT_INSTANT: f64 = 1e-3;

/// Distances by which a place is moved to make its switch pass the sampling instant, and the part of them by which
/// the orbit is moved along the branch: the place decides on which side the motion begins.
const OFFSETS: [f64; 5] = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2];
const AHEAD: f64 = 0.1;

/// Whether a switch of an orbit is at the sampling instant.
pub(crate) fn at_instant(orbit: &Orbit) -> bool {
    let mut crossings = orbit.crossings.iter().flatten();
    crossings.any(|crossing| crossing.at.min(1.0 - crossing.at) < AT_INSTANT)
}

impl<F: ParametricMap + ?Sized> Path<'_, F> {
    /// The orbit a little ahead with a switch on the other side of the sampling instant, oriented onwards.
    pub(crate) fn across_instant(&self, last: &Point) -> Option<Point> {
        if !at_instant(&last.orbit) {
            return None;
        }
        let (up, [low, high]) = (self.upwards(), self.range);
        OFFSETS.iter().find_map(|&offset| {
            let length = AHEAD * offset;
            let ahead = last
                .orbit
                .guess()
                .moved(&self.free, length, &last.full_tangent);
            let inside = (low..=high).contains(&ahead.parameters[self.free[0].index]);
            let tries = self.jumped(last, offset).into_iter().filter(|_| inside);
            let mut found = tries.filter_map(|place| {
                let mut guess = ahead.clone();
                *guess.places.last_mut()? = place;
                guess.places.rotate_right(1);
                let rest = self.motion(&guess)?;
                self.solve(&rest, &up, &up).ok()
            });
            let point = found.find(|point| wandered(&last.orbit, &point.orbit))?;
            let onwards = point.parameter_rate() * last.parameter_rate() > 0.0;
            Some(if onwards { point } else { point.reversed() })
        })
    }

    /// Images of the last place of an orbit, moved along each axis, for which a switch comes before the sampling
    /// instant that came after it, or after it instead of before: they lie beyond the jump.
    fn jumped(&self, last: &Point, offset: f64) -> Vec<MapPoint> {
        let orbit = &last.orbit;
        let (Some(place), Some(switches)) = (orbit.places.last(), orbit.crossings.last()) else {
            return Vec::new();
        };
        let axes = 0..2 * place.x.len();
        let starts = axes.map(|i| {
            let mut start = place.clone();
            start.x[i / 2] += if i % 2 == 0 { offset } else { -offset };
            start
        });
        let starts: Vec<MapPoint> = starts.collect();
        let shots = starts.iter().map(|start| MapRequest {
            parameters: &orbit.parameters,
            start,
            derivative: true,
        });
        let images = self.family.images(&shots.collect::<Vec<_>>());
        let others = images.into_iter().flatten();
        let others = others.filter(|image| image.crossings.len() != switches.len());
        others.map(|image| image.place).collect()
    }

    /// The motion from the first place of a guess.
    fn motion(&self, guess: &Guess) -> Option<Guess> {
        let mut motion = guess.clone();
        for i in 1..guess.places.len() {
            let shot = MapRequest {
                parameters: &guess.parameters,
                start: &motion.places[i - 1],
                derivative: false,
            };
            motion.places[i] = self.family.images(&[shot]).pop()?.ok()?.place;
        }
        Some(motion)
    }
}

/// Whether two orbits have the same switches at nearly the same times, with a sampling instant between the times
/// of one of them.
fn wandered(a: &Orbit, b: &Orbit) -> bool {
    let (period, old) = (a.period() as f64, times(a));
    // The shorter way around the orbit from a time to another one.
    let way = |from: f64, to: f64| (to - from + period / 2.0).rem_euclid(period) - period / 2.0;
    let moved = |(switch, at): (Switch, f64)| {
        let same = old.iter().filter(|(other, _)| *other == switch);
        let ways = same.map(|&(_, from)| (from, way(from, at)));
        let (from, way) = ways.min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
        (way.abs() < AT_INSTANT).then_some(from.ceil() != (from + way).ceil())
    };
    let moved: Option<Vec<bool>> = times(b).into_iter().map(moved).collect();
    a.period() == b.period()
        && events::same(&a.switches(), &b.switches())
        && moved.is_some_and(|moved| moved.contains(&true))
}

/// The switches of an orbit and when they are made, in periods.
fn times(orbit: &Orbit) -> Vec<(Switch, f64)> {
    let times = orbit.crossings.iter().enumerate().flat_map(|(i, all)| {
        let at = all.iter().map(move |crossing| i as f64 + crossing.at);
        events::switches(all).into_iter().zip(at)
    });
    times.collect()
}
