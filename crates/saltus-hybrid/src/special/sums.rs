//! The sums that written-out code is made of.

use crate::arith::Arith;

/// c[i] x + sum.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn term<A: Arith, const N: usize>(
    arith: A,
    stream: &[A::Cell; N],
    i: usize,
    x: A::V,
    sum: A::V,
) -> A::V {
    arith.mul_add(arith.load(&stream[i]), x, sum)
}

/// Sums of `cauchy::squares_and_products` for W neighbours from slot Y and T on: `past` are the orders
/// below the one in hand.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn squares_and_products<
    A: Arith,
    const S: usize,
    const W: usize,
    const Y: usize,
    const T: usize,
>(
    arith: A,
    past: &[[A::Cell; S]],
    row: &[A::Cell; S],
) -> ([A::V; W], [A::V; W]) {
    let mut square = [arith.splat(0.0); W];
    let mut product = [arith.splat(0.0); W];
    let k = past.len();
    if let [zero, later @ ..] = past {
        for (i, j) in later.iter().zip(later.iter().rev()).take((k - 1) / 2) {
            for w in 0..W {
                let (yi, yj) = (arith.load(&i[Y + w]), arith.load(&j[Y + w]));
                square[w] = arith.mul_add(yi, yj, square[w]);
                product[w] = arith.mul_add(arith.load(&j[T + w]), yi, product[w]);
                product[w] = arith.mul_add(arith.load(&i[T + w]), yj, product[w]);
            }
        }
        for square in &mut square {
            *square = arith.add(*square, *square);
        }
        if k.is_multiple_of(2) {
            let middle = &past[k / 2];
            for w in 0..W {
                let y = arith.load(&middle[Y + w]);
                square[w] = arith.mul_add(y, y, square[w]);
                product[w] = arith.mul_add(arith.load(&middle[T + w]), y, product[w]);
            }
        }
        for w in 0..W {
            let (y0, yk) = (arith.load(&zero[Y + w]), arith.load(&row[Y + w]));
            square[w] = arith.mul_add(arith.add(y0, y0), yk, square[w]);
            product[w] = arith.mul_add(arith.load(&zero[T + w]), yk, product[w]);
        }
    } else {
        for w in 0..W {
            let y = arith.load(&row[Y + w]);
            square[w] = arith.mul(y, y);
        }
    }
    (square, product)
}

/// Sums of `cauchy::products` for W neighbours from slot F and from slot G on.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn products<A: Arith, const S: usize, const W: usize, const F: usize, const G: usize>(
    arith: A,
    past: &[[A::Cell; S]],
    row: &[A::Cell; S],
) -> [A::V; W] {
    let mut sums = [arith.splat(0.0); W];
    let first = past.first().unwrap_or(row);
    for w in 0..W {
        sums[w] = arith.mul_add(arith.load(&first[F + w]), arith.load(&row[G + w]), sums[w]);
    }
    if let [_, later @ ..] = past {
        for (f, g) in later.iter().zip(later.iter().rev()) {
            for w in 0..W {
                sums[w] = arith.mul_add(arith.load(&f[F + w]), arith.load(&g[G + w]), sums[w]);
            }
        }
        for w in 0..W {
            sums[w] = arith.mul_add(arith.load(&row[F + w]), arith.load(&first[G + w]), sums[w]);
        }
    }
    sums
}
