//! The vector work of one step of eight lanes: series, step length, guard bounds, new state.
//!
//! Tasks are unknown here, so that this is compiled once for all of them.

use std::sync::Arc;

use fearless_simd::{Level, Simd, SimdBase, dispatch};

use crate::arith::{Arith, LANES, Pack, Wide};

use crate::event::{Guarded, Spot};
use crate::polynomial::{BernsteinTable, HEAD};
use crate::series::{Series, expand};
use crate::sizes::Sizes;
use crate::special::Shape;
use crate::structure::{Structure, Watch};
use crate::system::System;

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
    /// A guard is near zero if its least value in a step is below this part of its largest.
    near: f64,
    level: Level,
    /// Straight-line code for the program, if there is.
    shape: Option<Shape>,
    stream: Vec<Pack>,
    series: Series<Pack>,
    sizes: Sizes,
    /// Largest last and last-but-one coefficient of each lane, in units of the size of the state or of the
    /// largest tangent; NaN if any is not finite.
    tail: [Pack; 2],
    tangent_tail: Option<[Pack; 2]>,
    /// Length that the series of each lane allowed in its last step; 0 at a start.
    allowed: Pack,
    /// Orders before the last two that [`Self::look_back`] looks at, and the size that their terms may have.
    earlier: Vec<(usize, f64)>,
    /// NaN where the new state is not finite, else 0.
    pub(crate) overflow: Pack,
    /// States at the start of the step.
    start: Vec<Pack>,
    guards: Vec<GuardRange>,
    /// Lanes that need a look at every step.
    wary: [bool; LANES],
}

/// Growth of a step beyond which its series is looked at again.
const LONGER: f64 = 2.0;

/// Range of a guard over the coming step, and the bounds beyond which a lane needs a look.
#[derive(Clone, Copy)]
struct GuardRange {
    low: Pack,
    high: Pack,
    /// A lane needs a look if `low` is not above this (0 if the mode lasts while the guard is
    /// positive, else minus infinity).
    floor: Pack,
    /// The same for `high` and below.
    ceiling: Pack,
}

impl Kernel {
    pub(crate) fn new(
        structure: &Arc<Structure>,
        tolerance: f64,
        order: usize,
        level: Level,
    ) -> Self {
        let guard = GuardRange {
            low: Pack::default(),
            high: Pack::default(),
            floor: Pack([f64::NEG_INFINITY; LANES]),
            ceiling: Pack([f64::INFINITY; LANES]),
        };
        Self {
            order,
            table: BernsteinTable::new(order),
            structure: Arc::clone(structure),
            left: Pack::default(),
            lengths: Pack::default(),
            tolerance,
            near: (100.0 * tolerance).clamp(1e-6, 0.1),
            level,
            shape: Shape::of(structure),
            stream: vec![Pack::default(); structure.stream.len()],
            series: Series::new(structure, order),
            sizes: Sizes::new(structure.controlled),
            tail: [Pack::default(); 2],
            tangent_tail: None,
            allowed: Pack::default(),
            earlier: (order.saturating_sub(5).max(order.div_ceil(2))..order - 1)
                .map(|k| (k, tolerance.powf(k as f64 / order as f64)))
                .collect(),
            overflow: Pack::default(),
            start: vec![Pack::default(); structure.states],
            guards: vec![guard; structure.guards.len()],
            wary: [false; LANES],
        }
    }

    /// Makes a lane idle: it computes with zeros, which disturb no other.
    pub(crate) fn clear(&mut self, slot: usize) {
        self.stream.iter_mut().for_each(|c| c.0[slot] = 0.0);
        let nodes = self.structure.nodes;
        self.series.cells(nodes).for_each(|c| c.0[slot] = 0.0);
        self.left.0[slot] = 0.0;
        self.wary[slot] = false;
        self.sizes.begin(slot, &[], false);
        for guard in &mut self.guards {
            guard.floor.0[slot] = f64::NEG_INFINITY;
            guard.ceiling.0[slot] = f64::INFINITY;
        }
    }

    /// All coefficients of a lane, in the modes given.
    pub(crate) fn set_system(&mut self, slot: usize, system: &System, modes: &[usize]) {
        for (pack, value) in self.stream.iter_mut().zip(system.stream(modes)) {
            pack.0[slot] = value;
        }
    }

