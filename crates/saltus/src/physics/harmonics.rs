//! The membrane energy through harmonics of the strains: what keeps a plate with many terms cheap.
//!
//! The squares and products of slopes that w adds to the strains are short sums of harmonics
//! (product-to-sum). With P, Q = 0, 1, 2, ... half-waves along x and y,
//!
//! ```text
//! w_x^2/2 = Σ E_x,PQ cos(P pi x/a) cos(Q pi y/b)     w_y^2/2 = Σ E_y,PQ cos cos
//! w_x w_y = Σ E_g,PQ sin(P pi x/a) sin(Q pi y/b)
//! ```
//!
//! and every pair r_j r_k enters at most four harmonics of each. So with E the vector of all
//! amplitudes E_x, E_y, E_g,
//!
//! ```text
//! E = H (r r),    U_p = 1/2 p.K p + 1/2 r.K_b r + p.(C^T E) + 1/2 E.W E
//! ```
//!
//! where W is diagonal but for nu between E_x and E_y of the same harmonic, and C, the work of the
//! in-plane terms' stresses on the harmonics, has at most three entries per term in the shear-free
//! basis and some 3 max(Q)/2 in the fixed one, where sin(n pi y/b) meets every cos(Q pi y/b) of the
//! other parity. Nothing here grows faster than the number of pairs, N_w^2/2, while B and Q of
//! [`super::Elasticity`] have up to N_p N_w^2/2 and N_w^4/24 entries. They are
//! B_ijk = Σ C_row,i H_row,jk and Q_jklm = 1/2 sym(Σ H_row,jk W_row,col H_col,lm).

use super::in_plane::{membrane_strains, rectangle};
use super::shape::{Rectangle, Shape};
use super::trig::Trig::{Cos, Sin};
use super::{Mode, Plate};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

/// One nonzero entry of a matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// Row.
    pub row: usize,
    /// Column.
    pub col: usize,
    /// The entry.
    pub value: f64,
}

/// The matrices H, W and C of the module's equations, in SI units.
///
/// ```text
/// E_row   = Σ_(j<=k) multiplicity(j, k) H_row,jk r_j r_k     multiplicity: 1 if j = k, else 2
/// s_i     = Σ_row C_row,i E_row                              = B_ijk r_j r_k over all j, k
/// N_row   = Σ_col W_row,col E_col + Σ_i C_row,i p_i
/// T_jk    = 2 Σ_row H_row,jk N_row                           = 2 B_ijk p_i + 4 Q_jklm r_l r_m
/// force_j = Σ_k T_jk r_k                                     over all k, T symmetric
/// ```
///
/// N are the stresses that belong to E: force_j is dU/dr_j without bending. All lists are sorted by
/// row, then column, and hold no zeros.
#[derive(Clone, Debug, PartialEq)]
pub struct Harmonics {
    /// Number of strain amplitudes, the length of E.
    pub rows: usize,
    /// The pairs (j, k), j <= k, of w terms in the order of the columns of `strain`: pair (j, k) is
    /// number k (k + 1)/2 + j.
    pub pairs: Vec<(usize, usize)>,
    /// H (1/m^2), rows x pairs, without the multiplicity 2 of pairs j < k.
    pub strain: Vec<Entry>,
    /// W (J), rows x rows, symmetric, both triangles listed: 1/2 E.W E is half the sum over all
    /// entries of value E_row E_col.
    pub weights: Vec<Entry>,
    /// C (N), rows x N_p.
    pub in_plane: Vec<Entry>,
}

/// Multiply-adds of one evaluation of all T_jk from the products r_j r_k (and p), by each way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Work {
    /// Through the harmonics: E, W E and T.
    pub harmonics: usize,
    /// Additions of the in-plane amplitudes to that: C^T E and C p.
    pub in_plane: usize,
    /// Directly, as a pairs x pairs matrix, at most: Q_jklm vanishes unless m_j + m_k + m_l + m_m
    /// is even, and likewise along y.
    pub direct: usize,
}

/// Number of the pair j <= k.
pub(super) fn pair(j: usize, k: usize) -> usize {
    k * (k + 1) / 2 + j
}

