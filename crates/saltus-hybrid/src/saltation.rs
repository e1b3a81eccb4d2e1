//! What a switch does to the tangent flow.
//!
//! A neighbour at d reaches the guard g later by s = -(Dg d)/g', g' being the rate of g along the flow
//! before the switch. So the columns cross a switch with the reset R as
//!
//! ```text
//! d+ = DR (d + f- s) - f+ s
//! ```
//!
//! (the saltation matrix; di Bernardo et al., Piecewise-smooth Dynamical Systems (2008), section 2.5).
//! Where the field does not jump and nothing is reset it is the identity.

use crate::compile::Watch;
use crate::event::Firing;
use crate::system::{Evaluator, Mode};
use crate::tangent::Tangents;

/// A jump of the field below this part of its size is rounding: near grazing it must not be divided by
/// a vanishing rate.
const NO_JUMP: f64 = 1e-13;

/// Carries out the resets of `watch`, one of the base program, on `x`, and takes its columns across.
/// `evaluator` is the base program's, `modes` are those before.
pub(crate) fn cross(
    evaluator: &mut Evaluator,
    tangents: &Tangents,
    watch: &Watch,
    firing: &Firing,
    modes: &[Mode],
    x: &mut [f64],
) {
    let base = &tangents.base;
    let guard = base.guards[watch.guard];
    let (state, columns) = x.split_at_mut(tangents.first);
    let field = |nodes: &[f64]| -> Vec<f64> { base.derivative.iter().map(|&i| nodes[i]).collect() };
    let of_resets =
        |nodes: &[f64]| -> Vec<f64> { watch.resets.iter().map(|&(_, i)| nodes[i]).collect() };

    let nodes = evaluator.nodes(modes, state);
    let (before, resets) = (field(nodes), of_resets(nodes));
    let rates = evaluator.along(&before);
    let (guard_rate, reset_rates) = (rates[guard], of_resets(rates));
    let mut direction = vec![0.0; base.states];
    let slopes: Vec<(f64, Vec<f64>)> = columns
        .chunks_exact(tangents.size)
        .map(|column| {
            direction[..tangents.size].copy_from_slice(column);
            let along = evaluator.along(&direction);
            (along[guard], of_resets(along))
        })
        .collect();

    for (&(to, _), &value) in watch.resets.iter().zip(&resets) {
        state[to] = value;
    }
    let mut after_modes = modes.to_vec();
    after_modes[firing.unit] = watch.to;
    let after = field(evaluator.nodes(&after_modes, state));

    // DR f- - f+, and DR d
    let mut jump: Vec<f64> = before.iter().zip(&after).map(|(b, a)| b - a).collect();
    for (&(to, _), rate) in watch.resets.iter().zip(&reset_rates) {
        jump[to] = rate - after[to];
    }
    let size = before
        .iter()
        .chain(&after)
        .fold(0.0, |m: f64, f| m.max(f.abs()));
    let jumps = jump[..tangents.size]
        .iter()
        .any(|j| j.abs() > NO_JUMP * size);
    for (column, (guard_slope, reset_slopes)) in columns.chunks_exact_mut(tangents.size).zip(slopes)
    {
        for (&(to, _), slope) in watch.resets.iter().zip(reset_slopes) {
            if let Some(d) = column.get_mut(to) {
                *d = slope;
            }
        }
        // One that was on the wrong side already switches at once, whatever its neighbours do.
        if jumps && firing.on_zero {
            let later = -guard_slope / guard_rate;
            column
                .iter_mut()
                .zip(&jump)
                .for_each(|(d, jump)| *d += jump * later);
        }
    }
}
