//! Taylor coefficients of every node, order by order (automatic differentiation in time).
//!
//! With node(t0 + s) = sum_k node[k] s^k: a sum is a sum in each order, a product is the Cauchy
//! product, and x' = node gives x[k+1] = node[k]/(k+1). See Jorba & Zou, Experiment. Math. 14 (2005).

use crate::arith::{Arith, Scalar};
use crate::compile::{Op, Structure};

/// Taylor coefficients of all nodes of a program, and second factors of products once more in
/// reverse, so that a Cauchy product runs forward through both.
#[derive(Clone, Debug, Default)]
pub(crate) struct Series<C> {
    order: usize,
    /// Coefficient k of node n is at n * (order + 1) + k.
    forward: Vec<C>,
    /// Coefficient k of mirror m is at (m + 1) * (order + 1) - 1 - k.
    mirror: Vec<C>,
}

impl Series<f64> {
    /// Value and first derivative of a node, of a series of order 1.
    pub(crate) fn pair(&self, node: usize) -> &[f64; 2] {
        &self.forward.as_chunks::<2>().0[node]
    }
}

impl<C: Copy + Default> Series<C> {
    pub(crate) fn new(structure: &Structure, order: usize) -> Self {
        Self {
            order,
            forward: vec![C::default(); structure.nodes * (order + 1)],
            mirror: vec![C::default(); structure.mirrors.len() * (order + 1)],
        }
    }

    /// All coefficients of a node.
    #[inline(always)]
    pub(crate) fn of(&self, node: usize) -> &[C] {
        &self.forward[node * (self.order + 1)..(node + 1) * (self.order + 1)]
    }

    /// All coefficients of a node.
    #[inline(always)]
    pub(crate) fn of_mut(&mut self, node: usize) -> &mut [C] {
        &mut self.forward[node * (self.order + 1)..(node + 1) * (self.order + 1)]
    }

    /// Its value at the point of expansion.
    #[inline(always)]
    pub(crate) fn value(&mut self, node: usize) -> &mut C {
        &mut self.forward[node * (self.order + 1)]
    }

    /// All coefficients of all nodes; of a series of order 0, their values.
    pub(crate) fn all(&self) -> &[C] {
        &self.forward
    }

    /// Every stored coefficient, to be cleared.
    pub(crate) fn cells(&mut self) -> impl Iterator<Item = &mut C> {
        self.forward.iter_mut().chain(&mut self.mirror)
    }

    #[inline(always)]
    fn get(&self, node: usize, k: usize) -> &C {
        &self.forward[node * (self.order + 1) + k]
    }

    #[inline(always)]
    fn set(&mut self, node: usize, k: usize, value: C) {
        self.forward[node * (self.order + 1) + k] = value;
    }

    #[inline(always)]
    fn reflect(&mut self, mirror: usize, node: usize, k: usize) {
        self.mirror[(mirror + 1) * (self.order + 1) - 1 - k] = *self.get(node, k);
    }

    /// The first k + 1 coefficients of a node, and those of a mirror in reverse.
    #[inline(always)]
    fn factors(&self, (node, mirror): (usize, usize), k: usize) -> (&[C], &[C]) {
        let stride = self.order + 1;
        (
            &self.forward[node * stride..][..k + 1],
            &self.mirror[mirror * stride + self.order - k..][..k + 1],
        )
    }
}

/// Order k of four products at once: four sums, so that no multiply-add waits for the one before.
#[inline(always)]
fn four_products<A: Arith>(
    arith: A,
    series: &Series<A::Cell>,
    pairs: &[(usize, usize); 4],
    k: usize,
) -> [A::V; 4] {
    let [(a0, b0), (a1, b1), (a2, b2), (a3, b3)] = pairs.map(|pair| series.factors(pair, k));
    let [mut s0, mut s1, mut s2, mut s3] = [arith.splat(0.0); 4];
    let first = a0.iter().zip(b0).zip(a1.iter().zip(b1));
    let second = a2.iter().zip(b2).zip(a3.iter().zip(b3));
    for (((a0, b0), (a1, b1)), ((a2, b2), (a3, b3))) in first.zip(second) {
        s0 = arith.mul_add(arith.load(a0), arith.load(b0), s0);
        s1 = arith.mul_add(arith.load(a1), arith.load(b1), s1);
        s2 = arith.mul_add(arith.load(a2), arith.load(b2), s2);
        s3 = arith.mul_add(arith.load(a3), arith.load(b3), s3);
    }
    [s0, s1, s2, s3]
}

/// Order k of one product.
#[inline(always)]
fn product<A: Arith>(arith: A, series: &Series<A::Cell>, pair: (usize, usize), k: usize) -> A::V {
    let (a, b) = series.factors(pair, k);
    let mut sum = arith.splat(0.0);
    for (a, b) in a.iter().zip(b) {
        sum = arith.mul_add(arith.load(a), arith.load(b), sum);
    }
    sum
}

/// Two nodes to multiply.
type Pair = (usize, usize);

/// Splits a list of pairs into fours and the rest.
#[inline(always)]
fn fours(pairs: &[Pair]) -> (&[[Pair; 4]], &[Pair]) {
    pairs.as_chunks::<4>()
}

