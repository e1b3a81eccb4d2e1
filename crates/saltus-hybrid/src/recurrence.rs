//! Recurrences of quotients, powers and elementary functions: order k from the orders below.
//!
//! Each comes from a linear differential equation that the function obeys (Jorba & Zou, Experiment. Math. 14 (2005),
//! section 2.1): q b = a, u p' = alpha p u', and y' = g u'. Where `active` is 0 they go on as for 0/1, a power of 1, or
//! a function of 1, all constant.

use crate::arith::Arith;
use crate::cauchy::Orders;
use crate::function::Function;

/// Order k of a/b from order k of a: q_k = (a_k - sum over j from 1 to k of b_j q_{k-j}) / b_0.
#[inline(always)]
pub(crate) fn quotient<A: Arith>(
    arith: A,
    orders: Orders<'_, A::Cell>,
    active: &A::Cell,
    dividend: &A::Cell,
    [divisor, own]: [usize; 2],
    k: usize,
) -> A::Cell {
    let active = arith.load(active);
    let mut sum = arith.splat(0.0);
    for j in 1..=k {
        let (b, q) = (
            orders.load(arith, j, divisor),
            orders.load(arith, k - j, own),
        );
        sum = arith.mul_add(b, q, sum);
    }
    let rest = arith.mul_add(arith.splat(-1.0), sum, arith.load(dividend));
    let first = arith.choose(active, orders.load(arith, 0, divisor));
    arith.store(arith.div(arith.mul(active, rest), first))
}

/// Order k of u to the power alpha: p_k = sum over j from 1 to k of (alpha j - (k - j)) u_j p_{k-j} / (k u_0).
#[inline(always)]
pub(crate) fn power<A: Arith>(
    arith: A,
    orders: Orders<'_, A::Cell>,
    active: &A::Cell,
    exponent: &A::Cell,
    [base, own]: [usize; 2],
    k: usize,
) -> A::Cell {
    let (active, exponent) = (arith.load(active), arith.load(exponent));
    let first = arith.choose(active, orders.load(arith, 0, base));
    if k == 0 {
        let first = arith.positive(first, arith.splat(0.0));
        return arith.store(arith.power(first, exponent));
    }
    let first = arith.positive(first, arith.mul(active, orders.load(arith, 1, base)));
    let mut sum = arith.splat(0.0);
    for j in 1..=k {
        let left = arith.splat(-((k - j) as f64));
        let weight = arith.mul_add(exponent, arith.splat(j as f64), left);
        let (u, p) = (orders.load(arith, j, base), orders.load(arith, k - j, own));
        sum = arith.mul_add(arith.mul(weight, u), p, sum);
    }
    let sum = arith.mul(active, sum);
    arith.store(arith.div(sum, arith.mul(arith.splat(k as f64), first)))
}

/// Order k of y = F(u), whose rate is g u' or minus that: y_k = sum over j from 1 to k of j u_j g_{k-j} / k.
#[inline(always)]
pub(crate) fn function<A: Arith>(
    arith: A,
    orders: Orders<'_, A::Cell>,
    active: &A::Cell,
    (function, minus): (Function, bool),
    [u, g]: [usize; 2],
    k: usize,
) -> A::Cell {
    let active = arith.load(active);
    if k == 0 {
        let u = arith.choose(active, orders.load(arith, 0, u));
        return arith.store(arith.function(function, u));
    }
    let mut sum = arith.splat(0.0);
    for j in 1..=k {
        let weighted = arith.mul(arith.splat(j as f64), orders.load(arith, j, u));
        sum = arith.mul_add(weighted, orders.load(arith, k - j, g), sum);
    }
    let part = 1.0 / k as f64;
    arith.store(arith.mul(
        arith.mul(active, sum),
        arith.splat(if minus { -part } else { part }),
    ))
}
