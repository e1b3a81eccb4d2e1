//! Peaks of quantities between samples, from dense output.
//!
//! Each step is read at its ends and [`PARTS`] - 1 points between. Where a reading comes near the largest
//! so far, a parabola through the three readings around it says where the top is, and the quantity is
//! read there; and again with that reading, until the top grows no more. What is kept is always a value that was
//! read, so a peak is never too large, and too small by less than 1e-9 of itself (test
//! `peaks_are_the_tops_of_the_motion_between_samples`).

use saltus_hybrid::{Mode, Step};

/// Parts of a step between readings. A step of the default method is short beside the highest mode.
const PARTS: usize = 2;

/// A top is looked for where a reading exceeds this part of the largest so far.
const NEAR: f64 = 0.9;

/// A parabola through three readings of a step meets the top to this part.
const NEARLY: f64 = 0.999;

/// Readings around a top at most; each brings some two digits.
const READINGS: usize = 8;

/// A reading this near to the highest one, relative to it, has found the top.
const FOUND: f64 = 1e-12;

/// The largest values of `channels` quantities.
#[derive(Clone, Debug)]
pub struct Peaks {
    /// Largest so far, channel by channel.
    pub largest: Vec<f64>,
    x: Vec<f64>,
    /// Readings of a step, point by point.
    readings: Vec<f64>,
    top: Vec<f64>,
    /// Modes in which the last point of `readings` was read; it is the first one of the next step, if no
    /// switch lies between.
    modes: Vec<Mode>,
}

impl Peaks {
    /// For states of this length.
    pub fn new(channels: usize, states: usize) -> Self {
        Self {
            largest: vec![0.0; channels],
            x: vec![0.0; states],
            readings: vec![0.0; channels * (PARTS + 1)],
            top: vec![0.0; channels],
            modes: Vec::new(),
        }
    }

    /// Forgets what was seen.
    pub fn clear(&mut self) {
        self.largest.fill(0.0);
    }

    /// Takes a step into account; `read` gives the channels at a state.
    pub fn step(&mut self, step: &Step<'_>, mut read: impl FnMut(&[f64], &mut [f64])) {
        let channels = self.largest.len();
        if channels == 0 {
            return;
        }
        let spacing = step.length / PARTS as f64;
        let mut at = |since: f64, out: &mut [f64]| {
            step.state(since, &mut self.x);
            read(&self.x, out);
        };
        let goes_on = self.modes == step.modes;
        if goes_on {
            self.readings.copy_within(PARTS * channels.., 0);
        } else {
            self.modes.clear();
            self.modes.extend(step.modes);
        }
        let points = self.readings.chunks_exact_mut(channels).enumerate();
        for (point, out) in points.skip(usize::from(goes_on)) {
            at(point as f64 * spacing, out);
        }
        for channel in 0..channels {
            let values: [f64; PARTS + 1] =
                std::array::from_fn(|point| self.readings[point * channels + channel]);
            let highest = (1..values.len())
                .fold(0, |best, i| if values[i] > values[best] { i } else { best });
            let largest = &mut self.largest[channel];
            if values[highest] < NEAR * *largest || values[highest] <= 0.0 {
                continue;
            }
            *largest = largest.max(values[highest]);
            // at an end of the step the nearest three points, so that a top just inside is found too
            let middle = highest.clamp(1, PARTS - 1);
            let mut points =
                [middle - 1, middle, middle + 1].map(|i| (i as f64 * spacing, values[i]));
            let mut top = values[highest];
            for _ in 0..READINGS {
                let Some((since, height)) = vertex(points) else {
                    break;
                };
                if height < NEARLY * *largest {
                    break;
                }
                let since = since.clamp(0.0, step.length);
                at(since, &mut self.top);
                let reading = self.top[channel];
                let gain = reading - top;
                top = top.max(reading);
                if gain.abs() <= FOUND * top {
                    break;
                }
                points = around(points, (since, reading));
            }
            *largest = largest.max(top);
        }
    }
}

/// Place and height of the maximum of the parabola through three points, if it has one.
fn vertex([(a, fa), (b, fb), (c, fc)]: [(f64, f64); 3]) -> Option<(f64, f64)> {
    let (left, right) = ((b - a) * (fb - fc), (b - c) * (fb - fa));
    let curvature = left - right;
    let off = -0.5 * ((b - a) * left - (b - c) * right) / curvature;
    // f(x) = fb + slope (x - b) - bend (x - b)^2, and the slope is 2 bend off
    let bend = curvature / ((b - a) * (c - b) * (c - a));
    let height = fb + bend * off * off;
    (curvature > 0.0 && off.is_finite()).then_some((b + off, height))
}

/// The new point with its neighbours on both sides, or the three it came from if it is one of them.
fn around(points: [(f64, f64); 3], new: (f64, f64)) -> [(f64, f64); 3] {
    let [a, b, c] = points;
    if new.0 <= a.0 || new.0 >= c.0 || new.0 == b.0 {
        points
    } else if new.0 < b.0 {
        [a, new, b]
    } else {
        [b, new, c]
    }
}

#[cfg(test)]
mod tests {
    use super::{around, vertex};

    #[test]
    fn the_vertex_of_a_parabola_is_exact() {
        let f = |x: f64| (x, 3.0 - 2.0 * (x - 0.7) * (x - 0.7));
        let (top, height) = vertex([f(0.1), f(0.5), f(1.3)]).expect("a maximum");
        assert!((top - 0.7).abs() < 1e-14, "{top}");
        assert!((height - 3.0).abs() < 1e-14, "{height}");
        assert_eq!(vertex([(0.0, 1.0), (1.0, 0.0), (2.0, 1.0)]), None);
        assert_eq!(vertex([(0.0, 1.0), (1.0, 1.0), (2.0, 1.0)]), None);
    }

    #[test]
    fn the_second_top_of_a_sine_is_far_better_than_the_first() {
        let f = |x: f64| (x, x.sin());
        let points = [f(1.0), f(1.5), f(2.0)];
        let (first, _) = vertex(points).expect("a maximum");
        let (second, _) = vertex(around(points, f(first))).expect("a maximum");
        let error = |x: f64| 1.0 - x.sin();
        assert!(error(first) < 1e-3 && error(second) < 0.5 * error(first));
        assert!(error(second) < 1e-4);
    }
}
