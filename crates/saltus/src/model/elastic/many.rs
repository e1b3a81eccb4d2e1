//! Many w terms: E = h^2 H (R R), N = W E + h C P, T = 2 H^T N, with strains E and stresses N by their harmonics.

use std::collections::HashMap;

use saltus_hybrid::Node;

use super::program::{Elastic, Program, Sum, sum_nodes};
use crate::model::frame::{Frame, Pair};
use crate::physics::{Entry, Harmonics};

/// Many w terms.
#[derive(Clone, Debug)]
pub(crate) struct Many {
    pub(super) condensed: Harmonics,
    /// K^-1, where the condensed harmonics still have in-plane terms.
    pub(super) flexibility: Vec<Entry>,
}

/// The in-plane amplitudes.
#[derive(Clone, Copy)]
pub(super) enum InPlane<'a> {
    /// They are states.
    Free,
    /// P = -K^-1 s/h, with K^-1 given; empty where the harmonics are condensed already.
    Static(&'a [Entry]),
}

/// A weight on a node, for the in-plane term of this number.
type Load = (usize, f64, Node);

impl Program<'_> {
    pub(super) fn many(&mut self, harmonics: &Harmonics, in_plane: InPlane<'_>) -> Elastic {
        let layout = self.layout;
        let used = used_pairs(harmonics);
        let frame = Frame::new(layout.transverse, used.iter().copied());
        let y = frame.nodes(self.b, layout);
        let products = self.pair_products(&frame, &y, &used);
        let strains = self.strains(harmonics, &products);
        let loads = harmonics
            .in_plane
            .iter()
            .map(|c| (c.col, c.value, strains[c.row]));
        let (p, forces): (Vec<Node>, Vec<Sum>) = match in_plane {
            InPlane::Free => {
                let p = (0..layout.in_plane).map(|i| self.b.state(layout.p(i)));
                (p.collect(), self.in_plane(loads))
            }
            InPlane::Static(flexibility) => (self.static_in_plane(flexibility, loads), Vec::new()),
        };
        let stresses = self.stresses(harmonics, &strains, &p);
        let factors = self.factors(harmonics, &frame, &used, &stresses);
        let pairs: Vec<(Node, Node)> = factors.into_iter().zip(y).collect();
        let products = self.b.products(&pairs);
        Elastic {
            transverse: frame.forces(layout.transverse, &products),
            in_plane: forces,
        }
    }

    /// R_j R_k of the pairs that are used, through the squares of the frame.
    fn pair_products(&mut self, frame: &Frame, y: &[Node], used: &[Pair]) -> HashMap<Pair, Node> {
        let squares = self.b.squares(y);
        let product = |&pair: &Pair| {
            let terms: Sum = frame
                .product(pair)
                .into_iter()
                .map(|(a, weight)| (weight, squares[a]))
                .collect();
            let alone = pair.0 == pair.1;
            let node = if alone {
                terms[0].1
            } else {
                self.b.linear(0.0, &terms)
            };
            (pair, node)
        };
        used.iter().map(product).collect()
    }

    /// E = h^2 H (R R).
    fn strains(&mut self, harmonics: &Harmonics, products: &HashMap<Pair, Node>) -> Vec<Node> {
        let h = self.length();
        let mut strains = vec![Sum::new(); harmonics.rows];
        for entry in &harmonics.strain {
            let (j, k) = harmonics.pairs[entry.col];
            let multiplicity = if j == k { 1.0 } else { 2.0 };
            strains[entry.row].push((h * h * multiplicity * entry.value, products[&(j, k)]));
        }
        sum_nodes(self.b, &strains)
    }

    /// P = -K^-1 s/h; zeros where the harmonics are condensed.
    fn static_in_plane(
        &mut self,
        flexibility: &[Entry],
        loads: impl Iterator<Item = Load>,
    ) -> Vec<Node> {
        let h = self.length();
        let mut s = vec![Sum::new(); self.e.in_plane_mass.len()];
        loads.for_each(|(i, weight, node)| s[i].push((weight, node)));
        let mut p = vec![Sum::new(); s.len()];
        if !flexibility.is_empty() {
            let s = sum_nodes(self.b, &s);
            for entry in flexibility {
                p[entry.row].push((-entry.value / h, s[entry.col]));
            }
        }
        sum_nodes(self.b, &p)
    }

    /// N = W E + h C P.
    fn stresses(&mut self, harmonics: &Harmonics, strains: &[Node], p: &[Node]) -> Vec<Node> {
        let h = self.length();
        let mut stresses = vec![Sum::new(); harmonics.rows];
        for entry in &harmonics.weights {
            stresses[entry.row].push((entry.value, strains[entry.col]));
        }
        for entry in &harmonics.in_plane {
            stresses[entry.row].push((h * entry.value, p[entry.col]));
        }
        sum_nodes(self.b, &stresses)
    }

    /// T = 2 H^T N as factors of the frame.
    fn factors(
        &mut self,
        harmonics: &Harmonics,
        frame: &Frame,
        used: &[Pair],
        stresses: &[Node],
    ) -> Vec<Node> {
        let mut tension: HashMap<Pair, Sum> = HashMap::new();
        for entry in &harmonics.strain {
            let value = 2.0 * entry.value * self.per_mass();
            let terms = tension.entry(harmonics.pairs[entry.col]).or_default();
            terms.push((value, stresses[entry.row]));
        }
        let mut factors = vec![Sum::new(); frame.pairs.len()];
        for pair in used {
            let node = self.b.linear(0.0, &tension[pair]);
            for (a, sign) in frame.factors(*pair) {
                factors[a].push((sign, node));
            }
        }
        sum_nodes(self.b, &factors)
    }
}

/// The pairs whose product strains anything, in the order of the harmonics.
fn used_pairs(harmonics: &Harmonics) -> Vec<Pair> {
    let mut columns: Vec<usize> = harmonics.strain.iter().map(|entry| entry.col).collect();
    columns.sort_unstable();
    columns.dedup();
    columns.into_iter().map(|c| harmonics.pairs[c]).collect()
}
