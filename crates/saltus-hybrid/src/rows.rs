//! Rows of a matrix times a vector of cells, by fours and the rest.

use crate::arith::Arith;

/// out = matrix times x, rows by fours and the rest; `onto` adds to what is there.
#[inline(always)]
pub(crate) fn block_rows<A: Arith>(
    arith: A,
    weights: &[A::Cell],
    x: &[A::Cell],
    onto: bool,
    out: &mut [A::Cell],
) {
    let mut row = 0;
    while row < out.len() {
        let weights = &weights[row * x.len()..];
        match out.len() - row {
            1 => some_rows::<A, 1>(arith, weights, x, onto, &mut out[row..]),
            2 => some_rows::<A, 2>(arith, weights, x, onto, &mut out[row..]),
            3 => some_rows::<A, 3>(arith, weights, x, onto, &mut out[row..]),
            _ => some_rows::<A, 4>(arith, weights, x, onto, &mut out[row..]),
        }
        row += 4;
    }
}

#[cfg_attr(not(unoptimised), inline(always))]
fn some_rows<A: Arith, const W: usize>(
    arith: A,
    weights: &[A::Cell],
    x: &[A::Cell],
    onto: bool,
    out: &mut [A::Cell],
) {
    let mut sums = [arith.splat(0.0); W];
    if onto {
        for w in 0..W {
            sums[w] = arith.load(&out[w]);
        }
    }
    // Two sums for each row, so that fewer multiply-adds wait for the one before.
    let mut others = [arith.splat(0.0); W];
    let columns = weights[..W * x.len()].as_chunks::<W>().0;
    let (weights, last_weights) = columns.as_chunks::<2>();
    let (x, last_x) = x.as_chunks::<2>();
    for (weights, x) in weights.iter().zip(x) {
        let (even, odd) = (arith.load(&x[0]), arith.load(&x[1]));
        for w in 0..W {
            sums[w] = arith.mul_add(arith.load(&weights[0][w]), even, sums[w]);
            others[w] = arith.mul_add(arith.load(&weights[1][w]), odd, others[w]);
        }
    }
    for (weights, x) in last_weights.iter().zip(last_x) {
        let x = arith.load(x);
        for w in 0..W {
            sums[w] = arith.mul_add(arith.load(&weights[w]), x, sums[w]);
        }
    }
    for w in 0..W {
        out[w] = arith.store(arith.add(sums[w], others[w]));
    }
}
