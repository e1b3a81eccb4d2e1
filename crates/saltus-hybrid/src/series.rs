//! Taylor coefficients of every node, order by order (automatic differentiation in time).
//!
//! Let node(t0 + s) = sum_k node[k] s^k. A sum is a sum in each order, a product is the Cauchy
//! product, and x' = node gives x[k+1] = node[k]/(k+1). See Jorba & Zou, Experiment. Math. 14 (2005).

use crate::arith::{Arith, Scalar};
use crate::cauchy::{Orders, products, squares, squares_and_products};
use crate::recurrence;
use crate::rows::block_rows;
use crate::special::Shape;
use crate::structure::{Adiabatic, Cubic, Group, MAX_NODES, Op, Place, Step, Structure};

/// Taylor coefficients: all nodes at the order in hand, and all orders of those nodes that are needed
/// later (states, factors of products, guards), each in its slot.
#[derive(Clone, Debug, Default)]
pub(crate) struct Series<C> {
    order: usize,
    slots: usize,
    now: Vec<C>,
    /// Order k of slot s is at k * slots + s.
    kept: Vec<C>,
    scratch: Vec<C>,
}

/// Nodes of a small program, such as four modes and a person with all their tangents.
const FEW: usize = 1024;

/// Length of the table of nodes: one of two, known to the compiler where it is read, so that an index
/// cut to that range needs no check.
fn room(structure: &Structure) -> usize {
    if structure.nodes <= FEW {
        FEW
    } else {
        MAX_NODES
    }
}

impl<C: Copy + Default> Series<C> {
    /// A series of this order, or of the order that values take to compute.
    pub(crate) fn new(structure: &Structure, order: usize) -> Self {
        let order = order.max(structure.order_of_values());
        Self {
            order,
            slots: structure.slots,
            now: vec![C::default(); room(structure)],
            kept: vec![C::default(); structure.slots * (order + 1)],
            scratch: structure
                .adiabatic
                .first()
                .map_or_else(Vec::new, |x| vec![C::default(); x.scratch(order)]),
        }
    }

    /// All coefficients of a slot, order by order.
    #[inline(always)]
    pub(crate) fn of(
        &self,
        slot: usize,
    ) -> impl DoubleEndedIterator<Item = &C> + ExactSizeIterator {
        self.kept[slot..].iter().step_by(self.slots)
    }

    /// The slots at each order.
    #[inline(always)]
    pub(crate) fn rows(&self) -> std::slice::ChunksExact<'_, C> {
        self.kept.chunks_exact(self.slots)
    }

    /// Order k of all slots.
    #[inline(always)]
    pub(crate) fn row(&self, k: usize) -> &[C] {
        &self.kept[k * self.slots..][..self.slots]
    }

    /// Order k of a slot.
    #[inline(always)]
    pub(crate) fn at(&self, slot: usize, k: usize) -> &C {
        &self.kept[k * self.slots + slot]
    }

    /// Order 0 of a slot.
    #[inline(always)]
    pub(crate) fn value(&mut self, slot: usize) -> &mut C {
        &mut self.kept[slot]
    }

    /// All nodes at the last order computed; after [`values`], their values.
    pub(crate) fn now(&self) -> &[C] {
        &self.now
    }

    /// Every stored coefficient of a program of `nodes` nodes, to be cleared.
    pub(crate) fn cells(&mut self, nodes: usize) -> impl Iterator<Item = &mut C> {
        self.now[..nodes].iter_mut().chain(&mut self.kept)
    }

    /// Puts the values of the states, given in their first slots, everywhere.
    #[inline(always)]
    fn open(&mut self, structure: &Structure) {
        for (now, &slot) in self.now.iter_mut().zip(&structure.state_slots) {
            *now = self.kept[slot];
        }
        for &(state, slot) in &structure.state_copies {
            self.kept[slot] = self.now[state];
        }
    }
}

/// Places that sums are read from and written to.
struct Sums<'a, A: Arith, const M: usize> {
    arith: A,
    stream: &'a [A::Cell],
    now: &'a mut [A::Cell; M],
    /// The order in hand of all slots.
    kept: &'a mut [A::Cell],
}

