//! Periods of motions that have settled, by samples at the section.
//!
//! Let d_k = |x_k - x_(k-n)| be the distance of a sample from the one n periods before, D the largest
//! d_k of the last block of samples and D' that of the block before. A motion that settles on a cycle
//! whose length divides n contracts by some q = D/D' per block, so by q^(n/block) per return, and the
//! rest of the transient is at most the geometric series
//!
//! ```text
//! r_n = D q^(n/block) / (1 - q^(n/block)).
//! ```
//!
//! The motion has period n if r_n is small and n is the shortest such: for every divisor m of n the
//! samples m periods apart must lie further apart than that rest can explain, and stay so. So
//! an alternating approach to a fixed point, whose every second sample hardly moves, is not called a 2-cycle.
//! A D that is no longer above the noise of the integration does not shrink either, and r_n = D. Then the
//! split, the smallest of those distances, is all that separates n from a divisor. A narrow one must have
//! kept its width in all samples that are remembered; ask Newton's method too if you can, since a
//! multiplier near -1 narrows it more slowly than any number of samples shows ([`OnCycle::is_sure`]).
//!
//! A motion whose returns are small, but visibly shrink or grow over four blocks in a row, or hardly change
//! from one to the next, is [`Recurrence::Drifting`]: still coming to a cycle, or leaving an unstable one. Near
//! a bifurcation this is the right answer after any finite number of periods. A torus narrower than
//! about 0.05 eta may be taken for such a drift.

use crate::Recurrence;

/// Longest period looked for.
pub const MAX_PERIOD: usize = 32;

/// Samples in a block at least: short periods have several returns in one.
const BLOCK: usize = 16;

/// Distances below this are noise of the integration (in the units of the samples, eta).
const NOISE: f64 = 1e-9;

/// The rest of a transient must be this many times smaller than the distance that separates two periods.
const APART: f64 = 10.0;

/// Distances that separate two periods keep this part of themselves from block to block.
const STAYS: f64 = 0.99;

/// Cycles whose samples lie closer together than this (eta) are one: integration leaves as much.
const SAME: f64 = 1e-6;

/// A split wider than this (eta) is no slow transient: at the doubling itself, where one narrows as its cube, it
/// would still move by more than [`Closeness::TIGHT`] allows.
const WIDE: f64 = 0.02;

/// Distances above this are no return at all.
const FAR: f64 = 0.1;

/// Each of four blocks shrinks to less than this in a visible contraction, or grows by as much; a torus or
/// a chaotic band keeps its width. With blocks of 56 samples that is seen up to a multiplier of 0.9995.
const VISIBLE: f64 = 0.97;

/// Returns below this may be a drift (eta), if one differs from the next by less than this part.
const SLOW: f64 = 0.02;
const STEADY: f64 = 0.1;

/// Bounds on the rest of a transient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closeness {
    /// Largest distance of a return (eta).
    pub distance: f64,
    /// Largest sum of the returns still to come (eta).
    pub rest: f64,
}

impl Closeness {
    /// Surely on the cycle: the rest of the transient can be left out.
    pub const TIGHT: Self = Self {
        distance: 1e-7,
        rest: 1e-6,
    };
    /// Close enough to name the period when there is no more time.
    pub const FAIR: Self = Self {
        distance: 1e-4,
        rest: 1e-3,
    };
}

/// A motion on a cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnCycle {
    /// Period of the cycle.
    pub period: u32,
    /// Bound on the rest of the transient (eta).
    pub rest: f64,
    /// The smallest distance (eta) between samples that a shorter period would make equal; infinite for period 1.
    pub split: f64,
}

impl OnCycle {
    /// Whether samples alone prove the period: next to nothing is left of the transient, and no part of the cycle comes
    /// near to repeating. They prove that the cycle is stable only for a motion that came from far away.
    pub fn is_sure(&self) -> bool {
        self.rest <= Closeness::TIGHT.rest && self.split > WIDE
    }
}

impl From<OnCycle> for Recurrence {
    fn from(OnCycle { period, rest, .. }: OnCycle) -> Self {
        Self::Recurs { period, rest }
    }
}

/// The last samples of a motion, as many as a verdict may need.
#[derive(Clone, Debug)]
pub struct Samples {
    width: usize,
    /// Sample k stands at row k mod [`Self::ROWS`].
    rows: Vec<f64>,
    count: usize,
}

impl Samples {
    /// Number of samples kept: four blocks of 56 and one return of the longest period.
    pub const ROWS: usize = 256;

