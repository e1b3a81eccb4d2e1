//! Few w terms: the quartic energy as a matrix between squares ([`Frame`]).

use super::program::{Elastic, Program, Sum, collected, sum_nodes};
use crate::model::frame::{Frame, split};
use crate::physics::{CouplingTerm, Elasticity, PhysicsError, QuarticTerm};

/// Terms of the slow manifold beyond the static one: the in-plane motion that is left out is of
/// relative size (f_w/f_in-plane)^(2 CORRECTIONS + 2).
const CORRECTIONS: usize = 2;

/// Few w terms. Forces on R_j with lengths in metres, to be scaled by h^2/(M Omega^2).
#[derive(Clone, Debug)]
pub(crate) struct Few {
    pub(super) frame: Frame,
    condensed: Vec<Vec<f64>>,
    /// Additions of the in-plane terms when their own inertia counts: R_n of (D^2 + c D)^n, time in s.
    pub(super) responses: Vec<Vec<Vec<f64>>>,
}

impl Few {
    pub(super) fn new(e: &Elasticity) -> Result<Self, PhysicsError> {
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

impl Program<'_> {
    pub(super) fn few_condensed(&mut self, few: &Few, responses: &[Vec<Vec<f64>>]) -> Elastic {
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

    pub(super) fn few_full(&mut self, frame: &Frame) -> Elastic {
        let y = frame.nodes(self.b, self.layout);
        let (h, per_mass) = (self.length(), self.per_mass());
        let a = scaled(&frame.quartic(&self.e.quartic), h * h * per_mass);
        // Tension that the in-plane amplitudes add: 2 B_ijk P_i h/(M Omega^2).
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
}

fn scaled(matrix: &[Vec<f64>], factor: f64) -> Vec<Vec<f64>> {
    let row = |row: &Vec<f64>| row.iter().map(|value| value * factor).collect();
    matrix.iter().map(row).collect()
}
