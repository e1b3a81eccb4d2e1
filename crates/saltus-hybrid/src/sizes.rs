//! How large the states of each lane are: what the error of a step is relative to.
//!
//! A state is as large as it has been in this period, to a factor of [`OUTGROWN`], and at least as large as its scale
//! ([`SystemBuilder::scale`](crate::SystemBuilder::scale)). Where it has none it is measured at the start of a period,
//! and after a switch if it has been zero: it is as large as it becomes in the coming step. Nothing is kept from one
//! period to the next, so a run that goes on is the same as one that was not interrupted.

use crate::arith::{LANES, Pack};

/// Growth beyond its size after which a state is measured again.
const OUTGROWN: f64 = 2.0;

/// Places in a step at which the series of a state is looked at.
const PLACES: u32 = 4;

/// Of one state, in all lanes.
#[derive(Clone, Copy, Default)]
pub(crate) struct Size {
    /// 1 over the size; 0 if there is none.
    pub(crate) inverse: Pack,
    size: Pack,
    scale: Pack,
}

/// Of all states that take part in error control.
pub(crate) struct Sizes {
    pub(crate) of: Vec<Size>,
    /// Largest value of a state in units of its size.
    pub(crate) growth: Pack,
    /// Whether a state of the lane has no size.
    unknown: [bool; LANES],
}

impl Sizes {
    pub(crate) fn new(states: usize) -> Self {
        Self {
            of: vec![Size::default(); states],
            growth: Pack::default(),
            unknown: [false; LANES],
        }
    }

    /// A lane begins a leg with these scales, or, with none, is idle.
    pub(crate) fn begin(&mut self, lane: usize, scales: &[f64]) {
        self.unknown[lane] = !scales.is_empty();
        let scales = scales.iter().copied().chain(std::iter::repeat(0.0));
        for (size, scale) in self.of.iter_mut().zip(scales) {
            size.scale.0[lane] = scale;
            size.set(lane, scale);
        }
    }

    /// A switch may wake a state that has been zero.
    pub(crate) fn switched(&mut self, lane: usize) {
        self.unknown[lane] |= self.of.iter().any(|size| size.inverse.0[lane] == 0.0);
    }

    /// A period begins at the state `x`.
    pub(crate) fn period_begins(&mut self, lane: usize, x: &[f64]) {
        for (size, x) in self.of.iter_mut().zip(x) {
            let scale = size.scale.0[lane];
            size.set(lane, if scale > 0.0 { scale.max(x.abs()) } else { 0.0 });
            self.unknown[lane] |= scale == 0.0;
        }
    }

    /// How large the states of a lane have been.
    pub(crate) fn of_lane(&self, lane: usize) -> Vec<f64> {
        self.of.iter().map(|size| size.size.0[lane]).collect()
    }

    /// Whether states of any lane are to be measured.
    #[inline(always)]
    pub(crate) fn are_due(&self) -> bool {
        (0..LANES).any(|lane| self.is_due(lane))
    }

    /// Whether those of this lane are.
    #[inline(always)]
    pub(crate) fn is_due(&self, lane: usize) -> bool {
        self.unknown[lane] || self.growth.0[lane] > OUTGROWN
    }

    /// Measures the states of a lane by their series, for a step of at most `longest`.
    pub(crate) fn measure(
        &mut self,
        lane: usize,
        longest: f64,
        tolerance: f64,
        series: &[Vec<f64>],
    ) {
        self.unknown[lane] = false;
        let unknown = |size: &Size| size.inverse.0[lane] == 0.0;
        let wanted = series.iter().zip(&self.of);
        let wanted = wanted.filter(|(_, size)| unknown(size));
        let length = wanted.fold(longest, |length, (series, _)| {
            length.min(longest_step(series, tolerance))
        });
        for (size, series) in self.of.iter_mut().zip(series) {
            let mut known = series[0].abs().max(size.size.0[lane]);
            if unknown(size) {
                let at = |place: u32| {
                    let x = length * f64::from(place) / f64::from(PLACES);
                    series.iter().rev().fold(0.0, |sum, a| sum * x + a)
                };
                known = (1..=PLACES).map(at).fold(known, |m, x| m.max(x.abs()));
            }
            size.set(lane, known);
        }
    }
}

impl Size {
    fn set(&mut self, lane: usize, size: f64) {
        self.size.0[lane] = size;
        self.inverse.0[lane] = if size > 0.0 { 1.0 / size } else { 0.0 };
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
