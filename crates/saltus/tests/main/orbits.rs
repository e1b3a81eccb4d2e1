//! Periodic orbits of the paper's case and their branches.

use std::sync::atomic::AtomicBool;

use saltus::hybrid::{Method, Options};
use saltus::model::{Model, Setup};
use saltus::orbits::{Differences, NewtonOptions, Stroboscopic, find_orbit};
use saltus::study::{Control, OrbitError, OrbitSearch, orbit, portrait, sequence, simulate};

const SEARCH: OrbitSearch = OrbitSearch {
    period: None,
    transient: 200,
    segments: None,
};

fn one_thread() -> Control {
    Control {
        threads: 1,
        ..Control::default()
    }
}

fn paper(zeta: f64, ratio: f64) -> Model {
    Setup::dias_del_prado(zeta, ratio).model().unwrap()
}

#[test]
fn the_named_cases_of_fig_3_are_orbits() {
    // (zeta_h, ratio, period): DP Fig. 3a, 3b, 3e; 3d and 3h at values of ours within their regimes
    for (zeta, ratio, period) in [
        (0.15, 0.9, 2),
        (0.35, 0.9, 1),
        (0.28, 1.0, 2),
        (0.45, 1.1, 2),
    ] {
        let model = paper(zeta, ratio);
        let start = model.start(3.0, 2.0);
        let found = orbit(&model, &start, &SEARCH, &one_thread()).unwrap();
        assert_eq!(found.period(), period, "{zeta} {ratio}");
        assert!(found.stable() && found.residual < 1e-11);
        let control = one_thread();
        let run = simulate(&model, &start, 1000, 0, 1, &control).unwrap();
        let seen = portrait(&model, &found, &control).unwrap();
        let last = run.section.last().unwrap();
        // The long-term motion is on it, to the accuracy of its integration.
        let nearest = seen
            .section
            .iter()
            .map(|s| (s.z[0] - last.z[0]).abs())
            .fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-6, "{zeta} {ratio}: {nearest}");
        let contact: f64 = run.contact_ratio[900..].iter().map(|r| r[0]).sum::<f64>() / 100.0;
        assert!((contact - seen.contact_ratio[0]).abs() < 1e-6);
        assert_eq!(
            seen.touch_down_phases[0].len(),
            sequence(&model, &found).matches('L').count()
        );
    }
}

#[test]
fn multipliers_do_not_depend_on_the_number_of_segments() {
    let model = paper(0.36, 1.1);
    let at = |segments| {
        let search = OrbitSearch {
            segments: Some(segments),
            transient: 1500,
            ..SEARCH
        };
        orbit(&model, &model.start(3.0, 2.0), &search, &one_thread()).unwrap()
    };
    let whole = at(1);
    for segments in [2, whole.period()] {
        let cut = at(segments);
        assert_eq!(cut.period(), whole.period());
        for (a, b) in whole.multipliers.iter().zip(&cut.multipliers) {
            assert!((a.re - b.re).hypot(a.im - b.im) < 1e-8, "{a:?} {b:?}");
        }
    }
}

#[test]
fn the_product_of_the_multipliers_is_liouvilles() {
    let model = paper(0.35, 0.9);
    let found = orbit(&model, &model.start(3.0, 2.0), &SEARCH, &one_thread()).unwrap();
    let seen = portrait(&model, &found, &one_thread()).unwrap();
    let tau = std::f64::consts::TAU;
    let dwell = [
        seen.contact_ratio[0] * tau,
        (1.0 - seen.contact_ratio[0]) * tau,
    ];
    let expected = model.divergence(&[dwell.to_vec()]);
    let product: f64 = found.multipliers.iter().map(|m| m.modulus().ln()).sum();
    assert!((product - expected).abs() < 1e-9, "{product} {expected}");
}

#[test]
fn chaos_has_no_orbit_by_itself_and_an_unstable_one_when_asked() {
    let model = paper(0.12, 1.0);
    let start = model.start(3.0, 2.0);
    match orbit(&model, &start, &SEARCH, &one_thread()) {
        Err(OrbitError::NoReturn { .. } | OrbitError::Newton(_)) => {}
        Ok(found) => assert!(!found.stable()),
        Err(other) => panic!("{other}"),
    }
}

#[test]
fn the_period_doubling_of_fig_2a_is_where_runge_kutta_puts_it() {
    // 0.1892865091 by continuation with Taylor series and tangents; here RK4 on a fixed grid, differences of plain
    // trajectories, and the secant method on the multiplier.
    let stop = AtomicBool::new(false);
    let options = Options {
        method: Method::Rk4 {
            steps_per_period: 3000,
        },
        ..Options::default()
    };
    let system = |p: &[f64]| Ok(paper(p[0], 0.9).system().clone());
    let model = paper(0.19, 0.9);
    let flow = Stroboscopic::new(system, model.free_states(), options, 0, &stop);
    let differences = Differences::new(&flow, 1e-5);
    let start = orbit(&model, &model.start(3.0, 2.0), &SEARCH, &one_thread()).unwrap();
    let above = |zeta: f64| {
        let newton = NewtonOptions {
            tolerance: 1e-10,
            ..NewtonOptions::default()
        };
        let found = find_orbit(&differences, &[zeta], &start.places[..1], &newton).unwrap();
        let real = found
            .multipliers
            .iter()
            .filter(|m| m.im == 0.0)
            .map(|m| m.re + 1.0);
        real.min_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap()
    };
    let (mut a, mut b) = (0.1893, 0.1892);
    let (mut at_a, mut at_b) = (above(a), above(b));
    for _ in 0..3 {
        let next = b - at_b * (b - a) / (at_b - at_a);
        (a, at_a) = (b, at_b);
        (b, at_b) = (next, above(next));
    }
    assert!((b - 0.189_286_509_1).abs() < 1e-8, "{b:.12}");
}
