//! Elastic forces beyond linear bending, as a program.
//!
//! Few w terms: the quartic energy as a matrix between squares ([`Frame`]). Many: through the harmonics
//! of the strains ([`Harmonics`]), whose work grows with the number of pairs and not with its square.

use std::collections::HashMap;

use saltus_hybrid::{Node, SystemBuilder};

use super::frame::{Frame, Pair, split};
use super::{Inertia, Layout, Scales};
use crate::physics::{CouplingTerm, Elasticity, Entry, Harmonics, PhysicsError, QuarticTerm};

/// From this many w terms on the harmonics are cheaper: complete sets of 9 terms take 1.4 times as long by
/// them as by the quartic matrix, of 16 terms 0.8 times (`cargo bench -p saltus --bench growth`).
pub(crate) const MANY: usize = 10;

/// Terms of the slow manifold beyond the static one: the in-plane motion that is left out is of
/// relative size (f_w/f_in-plane)^(2 CORRECTIONS + 2).
const CORRECTIONS: usize = 2;

/// What the stretching of a plate contributes, prepared once for all models on it.
#[derive(Clone, Debug)]
pub(crate) enum Stretching {
    Few(Box<Few>),
    Many(Box<Many>),
}

/// Few w terms. Forces on R_j with lengths in metres, to be scaled by h^2/(M Omega^2).
#[derive(Clone, Debug)]
pub(crate) struct Few {
    frame: Frame,
    condensed: Vec<Vec<f64>>,
    /// What the in-plane terms add when their own inertia counts: R_n of (D^2 + c D)^n, time in s.
    responses: Vec<Vec<Vec<f64>>>,
}

/// Many w terms.
#[derive(Clone, Debug)]
pub(crate) struct Many {
    condensed: Harmonics,
    /// K^-1, where the condensed harmonics still have in-plane terms.
    flexibility: Vec<Entry>,
}

/// Elastic forces beyond linear bending, as nodes.
pub(crate) struct Elastic {
    /// Nodes whose sum is sum_k T_jk R_k.
    pub(crate) transverse: Vec<Vec<Node>>,
    /// Terms of P_i'' but damping.
    pub(crate) in_plane: Vec<Sum>,
}

/// A sum of nodes with weights.
pub(crate) type Sum = Vec<(f64, Node)>;

impl Stretching {
    pub(crate) fn new(e: &Elasticity) -> Result<Self, PhysicsError> {
        if e.bending.len() < MANY {
            return Few::new(e).map(|few| Self::Few(Box::new(few)));
        }
        let (mut condensed, mut flexibility) = (e.condensed_harmonics()?, Vec::new());
        let work = |h: &Harmonics| 2 * h.strain.len() + h.weights.len() + 2 * h.in_plane.len();
        let inverse = e.in_plane_flexibility()?;
        if work(&e.harmonics) + inverse.len() < work(&condensed) {
            (condensed, flexibility) = (e.harmonics.clone(), inverse);
        }
        Ok(Self::Many(Box::new(Many {
            condensed,
            flexibility,
        })))
    }

    /// Whether [`Inertia::SlowManifold`] is possible.
    pub(crate) fn has_slow_manifold(&self) -> bool {
        matches!(self, Self::Few(_))
    }

    /// The forces as nodes.
    pub(crate) fn forces(
        &self,
        b: &mut SystemBuilder,
        e: &Elasticity,
        inertia: Inertia,
        scales: &Scales,
        layout: Layout,
    ) -> Elastic {
        let mut program = Program {
            b,
            e,
            scales,
            layout,
        };
        match (self, inertia) {
            (Self::Few(few), Inertia::Full) => program.few_full(&few.frame),
            (Self::Few(few), Inertia::Condensed) => program.few_condensed(few, &[]),
            (Self::Few(few), Inertia::SlowManifold) => program.few_condensed(few, &few.responses),
            (Self::Many(_), Inertia::Full) => program.many(&e.harmonics, InPlane::Free),
            (Self::Many(many), _) => {
                program.many(&many.condensed, InPlane::Static(&many.flexibility))
            }
        }
    }
}

impl Few {
    fn new(e: &Elasticity) -> Result<Self, PhysicsError> {
        let quartic = e.condensed_quartic()?;
        let frame = frame(e, &[&quartic, &e.quartic]);
        let responses = responses(e, &frame)?;
        Ok(Self {
            condensed: frame.quartic(&quartic),
            frame,
            responses,
        })
    }
}

/// All pairs that occur.
fn frame(e: &Elasticity, quartics: &[&[QuarticTerm]]) -> Frame {
    let halves = |term: &QuarticTerm| {
        let (first, second) = split(term);
        [first, second]
    };
    let quartic = quartics.iter().copied().flatten().flat_map(halves);
    let coupled = e.coupling.iter().map(|term| (term.j, term.k));
    Frame::new(e.bending.len(), quartic.chain(coupled))
}

