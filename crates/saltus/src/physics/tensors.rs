//! The coefficients of the plate's elastic energy, exactly integrated. DP Eqs. (1)-(3).
//!
//! With C = E h/(1-nu^2), e_x = u_x + w_x^2/2, e_y = v_y + w_y^2/2, g = u_y + v_x + w_x w_y, the
//! membrane energy C/2 ∫ e_x^2 + e_y^2 + 2 nu e_x e_y + (1-nu)/2 g^2 splits by powers of w into the
//! tensors K (none), B (two) and Q (four) computed here.

use super::shape::{Rectangle, Shape};
use super::trig::Trig::{Cos, Sin};
use super::{CouplingTerm, InPlaneBasis, Mode, Plate, QuarticTerm};

/// What a unit amplitude of an in-plane term contributes to e_x, e_y and g.
#[derive(Clone, Copy)]
struct MembraneStrain {
    x: Shape,
    y: Shape,
    shear: Shape,
}

/// Slopes of a transverse term.
#[derive(Clone, Copy)]
struct Slope {
    x: Shape,
    y: Shape,
}

/// A sum that knows how large its terms were, so that rounding is not taken for a value.
#[derive(Clone, Copy, Default)]
struct Sum {
    value: f64,
    magnitude: f64,
}

impl Sum {
    fn add(&mut self, term: f64) {
        self.value += term;
        self.magnitude += term.abs();
    }

    /// The sum; zero if it is no larger than the rounding of its (at most 12) terms.
    fn get(self) -> f64 {
        if self.value.abs() <= 1e-14 * self.magnitude {
            0.0
        } else {
            self.value
        }
    }
}

fn rectangle(plate: &Plate) -> Rectangle {
    Rectangle {
        length: plate.length,
        width: plate.width,
    }
}

/// Strains of all in-plane terms, u first.
fn membrane_strains(plate: &Plate) -> Vec<MembraneStrain> {
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

fn slopes(plate: &Plate) -> Vec<Slope> {
    let on = rectangle(plate);
    let slope = |&Mode { m, n }: &Mode| {
        let psi = Shape::new(Sin(m), Sin(n));
        Slope {
            x: on.d_dx(psi),
            y: on.d_dy(psi),
        }
    };
    plate.modes.w.iter().map(slope).collect()
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

/// B_ijk = C ∫ e_xi/2 (w_xj w_xk + nu w_yj w_yk) + e_yi/2 (w_yj w_yk + nu w_xj w_xk)
/// + (1-nu)/4 g_i (w_xj w_yk + w_yj w_xk)   (N/m^2), j <= k, nonzero entries only.
pub(super) fn coupling(plate: &Plate) -> Vec<CouplingTerm> {
    let (c, nu) = (plate.extensional_stiffness(), plate.poisson_ratio);
    let on = rectangle(plate);
    let slopes = slopes(plate);
    let mut terms = Vec::new();
    for (i, e) in membrane_strains(plate).iter().enumerate() {
        for (j, wj) in slopes.iter().enumerate() {
            for (k, wk) in slopes.iter().enumerate().skip(j) {
                let mut sum = Sum::default();
                sum.add(0.5 * on.integral([e.x, wj.x, wk.x]));
                sum.add(0.5 * nu * on.integral([e.x, wj.y, wk.y]));
                sum.add(0.5 * on.integral([e.y, wj.y, wk.y]));
                sum.add(0.5 * nu * on.integral([e.y, wj.x, wk.x]));
                sum.add((1.0 - nu) / 4.0 * on.integral([e.shear, wj.x, wk.y]));
                sum.add((1.0 - nu) / 4.0 * on.integral([e.shear, wj.y, wk.x]));
                let value = c * sum.get();
                if value != 0.0 {
                    terms.push(CouplingTerm { i, j, k, value });
                }
            }
        }
    }
    terms
}

/// Q_jklm = C/8 times the mean over the three pairings of ∫ (∇w_j·∇w_k)(∇w_l·∇w_m)   (N/m^3),
/// j <= k <= l <= m, nonzero entries only. Their sum is C/8 ∫ (w_x^2 + w_y^2)^2.
pub(super) fn quartic(plate: &Plate) -> Vec<QuarticTerm> {
    let c = plate.extensional_stiffness();
    let on = rectangle(plate);
    let slopes = slopes(plate);
    let mut terms = Vec::new();
    for_each_sorted_quadruple(slopes.len(), |[j, k, l, m]| {
        let mut sum = Sum::default();
        for [p, q, r, s] in [[j, k, l, m], [j, l, k, m], [j, m, k, l]] {
            let [p, q, r, s] = [slopes[p], slopes[q], slopes[r], slopes[s]];
            sum.add(on.integral([p.x, q.x, r.x, s.x]));
            sum.add(on.integral([p.x, q.x, r.y, s.y]));
            sum.add(on.integral([p.y, q.y, r.x, s.x]));
            sum.add(on.integral([p.y, q.y, r.y, s.y]));
        }
        let value = c / 24.0 * sum.get();
        if value != 0.0 {
            terms.push(QuarticTerm { j, k, l, m, value });
        }
    });
    terms
}

/// Calls `f` with every 0 <= j <= k <= l <= m < `size`, in lexicographic order.
pub(super) fn for_each_sorted_quadruple(size: usize, mut f: impl FnMut([usize; 4])) {
    for j in 0..size {
        for k in j..size {
            for l in k..size {
                for m in l..size {
                    f([j, k, l, m]);
                }
            }
        }
    }
}
