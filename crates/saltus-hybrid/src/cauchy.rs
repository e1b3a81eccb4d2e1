//! Cauchy products: order k of a b is the sum of a[i] b[k - i].
//!
//! This is where the time goes. Factors lie side by side in each order, so one pass over the orders
//! serves up to eight products, and no multiply-add waits for the one before.

use crate::arith::Arith;

/// Coefficients of all kept nodes, `stride` cells to an order.
#[derive(Clone, Copy)]
pub(crate) struct Orders<'a, C> {
    pub(crate) cells: &'a [C],
    pub(crate) stride: usize,
}

impl<'a, C> Orders<'a, C> {
    /// W neighbours at order `k`.
    #[inline(always)]
    fn at<const W: usize>(&self, k: usize, slot: usize) -> &'a [C; W] {
        self.cells[k * self.stride + slot..]
            .first_chunk()
            .expect("slots of a block lie within an order")
    }

    /// A slot at order `k`.
    #[inline(always)]
    pub(crate) fn load<A: Arith<Cell = C>>(&self, arith: A, k: usize, slot: usize) -> A::V {
        arith.load(&self.cells[k * self.stride + slot])
    }
}

/// Calls `$f::<A, W>` for the blocks of width W that make up `$count` neighbours; `$at` is where each
/// begins.
macro_rules! in_blocks {
    ($count:expr, $at:ident => $f:ident($($argument:expr),*)) => {
        let count = $count;
        let mut $at = 0;
        while count - $at >= 8 {
            $f::<A, 8>($($argument),*);
            $at += 8;
        }
        if count & 4 > 0 {
            $f::<A, 4>($($argument),*);
            $at += 4;
        }
        if count & 2 > 0 {
            $f::<A, 2>($($argument),*);
            $at += 2;
        }
        if count & 1 > 0 {
            $f::<A, 1>($($argument),*);
        }
    };
}

/// Order k of the products of neighbours from slot `a` on with those from slot `b` on.
#[inline(always)]
pub(crate) fn products<A: Arith>(
    arith: A,
    orders: Orders<'_, A::Cell>,
    [a, b]: [usize; 2],
    k: usize,
    out: &mut [A::Cell],
) {
    in_blocks!(out.len(), at => product_block(arith, orders, [a + at, b + at], k, &mut out[at..]));
}

#[cfg_attr(not(unoptimised), inline(always))]
fn product_block<A: Arith, const W: usize>(
    arith: A,
    orders: Orders<'_, A::Cell>,
    [a, b]: [usize; 2],
    k: usize,
    out: &mut [A::Cell],
) {
    let mut sums = [arith.splat(0.0); W];
    for i in 0..=k {
        let (a, b) = (orders.at::<W>(i, a), orders.at::<W>(k - i, b));
        for w in 0..W {
            sums[w] = arith.mul_add(arith.load(&a[w]), arith.load(&b[w]), sums[w]);
        }
    }
    for (out, sum) in out.iter_mut().zip(sums) {
        *out = arith.store(sum);
    }
}

/// Order k of the squares of neighbours from slot `a` on: twice the sum over half the terms, and the
/// middle one.
#[inline(always)]
pub(crate) fn squares<A: Arith>(
    arith: A,
    orders: Orders<'_, A::Cell>,
    a: usize,
    k: usize,
    out: &mut [A::Cell],
) {
    in_blocks!(out.len(), at => square_block(arith, orders, a + at, k, &mut out[at..]));
}

#[cfg_attr(not(unoptimised), inline(always))]
fn square_block<A: Arith, const W: usize>(
    arith: A,
    orders: Orders<'_, A::Cell>,
    slot: usize,
    k: usize,
    out: &mut [A::Cell],
) {
    let mut sums = [arith.splat(0.0); W];
    for i in 0..k.div_ceil(2) {
        let (a, b) = (orders.at::<W>(i, slot), orders.at::<W>(k - i, slot));
        for w in 0..W {
            sums[w] = arith.mul_add(arith.load(&a[w]), arith.load(&b[w]), sums[w]);
        }
    }
    for sum in &mut sums {
        *sum = arith.add(*sum, *sum);
    }
    if k.is_multiple_of(2) {
        let middle = orders.at::<W>(k / 2, slot);
        for w in 0..W {
            let middle = arith.load(&middle[w]);
            sums[w] = arith.mul_add(middle, middle, sums[w]);
        }
    }
    for (out, sum) in out.iter_mut().zip(sums) {
        *out = arith.store(sum);
    }
}

/// Order k of the squares of neighbours from slot `y` on, and of their products with those from slot
/// `t` on as far as orders below k of these go: with the squares known, the caller finds order k of t
/// and adds y[0] t[k]. Each coefficient is loaded once for three multiply-adds in all.
#[inline(always)]
pub(crate) fn squares_and_products<A: Arith>(
    arith: A,
    orders: Orders<'_, A::Cell>,
    [y, t]: [usize; 2],
    k: usize,
    squares: &mut [A::Cell],
    products: &mut [A::Cell],
) {
    in_blocks!(squares.len(), at => square_and_product_block(
        arith,
        orders,
        [y + at, t + at],
        k,
        &mut squares[at..],
        &mut products[at..]
    ));
}

#[cfg_attr(not(unoptimised), inline(always))]
fn square_and_product_block<A: Arith, const W: usize>(
    arith: A,
    orders: Orders<'_, A::Cell>,
    [y, t]: [usize; 2],
    k: usize,
    squares: &mut [A::Cell],
    products: &mut [A::Cell],
) {
    let mut square = [arith.splat(0.0); W];
    let mut product = [arith.splat(0.0); W];
    for i in 1..k.div_ceil(2) {
        let (yi, yj) = (orders.at::<W>(i, y), orders.at::<W>(k - i, y));
        let (ti, tj) = (orders.at::<W>(i, t), orders.at::<W>(k - i, t));
        for w in 0..W {
            let (yi, yj) = (arith.load(&yi[w]), arith.load(&yj[w]));
            square[w] = arith.mul_add(yi, yj, square[w]);
            product[w] = arith.mul_add(arith.load(&tj[w]), yi, product[w]);
            product[w] = arith.mul_add(arith.load(&ti[w]), yj, product[w]);
        }
    }
    for square in &mut square {
        *square = arith.add(*square, *square);
    }
    if k.is_multiple_of(2) && k > 0 {
        let (middle, t) = (orders.at::<W>(k / 2, y), orders.at::<W>(k / 2, t));
        for w in 0..W {
            let middle = arith.load(&middle[w]);
            square[w] = arith.mul_add(middle, middle, square[w]);
            product[w] = arith.mul_add(arith.load(&t[w]), middle, product[w]);
        }
    }
    // Order k of y has just been computed: what needs it comes last.
    let (y0, yk) = (orders.at::<W>(0, y), orders.at::<W>(k, y));
    if k == 0 {
        for w in 0..W {
            let y = arith.load(&y0[w]);
            square[w] = arith.mul(y, y);
        }
    } else {
        let t0 = orders.at::<W>(0, t);
        for w in 0..W {
            let (y0, yk) = (arith.load(&y0[w]), arith.load(&yk[w]));
            square[w] = arith.mul_add(arith.add(y0, y0), yk, square[w]);
            product[w] = arith.mul_add(arith.load(&t0[w]), yk, product[w]);
        }
    }
    for w in 0..W {
        squares[w] = arith.store(square[w]);
        products[w] = arith.store(product[w]);
    }
}
