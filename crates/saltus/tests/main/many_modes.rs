//! The plate with tens and hundreds of terms: against quadrature, Airy's stress function and
//! published numbers, and without any cost that grows with the fourth power of their number.

use crate::quadrature::GaussLegendre;
use saltus::physics::{Elasticity, InPlaneBasis, Load, Mode, ModeSet, PhysicsError, Plate};
use std::f64::consts::PI;

const BASES: [InPlaneBasis; 2] = [InPlaneBasis::Fixed, InPlaneBasis::ShearFree];

/// A square plate of side 1 m and thickness 1 cm whose bending stiffness D is 1 N m.
fn square(poisson_ratio: f64, modes: ModeSet, basis: InPlaneBasis) -> Plate {
    let thickness = 0.01_f64;
    Plate {
        length: 1.0,
        width: 1.0,
        thickness,
        youngs_modulus: 12.0 * (1.0 - poisson_ratio.powi(2)) / thickness.powi(3),
        density: 1.0 / thickness,
        poisson_ratio,
        damping_ratio: 0.0,
        modes,
        basis,
    }
}

/// Ten by ten w terms on a rectangle.
fn hundred(basis: InPlaneBasis) -> Plate {
    Plate {
        length: 1.3,
        width: 0.8,
        ..square(0.3, ModeSet::complete(10, 10, basis), basis)
    }
}

/// Numbers without a pattern in [-1, 1].
fn scattered(count: usize, seed: f64) -> Vec<f64> {
    (0..count)
        .map(|i| (seed + 1.7 * i as f64 * i as f64 + i as f64).sin())
        .collect()
}

/// Transverse amplitudes (m) of about 1/(m n).
fn deflected(plate: &Plate) -> Vec<f64> {
    scattered(plate.modes.w.len(), 0.4)
        .iter()
        .zip(&plate.modes.w)
        .map(|(r, mode)| r / f64::from(mode.m * mode.n))
        .collect()
}

fn assert_close(value: f64, expected: f64, tolerance: f64) {
    assert!(
        (value - expected).abs() <= tolerance,
        "{value:.12} instead of {expected:.12} +- {tolerance:e}"
    );
}

/// Nodes and weights of a Gauss-Legendre rule over (0, length).
fn nodes(length: f64) -> Vec<(f64, f64)> {
    // 100 nodes integrate the at most 80 half-waves of products of four slopes to rounding
    let rule = GaussLegendre::new(100);
    rule.iter()
        .map(|(node, weight)| (length * (node + 1.0) / 2.0, weight * length / 2.0))
        .collect()
}

/// sin and cos of k pi x/length for k = 0..=`most`.
fn waves(most: u32, x: f64, length: f64) -> Vec<(f64, f64)> {
    (0..=most)
        .map(|k| (f64::from(k) * PI * x / length).sin_cos())
        .collect()
}

/// Largest half-wave number of all terms.
fn highest(plate: &Plate) -> u32 {
    let ModeSet { u, v, w } = &plate.modes;
    let all = u.iter().chain(v).chain(w);
    all.map(|mode| mode.m.max(mode.n)).max().unwrap()
}

