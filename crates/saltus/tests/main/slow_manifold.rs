//! The slow manifold against the true full model (17 degrees of freedom), and against the condensed one.

#![allow(clippy::unwrap_used)] // a test may panic

use saltus::hybrid::{Method, Options, Recording, Segment, record};
use saltus::model::{Inertia, ModelError, Setup};
use saltus::physics::{InPlaneBasis, ModeSet};

/// (r/h, r'/(h Omega), z/h, z'/(h Omega)) after some periods of the paper's case.
fn end(setup: &Setup, periods: u64, method: Method) -> (Vec<f64>, Recording) {
    let model = setup.model().unwrap();
    let segment = Segment {
        system: model.system().clone(),
        start: model.start(3.0, 2.0),
        periods,
    };
    let options = Options {
        method,
        ..Options::default()
    };
    let run = record(&segment, &options).unwrap();
    let states = model.free_states();
    (run.end.point.x[states - 10..states].to_vec(), run)
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()))
}

fn with(inertia: Inertia, zeta: f64, ratio: f64) -> Setup {
    Setup {
        inertia,
        ..Setup::dias_del_prado(zeta, ratio)
    }
}

fn taylor(tolerance: f64, order: usize) -> Method {
    Method::Taylor { tolerance, order }
}

#[test]
fn it_is_a_hundred_thousand_times_closer_to_the_full_model_than_condensation() {
    // The bounds are twice what was measured: 2.2e-10, 1.3e-10, 1.9e-9 and 3.3e-5, 3.2e-5, 6.8e-4.
    for (zeta, ratio, slow_bound, condensed) in [
        (0.45, 0.9, 5e-10, 3.3e-5),
        (0.3, 0.9, 3e-10, 3.2e-5),
        (0.45, 1.1, 4e-9, 6.8e-4),
    ] {
        let full = end(&with(Inertia::Full, zeta, ratio), 20, taylor(1e-13, 18)).0;
        let slow = end(
            &with(Inertia::SlowManifold, zeta, ratio),
            20,
            taylor(1e-13, 18),
        );
        let error = distance(&slow.0, &full);
        assert!(error < slow_bound, "{zeta} {ratio}: {error:e}");
        let condensed_error = distance(
            &end(
                &with(Inertia::Condensed, zeta, ratio),
                20,
                taylor(1e-13, 18),
            )
            .0,
            &full,
        );
        assert!(
            (condensed_error / condensed - 1.0).abs() < 0.1,
            "{condensed_error:e}"
        );
        assert!(slow.1.end.switches > 30);
    }
}

#[test]
fn the_papers_method_on_the_full_model_agrees() {
    // RK4 on the true 17 degrees of freedom, located switches: 4e-9 at 4000 steps, from its own error.
    let rk4 = Method::Rk4 {
        steps_per_period: 4000,
    };
    let full = end(&with(Inertia::Full, 0.45, 0.9), 20, rk4).0;
    let slow = end(
        &with(Inertia::SlowManifold, 0.45, 0.9),
        20,
        taylor(1e-11, 16),
    )
    .0;
    let error = distance(&full, &slow);
    assert!(error < 2e-8, "{error:e}");
}

#[test]
fn rk4_integrates_it_too() {
    let setup = with(Inertia::SlowManifold, 0.3, 1.0);
    let rk4 = Method::Rk4 {
        steps_per_period: 2000,
    };
    let (rk4, taylor) = (end(&setup, 3, rk4).0, end(&setup, 3, taylor(1e-12, 16)).0);
    let error = distance(&rk4, &taylor);
    assert!(error < 1e-7, "{error:e}");
}

#[test]
fn too_many_terms_are_refused_by_name() {
    let mut setup = with(Inertia::SlowManifold, 0.3, 1.0);
    setup.plate.modes = ModeSet::complete(4, 4, InPlaneBasis::Fixed);
    let error = setup.model().unwrap_err();
    assert!(matches!(
        error,
        ModelError::SlowManifold {
            terms: 16,
            limit: 9
        }
    ));
    assert!(error.to_string().contains("slow-manifold"));
}
