//! The vector work of one step of eight lanes: series, step length, guard bounds, new state.
//!
//! Nothing here knows what runs on the lanes, so it is compiled once for all tasks.

use std::sync::Arc;

use fearless_simd::{Level, Simd, SimdBase, dispatch};

use crate::arith::{Arith, LANES, Pack, Wide};
use crate::compile::Structure;
use crate::polynomial::{BernsteinTable, MAX_DEGREE};
use crate::series::{Series, expand};

/// Eight lanes of numbers and the program they all follow.
pub(crate) struct Kernel {
    pub(crate) order: usize,
    pub(crate) table: BernsteinTable,
    pub(crate) structure: Arc<Structure>,
    /// Time left in the period of each lane.
    pub(crate) left: Pack,
    /// Length of the step of each lane.
    pub(crate) lengths: Pack,
    tolerance: f64,
    level: Level,
    coefficients: Vec<Pack>,
    series: Series<Pack>,
    /// Largest last, last-but-one and first coefficient of each lane.
    tail: [Pack; 3],
    /// Smallest and largest Bernstein coefficient of each guard over the step.
    bounds: Vec<[Pack; 2]>,
}

impl Kernel {
    /// At the best instruction set of this machine.
    pub(crate) fn new(
        structure: &Arc<Structure>,
        coefficients: usize,
        tolerance: f64,
        order: usize,
    ) -> Self {
        Self {
            order,
            table: BernsteinTable::new(order),
            structure: Arc::clone(structure),
            left: Pack::default(),
            lengths: Pack::default(),
            tolerance,
            level: Level::new(),
            coefficients: vec![Pack::default(); coefficients],
            series: Series::new(structure, order),
            tail: [Pack::default(); 3],
            bounds: vec![[Pack::default(); 2]; structure.guards.len()],
        }
    }

    /// An idle lane computes with zeros, which disturb nobody.
    pub(crate) fn clear(&mut self, slot: usize) {
        self.coefficients.iter_mut().for_each(|c| c.0[slot] = 0.0);
        self.series.cells().for_each(|c| c.0[slot] = 0.0);
        self.left.0[slot] = 0.0;
    }

    pub(crate) fn set_coefficients(&mut self, slot: usize, values: &[f64]) {
        for (pack, value) in self.coefficients.iter_mut().zip(values) {
            pack.0[slot] = *value;
        }
    }

    pub(crate) fn set_state(&mut self, slot: usize, x: &[f64]) {
        for (state, &value) in x.iter().enumerate() {
            self.series.value(state).0[slot] = value;
        }
    }

    pub(crate) fn state(&self, slot: usize, x: &mut [f64]) {
        for (state, x) in x.iter_mut().enumerate() {
            *x = self.series.of(state)[0].0[slot];
        }
    }

    /// Taylor coefficients of a node in one lane.
    pub(crate) fn power(&self, slot: usize, node: usize) -> impl Iterator<Item = f64> {
        self.series.of(node).iter().map(move |a| a.0[slot])
    }

    /// Whether a guard, seen with this sign, surely stays positive in the step of a lane.
    pub(crate) fn is_safe(&self, slot: usize, guard: usize, sign: f64) -> bool {
        let [low, high] = &self.bounds[guard];
        if sign > 0.0 {
            low.0[slot] > 0.0
        } else {
            high.0[slot] < 0.0
        }
    }

    /// Whether the series of a lane is finite.
    pub(crate) fn is_finite(&self, slot: usize) -> bool {
        self.tail.iter().map(|t| t.0[slot]).sum::<f64>().is_finite()
    }

    /// Series of all lanes, the step they allow and the range of the guards over it.
    pub(crate) fn expand(&mut self) {
        dispatch!(self.level, simd => self.expand_with(Wide(simd)));
    }

    /// States at the end of each lane's step, in place of those at its start.
    pub(crate) fn advance(&mut self) {
        dispatch!(self.level, simd => self.advance_with(Wide(simd)));
    }

    #[inline(always)]
    fn expand_with<S: Simd>(&mut self, arith: Wide<S>) {
        expand(arith, &self.structure, &self.coefficients, &mut self.series);
        let mut tail = [arith.splat(0.0); 3];
        for state in 0..self.structure.controlled {
            for (k, tail) in [self.order, self.order - 1, 0].into_iter().zip(&mut tail) {
                let term = arith.load(&self.series.of(state)[k]);
                // The maximum may drop a NaN; adding 0 x keeps it.
                *tail = tail.max(term.abs()) + term * arith.splat(0.0);
            }
        }
        self.tail = tail.map(|t| arith.store(t));
        for slot in 0..LANES {
            self.lengths.0[slot] = self.length(slot);
        }
        self.bound_guards(arith);
    }

    /// Length of the step: the last two terms of the series stay below the tolerance (relative to the
    /// largest state once that exceeds 1), and it ends on the period's end at the latest.
    #[inline(always)]
    fn length(&self, slot: usize) -> f64 {
        let [last, before, size] = self.tail.map(|t| t.0[slot]);
        if !(last + before + size).is_finite() {
            return 0.0;
        }
        let p = self.order as f64;
        let tolerance = self.tolerance * size.max(1.0);
        let allowed = root(tolerance / last.max(f64::MIN_POSITIVE), p)
            .min(root(tolerance / before.max(f64::MIN_POSITIVE), p - 1.0));
        allowed.min(self.left.0[slot])
    }

    /// Range of each guard over the step by its Bernstein coefficients: a lane whose guards keep
    /// their sign needs no root search.
    #[inline(always)]
    fn bound_guards<S: Simd>(&mut self, arith: Wide<S>) {
        let length = arith.load(&self.lengths);
        for (bounds, &node) in self.bounds.iter_mut().zip(&self.structure.guards) {
            let power = self.series.of(node);
            let mut scaled = [arith.splat(0.0); MAX_DEGREE + 1];
            let mut scale = arith.splat(1.0);
            for (scaled, a) in scaled.iter_mut().zip(power) {
                *scaled = arith.mul(arith.load(a), scale);
                scale = arith.mul(scale, length);
            }
            let (mut low, mut high) = (scaled[0], scaled[0]);
            for j in 1..=self.order {
                let mut b = scaled[0];
                for (&w, &a) in self.table.row(j)[1..].iter().zip(&scaled[1..]) {
                    b = arith.mul_add(arith.splat(w), a, b);
                }
                (low, high) = (low.min(b), high.max(b));
            }
            *bounds = [arith.store(low), arith.store(high)];
        }
    }

    /// Horner's scheme for every state.
    #[inline(always)]
    fn advance_with<S: Simd>(&mut self, arith: Wide<S>) {
        let h = arith.load(&self.lengths);
        for state in 0..self.structure.states {
            let power = self.series.of_mut(state);
            let mut sum = arith.load(&power[self.order]);
            for a in power[..self.order].iter().rev() {
                sum = arith.mul_add(sum, h, arith.load(a));
            }
            power[0] = arith.store(sum);
        }
    }
}

/// x^(1/p) to a few per cent, from the exponent's bits: enough to choose a step, and a hundred times
/// cheaper than `powf`.
#[inline(always)]
fn root(x: f64, p: f64) -> f64 {
    const ONE: f64 = 4_607_182_418_800_017_408.0; // bits of 1.0
    let bits = (x.to_bits() as f64 - ONE) / p + ONE;
    f64::from_bits(bits as u64)
}