    /// Those coefficients of a lane that depend on modes.
    pub(crate) fn set_modes(&mut self, slot: usize, system: &System, modes: &[usize]) {
        for (place, value) in system.switched_in(modes) {
            self.stream[place].0[slot] = value;
        }
    }

    /// Sets the guards that matter to a lane, and whether it needs a look at every step in any case.
    pub(crate) fn watch(&mut self, slot: usize, guarded: &Guarded, always: bool) {
        for guard in &mut self.guards {
            guard.floor.0[slot] = f64::NEG_INFINITY;
            guard.ceiling.0[slot] = f64::INFINITY;
        }
        for (_, _, watch) in guarded.watches(&self.structure) {
            let guard = &mut self.guards[watch.guard];
            if watch.sign > 0.0 {
                guard.floor.0[slot] = 0.0;
            } else {
                guard.ceiling.0[slot] = 0.0;
            }
        }
        self.wary[slot] = always || guarded.is_wary();
    }

    pub(crate) fn set_state(&mut self, slot: usize, x: &[f64]) {
        for (state, &value) in x.iter().enumerate() {
            self.series.value(self.structure.state_slots[state]).0[slot] = value;
        }
    }

    /// Begins a segment at the state `x`: sizes of its states are not known yet.
    pub(crate) fn begin(&mut self, slot: usize, system: &System, x: &[f64]) {
        self.set_state(slot, x);
        self.allowed.0[slot] = 0.0;
        self.sizes
            .begin(slot, &system.scales, system.program.together);
    }

    /// Sizes of the states of a lane, and how large they have been.
    pub(crate) fn sizes(&mut self) -> &mut Sizes {
        &mut self.sizes
    }

    pub(crate) fn state(&self, slot: usize, x: &mut [f64]) {
        for (state, x) in x.iter_mut().enumerate() {
            *x = self.series.at(self.structure.state_slots[state], 0).0[slot];
        }
    }

    /// The state at the start of the last step.
    pub(crate) fn state_before(&self, slot: usize, x: &mut [f64]) {
        for (x, pack) in x.iter_mut().zip(&self.start) {
            *x = pack.0[slot];
        }
    }

    /// Taylor coefficients in one lane.
    pub(crate) fn power(&self, lane: usize, slot: usize) -> impl Iterator<Item = f64> {
        self.series.of(slot).map(move |a| a.0[lane])
    }

    /// Whether a guard, seen with this sign, surely stays positive in the step of a lane.
    pub(crate) fn is_safe(&self, slot: usize, guard: usize, sign: f64) -> bool {
        let GuardRange { low, high, .. } = &self.guards[guard];
        if sign > 0.0 {
            low.0[slot] > 0.0
        } else {
            high.0[slot] < 0.0
        }
    }

    /// Whether guards are on their right sides at the end of the step of a lane, by more than the drive moves them
    /// when it is set to its exact values at a sample.
    pub(crate) fn is_clear<'a>(
        &self,
        slot: usize,
        mut watches: impl Iterator<Item = (usize, usize, &'a Watch)>,
    ) -> bool {
        watches.all(|(_, _, watch)| {
            let GuardRange { low, high, .. } = &self.guards[watch.guard];
            let near = self.near * low.0[slot].abs().max(high.0[slot].abs());
            let surely = if watch.sign > 0.0 { low } else { high };
            surely.0[slot] * watch.sign > near || {
                let length = self.lengths.0[slot];
                let power = self.series.of(watch.guard_slot(&self.structure));
                let end = power.rev().fold(0.0, |sum, a| sum * length + a.0[slot]);
                end * watch.sign > near
            }
        })
    }

    /// The start of the step of a lane.
    pub(crate) fn spot(&self, slot: usize) -> Spot {
        let mut x = vec![0.0; self.structure.base_states()];
        self.state(slot, &mut x);
        Spot {
            x,
            sizes: self.sizes.of_lane(slot),
        }
    }