    /// No samples yet, of `width` numbers each, in units of eta.
    pub fn new(width: usize) -> Self {
        Self {
            width,
            rows: vec![0.0; width * Self::ROWS],
            count: 0,
        }
    }

    /// Adds a sample, which `fill` writes.
    pub fn push(&mut self, fill: impl FnOnce(&mut [f64])) {
        let row = self.count % Self::ROWS;
        fill(&mut self.rows[row * self.width..(row + 1) * self.width]);
        self.count += 1;
    }

    /// Samples added so far.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The sample `back` samples before the last; the last 256 are kept.
    ///
    /// # Panics
    /// If there is none yet.
    pub fn back(&self, back: usize) -> &[f64] {
        let row = (self.count - 1 - back) % Self::ROWS;
        &self.rows[row * self.width..(row + 1) * self.width]
    }

    fn distance(&self, back: usize, n: usize) -> f64 {
        let pairs = self.back(back).iter().zip(self.back(back + n));
        pairs.fold(0.0, |most, (a, b)| f64::max(most, (a - b).abs()))
    }

    /// Largest distance over `n` periods in `block` samples that end `back` samples before the last.
    fn largest(&self, back: usize, block: usize, n: usize) -> f64 {
        let distances = (back..back + block).map(|back| self.distance(back, n));
        distances.fold(0.0, f64::max)
    }

    /// D and r_n, if there are samples enough.
    fn rest(&self, n: usize) -> Option<(f64, f64)> {
        let block = n.max(BLOCK);
        if self.count < 2 * block + n {
            return None;
        }
        let last = self.largest(0, block, n);
        if last <= NOISE {
            return Some((last, last));
        }
        let shrink = last / self.largest(block, block, n);
        let per_return = shrink.powf(n as f64 / block as f64);
        let still = per_return / (1.0 - per_return);
        let rest = if per_return < 1.0 {
            last * still
        } else {
            f64::INFINITY
        };
        Some((last, rest))
    }

    /// Whether samples `m` apart, for all divisors m of `n`, stay apart by more than `rest` can explain.
    fn is_shortest(&self, n: usize, rest: f64) -> bool {
        let block = n.max(BLOCK);
        let least = SAME.max(APART * rest);
        let oldest = |m: usize| self.largest(self.kept() - block - m, block, m);
        let apart = |m: usize| {
            let (last, before) = (self.largest(0, block, m), self.largest(block, block, m));
            last > least && last > STAYS * before && (last > WIDE || last > STAYS * oldest(m))
        };
        divisors(n).all(apart)
    }

    /// Samples that are still there.
    fn kept(&self) -> usize {
        self.count.min(Self::ROWS)
    }

    /// Periods after which each of the last samples, a block of them, comes back within `limit`: the shortest first, and
    /// of longer ones those whose returns are nearer than any before. The period of a cycle that the motion comes to is
    /// among them.
    pub fn returns(&self, limit: f64) -> Vec<usize> {
        let mut nearest = limit;
        let mut comes_back = |n: &usize| {
            let block = BLOCK.max(*n);
            // most are refused by one comparison
            let near = self.kept() >= block + n && self.distance(0, *n) <= nearest;
            let furthest = if near {
                self.largest(0, block, *n)
            } else {
                f64::INFINITY
            };
            let nearer = furthest <= nearest;
            if nearer {
                nearest = furthest;
            }
            nearer
        };
        (1..=MAX_PERIOD).filter(|n| comes_back(n)).collect()
    }

    /// Whether the motion is on a cycle, as closely as `limit` asks; `None` if it is not known to be.
    pub fn settled(&self, limit: Closeness) -> Option<OnCycle> {
        // most candidates are refused by one comparison
        let near = |n: &usize| self.count > *n && self.distance(0, *n) <= limit.distance;
        (1..=MAX_PERIOD).filter(near).find_map(|n| {
            let (last, rest) = self.rest(n)?;
            let close = last <= limit.distance && rest <= limit.rest;
            let splits = divisors(n).map(|m| self.largest(0, n.max(BLOCK), m));
            (close && self.is_shortest(n, rest)).then(|| OnCycle {
                period: n as u32,
                rest,
                split: splits.fold(f64::INFINITY, f64::min),
            })
        })
    }

    /// Whether the motion visibly comes closer to some cycle, or leaves one.
    fn drifts(&self) -> bool {
        (1..=MAX_PERIOD).any(|n| self.drifts_over(n) || self.creeps(n))
    }