/// Energies (J) by Gauss-Legendre quadrature of the strains: (membrane, bending).
fn energies_by_quadrature(plate: &Plate, p: &[f64], r: &[f64]) -> (f64, f64) {
    let nu = plate.poisson_ratio;
    let c = plate.youngs_modulus * plate.thickness / (1.0 - nu * nu);
    let d = c * plate.thickness.powi(2) / 12.0;
    let most = highest(plate);
    let shear_free = plate.basis == InPlaneBasis::ShearFree;
    let number = |mode: &Mode| {
        (
            f64::from(mode.m) * PI / plate.length,
            f64::from(mode.n) * PI / plate.width,
        )
    };
    let (mut membrane, mut bending) = (0.0, 0.0);
    for (x, dx) in nodes(plate.length) {
        let in_x = waves(most, x, plate.length);
        for (y, dy) in nodes(plate.width) {
            let in_y = waves(most, y, plate.width);
            let at = |mode: &Mode| (in_x[mode.m as usize], in_y[mode.n as usize]);
            let (mut e_x, mut e_y, mut g) = (0.0, 0.0, 0.0);
            for (mode, p) in plate.modes.u.iter().zip(p) {
                let ((k, l), ((sx, cx), (sy, cy))) = (number(mode), at(mode));
                // value and slope of the factor across
                let across = if shear_free {
                    (cy, -l * sy)
                } else {
                    (sy, l * cy)
                };
                e_x += p * k * cx * across.0;
                g += p * sx * across.1;
            }
            for (mode, p) in plate.modes.v.iter().zip(&p[plate.modes.u.len()..]) {
                let ((k, l), ((sx, cx), (sy, cy))) = (number(mode), at(mode));
                let across = if shear_free {
                    (cx, -k * sx)
                } else {
                    (sx, k * cx)
                };
                e_y += p * l * cy * across.0;
                g += p * sy * across.1;
            }
            let (mut w_x, mut w_y, mut w_xx, mut w_yy, mut w_xy) = (0.0, 0.0, 0.0, 0.0, 0.0);
            for (mode, r) in plate.modes.w.iter().zip(r) {
                let ((k, l), ((sx, cx), (sy, cy))) = (number(mode), at(mode));
                w_x += r * k * cx * sy;
                w_y += r * l * sx * cy;
                w_xx -= r * k * k * sx * sy;
                w_yy -= r * l * l * sx * sy;
                w_xy += r * k * l * cx * cy;
            }
            // DP Eq. (1)
            e_x += w_x * w_x / 2.0;
            e_y += w_y * w_y / 2.0;
            g += w_x * w_y;
            membrane += dx * dy * c / 2.0
                * (e_x * e_x + e_y * e_y + 2.0 * nu * e_x * e_y + (1.0 - nu) / 2.0 * g * g);
            bending += dx * dy * d / 2.0
                * (w_xx * w_xx
                    + w_yy * w_yy
                    + 2.0 * nu * w_xx * w_yy
                    + 2.0 * (1.0 - nu) * w_xy * w_xy);
        }
    }
    (membrane, bending)
}

#[test]
fn the_energy_of_a_hundred_terms_is_its_quadrature() {
    for plate in BASES.map(hundred) {
        let e = plate.elasticity().unwrap();
        let r = deflected(&plate);
        let p: Vec<f64> = scattered(e.in_plane_mass.len(), 0.8)
            .iter()
            .map(|p| 0.02 * p)
            .collect();
        let (membrane, bending) = energies_by_quadrature(&plate, &p, &r);
        // rounding of the sums over 1e4 points
        assert_close(e.strain_energy(&p, &r) / (membrane + bending), 1.0, 1e-11);
    }
}

#[test]
fn forces_of_a_hundred_terms_are_gradients() {
    for plate in BASES.map(hundred) {
        let e = plate.elasticity().unwrap();
        let r = deflected(&plate);
        let p: Vec<f64> = scattered(e.in_plane_mass.len(), 0.8)
            .iter()
            .map(|p| 0.02 * p)
            .collect();
        let direction = (scattered(p.len(), 0.1), scattered(r.len(), 0.2));
        let moved = |x: &[f64], by: &[f64], step: f64| -> Vec<f64> {
            x.iter().zip(by).map(|(x, by)| x + step * by).collect()
        };
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        // five points are exact for a quartic polynomial, whatever the step
        let slope = |energy: &dyn Fn(f64) -> f64| {
            let s = 0.25;
            let [far_back, back, ahead, far_ahead] = [-2.0, -1.0, 1.0, 2.0].map(|k| energy(k * s));
            let rounding = 1e-12 * (far_back.abs() + far_ahead.abs()) / s;
            (
                (8.0 * (ahead - back) - (far_ahead - far_back)) / (12.0 * s),
                rounding,
            )
        };
        let (on_p, on_r) = e.elastic_force(&p, &r);
        let (expected, rounding) = slope(&|step| {
            e.strain_energy(
                &moved(&p, &direction.0, step),
                &moved(&r, &direction.1, step),
            )
        });
        assert_close(
            dot(&on_p, &direction.0) + dot(&on_r, &direction.1),
            expected,
            rounding,
        );

        let force = e.condensed_force(&r);
        let (expected, rounding) =
            slope(&|step| e.condensed_energy(&moved(&r, &direction.1, step)));
        assert_close(dot(&force, &direction.1), expected, rounding);

        // the force is a cubic polynomial, so five points are exact again
        let hessian = e.condensed_hessian(&r).unwrap();
        let change: Vec<f64> = hessian
            .chunks(r.len())
            .map(|row| dot(row, &direction.1))
            .collect();
        for (j, change) in change.iter().enumerate().step_by(9) {
            let (expected, rounding) =
                slope(&|step| e.condensed_force(&moved(&r, &direction.1, step))[j]);
            // the largest force sets the scale of rounding
            let scale: f64 = force.iter().fold(0.0, |max, f| f.abs().max(max));
            assert_close(*change, expected, rounding + 1e-11 * scale);
        }

        // in equilibrium in the plane, the full plate is the condensed one
        let rest = e.in_plane_from_transverse(&r);
        let (on_p, on_r) = e.elastic_force(&rest, &r);
        let scale: f64 = force.iter().fold(0.0, |max, f| f.abs().max(max));
        assert!(on_p.iter().all(|f| f.abs() < 1e-11 * scale));
        assert!(
            on_r.iter()
                .zip(&force)
                .all(|(full, f)| (full - f).abs() < 1e-11 * scale)
        );
        assert_close(
            e.strain_energy(&rest, &r) / e.condensed_energy(&r),
            1.0,
            1e-12,
        );
    }
}

