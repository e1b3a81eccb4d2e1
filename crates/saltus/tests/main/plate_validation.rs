//! Published and independently derived numbers about the plate. Nothing here is integrated in time.
//!
//! "Secular equation", "exact" and "quadrature" mark references computed inside the test by a
//! method that shares no code with the library.

use crate::quadrature::GaussLegendre;
use proptest::prelude::*;
use saltus::physics::{
    Base, BaseFrequency, CouplingTerm, Elasticity, FrequencyReference, InPlaneBasis, Jumper, Load,
    Mode, ModeSet, OneMode, PhysicsError, Plate, QuarticTerm,
};
use std::f64::consts::{PI, TAU};

fn modes(list: &[(u32, u32)]) -> Vec<Mode> {
    list.iter().map(|&(m, n)| Mode::new(m, n)).collect()
}

/// (m pi/a, n pi/b) (1/m).
fn wave_numbers(plate: &Plate, mode: &Mode) -> (f64, f64) {
    (
        f64::from(mode.m) * PI / plate.length,
        f64::from(mode.n) * PI / plate.width,
    )
}

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

fn paper() -> (Plate, Jumper) {
    let plate = Plate::dias_del_prado();
    let jumper = Jumper::dias_del_prado(plate.length, plate.width);
    (plate, jumper)
}

fn assert_close(value: f64, expected: f64, tolerance: f64) {
    assert!(
        (value - expected).abs() <= tolerance,
        "{value:.12} instead of {expected:.12} +- {tolerance:e}"
    );
}

/// This many random cases, leaving no files behind.
fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

// ---------------------------------------------------------------- natural frequencies

#[test]
fn empty_plate_rings_at_2_297_hz() {
    let (mut plate, _) = paper();
    plate.modes.w = modes(&[(1, 2), (2, 1), (1, 1)]);
    let hz = plate.frequencies_hz().unwrap();
    // closed form, evaluated independently to 10 digits; DP section 3 prints 2.297
    for (hz, expected) in hz.iter().zip([2.296895066, 4.624829256, 6.859646077]) {
        assert_close(*hz, expected, 1e-9);
    }
    assert_close(
        plate.elasticity().unwrap().first_omega,
        TAU * 2.296895066,
        TAU * 1e-9,
    );
}

