//! The cycle that a motion is on, or coming to, by Newton's method and the Floquet multipliers.
//!
//! Samples cannot tell a period from its half where a multiplier is near -1, since the motion then comes back far
//! better after twice the period; nor a stable cycle from an unstable one, if the motion was carried to it. An orbit
//! and its multipliers can. The periods after which a motion comes back are tried, the shortest first, so the
//! shortest one wins. A stable cycle is the motion's own if the motion is on it, or if the distance between them
//! shrinks as the multipliers say.

use saltus_hybrid::{Point, Segment, record};
use saltus_orbits::{MapPoint, NewtonOptions, Orbit, Samples, find_orbit};

use crate::recording::rounded;
use crate::subject::Subject;
use crate::{Control, place, point, stroboscopic};

/// A motion that comes back within this may be near a cycle.
const NEAR: f64 = 0.1;

/// A motion this near is on the cycle: its own integration is that good, and no better.
const ON: f64 = 1e-6;

/// Multipliers are known to some 1e-8 (test `the_product_of_the_multipliers_is_liouvilles`).
const STABLE: f64 = 1.0 - 1e-7;

/// Periods that are tried at most: a cascade of doublings passes through no more with samples this close.
const TRIES: usize = 5;

/// Distance by which a motion is moved off an unstable cycle, in the units of the model.
const KICK: f64 = 1e-3;

/// The cycle that a motion is near.
pub(crate) enum Near {
    /// Stable, and the motion is on it or comes closer.
    Stable(Orbit),
    /// Unstable, and the motion is on it.
    Unstable(Orbit),
    /// No cycle of at most 32 periods.
    Nothing,
}

/// The cycle near a motion that has come to `end`, its last sample. It depends on these alone, to the bit.
pub(crate) fn cycle<S: Subject>(
    model: &S,
    end: &Point,
    samples: &Samples,
    control: &Control,
) -> Near {
    let mut returns = samples.returns(NEAR);
    returns.truncate(TRIES);
    let Some(&longest) = returns.last() else {
        return Near::Nothing;
    };
    // the number of threads would change the rounding of the derivatives
    let control = Control {
        threads: 1,
        ..control.clone()
    };
    let segment = Segment {
        system: model.system().clone(),
        start: end.clone(),
        periods: longest as u64,
    };
    let Ok(way) = record(&segment, &control.options) else {
        return Near::Nothing;
    };
    let places: Vec<MapPoint> = std::iter::once(end)
        .chain(&way.samples)
        .map(|point| place(model, point))
        .collect();
    let family = stroboscopic(model, |_: &[f64]| Ok(model.clone()), &control);
    let mut found = Near::Nothing;
    for n in returns {
        let Some(start) = places.get(..n) else { break };
        let Ok(orbit) = find_orbit(&family, &[], start, &NewtonOptions::default()) else {
            continue;
        };
        let away = Distances::new(model, &orbit, samples);
        let largest = orbit.multipliers.first().map_or(0.0, |m| m.modulus());
        if largest < STABLE && away.vanish(largest, orbit.period()) {
            return Near::Stable(orbit);
        }
        if largest >= STABLE && away.blocks[0] <= ON {
            found = Near::Unstable(orbit);
        }
    }
    found
}

/// A state beside a cycle, in the direction that grows most.
pub(crate) fn beside<S: Subject>(model: &S, orbit: &Orbit) -> Point {
    let n = orbit.monodromy.nrows();
    let mut direction = vec![1.0; n];
    for _ in 0..64 {
        let row = |i: usize| (0..n).map(|j| orbit.monodromy[(i, j)] * direction[j]).sum();
        let image: Vec<f64> = (0..n).map(row).collect();
        let length = image.iter().map(|x| x * x).sum::<f64>().sqrt();
        if !(length > 0.0 && length.is_finite()) {
            break;
        }
        direction = image.into_iter().map(|x| x / length).collect();
    }
    let mut beside = orbit.places[0].clone();
    for (x, part) in beside.x.iter_mut().zip(&direction) {
        *x = rounded(*x + KICK * part);
    }
    point(model, &beside)
}

/// Distances of a motion from a cycle, at the same phases.
struct Distances {
    /// The largest distance in each quarter of the samples, the last first.
    blocks: [f64; 4],
    /// Samples in each.
    length: usize,
}

impl Distances {
    fn new<S: Subject>(model: &S, orbit: &Orbit, samples: &Samples) -> Self {
        let row = |place: &MapPoint| {
            let mut row = vec![0.0; model.width()];
            model.coordinates(&point(model, place).x, &mut row);
            row
        };
        let rows: Vec<Vec<f64>> = orbit.places.iter().map(row).collect();
        let n = rows.len();
        // the last sample belongs to the first place
        let distance = |back: usize| {
            let pairs = samples.back(back).iter().zip(&rows[(n - back % n) % n]);
            pairs.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
        };
        let length = samples.count().min(Samples::ROWS) / 4;
        let largest = |block: usize| {
            let block = block * length..(block + 1) * length;
            block.map(distance).fold(0.0, f64::max)
        };
        Self {
            blocks: [0, 1, 2, 3].map(largest),
            length,
        }
    }

    /// Whether they are gone, or shrink in each block, over all of them at a third of the rate of the largest
    /// multiplier or faster.
    fn vanish(&self, multiplier: f64, period: usize) -> bool {
        let [last, .., first] = self.blocks;
        let shrink = multiplier.powf(self.length as f64 / period as f64);
        let shrinks = self.blocks.windows(2).all(|pair| pair[0] < pair[1]);
        last <= ON || last <= NEAR && shrinks && last <= shrink * first
    }
}
