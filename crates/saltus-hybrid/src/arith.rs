//! Arithmetic on one number or on eight lanes, in which the series code is written.

use fearless_simd::{Simd, SimdBase, SimdFloat, f64x8};

/// Lanes of one vector register.
pub(crate) const LANES: usize = 8;

/// Eight lanes in memory, aligned for the widest register.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
pub(crate) struct Pack(pub(crate) [f64; LANES]);

/// Arithmetic on values `V` kept in memory as `Cell`.
pub(crate) trait Arith: Copy {
    /// A number as stored.
    type Cell: Copy + Default;
    /// A number as computed with.
    type V: Copy;
    /// Whether straight-line code pays: eight lanes in one or two registers.
    const WIDE: bool;
    fn load(self, cell: &Self::Cell) -> Self::V;
    fn store(self, value: Self::V) -> Self::Cell;
    fn splat(self, value: f64) -> Self::V;
    fn add(self, a: Self::V, b: Self::V) -> Self::V;
    fn mul(self, a: Self::V, b: Self::V) -> Self::V;
    /// a b + c, in one rounding where the machine has it.
    fn mul_add(self, a: Self::V, b: Self::V, c: Self::V) -> Self::V;
}

/// Plain `f64`.
#[derive(Clone, Copy)]
pub(crate) struct Scalar;

impl Arith for Scalar {
    type Cell = f64;
    type V = f64;
    const WIDE: bool = false;
    #[inline(always)]
    fn load(self, cell: &f64) -> f64 {
        *cell
    }
    #[inline(always)]
    fn store(self, value: f64) -> f64 {
        value
    }
    #[inline(always)]
    fn splat(self, value: f64) -> f64 {
        value
    }
    #[inline(always)]
    fn add(self, a: f64, b: f64) -> f64 {
        a + b
    }
    #[inline(always)]
    fn mul(self, a: f64, b: f64) -> f64 {
        a * b
    }
    #[inline(always)]
    fn mul_add(self, a: f64, b: f64, c: f64) -> f64 {
        // Not `f64::mul_add`: without the instruction it is a slow call.
        a * b + c
    }
}

/// Eight lanes at the instruction set of `S`.
#[derive(Clone, Copy)]
pub(crate) struct Wide<S: Simd>(pub(crate) S);

impl<S: Simd> Arith for Wide<S> {
    type Cell = Pack;
    type V = f64x8<S>;
    const WIDE: bool = size_of::<S::f64s>() >= 32;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn load(self, cell: &Pack) -> f64x8<S> {
        f64x8::load_array_ref(self.0, &cell.0)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn store(self, value: f64x8<S>) -> Pack {
        let mut out = Pack::default();
        value.store_slice(&mut out.0);
        out
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn splat(self, value: f64) -> f64x8<S> {
        f64x8::splat(self.0, value)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn add(self, a: f64x8<S>, b: f64x8<S>) -> f64x8<S> {
        a + b
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn mul(self, a: f64x8<S>, b: f64x8<S>) -> f64x8<S> {
        a * b
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn mul_add(self, a: f64x8<S>, b: f64x8<S>, c: f64x8<S>) -> f64x8<S> {
        a.mul_add(b, c)
    }
}