/// Occurrences of r_j r_k in a sum over all j, k.
pub(super) fn multiplicity(j: usize, k: usize) -> f64 {
    if j == k { 1.0 } else { 2.0 }
}

/// Components of the strain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Field {
    X,
    Y,
    Shear,
}

/// (field, P, Q).
type Row = (Field, u32, u32);

impl Harmonics {
    /// Cost: 6 N_w^2 strain entries and 2 N_p x rows exact integrals of two factors.
    pub(super) fn new(plate: &Plate) -> Self {
        let w = &plate.modes.w;
        let pairs: Vec<(usize, usize)> = (0..w.len())
            .flat_map(|k| (0..=k).map(move |j| (j, k)))
            .collect();
        let on = rectangle(plate);
        let entries: Vec<(Row, usize, f64)> = pairs
            .iter()
            .enumerate()
            .flat_map(|(col, &(j, k))| {
                strains_of_pair(on, w[j], w[k])
                    .into_iter()
                    .map(move |(row, value)| (row, col, value))
            })
            .collect();
        let used: BTreeSet<Row> = entries.iter().map(|entry| entry.0).collect();
        let rows: Vec<Row> = used.into_iter().collect();
        let number: BTreeMap<Row, usize> = rows.iter().copied().zip(0..).collect();
        let strain = entries.into_iter().map(|(row, col, value)| Entry {
            row: number[&row],
            col,
            value,
        });
        Self {
            rows: rows.len(),
            pairs,
            strain: sorted(strain.collect()),
            weights: weights(plate, &rows, &number),
            in_plane: in_plane(plate, &rows),
        }
    }

    /// Are all entries finite, and every Q_jjjj = 1/2 E.W E of r_j = 1 m alone finite and positive?
    pub(super) fn is_sound(&self) -> bool {
        let mut alone = vec![Vec::new(); self.pairs.len()];
        for h in &self.strain {
            let (j, k) = self.pairs[h.col];
            if j == k {
                alone[h.col].push((h.row, h.value));
            }
        }
        let quartic = |alone: &Vec<(usize, f64)>| {
            let mut e = vec![0.0; self.rows];
            alone.iter().for_each(|&(row, value)| e[row] = value);
            let energy = |w: &Entry| 0.5 * w.value * e[w.row] * e[w.col];
            self.weights.iter().map(energy).sum::<f64>()
        };
        let lists = [&self.strain, &self.weights, &self.in_plane];
        lists
            .into_iter()
            .flatten()
            .all(|entry| entry.value.is_finite())
            && alone
                .iter()
                .filter(|alone| !alone.is_empty())
                .map(quartic)
                .all(|q| q > 0.0 && q.is_finite())
    }

    /// E (-), one amplitude per row, of the transverse amplitudes `r` (m, N_w).
    pub fn strains(&self, r: &[f64]) -> Vec<f64> {
        let products: Vec<f64> = self
            .pairs
            .iter()
            .map(|&(j, k)| multiplicity(j, k) * r[j] * r[k])
            .collect();
        times(self.rows, &self.strain, &products)
    }

    /// C^T E (N), the load of the strains `e` on the in-plane terms: s_i = B_ijk r_j r_k. Length
    /// `in_plane` terms, N_p.
    pub(super) fn load_on_in_plane(&self, e: &[f64], in_plane: usize) -> Vec<f64> {
        transpose_times(in_plane, &self.in_plane, e)
    }

    /// N = W E + C p (J), one stress per row, for the strains `e` (rows) and in-plane amplitudes
    /// `p` (m, N_p).
    pub(super) fn stresses(&self, e: &[f64], p: &[f64]) -> Vec<f64> {
        let own = times(self.rows, &self.weights, e);
        let in_plane = times(self.rows, &self.in_plane, p);
        own.iter().zip(in_plane).map(|(w, c)| w + c).collect()
    }