/// Order k of four rows of a matrix at once: each node is loaded for four multiply-adds.
#[inline(always)]
fn four_rows<A: Arith>(
    arith: A,
    series: &Series<A::Cell>,
    rows: &[A::Cell],
    nodes: &[usize],
    k: usize,
) -> [A::V; 4] {
    let n = nodes.len();
    let (first, second) = rows.split_at(2 * n);
    let ((c0, c1), (c2, c3)) = (first.split_at(n), second.split_at(n));
    let [mut s0, mut s1, mut s2, mut s3] = [arith.splat(0.0); 4];
    let weights = c0.iter().zip(c1).zip(c2.iter().zip(c3));
    for (((c0, c1), (c2, c3)), &node) in weights.zip(nodes) {
        let x = arith.load(series.get(node, k));
        s0 = arith.mul_add(arith.load(c0), x, s0);
        s1 = arith.mul_add(arith.load(c1), x, s1);
        s2 = arith.mul_add(arith.load(c2), x, s2);
        s3 = arith.mul_add(arith.load(c3), x, s3);
    }
    [s0, s1, s2, s3]
}

/// Order k of operation `index`.
#[inline(always)]
fn operation<A: Arith>(
    arith: A,
    structure: &Structure,
    coefficients: &[A::Cell],
    series: &mut Series<A::Cell>,
    k: usize,
    index: usize,
) {
    match &structure.ops[index] {
        Op::Linear {
            out,
            constant,
            terms,
        } => {
            let nodes = &structure.terms[terms.0..terms.1];
            let weights = &coefficients[*constant..][..nodes.len() + 1];
            let term = |c: &A::Cell, node: usize, sum| {
                arith.mul_add(arith.load(c), arith.load(series.get(node, k)), sum)
            };
            let (mut even, mut odd) = (arith.splat(0.0), arith.splat(0.0));
            if k == 0 {
                even = arith.load(&weights[0]);
            }
            let (weights, last_weight) = weights[1..].as_chunks::<2>();
            let (nodes, last_node) = nodes.as_chunks::<2>();
            for (c, node) in weights.iter().zip(nodes) {
                even = term(&c[0], node[0], even);
                odd = term(&c[1], node[1], odd);
            }
            if let ([c], [node]) = (last_weight, last_node) {
                even = term(c, *node, even);
            }
            series.set(*out, k, arith.store(arith.add(even, odd)));
        }
        Op::Matrix {
            out,
            weights,
            nodes,
        } => {
            let nodes = &structure.terms[nodes.0..nodes.1];
            let weights = &coefficients[weights.0..weights.1];
            let n = nodes.len();
            let fours = weights.chunks_exact(4 * n);
            let rest = fours.remainder();
            let mut out = *out;
            for four in fours {
                for value in four_rows(arith, series, four, nodes, k) {
                    series.set(out, k, arith.store(value));
                    out += 1;
                }
            }
            for row in rest.chunks_exact(n) {
                let mut sum = arith.splat(0.0);
                for (c, &node) in row.iter().zip(nodes) {
                    sum = arith.mul_add(arith.load(c), arith.load(series.get(node, k)), sum);
                }
                series.set(out, k, arith.store(sum));
                out += 1;
            }
        }
        Op::Dot { out, pairs } => {
            let (fours, rest) = fours(&structure.pairs[pairs.0..pairs.1]);
            let mut sum = arith.splat(0.0);
            for four in fours {
                let [a, b, c, d] = four_products(arith, series, four, k);
                sum = arith.add(sum, arith.add(arith.add(a, b), arith.add(c, d)));
            }
            for &pair in rest {
                sum = arith.add(sum, product(arith, series, pair, k));
            }
            series.set(*out, k, arith.store(sum));
        }
        Op::Products { out, pairs } => {
            let (fours, rest) = fours(&structure.pairs[pairs.0..pairs.1]);
            for (i, four) in fours.iter().enumerate() {
                let values = four_products(arith, series, four, k);
                for (j, value) in values.into_iter().enumerate() {
                    series.set(out + 4 * i + j, k, arith.store(value));
                }
            }
            for (i, &pair) in rest.iter().enumerate() {
                let value = product(arith, series, pair, k);
                series.set(out + 4 * fours.len() + i, k, arith.store(value));
            }
        }
        Op::Mirror { mirror, node } => series.reflect(*mirror, *node, k),
    }
}

/// Fills orders 1..=order of all states, and of the guards, from order 0 of the states.
#[inline(always)]
pub(crate) fn expand<A: Arith>(
    arith: A,
    structure: &Structure,
    coefficients: &[A::Cell],
    series: &mut Series<A::Cell>,
) {
    let order = series.order;
    for k in 0..order {
        for index in 0..structure.ops.len() {
            operation(arith, structure, coefficients, series, k, index);
        }
        let factor = arith.splat(1.0 / (k + 1) as f64);
        for (state, &node) in structure.derivative.iter().enumerate() {
            let rate = arith.load(series.get(node, k));
            series.set(state, k + 1, arith.store(arith.mul(rate, factor)));
        }
    }
    for &index in &structure.guard_ops {
        operation(arith, structure, coefficients, series, order, index);
    }
}

/// Values of all operations, given those of the states (order 0 of `series`).
pub(crate) fn values(structure: &Structure, coefficients: &[f64], series: &mut Series<f64>) {
    for index in 0..structure.ops.len() {
        operation(Scalar, structure, coefficients, series, 0, index);
    }
}