/// Membrane energy (J) of the plate with edges that cannot move but slide along themselves, by
/// Airy's stress function F (Levy 1942): with F = Σ F_pq cos(p pi x/a) cos(q pi y/b),
/// (k^2 + l^2)^2 F_pq = E h times the amplitude of w_xy^2 - w_xx w_yy, energy 1/(2 E h) ∫ (ΔF)^2,
/// and besides the mean stretches of w, which immovable edges cannot undo.
fn energy_by_airys_function(plate: &Plate, r: &[f64]) -> f64 {
    let (a, b) = (plate.length, plate.width);
    let stiffness = plate.youngs_modulus * plate.thickness;
    let nu = plate.poisson_ratio;
    let most = 2 * highest(&Plate {
        modes: ModeSet {
            u: Vec::new(),
            v: Vec::new(),
            w: plate.modes.w.clone(),
        },
        ..plate.clone()
    });
    // the midpoint rule is exact below twice its number of points, here for the 4 `most` half-waves
    // of a product of curvatures and a harmonic
    let points = 2 * most + 1;
    let middle = |i: u32, length: f64| length * (f64::from(i) + 0.5) / f64::from(points);
    let size = (most + 1) as usize;
    let mut gauss = vec![0.0; size * size];
    let (mut mean_x, mut mean_y) = (0.0, 0.0);
    let share = f64::from(points).powi(-2);
    for i in 0..points {
        let in_x = waves(most, middle(i, a), a);
        for j in 0..points {
            let in_y = waves(most, middle(j, b), b);
            let (mut w_x, mut w_y, mut w_xx, mut w_yy, mut w_xy) = (0.0, 0.0, 0.0, 0.0, 0.0);
            for (mode, r) in plate.modes.w.iter().zip(r) {
                let (k, l) = (f64::from(mode.m) * PI / a, f64::from(mode.n) * PI / b);
                let ((sx, cx), (sy, cy)) = (in_x[mode.m as usize], in_y[mode.n as usize]);
                w_x += r * k * cx * sy;
                w_y += r * l * sx * cy;
                w_xx -= r * k * k * sx * sy;
                w_yy -= r * l * l * sx * sy;
                w_xy += r * k * l * cx * cy;
            }
            mean_x += share * w_x * w_x / 2.0;
            mean_y += share * w_y * w_y / 2.0;
            let curvature = share * (w_xy * w_xy - w_xx * w_yy);
            for (row, (_, cx)) in in_x.iter().enumerate() {
                for (col, (_, cy)) in in_y.iter().enumerate() {
                    gauss[row * size + col] += curvature * cx * cy;
                }
            }
        }
    }
    let stretch = mean_x * mean_x + mean_y * mean_y + 2.0 * nu * mean_x * mean_y;
    let mut energy = a * b * stiffness / (2.0 * (1.0 - nu * nu)) * stretch;
    for p in 0..size {
        for q in 0..size {
            let laplacian = (p as f64 * PI / a).powi(2) + (q as f64 * PI / b).powi(2);
            if laplacian > 0.0 {
                // mean of cos^2 cos^2: 1/4, doubled for every index 0
                let mean = [p, q].map(|index| if index == 0 { 1.0 } else { 0.5 });
                let norm: f64 = mean.iter().product();
                let amplitude = gauss[p * size + q] / norm;
                // ΔF = -E h amplitude/laplacian
                energy += a * b * norm * stiffness / 2.0 * (amplitude / laplacian).powi(2);
            }
        }
    }
    energy
}

