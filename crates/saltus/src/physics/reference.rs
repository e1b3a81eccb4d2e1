//! B and Q by direct integration of products of slopes: what the harmonics are held against. Slow
//! (N_p N_w^2/2 and N_w^4/24 integrals) and written from the strains alone. Compiled for tests only.

#![allow(clippy::unwrap_used)]

use super::in_plane::{Sum, membrane_strains, rectangle};
use super::lists::for_each_sorted_quadruple;
use super::shape::Shape;
use super::trig::Trig::Sin;
use super::{CouplingTerm, Elasticity, InPlaneBasis, Mode, ModeSet, Plate, QuarticTerm, algebra};

/// Slopes of a transverse term.
#[derive(Clone, Copy)]
struct Slope {
    x: Shape,
    y: Shape,
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

/// B_ijk = C ∫ e_xi/2 (w_xj w_xk + nu w_yj w_yk) + e_yi/2 (w_yj w_yk + nu w_xj w_xk)
/// + (1-nu)/4 g_i (w_xj w_yk + w_yj w_xk)   (N/m^2), j <= k, nonzero entries only.
fn coupling(plate: &Plate) -> Vec<CouplingTerm> {
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
fn quartic(plate: &Plate) -> Vec<QuarticTerm> {
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

/// Σ Q r r r r over all index values (J).
fn quartic_energy(terms: &[QuarticTerm], r: &[f64]) -> f64 {
    let term = |q: &QuarticTerm| q.multiplicity() * q.value * r[q.j] * r[q.k] * r[q.l] * r[q.m];
    terms.iter().map(term).sum()
}

/// Adds 4 Q r r r, the gradient of [`quartic_energy`], to `force` (N).
fn add_quartic_force(terms: &[QuarticTerm], r: &[f64], force: &mut [f64]) {
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
fn add_quartic_hessian(terms: &[QuarticTerm], r: &[f64], hessian: &mut [f64]) {
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

/// B r r (N, `in_plane` terms).
fn coupling_load(terms: &[CouplingTerm], in_plane: usize, r: &[f64]) -> Vec<f64> {
    let mut load = vec![0.0; in_plane];
    for b in terms {
        load[b.i] += b.multiplicity() * b.value * r[b.j] * r[b.k];
    }
    load
}

/// Rectangles with 1, 4, 9 and 16 w terms and their in-plane terms, one of them left out so that
/// nothing rests on a complete set.
fn plates() -> impl Iterator<Item = Plate> {
    let bases = [InPlaneBasis::Fixed, InPlaneBasis::ShearFree];
    bases.into_iter().flat_map(|basis| {
        (1..=4).map(move |terms| {
            let mut modes = ModeSet::complete(terms, terms, basis);
            modes.u.pop();
            Plate {
                modes,
                basis,
                ..Plate::dias_del_prado()
            }
        })
    })
}

/// Numbers without a pattern in [-1, 1].
fn scattered(count: usize, seed: f64) -> Vec<f64> {
    (0..count)
        .map(|i| (seed + 1.7 * i as f64 * i as f64 + i as f64).sin())
        .collect()
}

/// Largest difference, over the largest of `expected`.
fn difference(values: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(values.len(), expected.len());
    let largest =
        |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |max, v| v.abs().max(max));
    let scale = largest(&mut expected.iter().copied());
    let error = largest(
        &mut values
            .iter()
            .zip(expected)
            .map(|(value, expected)| value - expected),
    );
    if scale == 0.0 { error } else { error / scale }
}

/// K^-1 b by LU.
fn respond(e: &Elasticity, b: &[f64]) -> Vec<f64> {
    algebra::solve("test", b.len(), &e.membrane, b).unwrap()
}

#[test]
fn lists_are_the_direct_integrals() {
    for plate in plates() {
        let e = plate.elasticity().unwrap();
        let (b, q) = (coupling(&plate), quartic(&plate));
        let indices =
            |terms: &[CouplingTerm]| -> Vec<_> { terms.iter().map(|b| (b.i, b.j, b.k)).collect() };
        assert_eq!(indices(&e.coupling), indices(&b));
        // sums of some ten products, which may cancel in part, here and below
        for (term, expected) in e.coupling.iter().zip(&b) {
            assert!((term.value - expected.value).abs() <= 1e-12 * expected.value.abs());
        }
        let indices =
            |terms: &[QuarticTerm]| -> Vec<_> { terms.iter().map(QuarticTerm::indices).collect() };
        assert_eq!(indices(&e.quartic), indices(&q));
        for (term, expected) in e.quartic.iter().zip(&q) {
            assert!((term.value - expected.value).abs() <= 1e-12 * expected.value.abs());
        }
    }
}

#[test]
fn energies_and_forces_are_those_of_the_direct_integrals() {
    for plate in plates() {
        let e = plate.elasticity().unwrap();
        let (b, q) = (coupling(&plate), quartic(&plate));
        let (n_p, n_w) = (e.in_plane_mass.len(), e.bending.len());
        let r = scattered(n_w, 0.3);
        // p of the size that r brings about
        let p: Vec<f64> = scattered(n_p, 0.9).iter().map(|p| 0.1 * p).collect();
        let load = coupling_load(&b, n_p, &r);
        let bending: Vec<f64> = e.bending.iter().zip(&r).map(|(k, r)| k * r).collect();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let kp: Vec<f64> = e.membrane.chunks(n_p).map(|row| dot(row, &p)).collect();

        let energy =
            0.5 * dot(&p, &kp) + 0.5 * dot(&r, &bending) + dot(&p, &load) + quartic_energy(&q, &r);
        // rounding of sums of up to some thousand terms, here and below
        assert!((e.strain_energy(&p, &r) / energy - 1.0).abs() < 1e-12);
        let on_p: Vec<f64> = kp.iter().zip(&load).map(|(kp, s)| kp + s).collect();
        let mut on_r = bending;
        add_quartic_force(&q, &r, &mut on_r);
        for b in &b {
            on_r[b.j] += b.multiplicity() * b.value * p[b.i] * r[b.k];
            on_r[b.k] += b.multiplicity() * b.value * p[b.i] * r[b.j];
        }
        let force = e.elastic_force(&p, &r);
        assert!(difference(&force.0, &on_p) < 1e-12);
        assert!(difference(&force.1, &on_r) < 1e-12);
        let rest: Vec<f64> = respond(&e, &load).iter().map(|p| -p).collect();
        assert!(difference(&e.in_plane_from_transverse(&r), &rest) < 1e-12);
    }
}

#[test]
fn the_condensed_plate_is_that_of_the_direct_integrals() {
    for plate in plates() {
        let e = plate.elasticity().unwrap();
        let (n_p, n_w) = (e.in_plane_mass.len(), e.bending.len());
        let r = scattered(n_w, 0.3);
        let b = coupling(&plate);
        let load = coupling_load(&b, n_p, &r);
        let relief: f64 = load
            .iter()
            .zip(respond(&e, &load))
            .map(|(s, p)| 0.5 * s * p)
            .sum();
        let bending: f64 = e.bending.iter().zip(&r).map(|(k, r)| 0.5 * k * r * r).sum();
        let whole = quartic_energy(&quartic(&plate), &r);
        // rounding of the energies that cancel
        let condensed = e.condensed_energy(&r) - bending;
        assert!((condensed - (whole - relief)).abs() < 1e-12 * whole);

        let q = e.condensed_quartic().unwrap();
        assert!((quartic_energy(&q, &r) - condensed).abs() < 1e-12 * whole);
        let mut force: Vec<f64> = e.bending.iter().zip(&r).map(|(k, r)| k * r).collect();
        add_quartic_force(&q, &r, &mut force);
        assert!(difference(&e.condensed_force(&r), &force) < 1e-12);
        let mut hessian = vec![0.0; n_w * n_w];
        (0..n_w).for_each(|j| hessian[j * (n_w + 1)] = e.bending[j]);
        add_quartic_hessian(&q, &r, &mut hessian);
        assert!(difference(&e.condensed_hessian(&r).unwrap(), &hessian) < 1e-12);

        let alone = e.condensed_harmonics().unwrap();
        let strains = alone.strains(&r);
        let stresses = alone.stresses(&strains, &[]);
        let energy: f64 = strains
            .iter()
            .zip(&stresses)
            .map(|(e, n)| 0.5 * e * n)
            .sum();
        assert!((energy - condensed).abs() < 1e-12 * whole);
        let mut force: Vec<f64> = e.bending.iter().zip(&r).map(|(k, r)| k * r).collect();
        alone.add_force(&alone.tension(&stresses), &r, &mut force);
        assert!(difference(&force, &e.condensed_force(&r)) < 1e-12);
    }
}

#[test]
fn the_flexibility_is_the_inverse_of_k() {
    for plate in plates() {
        let e = plate.elasticity().unwrap();
        let n_p = e.in_plane_mass.len();
        let load = scattered(n_p, 0.1);
        let mut p = vec![0.0; n_p];
        for entry in e.in_plane_flexibility().unwrap() {
            p[entry.row] += entry.value * load[entry.col];
        }
        assert!(difference(&p, &respond(&e, &load)) < 1e-12);
    }
}
