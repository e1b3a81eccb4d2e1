//! The most multiply-adds this core does in a second: the limit of any kernel.

use fearless_simd::{Level, Simd, SimdBase, SimdFloat, dispatch, f64x8};

use crate::clock::Clock;

/// Independent chains, enough to hide the latency of four cycles on two units.
const CHAINS: usize = 12;
const ROUNDS: usize = 20_000_000;

#[inline(always)]
fn chains<S: Simd>(simd: S, rounds: usize) -> f64 {
    let factor = f64x8::splat(simd, std::hint::black_box(0.999_999));
    let term = f64x8::splat(simd, std::hint::black_box(1e-6));
    let mut sums: [f64x8<S>; CHAINS] = std::array::from_fn(|i| f64x8::splat(simd, 1.0 + i as f64));
    for _ in 0..rounds {
        for sum in &mut sums {
            *sum = sum.mul_add(factor, term);
        }
    }
    let mut out = [0.0; 8];
    let total = sums.into_iter().reduce(|a, b| a + b).expect("some chains");
    total.store_slice(&mut out);
    out.iter().sum()
}

/// GFlop/s in f64, eight lanes, a multiply-add counted as two.
pub fn gflops() -> f64 {
    let level = Level::new();
    let mut best: f64 = 0.0;
    for _ in 0..3 {
        let clock = Clock::start();
        std::hint::black_box(dispatch!(level, simd => chains(simd, ROUNDS)));
        let work = (ROUNDS * CHAINS * 8 * 2) as f64;
        best = best.max(work / clock.seconds() / 1e9);
    }
    best
}
