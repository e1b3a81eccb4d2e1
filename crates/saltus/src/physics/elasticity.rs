//! Everything the plate brings to the equations of motion, computed once. DP Eqs. (1)-(5), (9).
//!
//! With p the in-plane amplitudes (u first, then v) and r the transverse ones, the elastic energy
//! is
//!
//! ```text
//! U_p = 1/2 p.K p + 1/2 r.K_b r + Σ_ijk B_ijk p_i r_j r_k + Σ_jklm Q_jklm r_j r_k r_l r_m,
//! ```
//!
//! the sums running over *all* index values, B symmetric in jk and Q in all four indices. The
//! sparse lists hold one entry per set of indices; `multiplicity` says how often it occurs in the
//! full sum.

use super::{PhysicsError, Plate, algebra, tensors};

/// More w terms than this and the N^4/24 entries of Q no longer make sense.
const MAX_TRANSVERSE: usize = 64;
/// More in-plane terms than this and the dense K no longer makes sense.
const MAX_IN_PLANE: usize = 2048;

/// Inertia, damping and elastic coefficients of a plate, in SI units.
///
/// N_p = `in_plane_mass.len()` counts the in-plane terms (u first, then v, in the order of
/// [`super::ModeSet`]), N_w = `bending.len()` the transverse ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Elasticity {
    /// Modal mass of every w term, M = rho h a b/4 (kg).
    pub transverse_mass: f64,
    /// Modal masses of the in-plane terms (kg), length N_p: M, or 2 M where a cosine has index 0.
    pub in_plane_mass: Vec<f64>,
    /// Damping rate c = 2 zeta_p omega_11 (1/s): the damping force on a coordinate is c times its
    /// momentum.
    pub damping: f64,
    /// omega_11, natural frequency of the half-wave (1, 1) (rad/s), whether or not w holds it.
    pub first_omega: f64,
    /// Diagonal of K_b (N/m), length N_w.
    pub bending: Vec<f64>,
    /// K (N/m), N_p x N_p, symmetric, row-major; see [`Elasticity::membrane_at`].
    pub membrane: Vec<f64>,
    /// Nonzero B_ijk with j <= k, sorted by i, j, k.
    pub coupling: Vec<CouplingTerm>,
    /// Nonzero Q_jklm with j <= k <= l <= m, sorted.
    pub quartic: Vec<QuarticTerm>,
    /// G_j = rho h ∫ psi_j = 16 M/(pi^2 m n) (kg) for odd m and n, else 0; length N_w.
    /// The base acceleration times G_j is the inertial load on r_j.
    pub base_load: Vec<f64>,
    /// K^-1 B, N_p x pairs(jk), row-major.
    response: Vec<f64>,
}

/// One independent entry of B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CouplingTerm {
    /// In-plane index, 0..N_p.
    pub i: usize,
    /// Transverse index.
    pub j: usize,
    /// Transverse index, j <= k.
    pub k: usize,
    /// B_ijk itself (N/m^2). For j < k the energy holds it twice, as B_ijk and B_ikj.
    pub value: f64,
}

/// One independent entry of Q (or of the condensed Q).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuarticTerm {
    /// Smallest index.
    pub j: usize,
    /// Second index.
    pub k: usize,
    /// Third index.
    pub l: usize,
    /// Largest index.
    pub m: usize,
    /// Q_jklm itself (N/m^3). The energy holds it once per distinct order of its indices.
    pub value: f64,
}

impl CouplingTerm {
    /// How often the entry occurs in the full sum: 1 if j = k, else 2.
    pub fn multiplicity(&self) -> f64 {
        if self.j == self.k { 1.0 } else { 2.0 }
    }
}

impl QuarticTerm {
    /// How often the entry occurs in the full sum: the number of distinct orders of (j, k, l, m).
    pub fn multiplicity(&self) -> f64 {
        // 4!/(product of the factorials of the lengths of runs of equal indices)
        let indices = self.indices();
        let (mut orders, mut run) = (24, 1);
        for pair in indices.windows(2) {
            run = if pair[0] == pair[1] { run + 1 } else { 1 };
            orders /= run;
        }
        f64::from(orders)
    }

    /// (j, k, l, m) as an array.
    pub fn indices(&self) -> [usize; 4] {
        [self.j, self.k, self.l, self.m]
    }
}

/// Position of the pair j <= k among all pairs.
fn pair(j: usize, k: usize) -> usize {
    k * (k + 1) / 2 + j
}