    /// T_jk = 2 Σ_row H_row,jk N_row (N/m), one per pair, for the stresses `n` (J, rows).
    pub fn tension(&self, n: &[f64]) -> Vec<f64> {
        let mut tension = transpose_times(self.pairs.len(), &self.strain, n);
        tension.iter_mut().for_each(|t| *t *= 2.0);
        tension
    }

    /// Adds force_j = Σ_k T_jk r_k (N) to `force` (N_w).
    pub(super) fn add_force(&self, tension: &[f64], r: &[f64], force: &mut [f64]) {
        for (&(j, k), t) in self.pairs.iter().zip(tension) {
            force[j] += t * r[k];
            if j != k {
                force[k] += t * r[j];
            }
        }
    }

    /// dE_row/dr_j = 2 Σ_k H_row,jk r_k (1/m), rows x N_w, row-major.
    pub(super) fn strain_gradient(&self, r: &[f64]) -> Vec<f64> {
        let size = r.len();
        let mut gradient = vec![0.0; self.rows * size];
        for entry in &self.strain {
            let (j, k) = self.pairs[entry.col];
            gradient[entry.row * size + j] += 2.0 * entry.value * r[k];
            if j != k {
                gradient[entry.row * size + k] += 2.0 * entry.value * r[j];
            }
        }
        gradient
    }

    /// What an evaluation costs through the harmonics and without them; O(pairs).
    pub fn work(&self, w: &[Mode]) -> Work {
        let mut of_parity = [0_usize; 4];
        for &(j, k) in &self.pairs {
            let (m, n) = (w[j].m + w[k].m, w[j].n + w[k].n);
            of_parity[(m % 2 + 2 * (n % 2)) as usize] += 1;
        }
        Work {
            harmonics: 2 * self.strain.len() + self.weights.len(),
            in_plane: 2 * self.in_plane.len(),
            direct: of_parity.iter().map(|count| count * count).sum(),
        }
    }
}

/// H_row,jk for the w terms `one` and `other`: the amplitudes of r_j r_k, symmetric in j and k,
/// with A = pi m/a and B = pi n/b,
///
/// ```text
/// w_x^2/2: A_j A_k/8 (cos M- + cos M+) (cos N- - cos N+)
/// w_y^2/2: B_j B_k/8 (cos M- - cos M+) (cos N- + cos N+)
/// w_x w_y: (A_j B_k + A_k B_j)/8 (sin M+ sin N+ - sin M- sin N-)
///        + (A_j B_k - A_k B_j)/8 (sin M- sin N+ - sin M+ sin N-)
/// M+- = m_k +- m_j,  N+- = n_k +- n_j
/// ```
fn strains_of_pair(on: Rectangle, one: Mode, other: Mode) -> Vec<(Row, f64)> {
    let (mj, nj, mk, nk) = (
        i64::from(one.m),
        i64::from(one.n),
        i64::from(other.m),
        i64::from(other.n),
    );
    let (m_sum, n_sum) = (one.m + other.m, one.n + other.n);
    let (m_gap, n_gap) = (one.m.abs_diff(other.m), one.n.abs_diff(other.n));
    // sin(-k x) = -sin(k x)
    let (m_sign, n_sign) = ((mk - mj).signum(), (nk - nj).signum());
    let (even, odd) = (mj * nk + mk * nj, mj * nk - mk * nj);
    let unit = PI.powi(2) / 8.0;
    let x = unit / on.length.powi(2);
    let y = unit / on.width.powi(2);
    let shear = unit / (on.length * on.width);
    // whole numbers, so that what cancels is exactly zero
    [
        (Field::X, m_gap, n_gap, x, mj * mk),
        (Field::X, m_gap, n_sum, x, -mj * mk),
        (Field::X, m_sum, n_gap, x, mj * mk),
        (Field::X, m_sum, n_sum, x, -mj * mk),
        (Field::Y, m_gap, n_gap, y, nj * nk),
        (Field::Y, m_gap, n_sum, y, nj * nk),
        (Field::Y, m_sum, n_gap, y, -nj * nk),
        (Field::Y, m_sum, n_sum, y, -nj * nk),
        (Field::Shear, m_sum, n_sum, shear, even),
        (Field::Shear, m_gap, n_gap, shear, -m_sign * n_sign * even),
        (Field::Shear, m_gap, n_sum, shear, m_sign * odd),
        (Field::Shear, m_sum, n_gap, shear, -n_sign * odd),
    ]
    .into_iter()
    .filter(|&(.., whole)| whole != 0)
    .map(|(field, p, q, unit, whole)| ((field, p, q), unit * whole as f64))
    .collect()
}