/// The in-plane amplitudes as a series in the squares q of the frame, with L = D^2 + c D:
/// p = -K^-1 (S q) + K^-1 M L K^-1 (S q) - ..., and what each term but the first adds to the factors
/// of Y, 2 B p: R_n = -2 B (-K^-1 M)^n K^-1 S.
fn responses(e: &Elasticity, frame: &Frame) -> Result<Vec<Vec<Vec<f64>>>, PhysicsError> {
    let (in_plane, size) = (e.in_plane_mass.len(), frame.pairs.len());
    let flexibility = e.in_plane_flexibility()?;
    let solve = |x: &[Vec<f64>]| {
        let mut out = vec![vec![0.0; size]; in_plane];
        for entry in &flexibility {
            for (out, x) in out[entry.row].iter_mut().zip(&x[entry.col]) {
                *out -= entry.value * x;
            }
        }
        out
    };
    let mut load = vec![vec![0.0; size]; in_plane];
    for term in &e.coupling {
        for (a, weight) in frame.product((term.j, term.k)) {
            load[term.i][a] += term.multiplicity() * term.value * weight;
        }
    }
    let mut p = solve(&load);
    let mut out = Vec::new();
    for _ in 0..CORRECTIONS {
        for (p, mass) in p.iter_mut().zip(&e.in_plane_mass) {
            p.iter_mut().for_each(|p| *p *= mass);
        }
        p = solve(&p);
        let mut response = vec![vec![0.0; size]; size];
        for term in &e.coupling {
            for (a, sign) in frame.factors((term.j, term.k)) {
                for (out, p) in response[a].iter_mut().zip(&p[term.i]) {
                    *out += 2.0 * sign * term.value * p;
                }
            }
        }
        out.push(response);
    }
    Ok(out)
}

/// What the in-plane amplitudes do.
#[derive(Clone, Copy)]
enum InPlane<'a> {
    /// They are states.
    Free,
    /// P = -K^-1 s/h, with K^-1 given; empty where the harmonics are condensed already.
    Static(&'a [Entry]),
}

/// What it takes to write forces into a program.
struct Program<'a> {
    b: &'a mut SystemBuilder,
    e: &'a Elasticity,
    scales: &'a Scales,
    layout: Layout,
}