impl Plate {
    /// Computes all coefficients by exact integration.
    ///
    /// Cost: N_w^4/24 + N_p N_w^2/2 exact integrals and a Cholesky factorization of size N_p; 16 w
    /// terms with their complete in-plane set take milliseconds.
    ///
    /// # Errors
    /// Those of [`Plate::check`]; [`PhysicsError::Modes`] for more than 64 w or 2048 in-plane
    /// terms; [`PhysicsError::Algebra`] if a coefficient overflows or vanishes, or K is not
    /// positive definite.
    pub fn elasticity(&self) -> Result<Elasticity, PhysicsError> {
        self.check()?;
        let (transverse, in_plane) = (self.modes.w.len(), self.modes.u.len() + self.modes.v.len());
        if transverse > MAX_TRANSVERSE || in_plane > MAX_IN_PLANE {
            return Err(PhysicsError::Modes {
                reason: format!(
                    "{transverse} w and {in_plane} in-plane terms are too many for the nonlinear \
                     plate; at most {MAX_TRANSVERSE} and {MAX_IN_PLANE} are possible"
                ),
            });
        }
        let mut elasticity = Elasticity {
            transverse_mass: self.modal_mass(),
            in_plane_mass: tensors::in_plane_mass(self),
            damping: self.damping(),
            first_omega: self.first_omega(),
            bending: self.bending_stiffness(),
            membrane: tensors::membrane(self),
            coupling: tensors::coupling(self),
            quartic: tensors::quartic(self),
            base_load: self.base_load(),
            response: Vec::new(),
        };
        if !elasticity.is_sound() {
            return Err(self.overflow());
        }
        elasticity.response = algebra::solve_positive_definite(
            "in-plane response to deflection",
            in_plane,
            &elasticity.membrane,
            pair(0, transverse),
            &elasticity.dense_coupling(),
        )?;
        Ok(elasticity)
    }
}

impl Elasticity {
    /// K_ik (N/m).
    ///
    /// # Panics
    /// If an index is not below N_p.
    pub fn membrane_at(&self, i: usize, k: usize) -> f64 {
        self.membrane[i * self.in_plane_mass.len() + k]
    }

    /// Elastic energy U_p (J) for in-plane amplitudes `p` (m, N_p) and transverse `r` (m, N_w).
    pub fn strain_energy(&self, p: &[f64], r: &[f64]) -> f64 {
        let n = p.len();
        let membrane: f64 = (0..n)
            .map(|i| {
                (0..n)
                    .map(|k| 0.5 * p[i] * self.membrane_at(i, k) * p[k])
                    .sum::<f64>()
            })
            .sum();
        let bending: f64 = self
            .bending
            .iter()
            .zip(r)
            .map(|(k, r)| 0.5 * k * r * r)
            .sum();
        let coupling: f64 = self
            .coupling
            .iter()
            .map(|b| b.multiplicity() * b.value * p[b.i] * r[b.j] * r[b.k])
            .sum();
        membrane + bending + coupling + quartic_energy(&self.quartic, r)
    }

    /// Gradient of [`Elasticity::strain_energy`] (N): (dU/dp, dU/dr), lengths N_p and N_w.
    pub fn elastic_force(&self, p: &[f64], r: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let n = p.len();
        // K p + B r r
        let mut on_p: Vec<f64> = (0..n)
            .map(|i| (0..n).map(|k| self.membrane_at(i, k) * p[k]).sum())
            .collect();
        // K_b r + 2 B p r + 4 Q r r r
        let mut on_r: Vec<f64> = self.bending.iter().zip(r).map(|(k, r)| k * r).collect();
        for b in &self.coupling {
            let weight = b.multiplicity() * b.value;
            on_p[b.i] += weight * r[b.j] * r[b.k];
            on_r[b.j] += weight * p[b.i] * r[b.k];
            on_r[b.k] += weight * p[b.i] * r[b.j];
        }
        add_quartic_force(&self.quartic, r, &mut on_r);
        (on_p, on_r)
    }

    /// The in-plane amplitudes (m, N_p) in static equilibrium with `r` (m, N_w): p = -K^-1 B r r.
    pub fn in_plane_from_transverse(&self, r: &[f64]) -> Vec<f64> {
        let pairs = pair(0, self.bending.len());
        let mut p = vec![0.0; self.in_plane_mass.len()];
        for (i, p) in p.iter_mut().enumerate() {
            for k in 0..r.len() {
                for j in 0..=k {
                    let multiplicity = if j == k { 1.0 } else { 2.0 };
                    *p -= multiplicity * self.response[i * pairs + pair(j, k)] * r[j] * r[k];
                }
            }
        }
        p
    }

    /// Q_eff = Q - 1/2 sym(B K^-1 B): the quartic energy left when the in-plane terms follow
    /// statically. Sorted indices, nonzero entries only; equal to Q without in-plane terms.
    ///
    /// # Errors
    /// [`PhysicsError::Algebra`] if the product overflows.
    pub fn condensed_quartic(&self) -> Result<Vec<QuarticTerm>, PhysicsError> {
        let (in_plane, transverse) = (self.in_plane_mass.len(), self.bending.len());
        if in_plane == 0 {
            return Ok(self.quartic.clone());
        }
        let pairs = pair(0, transverse);
        let relief = algebra::transpose_times(
            "condensed plate stiffness",
            in_plane,
            pairs,
            &self.dense_coupling(),
            &self.response,
        )?;
        let relief = |j: usize, k: usize, l: usize, m: usize| {
            let pair = |a: usize, b: usize| pair(a.min(b), a.max(b));
            relief[pair(j, k) * pairs + pair(l, m)]
        };
        // Hoelder's bound |Q_jklm|^4 <= Q_jjjj Q_kkkk Q_llll Q_mmmm sets the scale of rounding
        let mut size = vec![0.0; transverse];
        for q in self.quartic.iter().filter(|q| q.j == q.m) {
            size[q.j] = q.value.powf(0.25);
        }
        let mut known = self.quartic.iter().peekable();
        let mut terms = Vec::new();
        tensors::for_each_sorted_quadruple(transverse, |[j, k, l, m]| {
            let q = known
                .next_if(|q| q.indices() == [j, k, l, m])
                .map_or(0.0, |q| q.value);
            let value = q - (relief(j, k, l, m) + relief(j, l, k, m) + relief(j, m, k, l)) / 6.0;
            if value.abs() > 1e-13 * size[j] * size[k] * size[l] * size[m] {
                terms.push(QuarticTerm { j, k, l, m, value });
            }
        });
        Ok(terms)
    }