    /// Whether the series of a lane is finite.
    pub(crate) fn is_finite(&self, slot: usize) -> bool {
        let finite = |tail: &[Pack; 2]| tail.iter().map(|t| t.0[slot]).sum::<f64>().is_finite();
        finite(&self.tail) && self.tangent_tail.as_ref().is_none_or(finite)
    }

    /// Whether the new state of a lane is finite.
    pub(crate) fn has_finite_state(&self, slot: usize) -> bool {
        self.overflow.0[slot] == 0.0
    }

    /// Lanes in which something may happen in the coming step.
    #[inline(always)]
    fn needs_a_look(&self) -> [bool; LANES] {
        let mut look = self.wary;
        for guard in &self.guards {
            for (slot, look) in look.iter_mut().enumerate() {
                // Also if a bound is NaN.
                let clear = (guard.low.0[slot] > guard.floor.0[slot])
                    & (guard.high.0[slot] < guard.ceiling.0[slot]);
                *look |= !clear;
            }
        }
        for (slot, look) in look.iter_mut().enumerate() {
            // A step has no length if the series is not finite.
            *look |= self.lengths.0[slot] == 0.0;
        }
        look
    }

    /// Series of all lanes, the step they allow and the range of the guards over it; gives the lanes in which something
    /// may happen in that step.
    pub(crate) fn expand(&mut self) -> [bool; LANES] {
        dispatch!(self.level, simd => self.expand_with(Wide(simd)))
    }

    /// States at the end of each lane's step, in place of those at its start.
    pub(crate) fn advance(&mut self) {
        dispatch!(self.level, simd => self.advance_with(Wide(simd)));
    }

    #[inline(always)]
    fn expand_with<S: Simd>(&mut self, arith: Wide<S>) -> [bool; LANES] {
        let (structure, series) = (&self.structure, &mut self.series);
        expand(arith, structure, self.shape, &self.stream, series);
        self.tail = self.tail_of_states(arith);
        let tangents = self.structure.tangents.as_ref();
        self.tangent_tail = tangents.map(|t| self.tail_of_tangents(arith, t.first));
        if self.sizes.are_due() {
            self.measure();
        }
        self.lengths = self.step_lengths();
        self.bound_guards(arith);
        self.needs_a_look()
    }

    /// Last and last-but-one coefficients of the states, each in units of its size.
    #[inline(always)]
    fn tail_of_states<S: Simd>(&mut self, arith: Wide<S>) -> [Pack; 2] {
        let zero = arith.splat(0.0);
        let (mut largest, mut finite) = ([zero; 3], [zero; 3]);
        for (unit, &slot) in self.sizes.inverse.iter().zip(&self.structure.state_slots) {
            let unit = arith.load(unit);
            for (i, k) in [self.order, self.order - 1, 0].into_iter().enumerate() {
                let term = arith.mul(arith.load(self.series.at(slot, k)), unit);
                largest[i] = largest[i].max(term.abs());
                // The maximum may drop a NaN; 0 x keeps it.
                finite[i] = arith.mul_add(term, zero, finite[i]);
            }
        }
        self.sizes.growth = arith.store(largest[2]);
        let [last, before, value] = finite;
        [largest[0] + (last + value), largest[1] + before].map(|t| arith.store(t))
    }

    /// The same of the tangents, in units of the largest.
    #[inline(always)]
    fn tail_of_tangents<S: Simd>(&self, arith: Wide<S>, first: usize) -> [Pack; 2] {
        let mut tail = [arith.splat(0.0); 3];
        for &slot in &self.structure.state_slots[first..] {
            for (k, tail) in [self.order, self.order - 1, 0].into_iter().zip(&mut tail) {
                let term = arith.load(self.series.at(slot, k));
                *tail = arith.mul_add(term, arith.splat(0.0), tail.max(term.abs()));
            }
        }
        let [last, before, size] = tail.map(|t| arith.store(t).0);
        // Tangents that are all zero stay so.
        let part = |of: [f64; LANES]| {
            Pack(std::array::from_fn(|i| {
                if size[i] == 0.0 { 0.0 } else { of[i] / size[i] }
            }))
        };
        [part(last), part(before)]
    }