impl Program<'_> {
    fn length(&self) -> f64 {
        self.scales.length
    }

    /// 1/(M Omega^2).
    fn per_mass(&self) -> f64 {
        1.0 / (self.e.transverse_mass * self.scales.omega.powi(2))
    }

    fn few_condensed(&mut self, few: &Few, responses: &[Vec<Vec<f64>>]) -> Elastic {
        let y = few.frame.nodes(self.b, self.layout);
        let scale = self.length().powi(2) * self.per_mass();
        let added = match responses {
            [] => Vec::new(),
            _ => self.b.reserve_adiabatic(y.len()),
        };
        let heads = self.layout.transverse;
        let a = scaled(&few.condensed, scale);
        let (squares, products) = self.b.cubic(&y, &a, heads, &added);
        if !responses.is_empty() {
            // Time runs in 1/Omega: each D^2 brings Omega^2.
            let mut factor = scale;
            let mut in_time = Vec::new();
            for response in responses {
                factor *= self.scales.omega.powi(2);
                in_time.push(scaled(response, factor));
            }
            let damping = self.e.damping / self.scales.omega;
            self.b.define_adiabatic(&squares, damping, &in_time);
        }
        Elastic {
            transverse: few.frame.forces(heads, &products),
            in_plane: Vec::new(),
        }
    }

    fn few_full(&mut self, frame: &Frame) -> Elastic {
        let y = frame.nodes(self.b, self.layout);
        let (h, per_mass) = (self.length(), self.per_mass());
        let a = scaled(&frame.quartic(&self.e.quartic), h * h * per_mass);
        // What the in-plane amplitudes add to the tension: 2 B_ijk P_i h/(M Omega^2).
        let mut tension = vec![Sum::new(); y.len()];
        for term in &self.e.coupling {
            let p = self.b.state(self.layout.p(term.i));
            let value = 2.0 * term.value * h * per_mass;
            for (a, sign) in frame.factors((term.j, term.k)) {
                tension[a].push((sign * value, p));
            }
        }
        let added = if self.e.coupling.is_empty() {
            Vec::new()
        } else {
            let tension: Vec<Sum> = tension.iter().map(|terms| collected(terms)).collect();
            sum_nodes(self.b, &tension)
        };
        let heads = self.layout.transverse;
        let (squares, products) = self.b.cubic(&y, &a, heads, &added);
        let squares = &squares[..];
        let load = |term: &CouplingTerm| {
            let i = term.i;
            let weight = term.multiplicity() * term.value * h * h;
            let product = frame.product((term.j, term.k));
            product
                .into_iter()
                .map(move |(a, w)| (i, w * weight, squares[a]))
        };
        let loads: Vec<_> = self.e.coupling.iter().flat_map(load).collect();
        Elastic {
            transverse: frame.forces(heads, &products),
            in_plane: self.in_plane(loads),
        }
    }

    /// Terms of P_i'': -sum_k K_ik P_k/(M_i Omega^2) - s_i/(h M_i Omega^2), s given as (i, weight, node).
    fn in_plane(&self, loads: impl IntoIterator<Item = (usize, f64, Node)>) -> Vec<Sum> {
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

    /// Through harmonics: E = h^2 H (R R), N = W E + h C P, T = 2 H^T N.
    fn many(&mut self, harmonics: &Harmonics, in_plane: InPlane<'_>) -> Elastic {
        let (h, layout) = (self.length(), self.layout);
        let used: Vec<Pair> = {
            let mut columns: Vec<usize> = harmonics.strain.iter().map(|entry| entry.col).collect();
            columns.sort_unstable();
            columns.dedup();
            columns.into_iter().map(|c| harmonics.pairs[c]).collect()
        };
        let frame = Frame::new(layout.transverse, used.iter().copied());
        let y = frame.nodes(self.b, layout);
        let squares = self.b.squares(&y);
        let products: HashMap<Pair, Node> = used
            .iter()
            .map(|&pair| {
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
            })
            .collect();
        let mut strains = vec![Sum::new(); harmonics.rows];
        for entry in &harmonics.strain {
            let (j, k) = harmonics.pairs[entry.col];
            let multiplicity = if j == k { 1.0 } else { 2.0 };
            strains[entry.row].push((h * h * multiplicity * entry.value, products[&(j, k)]));
        }
        let strains = sum_nodes(self.b, &strains);
        let loads = harmonics
            .in_plane
            .iter()
            .map(|c| (c.col, c.value, strains[c.row]));
        let (p, forces): (Vec<Node>, Vec<Sum>) = match in_plane {
            InPlane::Free => {
                let p = (0..layout.in_plane).map(|i| self.b.state(layout.p(i)));
                (p.collect(), self.in_plane(loads))
            }
            InPlane::Static(flexibility) => {
                let mut s = vec![Sum::new(); self.e.in_plane_mass.len()];
                loads.for_each(|(i, weight, node)| s[i].push((weight, node)));
                let mut p = vec![Sum::new(); s.len()];
                if !flexibility.is_empty() {
                    let s = sum_nodes(self.b, &s);
                    for entry in flexibility {
                        p[entry.row].push((-entry.value / h, s[entry.col]));
                    }
                }
                (sum_nodes(self.b, &p), Vec::new())
            }
        };
        let mut stresses = vec![Sum::new(); harmonics.rows];
        for entry in &harmonics.weights {
            stresses[entry.row].push((entry.value, strains[entry.col]));
        }
        for entry in &harmonics.in_plane {
            stresses[entry.row].push((h * entry.value, p[entry.col]));
        }
        let stresses = sum_nodes(self.b, &stresses);
        let mut tension: HashMap<Pair, Sum> = HashMap::new();
        for entry in &harmonics.strain {
            let value = 2.0 * entry.value * self.per_mass();
            let terms = tension.entry(harmonics.pairs[entry.col]).or_default();
            terms.push((value, stresses[entry.row]));
        }
        let mut factors = vec![Sum::new(); frame.pairs.len()];
        for pair in &used {
            let node = self.b.linear(0.0, &tension[pair]);
            for (a, sign) in frame.factors(*pair) {
                factors[a].push((sign, node));
            }
        }
        let factors = sum_nodes(self.b, &factors);
        let pairs: Vec<(Node, Node)> = factors.into_iter().zip(y).collect();
        let products = self.b.products(&pairs);
        Elastic {
            transverse: frame.forces(layout.transverse, &products),
            in_plane: forces,
        }
    }
}

fn scaled(matrix: &[Vec<f64>], factor: f64) -> Vec<Vec<f64>> {
    let row = |row: &Vec<f64>| row.iter().map(|value| value * factor).collect();
    matrix.iter().map(row).collect()
}

/// The same sum with one term for each node, in the order of their first use.
fn collected(terms: &[(f64, Node)]) -> Sum {
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
fn sum_nodes(b: &mut SystemBuilder, sums: &[Sum]) -> Vec<Node> {
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