    /// Whether the returns after `n` periods shrink, or grow, from each of four blocks to the next.
    fn drifts_over(&self, n: usize) -> bool {
        let block = self.kept().saturating_sub(n) / 4;
        if block < BLOCK / 2 || self.largest(0, block, n) > FAR {
            return false;
        }
        let blocks = [0, 1, 2, 3].map(|i| self.largest(i * block, block, n));
        let shrinks = |pair: &[f64]| pair[0] < VISIBLE * pair[1];
        let grows = |pair: &[f64]| pair[1] < VISIBLE * pair[0];
        blocks.windows(2).all(shrinks) || blocks.windows(2).all(grows)
    }

    /// Whether the returns after `n` periods are small, and each is nearly the one before.
    fn creeps(&self, n: usize) -> bool {
        let block = n.max(BLOCK);
        if self.count < block + 2 * n {
            return false;
        }
        let largest = self.largest(0, block, n);
        let steady = |back: usize| {
            let (now, before) = (self.back(back), self.back(back + n));
            let triples = now.iter().zip(before).zip(self.back(back + 2 * n));
            triples
                .map(|((a, b), c)| (a - 2.0 * b + c).abs())
                .all(|change| change <= STEADY * largest)
        };
        largest <= SLOW && (0..block).all(steady)
    }

    /// The verdict on the samples when there is no more time.
    pub fn judge(&self) -> Recurrence {
        match self.settled(Closeness::FAIR) {
            Some(found) => found.into(),
            None if self.drifts() => Recurrence::Drifting,
            None => Recurrence::Open,
        }
    }
}