impl<A: Arith, const M: usize> Sums<'_, A, M> {
    #[inline(always)]
    fn put<const W: usize>(&mut self, out: Place, values: [A::V; W]) {
        let cells = match out {
            Place::Now(node) => &mut self.now[node..][..W],
            Place::Kept(slot) => &mut self.kept[slot..][..W],
        };
        for (cell, value) in cells.iter_mut().zip(values) {
            *cell = self.arith.store(value);
        }
    }

    /// W sums of equally many terms.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn group<const W: usize>(&mut self, group: &Group, terms: &[u16], first: bool) {
        let arith = self.arith;
        let weights = &self.stream[group.weights..][..W * (group.terms + 1)];
        let Some((constants, weights)) = weights.split_first_chunk::<W>() else {
            return;
        };
        let nodes = &terms[group.nodes..][..W * group.terms];
        let mut sums = [arith.splat(0.0); W];
        if first {
            for w in 0..W {
                sums[w] = arith.load(&constants[w]);
            }
        }
        let terms = weights
            .as_chunks::<W>()
            .0
            .iter()
            .zip(nodes.as_chunks::<W>().0);
        for (weights, nodes) in terms {
            for w in 0..W {
                let x = arith.load(&self.now[nodes[w] as usize % M]);
                sums[w] = arith.mul_add(arith.load(&weights[w]), x, sums[w]);
            }
        }
        self.put(group.out, sums);
    }

    /// W rows of a matrix: each node is loaded for W multiply-adds.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn rows<const W: usize>(&mut self, out: Place, weights: &[A::Cell], nodes: &[u16]) {
        let arith = self.arith;
        let mut sums = [arith.splat(0.0); W];
        for (weights, &node) in weights.as_chunks::<W>().0.iter().zip(nodes) {
            let x = arith.load(&self.now[node as usize % M]);
            for w in 0..W {
                sums[w] = arith.mul_add(arith.load(&weights[w]), x, sums[w]);
            }
        }
        self.put(out, sums);
    }

    /// A whole matrix: rows by fours, then the rest.
    #[inline(always)]
    fn matrix(&mut self, out: Place, rows: usize, weights: &[A::Cell], nodes: &[u16]) {
        let at = |row: usize| match out {
            Place::Now(node) => Place::Now(node + row),
            Place::Kept(slot) => Place::Kept(slot + row),
        };
        let mut row = 0;
        while rows - row >= 4 {
            self.rows::<4>(at(row), &weights[row * nodes.len()..], nodes);
            row += 4;
        }
        let rest = &weights[row * nodes.len()..];
        match rows - row {
            3 => self.rows::<3>(at(row), rest, nodes),
            2 => self.rows::<2>(at(row), rest, nodes),
            1 => self.rows::<1>(at(row), rest, nodes),
            _ => {}
        }
    }
}

/// Order k of a program of at most M nodes.
#[cfg_attr(not(unoptimised), inline(always))]
fn run<A: Arith, const M: usize>(
    arith: A,
    structure: &Structure,
    program: &[Step],
    stream: &[A::Cell],
    series: &mut Series<A::Cell>,
    k: usize,
) {
    let stride = series.slots;
    let Some(now) = series.now.first_chunk_mut::<M>() else {
        return;
    };
    for step in program {
        match &step.op {
            Op::Linear { groups } => {
                let mut sums = Sums {
                    arith,
                    stream,
                    now,
                    kept: &mut series.kept[k * stride..][..stride],
                };
                for group in &structure.groups[groups.0..groups.1] {
                    match group.width {
                        4 => sums.group::<4>(group, &structure.terms, k == 0),
                        3 => sums.group::<3>(group, &structure.terms, k == 0),
                        2 => sums.group::<2>(group, &structure.terms, k == 0),
                        _ => sums.group::<1>(group, &structure.terms, k == 0),
                    }
                }
            }
            Op::Matrix {
                out,
                rows,
                weights,
                nodes,
            } => {
                let mut sums = Sums {
                    arith,
                    stream,
                    now,
                    kept: &mut series.kept[k * stride..][..stride],
                };
                let nodes = &structure.terms[nodes.0..nodes.1];
                let weights = &stream[*weights..][..rows * nodes.len()];
                sums.matrix(*out, *rows, weights, nodes);
            }
            Op::Squares { out, count, factor } => {
                let orders = Orders {
                    cells: &series.kept,
                    stride,
                };
                squares(arith, orders, *factor, k, &mut now[*out..out + count]);
            }
            Op::Products {
                out,
                count,
                factors,
            } => {
                let orders = Orders {
                    cells: &series.kept,
                    stride,
                };
                products(arith, orders, *factors, k, &mut now[*out..out + count]);
            }
            Op::Recall { out, slot, count } => {
                let from = k * stride + slot;
                now[*out..out + count].copy_from_slice(&series.kept[from..from + count]);
            }
            Op::Quotient { out, .. } | Op::Power { out, .. } | Op::Function { out, .. } => {
                let orders = Orders {
                    cells: &series.kept,
                    stride,
                };
                now[*out % M] = by_recurrence(arith, &step.op, stream, now, orders, k);
            }
            Op::Cubic(index) => {
                let cubic = &structure.cubics[*index];
                run_cubic(arith, cubic, stream, now, &mut series.kept, stride, k);
            }
        }
        for &(node, slot) in &structure.keeps[step.keeps.0..step.keeps.1] {
            series.kept[k * stride + slot as usize] = now[node as usize % M];
        }
    }
}

