//! Products of transverse amplitudes through squares: the form in which the engine takes a quartic
//! energy.

use std::collections::{BTreeSet, HashMap};

use saltus_hybrid::{Node, SystemBuilder};

use super::layout::Layout;
use crate::physics::QuarticTerm;

/// A pair of transverse indices, the smaller first.
pub(crate) type Pair = (usize, usize);

/// The frame Y_jj = R_j for all j, then Y_jk = R_j + R_k for some j < k.
///
/// R_j R_k = (Y_jk^2 - Y_jj^2 - Y_kk^2)/2, and squares cost half as much in a series. An energy
/// 1/4 sum_ab A_ab Y_a^2 Y_b^2 has the forces sum_a l_aj Y_a (sum_b A_ab Y_b^2), l_aj = dY_a/dR_j: one
/// product for each a serves both ends of a pair.
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    pub(crate) pairs: Vec<Pair>,
    place: HashMap<Pair, usize>,
}

impl Frame {
    /// With the pairs j < k that are used.
    pub(crate) fn new(transverse: usize, used: impl IntoIterator<Item = Pair>) -> Self {
        let mixed: BTreeSet<Pair> = used.into_iter().filter(|(j, k)| j < k).collect();
        let pairs: Vec<Pair> = (0..transverse).map(|j| (j, j)).chain(mixed).collect();
        Self {
            place: pairs
                .iter()
                .enumerate()
                .map(|(a, &pair)| (pair, a))
                .collect(),
            pairs,
        }
    }

    /// Y_a as nodes.
    pub(crate) fn nodes(&self, b: &mut SystemBuilder, layout: Layout) -> Vec<Node> {
        let node = |&(j, k): &Pair| {
            let (r_j, r_k) = (b.state(layout.r(j)), b.state(layout.r(k)));
            if j == k {
                r_j
            } else {
                b.linear(0.0, &[(1.0, r_j), (1.0, r_k)])
            }
        };
        self.pairs.iter().map(node).collect()
    }

    /// R_j R_k as weights of squares.
    pub(crate) fn product(&self, (j, k): Pair) -> Vec<(usize, f64)> {
        let at = |pair| self.place[&pair];
        if j == k {
            return vec![(at((j, j)), 1.0)];
        }
        vec![(at((j, k)), 0.5), (at((j, j)), -0.5), (at((k, k)), -0.5)]
    }

    /// An entry T_jk of a symmetric T as factors of Y in sum_k T_jk R_k:
    /// (T_jj - sum_{k != j} T_jk) of R_j and T_jk of R_j + R_k.
    pub(crate) fn factors(&self, (j, k): Pair) -> Vec<(usize, f64)> {
        let at = |pair| self.place[&pair];
        if j == k {
            return vec![(at((j, j)), 1.0)];
        }
        vec![(at((j, k)), 1.0), (at((j, j)), -1.0), (at((k, k)), -1.0)]
    }

    /// Spreads products Y_a t_a over the forces.
    pub(crate) fn forces(&self, transverse: usize, products: &[Node]) -> Vec<Vec<Node>> {
        let mut forces = vec![Vec::new(); transverse];
        for (&(j, k), &product) in self.pairs.iter().zip(products) {
            forces[j].push(product);
            if j < k {
                forces[k].push(product);
            }
        }
        forces
    }

    /// A of the energy sum Q R_j R_k R_l R_m. A square is split off where there is one: then A couples
    /// mixed Y_a with each other for four different indices only.
    pub(crate) fn quartic(&self, terms: &[QuarticTerm]) -> Vec<Vec<f64>> {
        let size = self.pairs.len();
        let mut a = vec![vec![0.0; size]; size];
        for term in terms {
            let (first, second) = split(term);
            let weight = 4.0 * term.multiplicity() * term.value;
            for &(row, u) in &self.product(first) {
                for &(column, v) in &self.product(second) {
                    a[row][column] += 0.5 * weight * u * v;
                    a[column][row] += 0.5 * weight * u * v;
                }
            }
        }
        a
    }
}

/// Two pairs of indices, equal ones together.
pub(crate) fn split(term: &QuarticTerm) -> (Pair, Pair) {
    let [j, k, l, m] = term.indices();
    if k == l {
        ((k, l), (j, m))
    } else {
        ((j, k), (l, m))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_frame_gives_the_gradient_of_a_quartic_energy() {
        let n = 4;
        let mut terms = Vec::new();
        for j in 0..n {
            for k in j..n {
                for l in k..n {
                    for m in l..n {
                        let value = ((j * 64 + k * 16 + l * 4 + m) as f64).sin();
                        terms.push(QuarticTerm { j, k, l, m, value });
                    }
                }
            }
        }
        let frame = Frame::new(n, (0..n).flat_map(|k| (0..k).map(move |j| (j, k))));
        let a = frame.quartic(&terms);
        let r = [0.3, -1.2, 0.7, 0.4];
        let y: Vec<f64> = frame
            .pairs
            .iter()
            .map(|&(j, k)| if j == k { r[j] } else { r[j] + r[k] })
            .collect();
        let mut force = vec![0.0; n];
        for (row, &(j, k)) in frame.pairs.iter().enumerate() {
            let t: f64 = a[row].iter().zip(&y).map(|(a, y)| a * y * y).sum();
            force[j] += t * y[row];
            if j < k {
                force[k] += t * y[row];
            }
        }
        let mut expected = vec![0.0; n];
        for term in &terms {
            let at = term.indices();
            for first in 0..4 {
                let rest = (0..4)
                    .filter(|&other| other != first)
                    .map(|other| r[at[other]]);
                expected[at[first]] += term.multiplicity() * term.value * rest.product::<f64>();
            }
        }
        for (got, expected) in force.iter().zip(expected) {
            assert!((got - expected).abs() < 1e-13, "{got} {expected}");
        }
        // Mixed sums couple with each other for four different indices only.
        let mixed = (n..a.len()).flat_map(|i| (n..a.len()).map(move |k| (i, k)));
        assert_eq!(mixed.filter(|&(i, k)| a[i][k] != 0.0).count(), 2);
    }
}