/// Divisors of `n` below it.
fn divisors(n: usize) -> impl Iterator<Item = usize> {
    (1..n).filter(move |m| n.is_multiple_of(*m))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(count: usize, at: impl Fn(f64) -> f64) -> Samples {
        let mut samples = Samples::new(1);
        for k in 0..count {
            samples.push(|row| row[0] = at(k as f64));
        }
        samples
    }

    fn tight(count: usize, at: impl Fn(f64) -> f64) -> Option<u32> {
        let settled = samples(count, at).settled(Closeness::TIGHT);
        settled.map(|found| found.period)
    }

    fn period(found: Recurrence) -> Option<u32> {
        match found {
            Recurrence::Recurs { period, .. } => Some(period),
            _ => None,
        }
    }

    #[test]
    fn cycles_have_their_shortest_period() {
        for n in [1, 2, 3, 4, 5, 8, 12, 16, 31, 32] {
            let cycle = |k: f64| ((k as usize % n) as f64 * 0.7).sin();
            assert_eq!(tight(200, cycle), Some(n as u32), "{n}");
        }
        let long = |k: f64| ((k as usize % 33) as f64 * 0.7).sin();
        assert_eq!(samples(400, long).judge(), Recurrence::Open);
    }

    #[test]
    fn too_few_samples_say_nothing() {
        assert_eq!(samples(17, |_| 1.0).judge(), Recurrence::Open);
        assert_eq!(period(samples(32, |_| 1.0).judge()), None);
        assert_eq!(tight(33, |_| 1.0), Some(1));
        assert_eq!(samples(0, |_| 1.0).judge(), Recurrence::Open);
    }

    #[test]
    fn the_rest_of_a_transient_is_bounded() {
        for rate in [0.5_f64, 0.9, 0.97] {
            let mut samples = Samples::new(1);
            let there = (0..2000).find_map(|k| {
                let left = 0.3 * rate.powi(k);
                samples.push(|row| row[0] = 1.0 + left);
                Some((samples.settled(Closeness::TIGHT)?, left))
            });
            let (found, left) = there.expect("it settles");
            assert_eq!(found.period, 1);
            assert!(
                left <= 1.01 * found.rest + NOISE,
                "{rate}: {left}, {found:?}"
            );
            assert!(found.rest <= 1e-6);
        }
    }

    #[test]
    fn a_slow_alternating_approach_is_no_two_cycle() {
        // every second sample moves by a thousandth of what is left
        let slow = |k: f64| 1e-2 * (-0.9995_f64).powi(k as i32);
        for count in [100, 464, 1000] {
            assert_eq!(period(samples(count, slow).judge()), None, "{count}");
        }
        // less slow: visibly on its way, then there
        let less = |k: f64| (-0.98_f64).powi(k as i32);
        assert_eq!(samples(300, less).judge(), Recurrence::Drifting);
        assert_eq!(period(samples(1000, less).judge()), Some(1));
        assert_eq!(tight(2000, less), Some(1));
        // a faster decay in the same motion does not hide the alternating one
        for count in (40..400).step_by(8) {
            let both = |k: f64| 0.85_f64.powf(k) + 1e-3 * (-0.95_f64).powi(k as i32);
            assert!(tight(count, both).is_none_or(|n| n == 1), "{count}");
        }
    }

    #[test]
    fn a_cycle_barely_split_is_told_once_it_has_settled() {
        let sign = |k: f64| if k % 2.0 == 0.0 { 1.0 } else { -1.0 };
        assert_eq!(
            tight(400, |k| 0.2 * (1.0 - 0.9_f64.powf(k)) * sign(k)),
            Some(2)
        );
        assert_eq!(tight(400, |k| 1e-6 * sign(k)), Some(2));
    }

    #[test]
    fn what_never_repeats_stays_open() {
        let turn = |k: f64| (k * 0.618_034 * std::f64::consts::TAU).sin();
        assert_eq!(samples(464, |k| 1e-3 * turn(k)).judge(), Recurrence::Open);
        let mut x = 0.3;
        let mut chaos = Samples::new(1);
        for _ in 0..464 {
            x = 3.9 * x * (1.0 - x);
            chaos.push(|row| row[0] = x);
            assert_eq!(chaos.settled(Closeness::FAIR), None);
        }
        assert_eq!(chaos.judge(), Recurrence::Open);
    }

    #[test]
    fn a_split_that_grows_and_slows_down_is_a_drift() {
        // a fixed point that has lost its stability, passed closely, and the 2-cycle beyond
        let sign = |k: f64| if k % 2.0 == 0.0 { 1.0 } else { -1.0 };
        let split = |k: f64| 0.3 * sign(k) / (1.0 + (-(k - 400.0) / 60.0).exp());
        for count in [300, 464, 600] {
            assert_eq!(
                samples(count, split).judge(),
                Recurrence::Drifting,
                "{count}"
            );
        }
        assert_eq!(period(samples(1500, split).judge()), Some(2));
    }

    #[test]
    fn leaving_an_unstable_cycle_is_not_settling() {
        let leaving = |k: f64| 1e-6 * 1.01_f64.powf(k);
        assert_eq!(tight(200, leaving), None);
        assert_eq!(samples(464, leaving).judge(), Recurrence::Drifting);
    }

    /// Alternates between 0 and `old`, and at the last 17 samples, those of the last block of 16 steps, between 0
    /// and `new`.
    fn steps(old: f64, new: f64) -> Samples {
        let width = |k: usize| if k < 23 { old } else { new };
        samples(40, |k| (1.0 - k % 2.0) * width(k as usize))
    }

    #[test]
    fn a_period_is_the_shortest_only_beyond_each_of_its_bounds() {
        // 10 rests of 1/8: a split as wide as that may be what is left of the transient
        assert!(!steps(1.25, 1.25).is_shortest(2, 0.125));
        assert!(steps(1.25, 1.25).is_shortest(2, 0.1249));
        // 0.99 of itself and no more is what is left of a split that is not there to stay
        assert!(!steps(1.0, STAYS).is_shortest(2, 0.0));
        assert!(steps(1.0, 0.991).is_shortest(2, 0.0));
        // either bound alone refuses
        assert!(!steps(1.0, 0.5).is_shortest(2, 0.0));
        assert!(!steps(1.0, 1.0).is_shortest(2, 1.0));
        // and so does one divisor of several: 4 samples that are 2 samples twice
        assert!(!samples(60, |k| k % 2.0).is_shortest(4, 0.0));
        assert!(samples(60, |k| k % 4.0).is_shortest(4, 0.0));
        // what the integration leaves of one cycle does not make two
        assert!(!steps(SAME, SAME).is_shortest(2, 0.0));
        assert!(steps(1.5 * SAME, 1.5 * SAME).is_shortest(2, 0.0));
    }

    #[test]
    fn a_narrow_split_must_have_stayed_for_as_long_as_is_remembered() {
        // half a percent in a block of 16, as a multiplier of -0.9997 leaves, and 7 % since the first one
        let narrowing = |width: f64| {
            let sign = |k: f64| if k % 2.0 == 0.0 { 0.5 } else { -0.5 };
            samples(256, move |k| sign(k) * width * 0.9997_f64.powf(k - 255.0))
        };
        assert!(!narrowing(0.95 * WIDE).is_shortest(2, 0.0));
        assert!(narrowing(1.05 * WIDE).is_shortest(2, 0.0));
        let split = |width: f64| samples(200, |k| width * (k % 2.0)).settled(Closeness::TIGHT);
        assert!(
            split(1.01 * WIDE).is_some_and(|found| found.is_sure() && found.split == 1.01 * WIDE)
        );
        assert!(split(WIDE).is_some_and(|found| !found.is_sure()));
        assert!(tight(200, |_| 1.0).is_some());
    }

    #[test]
    fn the_slow_double_return_of_a_negative_multiplier_is_no_doubled_period() {
        // a 6-cycle with a multiplier of -0.999: after 12 periods it is back within 1e-9 while still 1e-6 from itself
        let place = |k: f64| ((k as usize % 6) as f64 * 0.7).sin();
        for left in [1e-5, 1e-6, 1e-7] {
            let near = |k: f64| place(k) + left * (-0.999_f64).powi(k as i32 / 6);
            for count in (60..700).step_by(8) {
                let found = samples(count, near);
                let name = found.settled(Closeness::TIGHT).map(|found| found.period);
                assert!(matches!(name, None | Some(6)), "{left} {count}: {name:?}");
                assert_ne!(period(found.judge()), Some(12), "{left} {count}");
            }
        }
    }

    #[test]
    fn a_slow_spiral_onto_a_cycle_is_no_cycle_of_seven_turns() {
        // a 2-cycle whose multipliers turn by nearly a seventh: samples come back best after 14 periods
        let spiral = |k: f64| {
            let turns = (k / 2.0).floor();
            k % 2.0 + 1e-8 * 0.9999_f64.powf(turns) * (turns / 7.0 * std::f64::consts::TAU).cos()
        };
        for count in (60..700).step_by(8) {
            assert!(matches!(tight(count, spiral), None | Some(2)), "{count}");
        }
        assert_eq!(period(samples(464, spiral).judge()), Some(2));
    }

    #[test]
    fn a_rest_is_noise_up_to_its_bound_and_a_geometric_series_above() {
        let halves = |last: f64| samples(33, move |k| if k < 32.0 { 0.0 } else { last });
        assert_eq!(halves(NOISE).rest(1), Some((NOISE, NOISE)));
        // nothing moved before, so that nothing shrinks
        assert_eq!(
            halves(1.01 * NOISE).rest(1),
            Some((1.01 * NOISE, f64::INFINITY))
        );
        // halved from block to block: 2^(-1/16) per return
        let shrinking = samples(33, |k| 0.5_f64.powf(k / 16.0));
        let (last, rest) = shrinking.rest(1).unwrap_or_default();
        let ratio = 0.5_f64.powf(1.0 / 16.0);
        assert!(
            (rest - last * ratio / (1.0 - ratio)).abs() < 1e-12 * rest,
            "{last} {rest}"
        );
        assert_eq!(samples(32, |_| 1.0).rest(1), None);
        assert_eq!(samples(36, |_| 1.0).rest(4), Some((0.0, 0.0)));
        assert_eq!(samples(35, |_| 1.0).rest(4), None);
    }

    #[test]
    fn a_drift_is_visible_only_beyond_each_of_its_bounds() {
        // four blocks of 16 samples with one return each, the first number that of the last block
        let blocks = |returns: [f64; 4]| {
            let height =
                move |k: usize| returns[3 - k.saturating_sub(1) / 16] * f64::from(k % 16 == 8);
            samples(65, move |k| height(k as usize))
        };
        let drifts = |returns: [f64; 4]| blocks(returns).drifts_over(1);
        assert!(drifts([0.01, 0.02, 0.03, 0.04]) && drifts([0.04, 0.03, 0.02, 0.01]));
        assert!(!drifts([0.01, 0.02, 0.04, 0.03]) && !drifts([0.04, 0.03, 0.01, 0.02]));
        // a sixteenth times 0.97, and hardly less
        let [whole, part, less] = [1.0, VISIBLE, 0.9999 * VISIBLE].map(|ratio| ratio / 16.0);
        assert!(!drifts([0.01, 0.02, part, whole]) && drifts([0.01, 0.02, less, whole]));
        assert!(!drifts([whole, part, 0.02, 0.01]) && drifts([whole, less, 0.02, 0.01]));
        assert!(drifts([FAR, 0.03, 0.02, 0.01]) && !drifts([1.001 * FAR, 0.03, 0.02, 0.01]));
        // blocks of eight samples, and of seven
        let decay = |count: usize| samples(count, |k| 0.1 * 0.9_f64.powf(k));
        assert!(decay(33).drifts_over(1) && !decay(32).drifts_over(1));
        assert!(samples(18, |k| k / 64.0).creeps(1), "as slow as that");
        assert!(!samples(18, |k| k / 32.0).creeps(1), "too fast");
        assert!(!samples(17, |k| k / 64.0).creeps(1), "too few");
    }
}
