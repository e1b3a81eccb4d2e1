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
//! full sum. Energies and forces go through the strain harmonics ([`Harmonics`]) and need no lists.

use super::factor::Factor;
use super::{CouplingTerm, Harmonics, PhysicsError, Plate, QuarticTerm, in_plane, lists};

/// More w terms than this and even pairs of them, strain by strain, no longer make sense.
const MAX_TRANSVERSE: usize = 400;
/// More in-plane terms than this and the dense K no longer makes sense.
const MAX_IN_PLANE: usize = 4096;

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
    /// Nonzero B_ijk with j <= k, sorted by i, j, k; empty above [`Elasticity::MAX_LISTED`] w terms.
    pub coupling: Vec<CouplingTerm>,
    /// Nonzero Q_jklm with j <= k <= l <= m, sorted; empty above [`Elasticity::MAX_LISTED`] w terms.
    pub quartic: Vec<QuarticTerm>,
    /// B and Q through the harmonics of the strains, for any number of terms.
    pub harmonics: Harmonics,
    /// G_j = rho h ∫ psi_j = 16 M/(pi^2 m n) (kg) for odd m and n, else 0; length N_w.
    /// The base acceleration times G_j is the inertial load on r_j.
    pub base_load: Vec<f64>,
    /// K by its Cholesky factors.
    pub(super) factor: Factor,
}

impl Plate {
    /// Computes all coefficients by exact integration.
    ///
    /// Cost: N_p^2 + N_p rows integrals, 6 N_w^2 strain entries and the Cholesky factorization of
    /// K's blocks; 100 w terms with their complete in-plane set take a fraction of a second. Up to
    /// [`Elasticity::MAX_LISTED`] w terms the lists of B and Q are written out besides.
    ///
    /// # Errors
    /// Those of [`Plate::check`]; [`PhysicsError::Modes`] for more than 400 w or 4096 in-plane
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
        let membrane = in_plane::membrane(self);
        let harmonics = Harmonics::new(self);
        if !harmonics.is_sound() || !is_sound(in_plane, &membrane) {
            return Err(self.overflow());
        }
        let (mut coupling, mut quartic) = (Vec::new(), Vec::new());
        if transverse <= Elasticity::MAX_LISTED {
            coupling = lists::coupling(&harmonics, in_plane);
            quartic = lists::quartic(&harmonics, transverse, None)?;
        }
        Ok(Elasticity {
            transverse_mass: self.modal_mass(),
            in_plane_mass: in_plane::in_plane_mass(self),
            damping: self.damping(),
            first_omega: self.first_omega(),
            bending: self.bending_stiffness(),
            factor: Factor::new(in_plane, &membrane)?,
            membrane,
            coupling,
            quartic,
            harmonics,
            base_load: self.base_load(),
        })
    }
}

impl Elasticity {
    /// Up to this many w terms the lists `coupling` and `quartic` are written out. Beyond, their
    /// N_p N_w^2/2 and N_w^4/24 entries cost more than they are worth; see
    /// [`Elasticity::harmonics`].
    pub const MAX_LISTED: usize = 16;

    /// K_ik (N/m).
    ///
    /// # Panics
    /// If an index is not below N_p.
    pub fn membrane_at(&self, i: usize, k: usize) -> f64 {
        self.membrane[i * self.in_plane_mass.len() + k]
    }

    /// Elastic energy U_p (J) for in-plane amplitudes `p` (m, N_p) and transverse `r` (m, N_w).
    pub fn strain_energy(&self, p: &[f64], r: &[f64]) -> f64 {
        let membrane = 0.5 * dot(p, &self.membrane_times(p));
        // p.(C^T E) + 1/2 E.W E = E.(C p + W E/2)
        let e = self.harmonics.strains(r);
        let half: Vec<f64> = e.iter().map(|e| 0.5 * e).collect();
        let stretching = dot(&e, &self.harmonics.stresses(&half, p));
        membrane + self.bending_energy(r) + stretching
    }

    /// Gradient of [`Elasticity::strain_energy`] (N): (dU/dp, dU/dr), lengths N_p and N_w.
    pub fn elastic_force(&self, p: &[f64], r: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let e = self.harmonics.strains(r);
        // K p + C^T E, which is K p + B r r
        let load = self.harmonics.load_on_in_plane(&e, p.len());
        let on_p = self
            .membrane_times(p)
            .iter()
            .zip(load)
            .map(|(kp, s)| kp + s)
            .collect();
        // K_b r + T r, which is K_b r + 2 B p r + 4 Q r r r
        let mut on_r: Vec<f64> = self.bending.iter().zip(r).map(|(k, r)| k * r).collect();
        let tension = self.harmonics.tension(&self.harmonics.stresses(&e, p));
        self.harmonics.add_force(&tension, r, &mut on_r);
        (on_p, on_r)
    }

    /// The in-plane amplitudes (m, N_p) in static equilibrium with `r` (m, N_w): p = -K^-1 B r r.
    pub fn in_plane_from_transverse(&self, r: &[f64]) -> Vec<f64> {
        self.in_plane_from_strains(&self.harmonics.strains(r))
    }

    /// p = -K^-1 C^T E (m, N_p) for the strains `e` of a deflection.
    pub(super) fn in_plane_from_strains(&self, e: &[f64]) -> Vec<f64> {
        let load = self.harmonics.load_on_in_plane(e, self.in_plane_mass.len());
        let mut p = self.factor.solve(&load);
        p.iter_mut().for_each(|p| *p = -*p);
        p
    }

    /// 1/2 r.K_b r (J).
    pub(super) fn bending_energy(&self, r: &[f64]) -> f64 {
        self.bending
            .iter()
            .zip(r)
            .map(|(k, r)| 0.5 * k * r * r)
            .sum()
    }

    /// K p (N).
    fn membrane_times(&self, p: &[f64]) -> Vec<f64> {
        let rows = self.membrane.chunks_exact(p.len().max(1));
        rows.map(|row| dot(row, p)).collect()
    }
}

/// Is K finite with a positive diagonal?
fn is_sound(size: usize, membrane: &[f64]) -> bool {
    membrane.iter().all(|value| value.is_finite())
        && (0..size).all(|i| membrane[i * size + i] > 0.0)
}

/// Σ a_i b_i.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::{InPlaneBasis, ModeSet};

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
        let modes = ModeSet::complete(21, 20, InPlaneBasis::Fixed);
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
