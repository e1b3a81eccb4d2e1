//! The tangent flow across a switch.
//!
//! A neighbour at d reaches the guard g later by s = -(Dg d)/g', g' being the rate of g along the flow
//! before the switch. So the columns cross a switch with the reset R as
//!
//! ```text
//! d+ = DR (d + f- s) - f+ s
//! ```
//!
//! (the saltation matrix; di Bernardo et al., Piecewise-smooth Dynamical Systems (2008), section 2.5).
//! It is the identity if the field does not jump and nothing is reset. A switch that fires at once after
//! another has the s of that one: a neighbour that comes later makes all of the chain later.

use crate::evaluator::Evaluator;
use crate::event::{Cause, Firing};
use crate::program::Mode;
use crate::structure::{Tangents, Watch};

/// A jump of the field below this part of its size is rounding: near grazing it must not be divided by
/// a vanishing rate.
const NO_JUMP: f64 = 1e-13;

/// Part of a state by which it is moved for a difference: the error of central differences, its square, and
/// rounding over it are alike.
const DIFFERENCE: f64 = 1e-5;

/// Carries out the resets of `watch`, one of the base program, on `x`, and takes its columns across.
/// `evaluator` is the base program's, `modes` are those before. `later` is s of each column at the last
/// switch of this instant, empty if there was none, and becomes that of this one.
pub(crate) fn cross(
    evaluator: &mut Evaluator,
    tangents: &Tangents,
    watch: &Watch,
    firing: &Firing,
    modes: &[Mode],
    x: &mut [f64],
    later: &mut Vec<f64>,
) {
    let base = &tangents.base;
    let guard = base.guards[watch.guard];
    let (state, columns) = x.split_at_mut(tangents.first);
    // Without states of its own a system has no columns.
    let size = tangents.size.max(1);
    let field = |nodes: &[f64]| -> Vec<f64> { base.derivative.iter().map(|&i| nodes[i]).collect() };
    let of_resets =
        |nodes: &[f64]| -> Vec<f64> { watch.resets.iter().map(|&(_, i)| nodes[i]).collect() };

    later.resize(columns.len() / size, 0.0);
    if firing.cause == Cause::Turning {
        let all = columns.chunks_exact(size);
        turn(evaluator, guard, modes, state, all, later, field);
    }
    let nodes = evaluator.nodes(modes, state);
    let (before, resets) = (field(nodes), of_resets(nodes));
    let rates = evaluator.along(&before);
    let (guard_rate, reset_rates) = (rates[guard], of_resets(rates));
    let mut direction = vec![0.0; base.states];
    let mut reset_slopes: Vec<Vec<f64>> = Vec::with_capacity(later.len());
    for (column, later) in columns.chunks_exact(size).zip(later.iter_mut()) {
        direction[..tangents.size].copy_from_slice(column);
        let along = evaluator.along(&direction);
        if firing.cause == Cause::Crossing {
            *later = -along[guard] / guard_rate;
        }
        reset_slopes.push(of_resets(along));
    }

    for (&(to, _), &value) in watch.resets.iter().zip(&resets) {
        state[to] = value;
    }
    let mut after_modes = modes.to_vec();
    after_modes[firing.unit] = watch.to;
    let after = field(evaluator.nodes(&after_modes, state));

    let rates = watch.resets.iter().zip(&reset_rates);
    let rates = rates.map(|(&(to, _), &rate)| (to, rate));
    let jump = jump(&before, &after, rates, tangents.size);
    let columns = columns.chunks_exact_mut(size);
    for ((column, reset_slopes), &later) in columns.zip(reset_slopes).zip(later.iter()) {
        for (&(to, _), slope) in watch.resets.iter().zip(reset_slopes) {
            if let Some(d) = column.get_mut(to) {
                *d = slope;
            }
        }
        for (d, jump) in column.iter_mut().zip(jump.iter().flatten()) {
            *d += jump * later;
        }
    }
}

/// DR f- - f+, unless its first `size` components are rounding. `rates` holds the states that are reset, each with its
/// component of DR f-.
fn jump(
    before: &[f64],
    after: &[f64],
    rates: impl Iterator<Item = (usize, f64)>,
    size: usize,
) -> Option<Vec<f64>> {
    let mut jump: Vec<f64> = before.iter().zip(after).map(|(b, a)| b - a).collect();
    for (to, rate) in rates {
        jump[to] = rate - after[to];
    }
    let largest = before
        .iter()
        .chain(after)
        .fold(0.0, |m: f64, f| m.max(f.abs()));
    let jumps = |j: &f64| j.abs() > NO_JUMP * largest;
    jump[..size].iter().any(jumps).then_some(jump)
}

/// Delays of neighbours at a place at which the rate of a guard vanishes: the rate takes the part of
/// the guard, and its derivatives are differences.
fn turn<'a>(
    evaluator: &mut Evaluator,
    guard: usize,
    modes: &[Mode],
    state: &[f64],
    columns: impl Iterator<Item = &'a [f64]>,
    later: &mut [f64],
    field: impl Fn(&[f64]) -> Vec<f64>,
) {
    let mut rate_at = |x: &[f64]| {
        let flow = field(evaluator.nodes(modes, x));
        (evaluator.along(&flow)[guard], flow)
    };
    let flow = rate_at(state).1;
    let largest = |x: &[f64]| x.iter().fold(f64::MIN_POSITIVE, |m: f64, a| m.max(a.abs()));
    let size = largest(state);
    let mut slope = |direction: &[f64]| {
        let by = DIFFERENCE * size / largest(direction);
        let mut moved = |by: f64| {
            let mut x = state.to_vec();
            let pairs = x.iter_mut().zip(direction);
            pairs.for_each(|(x, d)| *x += by * d);
            rate_at(&x).0
        };
        (moved(by) - moved(-by)) / (2.0 * by)
    };
    let curvature = slope(&flow);
    for (later, column) in later.iter_mut().zip(columns) {
        *later = -slope(column) / curvature;
    }
}
