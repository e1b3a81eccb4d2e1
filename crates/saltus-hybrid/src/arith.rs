//! Arithmetic on one number or on eight lanes, in which the series code is written.

use crate::function::{self, Function};
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
    fn div(self, a: Self::V, b: Self::V) -> Self::V;
    /// `x`, or 1 where `active` is 0.
    fn choose(self, active: Self::V, x: Self::V) -> Self::V;
    fn function(self, function: Function, x: Self::V) -> Self::V;
    /// The base of a power as its series takes it, see [`function::positive`].
    fn positive(self, base: Self::V, rate: Self::V) -> Self::V;
    /// A power of such a base.
    fn power(self, base: Self::V, exponent: Self::V) -> Self::V;
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
    #[inline(always)]
    fn div(self, a: f64, b: f64) -> f64 {
        a / b
    }
    #[inline(always)]
    fn choose(self, active: f64, x: f64) -> f64 {
        if active == 0.0 { 1.0 } else { x }
    }
    fn function(self, function: Function, x: f64) -> f64 {
        function.of(x)
    }
    fn positive(self, base: f64, rate: f64) -> f64 {
        function::positive(base, rate)
    }
    fn power(self, base: f64, exponent: f64) -> f64 {
        function::power(base, exponent)
    }
}

/// A number, and a bound on the size of the terms that it is made of.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Bounded {
    pub(crate) value: f64,
    pub(crate) bound: f64,
}

impl Bounded {
    pub(crate) fn new(value: f64) -> Self {
        Self {
            value,
            bound: value.abs(),
        }
    }
}

/// Plain `f64` with bounds beside it: those of a sum add, those of a product multiply, and a function passes its
/// argument's on by its slope.
#[derive(Clone, Copy)]
pub(crate) struct Bounds;

impl Arith for Bounds {
    type Cell = Bounded;
    type V = Bounded;
    const WIDE: bool = false;
    #[inline(always)]
    fn load(self, cell: &Bounded) -> Bounded {
        *cell
    }
    #[inline(always)]
    fn store(self, value: Bounded) -> Bounded {
        value
    }
    #[inline(always)]
    fn splat(self, value: f64) -> Bounded {
        Bounded::new(value)
    }
    #[inline(always)]
    fn add(self, a: Bounded, b: Bounded) -> Bounded {
        Bounded {
            value: a.value + b.value,
            bound: a.bound + b.bound,
        }
    }
    #[inline(always)]
    fn mul(self, a: Bounded, b: Bounded) -> Bounded {
        Bounded {
            value: a.value * b.value,
            bound: a.bound * b.bound,
        }
    }
    #[inline(always)]
    fn mul_add(self, a: Bounded, b: Bounded, c: Bounded) -> Bounded {
        self.add(self.mul(a, b), c)
    }
    fn div(self, a: Bounded, b: Bounded) -> Bounded {
        let value = a.value / b.value;
        Bounded {
            value,
            bound: (a.bound + value.abs() * b.bound) / b.value.abs(),
        }
    }
    fn choose(self, active: Bounded, x: Bounded) -> Bounded {
        if active.value == 0.0 {
            Bounded::new(1.0)
        } else {
            x
        }
    }
    fn function(self, function: Function, x: Bounded) -> Bounded {
        let value = function.of(x.value);
        Bounded {
            value,
            bound: value.abs() + function.slope(x.value).abs() * x.bound,
        }
    }
    fn positive(self, base: Bounded, rate: Bounded) -> Bounded {
        let value = function::positive(base.value, rate.value);
        Bounded {
            value,
            bound: base.bound.max(value),
        }
    }
    fn power(self, base: Bounded, exponent: Bounded) -> Bounded {
        let value = function::power(base.value, exponent.value);
        let slope = (exponent.value * value / base.value).abs();
        Bounded {
            value,
            bound: value.abs() + slope * base.bound,
        }
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
    #[cfg_attr(not(unoptimised), inline(always))]
    fn div(self, a: f64x8<S>, b: f64x8<S>) -> f64x8<S> {
        a / b
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn choose(self, active: f64x8<S>, x: f64x8<S>) -> f64x8<S> {
        let (active, mut x) = (self.store(active), self.store(x));
        for (x, active) in x.0.iter_mut().zip(active.0) {
            *x = if active == 0.0 { 1.0 } else { *x };
        }
        self.load(&x)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn function(self, function: Function, x: f64x8<S>) -> f64x8<S> {
        self.load(&Pack(self.store(x).0.map(|x| function.of(x))))
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn positive(self, base: f64x8<S>, rate: f64x8<S>) -> f64x8<S> {
        let (mut base, rate) = (self.store(base), self.store(rate));
        for (base, rate) in base.0.iter_mut().zip(rate.0) {
            *base = function::positive(*base, rate);
        }
        self.load(&base)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn power(self, base: f64x8<S>, exponent: f64x8<S>) -> f64x8<S> {
        let (mut base, exponent) = (self.store(base), self.store(exponent));
        for (base, exponent) in base.0.iter_mut().zip(exponent.0) {
            *base = function::power(*base, exponent);
        }
        self.load(&base)
    }
}