/// Frequencies of a plate with one jumper (Hz) by bisection of the secular equation
/// 1/(m w^2) - Σ psi_j^2/(M (w_j^2 - w^2)) = 1/k: eliminate r_j and z from the two free vibrations.
fn secular_hz(plate: &Plate, jumper: &Jumper) -> Vec<f64> {
    let mass = plate.density * plate.thickness * plate.length * plate.width / 4.0;
    let flexibility = 12.0 * (1.0 - plate.poisson_ratio.powi(2));
    let rigidity = plate.youngs_modulus * plate.thickness.powi(3) / flexibility;
    let terms: Vec<(f64, f64)> = plate
        .modes
        .w
        .iter()
        .map(|mode| {
            let (kx, ky) = wave_numbers(plate, mode);
            let omega = (kx * kx + ky * ky) * (rigidity / (plate.density * plate.thickness)).sqrt();
            (
                omega * omega,
                ((kx * jumper.x).sin() * (ky * jumper.y).sin()).powi(2),
            )
        })
        .collect();
    let secular = |square: f64| {
        let plate: f64 = terms
            .iter()
            .map(|(own, psi2)| psi2 / (mass * (own - square)))
            .sum();
        1.0 / (jumper.mass * square) - plate - 1.0 / jumper.stiffness
    };
    // its left side falls from +inf to -inf between neighbouring poles 0, w_1^2, w_2^2, ...
    let mut poles: Vec<f64> = std::iter::once(0.0)
        .chain(
            terms
                .iter()
                .filter(|term| term.1 > 1e-20)
                .map(|term| term.0),
        )
        .collect();
    poles.sort_by(f64::total_cmp);
    poles.push(4.0 * poles[poles.len() - 1] + 4.0 * jumper.stiffness / jumper.mass);
    poles
        .windows(2)
        .map(|gap| {
            let (mut low, mut high) = (gap[0], gap[1]);
            for _ in 0..200 {
                let middle = 0.5 * (low + high);
                if secular(middle) > 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            low.sqrt() / TAU
        })
        .collect()
}

#[test]
fn occupied_plate_rings_at_2_243_and_2_537_hz() {
    let (plate, jumper) = paper();
    let modes = plate.occupied(&[jumper]).unwrap();
    // DP section 3 prints 2.243 and 2.537; five decimals derived independently
    assert_close(modes.hz[0], 2.24313, 5e-6);
    assert_close(modes.hz[1], 2.53731, 5e-6);
    assert_eq!(modes.body_index, Some(1));
    // secular equation; both methods lose about 1e-13 to rounding
    for (hz, expected) in modes.hz.iter().zip(secular_hz(&plate, &jumper)) {
        assert_close(*hz, expected, 1e-11 * expected);
    }
    // unit modal mass, and the shape balances inertia: k (w - z) = -omega^2 m z
    for (hz, shape) in modes.hz.iter().zip(&modes.shapes) {
        let z = shape[4];
        let modal: f64 = shape[..4].iter().map(|r| 8750.0 * r * r).sum::<f64>() + 76.64 * z * z;
        assert_close(modal, 1.0, 1e-12);
        let leg = 18_600.0 * (plate.deflection_at(&shape[..4], jumper.x, jumper.y) - z);
        assert_close(leg, -(TAU * hz).powi(2) * 76.64 * z, 1e-8);
    }
}

#[test]
fn the_printed_frequencies_need_w_31_and_the_printed_stiffness() {
    let (plate, jumper) = paper();
    let body = |plate: &Plate, jumper: Jumper| {
        let modes = plate.occupied(&[jumper]).unwrap();
        modes.hz[modes.body_index.unwrap()]
    };
    assert_close(body(&plate, jumper), 2.5373, 5e-5);
    // the list as printed, without w_31
    let mut printed = plate.clone();
    printed.modes.w = modes(&[(1, 1), (1, 3), (3, 3)]);
    assert_close(body(&printed, jumper), 2.5382, 5e-5);
    // omega_h = 2.48 Hz as printed, instead of k_h = 18.6 kN/m
    let stiffness = jumper.mass * (TAU * 2.48).powi(2);
    assert_close(
        body(
            &plate,
            Jumper {
                stiffness,
                ..jumper
            },
        ),
        2.5378,
        5e-5,
    );
    assert_close(jumper.omega() / TAU, 2.4794, 5e-5);
}

#[test]
fn a_rigid_leg_is_an_added_mass_and_a_massless_body_is_nobody() {
    let (mut plate, jumper) = paper();
    plate.modes.w = modes(&[(1, 1)]);
    let (mass, stiffness) = (8750.0, plate.bending_stiffness()[0]);
    // the leg's flexibility moves the frequency by m^2 omega^2/(2 M k) relative, here 1e-9; a
    // stiffer one would drown the plate's eigenvalue in the rounding of its own
    let rigid = Jumper {
        stiffness: 1e11,
        ..jumper
    };
    let added = (stiffness / (mass + jumper.mass)).sqrt() / TAU;
    assert_close(plate.occupied(&[rigid]).unwrap().hz[0], added, 1e-8);
    // a mass m changes the frequency by m/(2 M) relative, here 6e-11
    let light = Jumper {
        mass: 1e-6,
        stiffness: 18.6,
        ..jumper
    };
    let empty = plate.frequencies_hz().unwrap()[0];
    assert_close(plate.occupied(&[light]).unwrap().hz[0], empty, 1e-9);
    assert_eq!(plate.occupied(&[]).unwrap().body_index, None);
    assert_close(plate.occupied(&[]).unwrap().hz[0], empty, 1e-14);
}

#[test]
fn two_equal_jumpers_at_mirrored_places_can_rest_the_plate() {
    let (plate, jumper) = paper();
    let left = Jumper {
        x: 4.0,
        y: 3.0,
        ..jumper
    };
    let right = Jumper {
        x: 10.0,
        y: 7.0,
        ..jumper
    };
    let modes = plate.occupied(&[left, right]).unwrap();
    assert_eq!(modes.hz.len(), 6);
    // moving against each other they exert no net force on odd half-waves: exactly the free body
    let free = jumper.omega() / TAU;
    assert!(modes.hz.iter().any(|hz| (hz - free).abs() < 1e-12 * free));
}

#[test]
fn in_plane_modes_are_a_hundred_times_faster() {
    let plate = &Plate::dias_del_prado();
    let hz = plate.in_plane_frequencies_hz().unwrap();
    // range found by an independent program, "250 to 1340 Hz"
    assert!(hz.len() == 12 && hz[0] > 250.0 && hz[11] < 1350.0);
    // exact: the squares add up to the trace, Σ C/(rho h) (k_along^2 + (1-nu)/2 k_across^2)
    let nu = plate.poisson_ratio;
    let wave_speed_squared = plate.youngs_modulus / (plate.density * (1.0 - nu * nu));
    let number = |mode: &Mode| wave_numbers(plate, mode);
    let along_x = plate.modes.u.iter().map(number);
    let along_y = plate.modes.v.iter().map(number).map(|(kx, ky)| (ky, kx));
    let trace: f64 = along_x
        .chain(along_y)
        .map(|(along, across)| {
            wave_speed_squared * (along.powi(2) + (1.0 - nu) / 2.0 * across.powi(2))
        })
        .sum();
    let squares: f64 = hz.iter().map(|hz| (TAU * hz).powi(2)).sum();
    assert_close(squares / trace, 1.0, 1e-13);
}

fn swap_axes(plate: &Plate) -> Plate {
    let swap = |list: &[Mode]| list.iter().map(|mode| Mode::new(mode.n, mode.m)).collect();
    Plate {
        length: plate.width,
        width: plate.length,
        modes: ModeSet {
            u: swap(&plate.modes.v),
            v: swap(&plate.modes.u),
            w: swap(&plate.modes.w),
        },
        ..plate.clone()
    }
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn mirrored_places_and_swapped_axes_ring_alike(
        x in 0.1..13.9_f64,
        y in 0.1..9.9_f64,
        even in any::<bool>(),
    ) {
        let (mut plate, jumper) = paper();
        if even {
            plate.modes.w.extend(modes(&[(2, 1), (1, 2), (2, 2)]));
        }
        let jumper = Jumper { x, y, ..jumper };
        let swapped = swap_axes(&plate);
        let reference = plate.occupied(&[jumper]).unwrap().hz;
        for (plate, jumper) in [
            (&plate, Jumper { x: plate.length - x, ..jumper }),
            (&plate, Jumper { y: plate.width - y, ..jumper }),
            (&swapped, Jumper { x: y, y: x, ..jumper }),
        ] {
            for (hz, expected) in plate.occupied(&[jumper]).unwrap().hz.iter().zip(&reference) {
                // rounding of eigenvalues up to (20 Hz)^2 seen from (2 Hz)^2
                prop_assert!((hz - expected).abs() < 1e-11 * expected);
            }
        }
        let in_plane = plate.in_plane_frequencies_hz().unwrap();
        for (hz, expected) in swapped.in_plane_frequencies_hz().unwrap().iter().zip(&in_plane) {
            prop_assert!((hz - expected).abs() < 1e-12 * expected);
        }
    }
}

// ---------------------------------------------------------------- forcing frequency

fn ratio(ratio: f64, reference: FrequencyReference) -> Base {
    Base {
        amplitude: 0.013,
        frequency: BaseFrequency::Ratio { ratio, reference },
    }
}

#[test]
fn omega_follows_its_reference() {
    let (plate, jumper) = paper();
    let hz = |base: Base| base.omega(&plate, &[jumper]).unwrap() / TAU;
    // occupied and empty: as above; free: sqrt(18600/76.64)/(2 pi)
    assert_close(
        hz(ratio(0.9, FrequencyReference::Occupied)),
        0.9 * 2.53731,
        5e-6,
    );
    assert_close(
        hz(ratio(1.1, FrequencyReference::Free)),
        1.1 * 2.479413,
        1e-6,
    );
    assert_close(hz(ratio(1.0, FrequencyReference::Plate)), 2.296895066, 1e-9);
    assert_close(
        hz(Base {
            amplitude: 0.0,
            frequency: BaseFrequency::Hertz(3.0),
        }),
        3.0,
        1e-15,
    );
}

#[test]
fn without_a_jumper_only_plate_and_hertz_make_sense() {
    let plate = Plate::dias_del_prado();
    for reference in [FrequencyReference::Occupied, FrequencyReference::Free] {
        let error = ratio(1.0, reference).omega(&plate, &[]).unwrap_err();
        assert_eq!(
            error,
            PhysicsError::NeedsJumper {
                reference: reference.name()
            }
        );
    }
    assert!(
        ratio(1.0, FrequencyReference::Plate)
            .omega(&plate, &[])
            .is_ok()
    );
    assert!(
        Base {
            amplitude: 0.0,
            frequency: BaseFrequency::Hertz(3.0)
        }
        .omega(&plate, &[])
        .is_ok()
    );
}

#[test]
fn jumpers_off_the_plate_are_refused_and_deaf_ones_are_noticed() {
    let (mut plate, jumper) = paper();
    for (x, y) in [
        (0.0, 5.0),
        (14.0, 5.0),
        (7.0, -1.0),
        (7.0, f64::NAN),
        (f64::INFINITY, 5.0),
    ] {
        let result = plate.occupied(&[jumper, Jumper { x, y, ..jumper }]);
        assert!(
            matches!(result, Err(PhysicsError::OffThePlate { index: 1, .. })),
            "({x}, {y})"
        );
    }
    assert!(!plate.on_nodal_lines(&jumper));
    plate.modes.w = modes(&[(2, 1), (1, 2), (4, 3)]);
    assert!(plate.on_nodal_lines(&jumper));
    assert!(!plate.on_nodal_lines(&Jumper { x: 7.001, ..jumper }));
}

#[test]
fn every_bad_number_of_the_plate_is_named() {
    type Case = (&'static str, fn(&mut Plate, f64), &'static [f64]);
    let cases: [Case; 7] = [
        ("plate.length", |p, v| p.length = v, &[0.0, -1.0]),
        ("plate.width", |p, v| p.width = v, &[0.0, -1.0]),
        ("plate.thickness", |p, v| p.thickness = v, &[0.0, -1.0]),
        (
            "plate.youngs_modulus",
            |p, v| p.youngs_modulus = v,
            &[0.0, -1.0],
        ),
        ("plate.density", |p, v| p.density = v, &[0.0, -1.0]),
        (
            "plate.poisson_ratio",
            |p, v| p.poisson_ratio = v,
            &[-1.0, 0.5],
        ),
        ("plate.damping_ratio", |p, v| p.damping_ratio = v, &[-1e-9]),
    ];
    for (name, set, bad) in cases {
        for &value in bad
            .iter()
            .chain(&[f64::NAN, f64::INFINITY, f64::NEG_INFINITY])
        {
            let mut plate = Plate::dias_del_prado();
            set(&mut plate, value);
            for error in [
                plate.check().unwrap_err(),
                plate.elasticity().unwrap_err(),
                plate.frequencies_hz().unwrap_err(),
                plate.linear_deflection(&[]).unwrap_err(),
            ] {
                assert!(
                    matches!(&error, PhysicsError::OutOfRange { field, .. } if field == name),
                    "{error}"
                );
            }
        }
    }
}

#[test]
fn numbers_that_overflow_together_are_refused() {
    for (length, youngs_modulus) in [(1e-160, 27e9), (1e308, 27e9), (14.0, 1e307), (14.0, 1e-320)] {
        let plate = Plate {
            length,
            youngs_modulus,
            ..Plate::dias_del_prado()
        };
        let refused = matches!(plate.elasticity(), Err(PhysicsError::Algebra { .. }));
        assert!(refused, "{length} m {youngs_modulus} Pa");
        let hz = plate.frequencies_hz().unwrap_or_default();
        assert!(hz.iter().all(|hz| hz.is_normal()), "{hz:?}");
    }
}

// ---------------------------------------------------------------- tensors

/// Energies (J) of a plate by Gauss-Legendre quadrature of the strains: (membrane, bending).
fn energies_by_quadrature(plate: &Plate, p: &[f64], r: &[f64]) -> (f64, f64) {
    let nu = plate.poisson_ratio;
    let c = plate.youngs_modulus * plate.thickness / (1.0 - nu * nu);
    let d = c * plate.thickness.powi(2) / 12.0;
    // 30 nodes integrate the at most 4 * 3 half-waves of these tests to rounding
    let rule = GaussLegendre::new(30);
    let number = |mode: &Mode| wave_numbers(plate, mode);
    let shear_free = plate.basis == InPlaneBasis::ShearFree;
    // values and slopes
    let sine = |k: f64, x: f64| ((k * x).sin(), k * (k * x).cos());
    let cosine = |k: f64, x: f64| ((k * x).cos(), -k * (k * x).sin());
    let at = |x: f64, y: f64| {
        let (mut u_x, mut u_y, mut v_x, mut v_y) = (0.0, 0.0, 0.0, 0.0);
        for (mode, p) in plate.modes.u.iter().zip(p) {
            let (k, l) = number(mode);
            let across = if shear_free { cosine(l, y) } else { sine(l, y) };
            u_x += p * k * (k * x).cos() * across.0;
            u_y += p * (k * x).sin() * across.1;
        }
        for (mode, p) in plate.modes.v.iter().zip(&p[plate.modes.u.len()..]) {
            let (k, l) = number(mode);
            let across = if shear_free { cosine(k, x) } else { sine(k, x) };
            v_x += p * across.1 * (l * y).sin();
            v_y += p * across.0 * l * (l * y).cos();
        }
        let (mut w_x, mut w_y, mut w_xx, mut w_yy, mut w_xy) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for (mode, r) in plate.modes.w.iter().zip(r) {
            let (k, l) = number(mode);
            w_x += r * k * (k * x).cos() * (l * y).sin();
            w_y += r * l * (k * x).sin() * (l * y).cos();
            w_xx -= r * k * k * (k * x).sin() * (l * y).sin();
            w_yy -= r * l * l * (k * x).sin() * (l * y).sin();
            w_xy += r * k * l * (k * x).cos() * (l * y).cos();
        }
        // DP Eq. (1)
        let (e_x, e_y, g) = (
            u_x + w_x * w_x / 2.0,
            v_y + w_y * w_y / 2.0,
            u_y + v_x + w_x * w_y,
        );
        let membrane =
            c / 2.0 * (e_x * e_x + e_y * e_y + 2.0 * nu * e_x * e_y + (1.0 - nu) / 2.0 * g * g);
        let bending = d / 2.0
            * (w_xx * w_xx + w_yy * w_yy + 2.0 * nu * w_xx * w_yy + 2.0 * (1.0 - nu) * w_xy * w_xy);
        (membrane, bending)
    };
    let over = |part: fn((f64, f64)) -> f64| {
        rule.integrate(0.0, plate.length, |x| {
            rule.integrate(0.0, plate.width, |y| part(at(x, y)))
        })
    };
    (over(|both| both.0), over(|both| both.1))
}

/// A rectangle with odd and even terms, and in the shear-free basis cosines of index 0.
fn mixed(basis: InPlaneBasis) -> Plate {
    let cosine = match basis {
        InPlaneBasis::Fixed => 1,
        InPlaneBasis::ShearFree => 0,
    };
    let set = ModeSet {
        u: modes(&[(1, cosine), (2, 2), (2, 1), (4, cosine), (3, 2)]),
        v: modes(&[(cosine, 2), (2, 2), (1, 3), (cosine, 1), (2, 4)]),
        w: modes(&[(1, 1), (2, 1), (1, 3), (2, 2), (3, 1)]),
    };
    Plate {
        length: 1.3,
        width: 0.8,
        ..square(0.3, set, basis)
    }
}

/// The four parts of U_p, from the tensors alone: 1/2 p.K p, 1/2 r.K_b r, B p r r, Q r r r r.
fn energy_parts(e: &Elasticity, p: &[f64], r: &[f64]) -> [f64; 4] {
    let pairs = || (0..p.len()).flat_map(|i| (0..p.len()).map(move |k| (i, k)));
    let coupling = |b: &CouplingTerm| b.multiplicity() * b.value * p[b.i] * r[b.j] * r[b.k];
    [
        pairs()
            .map(|(i, k)| 0.5 * p[i] * e.membrane_at(i, k) * p[k])
            .sum(),
        e.bending.iter().zip(r).map(|(k, r)| 0.5 * k * r * r).sum(),
        e.coupling.iter().map(coupling).sum(),
        quartic_energy(&e.quartic, r),
    ]
}

fn quartic_energy(terms: &[QuarticTerm], r: &[f64]) -> f64 {
    let product = |q: &QuarticTerm| q.indices().map(|index| r[index]).iter().product::<f64>();
    terms
        .iter()
        .map(|q| q.multiplicity() * q.value * product(q))
        .sum()
}

fn amplitudes(count: usize) -> impl Strategy<Value = Vec<f64>> {
    proptest::collection::vec(-1.0..1.0_f64, count)
}

const BASES: [InPlaneBasis; 2] = [InPlaneBasis::Fixed, InPlaneBasis::ShearFree];

proptest! {
    #![proptest_config(cases(24))]

    #[test]
    fn every_tensor_is_its_energy_by_quadrature(p in amplitudes(10), r in amplitudes(5)) {
        for plate in BASES.map(mixed) {
            let e = plate.elasticity().unwrap();
            let zero = [0.0; 10];
            let minus: Vec<f64> = p.iter().map(|p| -p).collect();
            let membrane = |p: &[f64], r: &[f64]| energies_by_quadrature(&plate, p, r).0;
            let expected = [
                membrane(&p, &[0.0; 5]),
                energies_by_quadrature(&plate, &zero, &r).1,
                // what is odd in p is the coupling
                0.5 * (membrane(&p, &r) - membrane(&minus, &r)),
                membrane(&zero, &r),
            ];
            // quadrature and sums of some hundred terms: rounding only, of the energies that cancel
            let rounding = 1e-12 * (membrane(&p, &r) + membrane(&minus, &r));
            let tolerance = [1e-12 * expected[0], 1e-12 * expected[1], rounding, 1e-12 * expected[3]];
            let parts = energy_parts(&e, &p, &r);
            for ((part, expected), tolerance) in parts.iter().zip(expected).zip(tolerance) {
                prop_assert!((part - expected).abs() <= tolerance, "{part} {expected}");
            }
            let total: f64 = expected.iter().sum();
            let tolerance: f64 = tolerance.iter().sum();
            prop_assert!((e.strain_energy(&p, &r) - total).abs() <= tolerance);
        }
    }

    #[test]
    fn the_elastic_force_is_the_gradient_of_the_energy(p in amplitudes(10), r in amplitudes(5)) {
        for plate in BASES.map(mixed) {
            let e = plate.elasticity().unwrap();
            let (on_p, on_r) = e.elastic_force(&p, &r);
            let x = [p.clone(), r.clone()].concat();
            let force = [on_p, on_r].concat();
            let energy = |index: usize, step: f64| {
                let mut x = x.clone();
                x[index] += step;
                e.strain_energy(&x[..10], &x[10..])
            };
            for (index, force) in force.iter().enumerate() {
                // five points are exact for a quartic polynomial, whatever the step
                let s = 0.5;
                let [far_back, back, ahead, far_ahead] =
                    [-2.0, -1.0, 1.0, 2.0].map(|steps| energy(index, steps * s));
                let slope = (8.0 * (ahead - back) - (far_ahead - far_back)) / (12.0 * s);
                // rounding of the energies
                prop_assert!((force - slope).abs() <= 1e-12 * far_ahead.max(far_back));
            }
        }
    }

    #[test]
    fn condensed_energy_is_the_least_over_in_plane_terms(p in amplitudes(10), r in amplitudes(5)) {
        for plate in BASES.map(mixed) {
            let e = plate.elasticity().unwrap();
            let rest = e.in_plane_from_transverse(&r);
            let scale = quartic_energy(&e.quartic, &r);
            let condensed = quartic_energy(&e.condensed_quartic().unwrap(), &r);
            let [_, bending, ..] = energy_parts(&e, &rest, &r);
            prop_assert!((e.strain_energy(&rest, &r) - bending - condensed).abs() < 1e-12 * scale);
            prop_assert!(condensed > 0.0 && condensed < scale);
            // in-plane forces vanish there, and any other p costs 1/2 (p - rest).K (p - rest)
            let moved: Vec<f64> = rest.iter().zip(&p).map(|(rest, p)| rest + p).collect();
            let [extra, ..] = energy_parts(&e, &p, &r);
            let difference = e.strain_energy(&moved, &r) - e.strain_energy(&rest, &r);
            prop_assert!((difference - extra).abs() < 1e-12 * (scale + extra));
        }
    }
}

#[test]
fn lists_are_sorted_and_hold_no_zeros() {
    for basis in BASES {
        let plate = Plate {
            length: 1.4,
            ..square(0.3, ModeSet::complete(3, 3, basis), basis)
        };
        let e = plate.elasticity().unwrap();
        assert!(e.coupling.is_sorted_by_key(|b| (b.i, b.j, b.k)));
        assert!(e.coupling.iter().all(|b| b.value != 0.0 && b.j <= b.k));
        let condensed = e.condensed_quartic().unwrap();
        for list in [&e.quartic, &condensed] {
            assert!(list.is_sorted_by_key(QuarticTerm::indices));
            assert!(
                list.iter()
                    .all(|q| q.value != 0.0 && q.indices().is_sorted())
            );
        }
        // selection rules leave a small part of the N_p * 45 and of the 495 entries
        assert!(e.coupling.len() * 5 < e.in_plane_mass.len() * 45 && e.quartic.len() * 2 < 495);
    }
}

#[test]
fn without_in_plane_terms_the_condensed_tensor_is_q() {
    let mut plate = Plate::dias_del_prado();
    (plate.modes.u, plate.modes.v) = (Vec::new(), Vec::new());
    let e = plate.elasticity().unwrap();
    assert_eq!(e.condensed_quartic().unwrap(), e.quartic);
    assert_eq!(e.in_plane_from_transverse(&[1.0; 4]), Vec::<f64>::new());
    assert_eq!(plate.in_plane_frequencies_hz().unwrap(), Vec::<f64>::new());
}

#[test]
fn longer_in_plane_lists_change_nothing_in_the_shear_free_basis() {
    let basis = InPlaneBasis::ShearFree;
    let condensed = |in_plane: u32| {
        let set = ModeSet {
            w: ModeSet::complete(2, 2, basis).w,
            ..ModeSet::complete(in_plane, in_plane, basis)
        };
        square(0.3, set, basis)
            .elasticity()
            .unwrap()
            .condensed_quartic()
            .unwrap()
    };
    let (enough, more) = (condensed(2), condensed(3));
    assert_eq!(enough.len(), more.len());
    for (enough, more) in enough.iter().zip(&more) {
        assert_close(enough.value / more.value, 1.0, 1e-11);
    }
}

#[test]
fn base_load_is_the_integral_of_the_shape_and_not_the_printed_constant() {
    let mut plate = Plate::dias_del_prado();
    plate.modes.w.push(Mode::new(2, 1));
    let mass = plate.elasticity().unwrap().transverse_mass;
    assert_eq!(mass, 8750.0);
    let rule = GaussLegendre::new(20);
    for (index, load) in plate.elasticity().unwrap().base_load.iter().enumerate() {
        let shape = |x: f64, y: f64| plate.mode_shape(x, y)[index];
        let integral = rule.integrate(0.0, 14.0, |x| rule.integrate(0.0, 10.0, |y| shape(x, y)));
        // rho h = 250 kg/m^2; quadrature to rounding
        assert_close(*load, 250.0 * integral, 1e-10);
    }
    // DP Eqs. (9c), (11b) print 16/pi^2 for all of w_11, w_13, w_31, w_33: 1, 3, 3, 9 times this
    let printed = 16.0 / PI.powi(2) * mass;
    let base_load = plate.base_load();
    for (load, times) in base_load.iter().zip([1.0, 3.0, 3.0, 9.0]) {
        assert_close(printed / load, times, 1e-14);
    }
    assert_eq!(base_load[4], 0.0);
}

#[test]
fn a_cosine_of_index_zero_doubles_the_mass() {
    let set = ModeSet {
        u: modes(&[(2, 0), (2, 2)]),
        v: modes(&[(0, 2), (2, 2)]),
        w: modes(&[(1, 1)]),
    };
    let plate = square(0.3, set, InPlaneBasis::ShearFree);
    assert_eq!(
        plate.elasticity().unwrap().in_plane_mass,
        [0.5, 0.25, 0.5, 0.25]
    );
}

// ---------------------------------------------------------------- static deflection

#[test]
fn navier_series_gives_timoshenkos_coefficient() {
    let w = (1..=40)
        .flat_map(|m| (1..=40).map(move |n| Mode::new(m, n)))
        .collect();
    let set = ModeSet {
        u: Vec::new(),
        v: Vec::new(),
        w,
    };
    let plate = square(0.3, set, InPlaneBasis::Fixed);
    // D = q = a = 1
    let r = plate.linear_deflection(&[Load::Pressure(1.0)]).unwrap();
    let centre = plate.deflection_at(&r, 0.5, 0.5);
    // Timoshenko & Woinowsky-Krieger, Table 8: 0.00406; 0.00406235 with 40 x 40 terms, derived
    // independently to the digits shown
    assert_close(centre, 0.004_062_35, 5e-9);
    // the same table of the same book for a central point load, Table 23: 0.01160 P a^2/D; the
    // series to 40 terms lacks 4e-6
    let r = plate
        .linear_deflection(&[Load::Point {
            x: 0.5,
            y: 0.5,
            force: 1.0,
        }])
        .unwrap();
    assert_close(plate.deflection_at(&r, 0.5, 0.5), 0.011_60, 1e-5);
}

/// Levy 1942, NACA TR 737, square plate, nu^2 = 0.1, edges immovable: q a^4/(E h^4), and w/h at the
/// centre to three digits.
const LEVY: [(f64, f64); 4] = [
    (14.78, 0.485),
    (51.4, 0.952),
    (132.0, 1.402),
    (278.5, 1.846),
];

/// Largest relative difference from Levy's table with these w terms (m, n up to 7, both odd).
fn difference_from_levy(w: Vec<Mode>) -> f64 {
    let mut set = ModeSet {
        w,
        ..ModeSet::complete(7, 7, InPlaneBasis::ShearFree)
    };
    // products of slopes of odd terms hold even half-waves only
    let even = |mode: &Mode| mode.m.is_multiple_of(2) && mode.n.is_multiple_of(2);
    set.u.retain(even);
    set.v.retain(even);
    let plate = square(0.1_f64.sqrt(), set, InPlaneBasis::ShearFree);
    let elasticity = plate.elasticity().unwrap();
    let difference = |(load, expected): (f64, f64)| {
        let pressure = load * plate.youngs_modulus * plate.thickness.powi(4);
        let f = plate.generalized_load(&[Load::Pressure(pressure)]).unwrap();
        let r = elasticity.deflection(&f).unwrap();
        // in equilibrium: the whole plate's forces, not only the condensed ones
        let (on_p, on_r) = elasticity.elastic_force(&elasticity.in_plane_from_transverse(&r), &r);
        assert!(on_p.iter().all(|force| force.abs() < 1e-9 * f[0]));
        assert!(
            on_r.iter()
                .zip(&f)
                .all(|(force, f_j)| (force - f_j).abs() < 1e-9 * f[0])
        );
        (plate.deflection_at(&r, 0.5, 0.5) / plate.thickness / expected - 1.0).abs()
    };
    LEVY.map(difference).into_iter().fold(0.0, f64::max)
}

#[test]
fn levys_table_of_large_deflections() {
    // six terms reproduce the three printed digits: 1 in 485 is 0.2 %
    let six = modes(&[(1, 1), (1, 3), (3, 1), (3, 3), (1, 5), (5, 1)]);
    assert!(difference_from_levy(six) < 0.0015);
    // sixteen terms show that six were not quite enough: 0.5 % at the largest load
    let odd = || (1..=7).step_by(2);
    let sixteen = odd()
        .flat_map(|m| odd().map(move |n| Mode::new(m, n)))
        .collect();
    assert!(difference_from_levy(sixteen) < 0.007);
}

// ---------------------------------------------------------------- backbone

fn shear_free(poisson_ratio: f64) -> Plate {
    let basis = InPlaneBasis::ShearFree;
    square(poisson_ratio, ModeSet::complete(1, 1, basis), basis)
}

#[test]
fn shear_free_cubic_coefficient_is_its_closed_form() {
    // eps = 3/4 ((1 + nu) + (1 - nu^2)/2) for a square: 1.316250 at nu = 0.3
    assert_close(shear_free(0.3).one_mode().unwrap().cubic, 1.316_25, 1e-13);
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn shear_free_cubic_coefficient_of_any_rectangle(aspect in 0.2..5.0_f64, nu in -0.9..0.49_f64) {
        // Airy's function F = E h A^2/32 ((l/k)^2 cos 2kx + (k/l)^2 cos 2ly) solves the
        // compatibility equation, and the edges must undo the mean stretches A^2 k^2/8, A^2 l^2/8
        let plate = Plate { width: aspect, ..shear_free(nu) };
        let (k, l) = (PI, PI / aspect);
        let (e_x, e_y) = (k * k / 8.0, l * l / 8.0);
        let stretch = (e_x * e_x + e_y * e_y + 2.0 * nu * e_x * e_y) / (2.0 * (1.0 - nu * nu));
        let waves = (k.powi(4) + l.powi(4)) / 256.0;
        let bending = (k * k + l * l).powi(2) / (48.0 * (1.0 - nu * nu));
        let expected = 4.0 * (stretch + waves) / bending;
        prop_assert!((plate.one_mode().unwrap().cubic / expected - 1.0).abs() < 1e-12);
    }
}

#[test]
fn chu_and_herrmanns_backbone() {
    // Chu & Herrmann 1956 (J. Appl. Mech. 23), square plate, nu = 0.3; printed to four decimals
    let one: OneMode = shear_free(0.3).one_mode().unwrap();
    assert_close(one.omega, 2.0 * PI * PI, 1e-12);
    for (amplitude, expected) in [
        (0.2, 1.0195),
        (0.4, 1.0757),
        (0.6, 1.1625),
        (0.8, 1.2734),
        (1.0, 1.4024),
    ] {
        assert_close(one.exact_ratio(amplitude), expected, 5e-5);
        // one harmonic alone is 0.5 % off at w = h
        assert_close(one.harmonic_balance_ratio(amplitude), expected, 0.008);
    }
}

#[test]
fn fixed_edges_converge_to_a_slightly_stiffer_plate() {
    // derived independently to six decimals; "n terms per direction" are u (2i, 2j-1), v (2j-1, 2i)
    for (count, expected) in [
        (1, 1.403686),
        (2, 1.327407),
        (4, 1.323444),
        (8, 1.323011),
        (12, 1.322967),
    ] {
        let pairs = || (1..=count).flat_map(|i| (1..=count).map(move |j| (2 * i, 2 * j - 1)));
        let set = ModeSet {
            u: pairs().map(|(even, odd)| Mode::new(even, odd)).collect(),
            v: pairs().map(|(even, odd)| Mode::new(odd, even)).collect(),
            w: modes(&[(1, 1)]),
        };
        assert_close(
            square(0.3, set, InPlaneBasis::Fixed)
                .one_mode()
                .unwrap()
                .cubic,
            expected,
            1e-6,
        );
    }
}
