//! Sizes of the states of each lane, to which the error of a step is relative.
//!
//! A state is as large as it has been in this period, to a factor of [`OUTGROWN`], and at least as large as its scale
//! ([`SystemBuilder::scale`](crate::SystemBuilder::scale)). Where it has none it is measured at the start of a period,
//! and after a switch if it has been zero: it is as large as it becomes in the coming step. Nothing is kept from one
//! period to the next, so a run that goes on is the same as one that was not interrupted.
//!
//! States that are one body ([`SystemBuilder::scale_together`](crate::SystemBuilder::scale_together)) are all as large
//! as the largest of them now, in units of their scales, up to [`FAR`]; beyond, each has its own size as above.

use crate::arith::{LANES, Pack};

/// Growth beyond its size after which a state is measured again.
const OUTGROWN: f64 = 2.0;

/// States of one body share a size up to this many scales. A state farther away is no part of it any more.
const FAR: f64 = 16.0;

/// Places in a step at which the series of a state is looked at.
const PLACES: u32 = 4;

/// Sizes of all states that take part in error control, in all lanes.
pub(crate) struct Sizes {
    /// 1 over the size of each state; 0 if there is none.
    pub(crate) inverse: Vec<Pack>,
    size: Vec<Pack>,
    scale: Vec<Pack>,
    /// Largest value of a state in units of its size.
    pub(crate) growth: Pack,
    /// 1 where all states of a lane are as large as the largest of them, else 0.
    together: Pack,
    /// Growth of a lane at which it is measured again.
    outgrown: Pack,
    /// Whether a state of the lane has no size.
    unknown: [bool; LANES],
    /// Whether a state of the lane may be larger than its scale.
    grown: [bool; LANES],
}

impl Sizes {
    pub(crate) fn new(states: usize) -> Self {
        let none = vec![Pack::default(); states];
        Self {
            inverse: none.clone(),
            size: none.clone(),
            scale: none,
            growth: Pack::default(),
            together: Pack::default(),
            outgrown: Pack([f64::INFINITY; LANES]),
            unknown: [false; LANES],
            grown: [false; LANES],
        }
    }

    /// Begins a segment on a lane with these scales; a lane without any is idle.
    pub(crate) fn begin(&mut self, lane: usize, scales: &[f64], together: bool) {
        self.together.0[lane] = f64::from(u8::from(together));
        self.unknown[lane] = !together && !scales.is_empty();
        self.outgrown.0[lane] = match () {
            () if together => FAR,
            () if scales.is_empty() => f64::INFINITY,
            () => OUTGROWN,
        };
        for state in 0..self.size.len() {
            let scale = scales.get(state).copied().unwrap_or(0.0);
            self.scale[state].0[lane] = scale;
            self.set(state, lane, scale);
        }
    }

    fn set(&mut self, state: usize, lane: usize, size: f64) {
        self.size[state].0[lane] = size;
        self.inverse[state].0[lane] = if size > 0.0 { 1.0 / size } else { 0.0 };
    }

    fn is_unknown(&self, state: usize, lane: usize) -> bool {
        self.inverse[state].0[lane] == 0.0
    }

    /// Measures states of a lane again that have been zero: a switch may wake them.
    pub(crate) fn switched(&mut self, lane: usize) {
        let mut states = 0..self.size.len();
        self.unknown[lane] |= states.any(|state| self.is_unknown(state, lane));
    }

    /// Begins a period at the state `x`.
    pub(crate) fn period_begins(&mut self, lane: usize, x: &[f64]) {
        let together = self.together.0[lane] > 0.0;
        if together && !std::mem::take(&mut self.grown[lane]) {
            return;
        }
        for (state, x) in x.iter().enumerate().take(self.size.len()) {
            let scale = self.scale[state].0[lane];
            let size = if together || scale == 0.0 {
                scale
            } else {
                scale.max(x.abs())
            };
            if size != self.size[state].0[lane] {
                self.set(state, lane, size);
            }
            self.unknown[lane] |= scale == 0.0;
        }
    }

    /// Sizes of the states of a lane.
    pub(crate) fn of_lane(&self, lane: usize) -> Vec<f64> {
        self.size.iter().map(|size| size.0[lane]).collect()
    }

    /// Whether states of any lane are to be measured.
    #[inline(always)]
    pub(crate) fn are_due(&self) -> bool {
        (0..LANES).any(|lane| self.is_due(lane))
    }

    /// Whether those of this lane are.
    #[inline(always)]
    pub(crate) fn is_due(&self, lane: usize) -> bool {
        self.unknown[lane] | (self.growth.0[lane] > self.outgrown.0[lane])
    }

    /// Largest state of a lane in units of its size, where all are as large as the largest; at least 1.
    #[inline(always)]
    pub(crate) fn largest(&self, lane: usize) -> f64 {
        (self.growth.0[lane] * self.together.0[lane]).max(1.0)
    }

    /// Measures the states of a lane, for a step of at most `longest`; `series` gives that of a state, and `now` its
    /// value.
    #[inline(always)]
    pub(crate) fn measure<I: DoubleEndedIterator<Item = f64>>(
        &mut self,
        lane: usize,
        longest: f64,
        tolerance: f64,
        now: impl Iterator<Item = f64>,
        series: impl Fn(usize) -> I,
    ) {
        if std::mem::take(&mut self.unknown[lane]) {
            self.measure_unknown(lane, longest, tolerance, &series);
        }
        for (state, now) in now.enumerate().take(self.size.len()) {
            if now.abs() > self.size[state].0[lane] {
                self.set(state, lane, now.abs());
            }
        }
        self.growth.0[lane] = 1.0;
        self.grown[lane] = true;
    }

    /// States without a size are as large as they become in the coming step.
    #[cold]
    fn measure_unknown<I: DoubleEndedIterator<Item = f64>>(
        &mut self,
        lane: usize,
        longest: f64,
        tolerance: f64,
        series: &impl Fn(usize) -> I,
    ) {
        let unknown = (0..self.size.len()).filter(|&state| self.is_unknown(state, lane));
        let unknown: Vec<(usize, Vec<f64>)> = unknown.map(|i| (i, series(i).collect())).collect();
        let length = unknown.iter().fold(longest, |length, (_, series)| {
            length.min(longest_step(series, tolerance))
        });
        for (state, series) in unknown {
            let at = |place: u32| {
                let x = length * f64::from(place) / f64::from(PLACES);
                series.iter().rev().fold(0.0, |sum, a| sum * x + a)
            };
            let known = (0..=PLACES).map(at).fold(0.0, |m: f64, x| m.max(x.abs()));
            self.set(state, lane, known);
        }
    }
}

/// Longest step after which the last two terms of a series are below the tolerance, relative to its first two.
fn longest_step(series: &[f64], tolerance: f64) -> f64 {
    let p = series.len() - 1;
    let Some(first) = series.iter().position(|&a| a != 0.0) else {
        return f64::INFINITY;
    };
    let by = |last: usize| {
        let allowed = |k: usize| {
            let ratio = tolerance * (series[k] / series[last]).abs();
            ratio.powf(1.0 / (last - k) as f64)
        };
        (first..=first + 1)
            .filter(|&k| k < last)
            .map(allowed)
            .fold(0.0, f64::max)
    };
    let [last, before] = [p, p - 1].map(|last| match by(last) {
        most if most > 0.0 => most,
        _ => f64::INFINITY,
    });
    last.min(before)
}