/// Order k of a quotient, power or function; zero for other operations.
#[cfg_attr(not(unoptimised), inline(always))]
fn by_recurrence<A: Arith>(
    arith: A,
    op: &Op,
    stream: &[A::Cell],
    now: &[A::Cell],
    orders: Orders<'_, A::Cell>,
    k: usize,
) -> A::Cell {
    match *op {
        Op::Quotient {
            own,
            dividend,
            divisor,
            active,
            ..
        } => {
            let (active, dividend) = (&stream[active], &now[dividend]);
            recurrence::quotient(arith, orders, active, dividend, [divisor, own], k)
        }
        Op::Power {
            own,
            base,
            exponent,
            active,
            ..
        } => {
            let (active, exponent) = (&stream[active], &stream[exponent]);
            recurrence::power(arith, orders, active, exponent, [base, own], k)
        }
        Op::Function {
            function,
            minus,
            of,
            slope,
            active,
            ..
        } => {
            let (active, which) = (&stream[active], (function, minus));
            recurrence::function(arith, orders, active, which, [of, slope], k)
        }
        _ => A::Cell::default(),
    }
}

/// Order k of a cubic.
#[cfg_attr(not(unoptimised), inline(always))]
fn run_cubic<A: Arith>(
    arith: A,
    cubic: &Cubic,
    stream: &[A::Cell],
    now: &mut [A::Cell],
    kept: &mut [A::Cell],
    stride: usize,
    k: usize,
) {
    let (count, heads) = (cubic.count, cubic.heads);
    let (before, out) = now.split_at_mut(cubic.out);
    let (q, out) = out.split_at_mut(count);
    let p = &mut out[..count];
    let orders = Orders {
        cells: kept,
        stride,
    };
    squares_and_products(arith, orders, [cubic.y, cubic.t], k, q, p);
    let t = &mut kept[k * stride + cubic.t..][..count];
    if let Some(first) = cubic.added {
        t.copy_from_slice(&before[first..first + count]);
    }
    let onto = cubic.added.is_some();
    let (t_heads, t_rest) = t.split_at_mut(heads);
    let weights = &stream[cubic.weights..][..heads * (2 * count - heads)];
    let (weights_heads, weights_rest) = weights.split_at(heads * count);
    block_rows(arith, weights_heads, q, onto, t_heads);
    block_rows(arith, weights_rest, &q[..heads], onto, t_rest);
    for &(row, column, weight) in &cubic.extra {
        let (weight, x) = (arith.load(&stream[weight]), arith.load(&q[column]));
        t[row] = arith.store(arith.mul_add(weight, x, arith.load(&t[row])));
    }
    let t = &kept[k * stride + cubic.t..][..count];
    let y = &kept[cubic.y..][..count];
    for ((p, t), y) in p.iter_mut().zip(t).zip(y) {
        *p = arith.store(arith.mul_add(arith.load(t), arith.load(y), arith.load(p)));
    }
}

