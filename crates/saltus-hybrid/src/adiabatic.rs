//! Fast linear oscillators that follow the rest of the system, without being integrated.
//!
//! Let x solve K x + c M x' + M x'' = -q with frequencies far above those of q. Then x is, but for
//! free oscillations that nothing excites, the series
//!
//! ```text
//! x = -K^-1 q + K^-1 M K^-1 (D^2 + c D) q - ...        D = d/dt,
//! ```
//!
//! an asymptotic one, whose terms fall by the squared ratio of the frequencies. Its first term is an
//! ordinary sum; the others need derivatives of q along the very solution that x takes part in. A
//! Taylor series has these: it is computed without them, then again with the derivatives of the last
//! round, once for each term. The derivatives that a series of finite order lacks at its end matter
//! as little as the terms that it omits.

use crate::arith::Arith;
use crate::rows::block_rows;
use crate::structure::Adiabatic;

impl Adiabatic {
    /// Sets x to zero in all orders: the first round.
    #[inline(always)]
    pub(crate) fn clear<C: Copy + Default>(&self, kept: &mut [C], stride: usize) {
        for row in kept.chunks_exact_mut(stride) {
            row[self.out..self.out + self.count].fill(C::default());
        }
    }

    /// The first `terms` terms of x from q of the last round, known below `order`.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)]
    pub(crate) fn update<A: Arith>(
        &self,
        arith: A,
        stream: &[A::Cell],
        kept: &mut [A::Cell],
        stride: usize,
        scratch: &mut [A::Cell],
        order: usize,
        terms: usize,
    ) {
        let n = self.sources;
        let damping = arith.load(&stream[self.damping]);
        let (mut from, mut to) = scratch.split_at_mut((order + 1) * n);
        for (round, &response) in self.responses[..terms].iter().enumerate() {
            let known = order.saturating_sub(2 * (round + 1));
            let weights = &stream[response..][..self.count * n];
            for k in 0..known {
                let first = arith.mul(damping, arith.splat((k + 1) as f64));
                let second = arith.splat(((k + 1) * (k + 2)) as f64);
                let at = |k: usize| match round {
                    0 => &kept[k * stride + self.source..][..n],
                    _ => &from[k * n..][..n],
                };
                let (a, b) = (at(k + 1), at(k + 2));
                let next = &mut to[k * n..][..n];
                for i in 0..n {
                    let sum = arith.mul(second, arith.load(&b[i]));
                    next[i] = arith.store(arith.mul_add(first, arith.load(&a[i]), sum));
                }
                let out = &mut kept[k * stride + self.out..][..self.count];
                block_rows(arith, weights, next, round > 0, out);
            }
            if round == 0 {
                self.clear(&mut kept[known * stride..], stride);
            }
            std::mem::swap(&mut from, &mut to);
        }
    }
}