#[test]
fn levys_stress_function_stores_the_same_energy_with_any_number_of_terms() {
    for terms in [1, 3, 10, 20] {
        let basis = InPlaneBasis::ShearFree;
        let plate = Plate {
            modes: ModeSet::complete(terms, terms, basis),
            ..hundred(basis)
        };
        let e = plate.elasticity().unwrap();
        let r = deflected(&plate);
        let bending: f64 = e.bending.iter().zip(&r).map(|(k, r)| 0.5 * k * r * r).sum();
        let membrane = e.condensed_energy(&r) - bending;
        // both sides are sums of several thousand terms
        assert_close(membrane / energy_by_airys_function(&plate, &r), 1.0, 1e-11);
        // one row for each harmonic of Airy's function, two for the mean stretches
        let alone = e.condensed_harmonics().unwrap();
        assert!(alone.rows <= (2 * terms as usize + 1).pow(2) + 1);
        assert!(
            alone.weights.len() <= alone.rows && alone.strain.len() * 2 < e.harmonics.strain.len()
        );
    }
}

/// eps of (1, 1) in x'' + omega^2 (x + eps x^3) = 0, x = r/h, all other w terms at rest.
fn cubic(e: &Elasticity, thickness: f64) -> f64 {
    let mut r = vec![0.0; e.bending.len()];
    r[0] = thickness;
    let linear = e.bending[0] * thickness;
    (e.condensed_force(&r)[0] - linear) / linear
}

#[test]
fn chu_and_herrmanns_coefficient_stays_with_a_hundred_terms() {
    // shear-free: the closed form 1.316250 of one term is that of any complete set
    // fixed: 1.327407, 1.323444, 1.323011 and 1.322967 for 2, 4, 8, 12 terms per direction, derived
    // independently; sets in between must lie between
    let (mut last, free) = (f64::INFINITY, InPlaneBasis::ShearFree);
    for terms in [1, 2, 4, 6, 8, 10, 12] {
        let plate = square(0.3, ModeSet::complete(terms, terms, free), free);
        assert_close(
            cubic(&plate.elasticity().unwrap(), plate.thickness),
            1.316_25,
            1e-11,
        );

        let fixed = InPlaneBasis::Fixed;
        let plate = square(0.3, ModeSet::complete(terms, terms, fixed), fixed);
        let eps = cubic(&plate.elasticity().unwrap(), plate.thickness);
        let known = [
            (1, 1.403686),
            (2, 1.327407),
            (4, 1.323444),
            (8, 1.323011),
            (12, 1.322967),
        ];
        if let Some((_, expected)) = known.iter().find(|known| known.0 == terms) {
            assert_close(eps, *expected, 1e-6);
        }
        assert!(
            1.32296 < eps && eps < last,
            "{eps} with {terms} terms per direction"
        );
        last = eps;
    }
}

/// Levy 1942, NACA TR 737, square plate, nu^2 = 0.1, edges immovable: q a^4/(E h^4), and w/h at the
/// centre to three digits, computed with six terms of w.
const LEVY: [(f64, f64); 4] = [
    (14.78, 0.485),
    (51.4, 0.952),
    (132.0, 1.402),
    (278.5, 1.846),
];

/// w/h at the centre for Levy's loads, with the odd w terms up to 2 `count` - 1 half-waves.
fn levys_plate(count: u32) -> [f64; 4] {
    let basis = InPlaneBasis::ShearFree;
    let highest = 2 * count - 1;
    let mut set = ModeSet::complete(highest, highest, basis);
    set.w.retain(|mode| mode.m % 2 == 1 && mode.n % 2 == 1);
    // products of slopes of odd terms hold even half-waves only
    set.u
        .retain(|mode| mode.m.is_multiple_of(2) && mode.n.is_multiple_of(2));
    set.v
        .retain(|mode| mode.m.is_multiple_of(2) && mode.n.is_multiple_of(2));
    let plate = square(0.1_f64.sqrt(), set, basis);
    let e = plate.elasticity().unwrap();
    LEVY.map(|(load, _)| {
        let pressure = load * plate.youngs_modulus * plate.thickness.powi(4);
        let f = plate.generalized_load(&[Load::Pressure(pressure)]).unwrap();
        let r = e.deflection(&f).unwrap();
        // in equilibrium: the whole plate's forces, not only the condensed ones
        let (on_p, on_r) = e.elastic_force(&e.in_plane_from_transverse(&r), &r);
        assert!(on_p.iter().all(|force| force.abs() < 1e-9 * f[0]));
        assert!(
            on_r.iter()
                .zip(&f)
                .all(|(force, f_j)| (force - f_j).abs() < 1e-9 * f[0])
        );
        plate.deflection_at(&r, 0.5, 0.5) / plate.thickness
    })
}

