//! The plate whose in-plane terms follow statically, p = -K^-1 C^T E: U_p at its least over p.
//!
//! ```text
//! U = 1/2 r.K_b r + 1/2 E.W_eff E = 1/2 r.K_b r + Q_eff r r r r,    W_eff = W - C K^-1 C^T
//! dU/dr = K_b r + T r                  T of the stresses N = W E + C p = W_eff E
//! d^2U/dr^2 = K_b + T + J^T W_eff J    J = dE/dr
//! ```

use super::elasticity::dot;
use super::harmonics::{by_row, sorted};
use super::in_plane::Sum;
use super::{Elasticity, Entry, Harmonics, PhysicsError, QuarticTerm, algebra, lists};
use std::collections::BTreeMap;

const WHAT: &str = "condensed plate stiffness";
/// More w terms than this and the N_w^4/24 entries of Q_eff are not worth listing on any request.
const MAX_QUARTIC: usize = 64;
/// Parts of W_eff below this are the rounding of W - C K^-1 C^T.
const ROUNDING: f64 = 1e-13;
/// A harmonic has at most this many strains.
const FIELDS: usize = 3;

impl Elasticity {
    /// Elastic energy (J) for transverse amplitudes `r` (m, N_w) when the in-plane terms follow:
    /// the least of [`Elasticity::strain_energy`] over p.
    pub fn condensed_energy(&self, r: &[f64]) -> f64 {
        self.bending_energy(r) + self.condensed_stretching(r)
    }

    /// Q_eff r r r r = 1/2 E.N (J).
    pub(super) fn condensed_stretching(&self, r: &[f64]) -> f64 {
        let (e, n) = self.condensed_stresses(r);
        0.5 * dot(&e, &n)
    }

    /// Gradient of [`Elasticity::condensed_energy`], K_b r + 4 Q_eff r r r (N, N_w).
    pub fn condensed_force(&self, r: &[f64]) -> Vec<f64> {
        let mut force: Vec<f64> = self.bending.iter().zip(r).map(|(k, r)| k * r).collect();
        let tension = self.harmonics.tension(&self.condensed_stresses(r).1);
        self.harmonics.add_force(&tension, r, &mut force);
        force
    }

    /// Hessian of [`Elasticity::condensed_energy`], K_b + 12 Q_eff r r (N/m), N_w x N_w, row-major.
    ///
    /// # Errors
    /// [`PhysicsError::Algebra`] if an entry overflows.
    pub fn condensed_hessian(&self, r: &[f64]) -> Result<Vec<f64>, PhysicsError> {
        let (size, in_plane) = (r.len(), self.in_plane_mass.len());
        let gradient = self.harmonics.strain_gradient(r);
        // J^T (W J)
        let mut stress = vec![0.0; gradient.len()];
        for w in &self.harmonics.weights {
            let of_row = &gradient[w.col * size..][..size];
            add_row(&mut stress[w.row * size..][..size], w.value, of_row);
        }
        let mut hessian =
            algebra::transpose_times(WHAT, self.harmonics.rows, size, &gradient, &stress)?;
        // X^T X with X = L^-1 C^T J
        let mut x = vec![0.0; in_plane * size];
        for c in &self.harmonics.in_plane {
            let of_row = &gradient[c.row * size..][..size];
            add_row(&mut x[c.col * size..][..size], c.value, of_row);
        }
        self.factor.half_solve(size, &mut x);
        let relief = algebra::transpose_times(WHAT, in_plane, size, &x, &x)?;
        add_row(&mut hessian, -1.0, &relief);
        let tension = self.harmonics.tension(&self.condensed_stresses(r).1);
        for (&(j, k), t) in self.harmonics.pairs.iter().zip(tension) {
            hessian[j * size + k] += t;
            if j != k {
                hessian[k * size + j] += t;
            }
        }
        for (j, bending) in self.bending.iter().enumerate() {
            hessian[j * size + j] += bending;
        }
        Ok(hessian)
    }

    /// E and N = W_eff E of a deflection.
    fn condensed_stresses(&self, r: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let e = self.harmonics.strains(r);
        let n = self.harmonics.stresses(&e, &self.in_plane_from_strains(&e));
        (e, n)
    }

    /// K^-1 (m/N), N_p x N_p, sorted by row, then column: p_i = -Σ K^-1_ik s_k. It has the blocks
    /// of K: 2 x 2 in the shear-free basis, four classes of parity in the fixed one.
    ///
    /// # Errors
    /// [`PhysicsError::Algebra`] if an entry overflows.
    pub(crate) fn in_plane_flexibility(&self) -> Result<Vec<Entry>, PhysicsError> {
        self.factor.inverse()
    }