    /// B as a dense N_p x pairs(jk) matrix, row-major.
    fn dense_coupling(&self) -> Vec<f64> {
        let pairs = pair(0, self.bending.len());
        let mut dense = vec![0.0; self.in_plane_mass.len() * pairs];
        for b in &self.coupling {
            dense[b.i * pairs + pair(b.j, b.k)] = b.value;
        }
        dense
    }

    /// Are all coefficients finite, and those that must be positive so?
    fn is_sound(&self) -> bool {
        let diagonal = (0..self.in_plane_mass.len()).map(|i| self.membrane_at(i, i));
        let pure = self.quartic.iter().filter(|q| q.j == q.m).map(|q| q.value);
        let couplings = self.coupling.iter().map(|b| b.value);
        let quartics = self.quartic.iter().map(|q| q.value);
        diagonal.chain(pure).all(|value| value > 0.0)
            && self
                .membrane
                .iter()
                .copied()
                .chain(couplings)
                .chain(quartics)
                .all(f64::is_finite)
    }
}

/// Σ Q r r r r over all index values (J).
pub(super) fn quartic_energy(terms: &[QuarticTerm], r: &[f64]) -> f64 {
    let term = |q: &QuarticTerm| q.multiplicity() * q.value * r[q.j] * r[q.k] * r[q.l] * r[q.m];
    terms.iter().map(term).sum()
}

/// Adds 4 Q r r r, the gradient of [`quartic_energy`], to `force` (N).
pub(super) fn add_quartic_force(terms: &[QuarticTerm], r: &[f64], force: &mut [f64]) {
    for q in terms {
        let weight = q.multiplicity() * q.value;
        let [rj, rk, rl, rm] = q.indices().map(|index| r[index]);
        force[q.j] += weight * rk * rl * rm;
        force[q.k] += weight * rj * rl * rm;
        force[q.l] += weight * rj * rk * rm;
        force[q.m] += weight * rj * rk * rl;
    }
}

/// Adds 12 Q r r, the Hessian of [`quartic_energy`], to the row-major `hessian` (N/m).
pub(super) fn add_quartic_hessian(terms: &[QuarticTerm], r: &[f64], hessian: &mut [f64]) {
    let size = r.len();
    for q in terms {
        let weight = q.multiplicity() * q.value;
        let at = q.indices();
        for first in 0..4 {
            for second in (0..4).filter(|&second| second != first) {
                let rest = (0..4).filter(|&other| other != first && other != second);
                let product: f64 = rest.map(|other| r[at[other]]).product();
                hessian[at[first] * size + at[second]] += weight * product;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::{InPlaneBasis, ModeSet};

    #[test]
    fn multiplicities_count_all_orders() {
        for (indices, orders) in [
            ([0, 0, 0, 0], 1.0),
            ([0, 0, 0, 1], 4.0),
            ([0, 1, 1, 1], 4.0),
            ([0, 0, 1, 1], 6.0),
            ([0, 1, 1, 2], 12.0),
            ([0, 1, 2, 2], 12.0),
            ([0, 1, 2, 3], 24.0),
        ] {
            let [j, k, l, m] = indices;
            assert_eq!(
                QuarticTerm {
                    j,
                    k,
                    l,
                    m,
                    value: 1.0
                }
                .multiplicity(),
                orders,
                "{indices:?}"
            );
        }
    }

    #[test]
    fn damping_follows_the_half_wave_11_even_if_w_lacks_it() {
        let mut plate = Plate::dias_del_prado();
        plate.modes.w.remove(0);
        let elasticity = plate.elasticity().expect("a valid plate");
        assert_eq!(
            elasticity.first_omega,
            Plate::dias_del_prado().first_omega()
        );
        assert_eq!(elasticity.damping, 0.04 * elasticity.first_omega);
    }

    #[test]
    fn too_many_terms_are_refused_before_they_cost_anything() {
        let modes = ModeSet::complete(9, 9, InPlaneBasis::Fixed);
        let plate = Plate {
            modes,
            ..Plate::dias_del_prado()
        };
        assert!(matches!(
            plate.elasticity(),
            Err(PhysicsError::Modes { .. })
        ));
    }
}
