//! Taylor coefficients of every node, order by order (automatic differentiation in time).
//!
//! With node(t0 + s) = sum_k node[k] s^k: a sum is a sum in each order, a product is the Cauchy
//! product, and x' = node gives x[k+1] = node[k]/(k+1). See Jorba & Zou, Experiment. Math. 14 (2005).

use crate::arith::{Arith, Scalar};
use crate::system::{Op, Structure};

/// Node-major storage: coefficient k of node n is at n * stride + k.
#[inline(always)]
fn operation<A: Arith>(
    arith: A,
    structure: &Structure,
    coefficients: &[A::Cell],
    series: &mut [A::Cell],
    stride: usize,
    k: usize,
    index: usize,
) {
    // Two sums in each case, so that consecutive multiply-adds do not wait for each other.
    let value = match &structure.ops[index] {
        Op::Linear { constant, terms } => {
            let nodes = &structure.terms[terms.0..terms.1];
            let weights = &coefficients[*constant..=*constant + nodes.len()];
            let term = |&c: &A::Cell, &node: &usize, sum| {
                arith.mul_add(arith.load(&c), arith.load(&series[node * stride + k]), sum)
            };
            let (mut even, mut odd) = (arith.splat(0.0), arith.splat(0.0));
            if k == 0 {
                even = arith.load(&weights[0]);
            }
            let mut weights = weights[1..].chunks_exact(2);
            let mut nodes = nodes.chunks_exact(2);
            for (c, node) in (&mut weights).zip(&mut nodes) {
                even = term(&c[0], &node[0], even);
                odd = term(&c[1], &node[1], odd);
            }
            if let ([c], [node]) = (weights.remainder(), nodes.remainder()) {
                even = term(c, node, even);
            }
            arith.add(even, odd)
        }
        Op::Dot { pairs } => {
            let (mut even, mut odd) = (arith.splat(0.0), arith.splat(0.0));
            for &(a, b) in &structure.pairs[pairs.0..pairs.1] {
                let a = &series[a * stride..a * stride + k + 1];
                let b = &series[b * stride..b * stride + k + 1];
                let mut forward = a.chunks_exact(2);
                let mut backward = b.rchunks_exact(2);
                for (a, b) in (&mut forward).zip(&mut backward) {
                    even = arith.mul_add(arith.load(&a[0]), arith.load(&b[1]), even);
                    odd = arith.mul_add(arith.load(&a[1]), arith.load(&b[0]), odd);
                }
                if let ([a], [b]) = (forward.remainder(), backward.remainder()) {
                    even = arith.mul_add(arith.load(a), arith.load(b), even);
                }
            }
            arith.add(even, odd)
        }
    };
    series[(structure.states + index) * stride + k] = arith.store(value);
}

/// Fills orders 1..=order of all states, and of the guards, from order 0 of the states.
#[inline(always)]
pub(crate) fn expand<A: Arith>(
    arith: A,
    structure: &Structure,
    coefficients: &[A::Cell],
    series: &mut [A::Cell],
    order: usize,
) {
    let stride = order + 1;
    for k in 0..order {
        for index in 0..structure.ops.len() {
            operation(arith, structure, coefficients, series, stride, k, index);
        }
        let factor = arith.splat(1.0 / (k + 1) as f64);
        for (state, &node) in structure.derivative.iter().enumerate() {
            let rate = arith.load(&series[node * stride + k]);
            series[state * stride + k + 1] = arith.store(arith.mul(rate, factor));
        }
    }
    for &index in &structure.guard_ops {
        operation(arith, structure, coefficients, series, stride, order, index);
    }
}

/// Values of all operations, given those of the states.
pub(crate) fn values(structure: &Structure, coefficients: &[f64], nodes: &mut [f64]) {
    for index in 0..structure.ops.len() {
        operation(Scalar, structure, coefficients, nodes, 1, 0, index);
    }
}
