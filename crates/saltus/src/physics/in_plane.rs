//! Strains, masses and stiffness K of the in-plane terms, exactly integrated.
//! DP Eqs. (1)-(3).
//!
//! With C = E h/(1-nu^2), e_x = u_x + w_x^2/2, e_y = v_y + w_y^2/2, g = u_y + v_x + w_x w_y, the
//! membrane energy C/2 ∫ e_x^2 + e_y^2 + 2 nu e_x e_y + (1-nu)/2 g^2 splits by powers of w into the
//! tensors K (none), B (two) and Q (four). `harmonics.rs` holds the other two.

use super::shape::{Rectangle, Shape};
use super::trig::Trig::{Cos, Sin};
use super::{InPlaneBasis, Mode, Plate};

/// Contribution of a unit amplitude of an in-plane term to e_x, e_y and g.
#[derive(Clone, Copy)]
pub(super) struct MembraneStrain {
    pub(super) x: Shape,
    pub(super) y: Shape,
    pub(super) shear: Shape,
}

/// A sum that knows how large its terms were, so that rounding is not taken for a value.
#[derive(Clone, Copy, Default)]
pub(super) struct Sum {
    value: f64,
    magnitude: f64,
}

impl Sum {
    pub(super) fn add(&mut self, term: f64) {
        self.value += term;
        self.magnitude += term.abs();
    }

    /// The sum; zero if it is no larger than the rounding of its (at most 12) terms.
    pub(super) fn get(self) -> f64 {
        if self.value.abs() <= 1e-14 * self.magnitude {
            0.0
        } else {
            self.value
        }
    }
}

pub(super) fn rectangle(plate: &Plate) -> Rectangle {
    Rectangle {
        length: plate.length,
        width: plate.width,
    }
}

/// Strains of all in-plane terms, u first.
pub(super) fn membrane_strains(plate: &Plate) -> Vec<MembraneStrain> {
    let on = rectangle(plate);
    let u = plate.modes.u.iter().map(|&Mode { m, n }| {
        let u = match plate.basis {
            InPlaneBasis::Fixed => Shape::new(Sin(m), Sin(n)),
            InPlaneBasis::ShearFree => Shape::new(Sin(m), Cos(n)),
        };
        MembraneStrain {
            x: on.d_dx(u),
            y: Shape::ZERO,
            shear: on.d_dy(u),
        }
    });
    let v = plate.modes.v.iter().map(|&Mode { m, n }| {
        let v = match plate.basis {
            InPlaneBasis::Fixed => Shape::new(Sin(m), Sin(n)),
            InPlaneBasis::ShearFree => Shape::new(Cos(m), Sin(n)),
        };
        MembraneStrain {
            x: Shape::ZERO,
            y: on.d_dy(v),
            shear: on.d_dx(v),
        }
    });
    u.chain(v).collect()
}

/// Modal masses of the in-plane terms (kg), u first: rho h ∫ shape^2. A cosine of index 0 doubles
/// it.
pub(super) fn in_plane_mass(plate: &Plate) -> Vec<f64> {
    let mass = |cosine_index: u32| {
        let flat = plate.basis == InPlaneBasis::ShearFree && cosine_index == 0;
        plate.modal_mass() * if flat { 2.0 } else { 1.0 }
    };
    let u = plate.modes.u.iter().map(|mode| mass(mode.n));
    let v = plate.modes.v.iter().map(|mode| mass(mode.m));
    u.chain(v).collect()
}

/// K_ij = C ∫ e_xi e_xj + e_yi e_yj + nu (e_xi e_yj + e_yi e_xj) + (1-nu)/2 g_i g_j   (N/m),
/// row-major.
pub(super) fn membrane(plate: &Plate) -> Vec<f64> {
    let (c, nu) = (plate.extensional_stiffness(), plate.poisson_ratio);
    let on = rectangle(plate);
    let strains = membrane_strains(plate);
    let size = strains.len();
    let mut k = vec![0.0; size * size];
    for (i, si) in strains.iter().enumerate() {
        for (j, sj) in strains.iter().enumerate().take(i + 1) {
            let mut sum = Sum::default();
            sum.add(on.integral([si.x, sj.x]));
            sum.add(on.integral([si.y, sj.y]));
            sum.add(nu * on.integral([si.x, sj.y]));
            sum.add(nu * on.integral([si.y, sj.x]));
            sum.add((1.0 - nu) / 2.0 * on.integral([si.shear, sj.shear]));
            k[i * size + j] = c * sum.get();
            k[j * size + i] = k[i * size + j];
        }
    }
    k
}