/// The function whose amplitude is E_row.
fn shape((field, p, q): Row) -> Shape {
    match field {
        Field::X | Field::Y => Shape::new(Cos(p), Cos(q)),
        Field::Shear => Shape::new(Sin(p), Sin(q)),
    }
}

/// W: C ∫ e_x^2 + e_y^2 + 2 nu e_x e_y + (1-nu)/2 g^2 = E.W E (J).
fn weights(plate: &Plate, rows: &[Row], number: &BTreeMap<Row, usize>) -> Vec<Entry> {
    let (c, nu) = (plate.extensional_stiffness(), plate.poisson_ratio);
    let on = rectangle(plate);
    let mut entries = Vec::new();
    for (row, &(field, p, q)) in rows.iter().enumerate() {
        let norm = on.integral([shape(rows[row]); 2]);
        let (own, across) = match field {
            Field::X => (c * norm, Some(Field::Y)),
            Field::Y => (c * norm, Some(Field::X)),
            Field::Shear => (c * (1.0 - nu) / 2.0 * norm, None),
        };
        entries.push(Entry {
            row,
            col: row,
            value: own,
        });
        let col = across.and_then(|across| number.get(&(across, p, q)));
        entries.extend(col.map(|&col| Entry {
            row,
            col,
            value: nu * own,
        }));
    }
    sorted(entries)
}

/// C_row,i = C ∫ shape_row (e_xi + nu e_yi), (e_yi + nu e_xi) or (1-nu)/2 g_i (N), with the strains
/// of a unit amplitude of the in-plane term i.
fn in_plane(plate: &Plate, rows: &[Row]) -> Vec<Entry> {
    let (c, nu) = (plate.extensional_stiffness(), plate.poisson_ratio);
    let on = rectangle(plate);
    let strains = membrane_strains(plate);
    let mut entries = Vec::new();
    for (row, &(field, ..)) in rows.iter().enumerate() {
        let shape = shape(rows[row]);
        for (col, e) in strains.iter().enumerate() {
            let integral = |strain| on.integral([strain, shape]);
            let value = match field {
                Field::X => c * (integral(e.x) + nu * integral(e.y)),
                Field::Y => c * (integral(e.y) + nu * integral(e.x)),
                Field::Shear => c * (1.0 - nu) / 2.0 * integral(e.shear),
            };
            if value != 0.0 {
                entries.push(Entry { row, col, value });
            }
        }
    }
    entries
}

/// By row, then column, zeros left out.
pub(super) fn sorted(mut entries: Vec<Entry>) -> Vec<Entry> {
    entries.retain(|entry| entry.value != 0.0);
    entries.sort_unstable_by_key(|entry| (entry.row, entry.col));
    entries.shrink_to_fit();
    entries
}

/// A x for A with `rows` rows.
fn times(rows: usize, a: &[Entry], x: &[f64]) -> Vec<f64> {
    let mut y = vec![0.0; rows];
    for entry in a {
        y[entry.row] += entry.value * x[entry.col];
    }
    y
}

/// A^T x for A with `cols` columns.
fn transpose_times(cols: usize, a: &[Entry], x: &[f64]) -> Vec<f64> {
    let mut y = vec![0.0; cols];
    for entry in a {
        y[entry.col] += entry.value * x[entry.row];
    }
    y
}

/// The entries of each row of a list sorted by row.
pub(super) fn by_row(rows: usize, entries: &[Entry]) -> Vec<&[Entry]> {
    let mut of_row = vec![&entries[..0]; rows];
    for run in entries.chunk_by(|one, next| one.row == next.row) {
        of_row[run[0].row] = run;
    }
    of_row
}
