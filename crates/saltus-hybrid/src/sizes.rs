//! How large the states of each lane are: what the error of a step is relative to.
//!
//! A state is as large as it has been in this period, to a factor of [`OUTGROWN`], at least as large as its scale
//! ([`SystemBuilder::scale`](crate::SystemBuilder::scale)), and forgets what it was before by a factor of
//! [`FORGETS`] a period. Until it has been anything, at the start of a leg and after a switch, it is as large as
//! the largest term of its series in the coming step.

use crate::arith::{LANES, Pack};

/// Growth beyond its size after which a state is measured again.
const OUTGROWN: f64 = 2.0;

/// A state that happens to pass zero within a short period has not become small.
const FORGETS: f64 = 16.0;

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

    /// A period ends at the state `x`.
    pub(crate) fn period_ends(&mut self, lane: usize, x: &[f64]) {
        for (size, x) in self.of.iter_mut().zip(x) {
            let known = x.abs().max(size.size.0[lane] / FORGETS);
            size.set(lane, known.max(size.scale.0[lane]));
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

    /// Measures the states of a lane by the absolute values of their series, for a step of at most `longest`.
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
            let mut known = series[0].max(size.size.0[lane]);
            if unknown(size) {
                let power = |k: usize| length.powi(k as i32);
                let terms = series.iter().enumerate().map(|(k, a)| a * power(k));
                known = terms.fold(known, f64::max);
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

/// Longest step after which the last two terms of a series are below the tolerance, relative to its largest.
fn longest_step(series: &[f64], tolerance: f64) -> f64 {
    let p = series.len() - 1;
    let by = |last: usize| {
        let allowed = |k: usize| {
            let ratio = tolerance * series[k] / series[last];
            ratio.powf(1.0 / (last - k) as f64)
        };
        let most = (0..p - 1).map(allowed).fold(0.0, f64::max);
        if most > 0.0 { most } else { f64::INFINITY }
    };
    by(p).min(by(p - 1))
}