/// Fills orders 1..=order of all states, and of the guards, from order 0 of the states.
#[inline(always)]
pub(crate) fn expand<A: Arith>(
    arith: A,
    structure: &Structure,
    shape: Option<Shape>,
    stream: &[A::Cell],
    series: &mut Series<A::Cell>,
) {
    let (order, stride) = (series.order, series.slots);
    let rounds = structure
        .adiabatic
        .first()
        .map_or(0, Adiabatic::corrections);
    // One call only, in a loop: all of the program is compiled into it.
    for terms in 0..=rounds {
        let (kept, scratch) = (&mut series.kept, &mut series.scratch);
        for adiabatic in &structure.adiabatic {
            if terms > 0 {
                adiabatic.update(arith, stream, kept, stride, scratch, order, terms);
            } else {
                adiabatic.clear(kept, stride);
            }
        }
        expand_once(arith, structure, shape, stream, series);
    }
}

/// Fills all orders once, with the adiabatic nodes as they are.
#[inline(always)]
fn expand_once<A: Arith>(
    arith: A,
    structure: &Structure,
    shape: Option<Shape>,
    stream: &[A::Cell],
    series: &mut Series<A::Cell>,
) {
    if A::WIDE
        && let Some(shape) = shape
    {
        shape.expand(arith, stream, &mut series.kept);
    } else if series.now.len() == FEW {
        expand_in::<A, FEW>(arith, structure, stream, series);
    } else {
        expand_in::<A, MAX_NODES>(arith, structure, stream, series);
    }
}

#[cfg_attr(not(unoptimised), inline(always))]
fn expand_in<A: Arith, const M: usize>(
    arith: A,
    structure: &Structure,
    stream: &[A::Cell],
    series: &mut Series<A::Cell>,
) {
    let (order, stride) = (series.order, series.slots);
    series.open(structure);
    for k in 0..order {
        let program = &structure.program;
        run::<A, M>(arith, structure, program, stream, series, k);
        let factor = arith.splat(1.0 / (k + 1) as f64);
        let next_row = &mut series.kept[(k + 1) * stride..][..stride];
        let Some(now) = series.now.first_chunk_mut::<M>() else {
            return;
        };
        // A state that is the rate of another comes after it, see `SystemBuilder::derivative`.
        for (state, rate) in structure.rates.iter().enumerate() {
            let next = arith.mul(arith.load(&now[rate.node as usize % M]), factor);
            now[state % M] = arith.store(next);
            next_row[rate.slot as usize] = arith.store(next);
        }
        for &(state, slot) in &structure.state_copies {
            next_row[slot] = now[state % M];
        }
    }
    let program = &structure.guard_program;
    run::<A, M>(arith, structure, program, stream, series, order);
}

/// Values of all operations, given those of the states (order 0 of `series`).
pub(crate) fn values(structure: &Structure, stream: &[f64], series: &mut Series<f64>) {
    if !structure.adiabatic.is_empty() {
        expand(Scalar, structure, None, stream, series);
    }
    series.open(structure);
    let program = &structure.program;
    if series.now.len() == FEW {
        run::<_, FEW>(Scalar, structure, program, stream, series, 0);
    } else {
        run::<_, MAX_NODES>(Scalar, structure, program, stream, series, 0);
    }
    for &(node, slot) in &structure.kept_only {
        series.now[node as usize] = series.kept[slot as usize];
    }
}

/// Derivatives of all operations while the states change at the rates `dx`, after [`values`]. Adiabatic
/// nodes change as they do in time.
pub(crate) fn along(structure: &Structure, stream: &[f64], dx: &[f64], series: &mut Series<f64>) {
    let stride = series.slots;
    for (state, &rate) in dx.iter().enumerate() {
        series.now[state] = rate;
        series.kept[stride + structure.state_slots[state]] = rate;
    }
    for &(state, slot) in &structure.state_copies {
        series.kept[stride + slot] = dx[state];
    }
    let program = &structure.program;
    if series.now.len() == FEW {
        run::<_, FEW>(Scalar, structure, program, stream, series, 1);
    } else {
        run::<_, MAX_NODES>(Scalar, structure, program, stream, series, 1);
    }
    for &(node, slot) in &structure.kept_only {
        series.now[node as usize] = series.kept[stride + slot as usize];
    }
}