    /// Length of each step: the last two terms of the series stay below the tolerance, in units of the size of each
    /// state and of the largest tangent, and it ends at the next sample at the latest. 0 if the series is not finite.
    #[inline(always)]
    fn step_lengths(&mut self) -> Pack {
        let mut lengths = [f64::INFINITY; LANES];
        self.shorten(&self.tail, |slot| self.sizes.largest(slot), &mut lengths);
        if let Some(tail) = &self.tangent_tail {
            self.shorten(tail, |_| 1.0, &mut lengths);
        }
        let longer = lengths.iter().zip(&self.allowed.0);
        if longer.fold(false, |any, (length, last)| any | (*length > LONGER * last)) {
            self.look_back(&mut lengths);
        }
        if !self.structure.curved_guards.is_empty() {
            self.shorten_by_guards(&mut lengths);
        }
        self.allowed = Pack(lengths);
        for (length, left) in lengths.iter_mut().zip(self.left.0) {
            *length = length.min(left);
        }
        Pack(lengths)
    }

    /// Shortens steps that are much longer than the ones before where the last two terms of the series vanish by a
    /// symmetry of the state, as those of x'' = -sin x do at pi/2 (every fourth term is there). Terms before them are
    /// then as large as in a geometric series that ends at the tolerance, at the most.
    #[cold]
    fn look_back(&self, lengths: &mut [f64; LANES]) {
        for (slot, length) in lengths.iter_mut().enumerate() {
            if self.left.0[slot] == 0.0 || *length <= LONGER * self.allowed.0[slot] {
                continue;
            }
            let largest = self.sizes.largest(slot);
            let by = |&(k, part): &(usize, f64)| {
                let row = self.series.row(k);
                let states = self.sizes.inverse.iter().zip(&self.structure.state_slots);
                let terms = states.map(|(unit, &at)| (row[at].0[slot] * unit.0[slot]).abs());
                let term = terms.fold(f64::MIN_POSITIVE, f64::max);
                root(part * largest / term, k as f64)
            };
            let allowed = self.earlier.iter().map(by).fold(f64::INFINITY, f64::min);
            if LONGER * allowed < *length {
                *length = allowed;
            }
        }
    }

    /// Steps over which the last two terms of guards that are no polynomials stay below the tolerance, relative to
    /// their largest.
    #[cold]
    fn shorten_by_guards(&self, lengths: &mut [f64; LANES]) {
        for &guard in &self.structure.curved_guards {
            for (slot, length) in lengths.iter_mut().enumerate() {
                let longest = length.min(self.left.0[slot]);
                let mut scale = 1.0;
                let mut terms = self.series.of(guard).map(|term| {
                    let term = (term.0[slot] * scale).abs();
                    scale *= longest;
                    term
                });
                let size = terms.by_ref().take(self.order - 1).fold(0.0, f64::max);
                for (term, k) in terms.zip(self.order - 1..) {
                    if term > self.tolerance * size {
                        let part = root(self.tolerance * size / term, k as f64);
                        *length = length.min(longest * part);
                    }
                }
            }
        }
    }

    /// Steps no longer than these terms allow, in units of a size. Without branches, so that the lanes are computed side
    /// by side.
    #[inline(always)]
    fn shorten(&self, tail: &[Pack; 2], size: impl Fn(usize) -> f64, lengths: &mut [f64; LANES]) {
        let p = self.order as f64;
        for (i, length) in lengths.iter_mut().enumerate() {
            let [last, before] = [tail[0].0[i], tail[1].0[i]];
            let tolerance = self.tolerance * size(i);
            let by = |term: f64, p: f64| root(tolerance / term.max(f64::MIN_POSITIVE), p);
            let allowed = by(last, p).min(by(before, p - 1.0)).min(*length);
            *length = if (last + before).is_finite() {
                allowed
            } else {
                0.0
            };
        }
    }