    /// The condensed plate in harmonics of its own: 1/2 E.W E of the result is Q_eff r r r r, and
    /// its list `in_plane` is empty.
    ///
    /// In the shear-free basis W_eff couples the three strains of one harmonic only, and what the
    /// in-plane terms of a complete set cannot undo is one combination of them, but both means of
    /// w_x^2 and w_y^2: the amplitudes that Airy's function answers to in Levy (1942). They become
    /// the rows, a third of the former ones, and W is diagonal. In the fixed basis the rows stay and W_eff is full
    /// within each class of parity: (rows)^2/4 entries.
    ///
    /// # Errors
    /// [`PhysicsError::Algebra`] if an entry overflows.
    pub fn condensed_harmonics(&self) -> Result<Harmonics, PhysicsError> {
        let plate = &self.harmonics;
        let weights = self.condensed_weights()?;
        let weight_of_row = by_row(plate.rows, &weights);
        let strain_of_row = by_row(plate.rows, &plate.strain);
        let (mut rows, mut strain, mut kept) = (0, Vec::new(), Vec::new());
        for set in connected(&weight_of_row) {
            let dense = block(&set, &weight_of_row);
            if set.len() > FIELDS {
                for (position, &old) in set.iter().enumerate() {
                    let row = rows + position;
                    strain.extend(strain_of_row[old].iter().map(|&h| Entry { row, ..h }));
                }
                kept.extend(entries(rows, set.len(), &dense));
                rows += set.len();
                continue;
            }
            let largest = (0..set.len())
                .map(|i| dense[i * (set.len() + 1)])
                .fold(0.0, f64::max);
            for (value, vector) in algebra::eigenpairs(WHAT, set.len(), &dense)? {
                if value > ROUNDING * largest {
                    strain.extend(combination(rows, &set, &vector, &strain_of_row));
                    kept.extend(entries(rows, 1, &[value]));
                    rows += 1;
                }
            }
        }
        Ok(Harmonics {
            rows,
            pairs: plate.pairs.clone(),
            strain: sorted(strain),
            weights: sorted(kept),
            in_plane: Vec::new(),
        })
    }

    /// W_eff = W - C K^-1 C^T, sorted by row, then column, rounding left out.
    fn condensed_weights(&self) -> Result<Vec<Entry>, PhysicsError> {
        let mut own = vec![0.0; self.harmonics.rows];
        for w in self.harmonics.weights.iter().filter(|w| w.row == w.col) {
            own[w.row] = w.value;
        }
        let relief = self.factor.sandwich(&self.harmonics.in_plane)?;
        let mut parts = self.harmonics.weights.clone();
        parts.extend(relief.iter().map(|c| Entry {
            value: -c.value,
            ..*c
        }));
        parts.sort_by_key(|entry| (entry.row, entry.col));
        Ok(parts
            .chunk_by(|one, next| (one.row, one.col) == (next.row, next.col))
            .map(|same| Entry {
                value: same.iter().map(|part| part.value).sum(),
                ..same[0]
            })
            .filter(|w| w.value.abs() > ROUNDING * (own[w.row] * own[w.col]).sqrt())
            .collect())
    }

    /// Q_eff = Q - 1/2 sym(B K^-1 B): the quartic energy left when the in-plane terms follow
    /// statically. Sorted indices, nonzero entries only; equal to Q without in-plane terms.
    ///
    /// Cost: N_w^4/4 values and N_w^4 N_p/4 multiplications.
    ///
    /// # Errors
    /// [`PhysicsError::Modes`] for more than 64 w terms: use [`Elasticity::condensed_force`] or
    /// [`Elasticity::condensed_harmonics`]. [`PhysicsError::Algebra`] if the product overflows.
    pub fn condensed_quartic(&self) -> Result<Vec<QuarticTerm>, PhysicsError> {
        let (in_plane, transverse) = (self.in_plane_mass.len(), self.bending.len());
        if transverse > MAX_QUARTIC {
            return Err(PhysicsError::Modes {
                reason: format!(
                    "{transverse} w terms are too many to list the condensed quartic energy; at \
                     most {MAX_QUARTIC} are possible"
                ),
            });
        }
        lists::quartic(&self.harmonics, transverse, Some((in_plane, &self.factor)))
    }
}

/// y += factor x.
fn add_row(y: &mut [f64], factor: f64, x: &[f64]) {
    y.iter_mut().zip(x).for_each(|(y, x)| *y += factor * x);
}

/// The sets of rows that a symmetric matrix connects; rows without entries are in none.
fn connected(of_row: &[&[Entry]]) -> Vec<Vec<usize>> {
    let mut known = vec![false; of_row.len()];
    let mut sets = Vec::new();
    for start in 0..of_row.len() {
        if known[start] || of_row[start].is_empty() {
            continue;
        }
        known[start] = true;
        let mut set = vec![start];
        let mut next = 0;
        while let Some(&row) = set.get(next) {
            next += 1;
            for entry in of_row[row] {
                if !known[entry.col] {
                    known[entry.col] = true;
                    set.push(entry.col);
                }
            }
        }
        set.sort_unstable();
        sets.push(set);
    }
    sets
}

/// The matrix restricted to the rows and columns of `set`, row-major.
fn block(set: &[usize], of_row: &[&[Entry]]) -> Vec<f64> {
    let mut dense = vec![0.0; set.len() * set.len()];
    for (position, &row) in set.iter().enumerate() {
        for entry in of_row[row] {
            let col = set.partition_point(|&other| other < entry.col);
            dense[position * set.len() + col] = entry.value;
        }
    }
    dense
}

/// A dense `size` x `size` block on the diagonal, from row `first` on.
fn entries(first: usize, size: usize, dense: &[f64]) -> impl Iterator<Item = Entry> + '_ {
    dense.iter().enumerate().map(move |(at, &value)| Entry {
        row: first + at / size,
        col: first + at % size,
        value,
    })
}

/// The row Σ vector_i H_(set_i) as row number `row`.
fn combination(
    row: usize,
    set: &[usize],
    vector: &[f64],
    strain_of_row: &[&[Entry]],
) -> Vec<Entry> {
    let mut sums: BTreeMap<usize, Sum> = BTreeMap::new();
    for (&old, part) in set.iter().zip(vector) {
        for h in strain_of_row[old] {
            sums.entry(h.col).or_default().add(part * h.value);
        }
    }
    let entry = |(col, sum): (usize, Sum)| Entry {
        row,
        col,
        value: sum.get(),
    };
    sums.into_iter().map(entry).collect()
}
