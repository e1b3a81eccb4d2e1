//! Nodes and sums that the forces of few and of many terms have in common.

use std::collections::HashMap;

use saltus_hybrid::{Node, SystemBuilder};

use crate::model::layout::Layout;
use crate::model::scales::Scales;
use crate::physics::Elasticity;

/// Elastic forces beyond linear bending, as nodes.
pub(crate) struct Elastic {
    /// Nodes whose sum is sum_k T_jk R_k.
    pub(crate) transverse: Vec<Vec<Node>>,
    /// Terms of P_i'' but damping.
    pub(crate) in_plane: Vec<Sum>,
}

/// A sum of nodes with weights.
pub(crate) type Sum = Vec<(f64, Node)>;

/// A program under way, and what its forces are made of.
pub(super) struct Program<'a> {
    pub(super) b: &'a mut SystemBuilder,
    pub(super) e: &'a Elasticity,
    pub(super) scales: &'a Scales,
    pub(super) layout: Layout,
}

impl Program<'_> {
    pub(super) fn length(&self) -> f64 {
        self.scales.length
    }

    /// 1/(M Omega^2).
    pub(super) fn per_mass(&self) -> f64 {
        1.0 / (self.e.transverse_mass * self.scales.omega.powi(2))
    }

    /// Terms of P_i'': -sum_k K_ik P_k/(M_i Omega^2) - s_i/(h M_i Omega^2), s given as (i, weight, node).
    pub(super) fn in_plane(&self, loads: impl IntoIterator<Item = (usize, f64, Node)>) -> Vec<Sum> {
        let size = self.layout.in_plane;
        let inertia = |i: usize| self.e.in_plane_mass[i] * self.scales.omega.powi(2);
        let mut forces = vec![Sum::new(); size];
        for (i, weight, node) in loads {
            forces[i].push((-weight / (self.length() * inertia(i)), node));
        }
        for (i, terms) in forces.iter_mut().enumerate() {
            *terms = collected(terms);
            for k in (0..size).filter(|&k| self.e.membrane_at(i, k) != 0.0) {
                let p = self.b.state(self.layout.p(k));
                terms.push((-self.e.membrane_at(i, k) / inertia(i), p));
            }
        }
        forces
    }
}

/// The same sum with one term for each node, in the order of their first use.
pub(super) fn collected(terms: &[(f64, Node)]) -> Sum {
    let mut out: Sum = Vec::new();
    let mut place: HashMap<Node, usize> = HashMap::new();
    for &(weight, node) in terms {
        let at = *place.entry(node).or_insert_with(|| {
            out.push((0.0, node));
            out.len() - 1
        });
        out[at].0 += weight;
    }
    out
}

/// One node for each sum, neighbours: as a matrix where that is mostly full, else as sums.
pub(super) fn sum_nodes(b: &mut SystemBuilder, sums: &[Sum]) -> Vec<Node> {
    let mut nodes: Vec<Node> = Vec::new();
    let mut column: HashMap<Node, usize> = HashMap::new();
    for &(_, node) in sums.iter().flatten() {
        column.entry(node).or_insert_with(|| {
            nodes.push(node);
            nodes.len() - 1
        });
    }
    let entries: usize = sums.iter().map(Vec::len).sum();
    if 2 * entries < sums.len() * nodes.len() || nodes.is_empty() {
        return sums.iter().map(|terms| b.linear(0.0, terms)).collect();
    }
    let row = |terms: &Sum| {
        let mut row = vec![0.0; nodes.len()];
        for (weight, node) in terms {
            row[column[node]] += *weight;
        }
        row
    };
    let rows: Vec<Vec<f64>> = sums.iter().map(row).collect();
    b.matrix(&nodes, &rows)
}