    /// Sizes of states that have none yet or have outgrown theirs, and the tail of their lanes with these.
    #[cold]
    fn measure(&mut self) {
        for slot in 0..LANES {
            if !self.sizes.is_due(slot) || !self.is_finite(slot) {
                continue;
            }
            let (structure, series) = (&self.structure, &self.series);
            let of = |state: usize| series.of(structure.state_slots[state]).map(|a| a.0[slot]);
            let row = |k: usize| {
                let row = series.row(k);
                let slots = structure.state_slots.iter();
                slots.map(move |&at| row[at].0[slot])
            };
            let longest = self.left.0[slot];
            self.sizes
                .measure(slot, longest, self.tolerance, row(0), of);
            for (k, tail) in [self.order, self.order - 1].into_iter().zip(&mut self.tail) {
                let terms = self.sizes.inverse.iter().zip(row(k));
                let terms = terms.map(|(unit, term)| term.abs() * unit.0[slot]);
                tail.0[slot] = terms.fold(0.0, f64::max);
            }
        }
    }

    /// Range of each guard over the step: a lane whose guards keep their sign needs no root search.
    #[inline(always)]
    fn bound_guards<S: Simd>(&mut self, arith: Wide<S>) {
        // The usual length is known to the compiler, which then keeps all coefficients in registers.
        if self.order >= HEAD {
            self.bound_guards_by(arith, HEAD + 1);
        } else {
            self.bound_guards_by(arith, self.order + 1);
        }
    }

    /// The same by `head` Bernstein coefficients and a bound on the other terms.
    #[inline(always)]
    fn bound_guards_by<S: Simd>(&mut self, arith: Wide<S>, head: usize) {
        let length = arith.load(&self.lengths);
        let table = self.table.head.as_deref().unwrap_or(&self.table);
        for (range, &slot) in self.guards.iter_mut().zip(&self.structure.guard_slots) {
            let mut bernstein = [arith.load(self.series.at(slot, 0)); HEAD + 1];
            let mut scale = length;
            for k in 1..head {
                let a = arith.mul(arith.load(self.series.at(slot, k)), scale);
                scale = arith.mul(scale, length);
                let weights = &table.column(k)[..head - k];
                for (b, &w) in bernstein[k..head].iter_mut().zip(weights) {
                    *b = arith.mul_add(arith.splat(w), a, *b);
                }
            }
            let mut margin = arith.splat(0.0);
            for k in head..=self.order {
                let a = arith.load(self.series.at(slot, k));
                margin = arith.mul_add(a.abs(), scale, margin);
                scale = arith.mul(scale, length);
            }
            let bernstein = &bernstein[..head];
            let (mut low, mut high) = (bernstein[0], bernstein[0]);
            for &b in &bernstein[1..] {
                (low, high) = (low.min(b), high.max(b));
            }
            (range.low, range.high) = (arith.store(low - margin), arith.store(high + margin));
        }
    }

    /// Horner's scheme for every state, some of them side by side.
    #[inline(always)]
    fn advance_with<S: Simd>(&mut self, arith: Wide<S>) {
        self.overflow = Pack::default();
        let states = self.structure.states;
        let mut at = 0;
        while states - at >= 4 {
            self.horner::<S, 4>(arith, at);
            at += 4;
        }
        while at < states {
            self.horner::<S, 1>(arith, at);
            at += 1;
        }
    }

    #[inline(always)]
    fn horner<S: Simd, const W: usize>(&mut self, arith: Wide<S>, at: usize) {
        let Some(slots) = self.structure.state_slots[at..].first_chunk::<W>() else {
            return;
        };
        let h = arith.load(&self.lengths);
        let mut sums = [arith.splat(0.0); W];
        for row in self.series.rows().rev() {
            for w in 0..W {
                sums[w] = arith.mul_add(sums[w], h, arith.load(&row[slots[w]]));
            }
        }
        let mut overflow = arith.load(&self.overflow);
        for w in 0..W {
            let value = self.series.value(slots[w]);
            self.start[at + w] = *value;
            *value = arith.store(sums[w]);
            overflow = arith.mul_add(sums[w], arith.splat(0.0), overflow);
        }
        self.overflow = arith.store(overflow);
    }
}

/// x^(1/p) of a positive x to a few per cent, from the exponent's bits: enough to choose a step, and a hundred times
/// cheaper than `powf`.
#[inline(always)]
fn root(x: f64, p: f64) -> f64 {
    const ONE: f64 = 4_607_182_418_800_017_408.0; // bits of 1.0
    let bits = (x.to_bits() as i64 as f64 - ONE) / p + ONE;
    f64::from_bits(bits as i64 as u64)
}