#[test]
fn levys_deflections_converge_with_36_64_and_100_terms() {
    let [before, few, odd, more, hundred] = [5, 6, 7, 8, 10].map(levys_plate);
    for (index, (_, printed)) in LEVY.into_iter().enumerate() {
        let w = hundred[index];
        // Levy's six terms are not quite enough: 0.5 % at the largest load, see `plate_validation`
        assert_close(w / printed, 1.0, 0.005);
        // the deflection at the centre alternates about its limit, ever more closely
        let steps = [
            few[index] - before[index],
            odd[index] - few[index],
            more[index] - odd[index],
        ];
        assert!(
            steps[0] < 0.0 && steps[1] > 0.0 && steps[2] < 0.0,
            "{steps:?}"
        );
        assert!(steps[1] < -steps[0] && -steps[2] < steps[1], "{steps:?}");
        assert!((w - more[index]).abs() < -steps[2], "{w}");
    }
}

#[test]
fn even_terms_stay_at_rest_under_a_uniform_load() {
    // the complete set of 36 terms holds the 9 odd ones; pressure moves no others
    let set = ModeSet::complete(6, 6, InPlaneBasis::Fixed);
    let plate = square(0.3, set, InPlaneBasis::Fixed);
    let pressure = 200.0 * plate.youngs_modulus * plate.thickness.powi(4);
    let r = plate.deflection(&[Load::Pressure(pressure)]).unwrap();
    assert!(r[0] > plate.thickness);
    for (mode, r_j) in plate.modes.w.iter().zip(&r) {
        if mode.m.is_multiple_of(2) || mode.n.is_multiple_of(2) {
            // rounding of the forces, over the least stiffness
            assert!(r_j.abs() < 1e-13 * r[0], "{mode:?}: {r_j}");
        } else {
            assert!(*r_j != 0.0);
        }
    }
}

#[test]
fn lists_grow_with_the_pairs_and_not_with_the_quadruples() {
    for (basis, per_in_plane_term) in [(InPlaneBasis::ShearFree, 3), (InPlaneBasis::Fixed, 33)] {
        let plate = hundred(basis);
        let e = plate.elasticity().unwrap();
        let h = &e.harmonics;
        assert_eq!(h.pairs.len(), 5050);
        assert!(h.rows <= 3 * 21 * 21);
        assert!(h.strain.len() <= 12 * h.pairs.len() && h.weights.len() <= 2 * h.rows);
        assert!(h.in_plane.len() <= per_in_plane_term * e.in_plane_mass.len());
        for list in [&h.strain, &h.weights, &h.in_plane] {
            assert!(list.is_sorted_by_key(|entry| (entry.row, entry.col)));
            assert!(list.iter().all(|entry| entry.value != 0.0));
        }
        let work = h.work(&plate.modes.w);
        assert!(work.harmonics * 20 < work.direct, "{work:?}");
        assert!(e.quartic.is_empty() && e.coupling.is_empty());
        assert!(matches!(
            e.condensed_quartic(),
            Err(PhysicsError::Modes { .. })
        ));
    }
}

#[test]
fn few_terms_are_cheaper_without_harmonics() {
    let plate = Plate::dias_del_prado();
    let e = plate.elasticity().unwrap();
    let work = e.harmonics.work(&plate.modes.w);
    assert!(work.direct < work.harmonics, "{work:?}");
}

#[test]
fn more_terms_than_a_program_holds_are_refused_by_name() {
    use saltus::model::{Inertia, Setup};
    let mut setup = Setup {
        inertia: Inertia::Condensed,
        ..Setup::dias_del_prado(0.3, 1.0)
    };
    setup.plate.basis = InPlaneBasis::ShearFree;
    setup.plate.modes = ModeSet::complete(13, 13, InPlaneBasis::ShearFree);
    let error = setup.model().expect_err("169 terms").to_string();
    assert!(
        error.contains("plate.modes with 169 w terms") && error.contains("65536"),
        "{error}"
    );
}
