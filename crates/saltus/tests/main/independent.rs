//! Two orbits computed by a program that shares nothing with this one but the equations:
//! `scripts/independent_check.py` (tensors by quadrature, SciPy's DOP853 with events at 1e-12).

use saltus::hybrid::{Method, Options};
use saltus::model::{Inertia, Setup};
use saltus::study::{Control, simulate};

/// zeta_h, Omega/omega_h, and after 20 periods z/eta, z'/(eta omega_h), r_11/h, r_13/h, r_31/h, r_33/h.
const ORBITS: [(f64, f64, [f64; 6]); 2] = [
    (
        0.45,
        0.9,
        [
            0.060928759321,
            1.825023754659,
            0.572157958869,
            0.002082205875,
            0.010853928930,
            0.000301645275,
        ],
    ),
    (
        0.28,
        1.0,
        [
            1.176553317575,
            3.065617423377,
            0.730272703704,
            0.002527369483,
            0.022012592682,
            0.000503224894,
        ],
    ),
];

fn largest_error(inertia: Inertia, method: Method, orbit: &(f64, f64, [f64; 6])) -> f64 {
    let (zeta, ratio, expected) = orbit;
    let setup = Setup {
        inertia,
        ..Setup::dias_del_prado(*zeta, *ratio)
    };
    let model = setup.model().unwrap();
    let options = Options {
        method,
        ..Options::default()
    };
    let control = Control {
        options,
        ..Control::default()
    };
    let run = simulate(&model, &model.start(3.0, 2.0), 20, 0, 1, &control).unwrap();
    let last = run.section.last().unwrap();
    let found = [
        last.z[0], last.v[0], last.w[0], last.w[1], last.w[2], last.w[3],
    ];
    found
        .iter()
        .zip(expected)
        .fold(0.0, |m: f64, (f, e)| m.max((f - e).abs()))
}

#[test]
fn both_steppers_agree_with_an_independent_program() {
    for orbit in &ORBITS {
        // The other program's tolerance of 1e-12 grows to a few 1e-10 over twenty periods.
        let taylor = largest_error(Inertia::Condensed, Method::taylor(1e-12), orbit);
        assert!(taylor < 2e-9, "Taylor: {taylor:e}");
        let rk4 = Method::Rk4 {
            steps_per_period: 4000,
        };
        let rk4 = largest_error(Inertia::Condensed, rk4, orbit);
        assert!(rk4 < 2e-9, "RK4: {rk4:e}");
    }
}

#[test]
fn the_full_model_differs_by_what_condensing_leaves_out() {
    // Twenty periods from rest, transients included: more than on a settled orbit, less than 1e-3.
    for orbit in &ORBITS {
        let difference = largest_error(Inertia::Full, Method::taylor(1e-10), orbit);
        assert!(difference > 1e-7 && difference < 1e-3, "{difference:e}");
    }
}
