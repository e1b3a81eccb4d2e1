//! Chaotic motion: two correct methods part ways after some periods, as they must, and agree in what
//! does not depend on the trajectory. Periodic motion: they agree to the error of the coarser one.

#![allow(clippy::unwrap_used)] // a test may panic

use saltus::hybrid::{Method, Options};
use saltus::model::Setup;
use saltus::study::{Bodies, Control, Pass, Sweep, SweepRow, sweep};

const RK4: Method = Method::Rk4 {
    steps_per_period: 400,
};
const TAYLOR: Method = Method::Taylor {
    tolerance: 1e-8,
    order: 14,
};

fn control(method: Method) -> Control {
    Control {
        options: Options {
            method,
            ..Options::default()
        },
        ..Control::default()
    }
}

/// Runs from many starts at one damping ratio, Omega at the occupied body frequency.
fn rows(zeta: f64, starts: usize, record: u64, method: Method) -> Vec<SweepRow> {
    let start = |i: usize| Pass::Start((-3.0 + 0.37 * i as f64, 2.0 - 0.21 * i as f64));
    let question = Sweep {
        values: vec![zeta],
        passes: (0..starts).map(start).collect(),
        start: (3.0, 2.0),
        transient: 200,
        record,
    };
    let model = |zeta| Setup::dias_del_prado(zeta, 1.0).model();
    sweep(&question, model, &control(method)).unwrap()
}

/// Mean and its standard error over independent runs.
fn mean(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let values: Vec<f64> = values.collect();
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0);
    (mean, (variance / n).sqrt())
}

fn assert_same(what: &str, (a, a_error): (f64, f64), (b, b_error): (f64, f64)) {
    let bound = 4.0 * a_error.hypot(b_error);
    assert!(
        (a - b).abs() < bound && bound > 0.0,
        "{what}: {a} +- {a_error}, {b} +- {b_error}"
    );
}

#[test]
fn chaos_has_the_same_statistics_by_both_methods() {
    // zeta_h = 0.12: an exponent of 0.27 per period (DP Fig. 3c).
    let (taylor, rk4) = (rows(0.12, 24, 300, TAYLOR), rows(0.12, 24, 300, RK4));
    assert_ne!(taylor[0].z()[0][299], rk4[0].z()[0][299]);
    let z = |row: &SweepRow| row.z()[0].iter().sum::<f64>() / row.z()[0].len() as f64;
    assert_same(
        "mean of z/eta",
        mean(taylor.iter().map(z)),
        mean(rk4.iter().map(z)),
    );
    let square =
        |row: &SweepRow| row.z()[0].iter().map(|z| z * z).sum::<f64>() / row.z()[0].len() as f64;
    assert_same(
        "mean of (z/eta)^2",
        mean(taylor.iter().map(square)),
        mean(rk4.iter().map(square)),
    );
    let contact = |row: &SweepRow| row.contact_ratio[0];
    assert_same(
        "contact ratio",
        mean(taylor.iter().map(contact)),
        mean(rk4.iter().map(contact)),
    );
}

#[test]
fn a_periodic_attractor_is_the_same_to_the_error_of_rk4() {
    // zeta_h = 0.28: period 2 (DP Fig. 3e). The error of RK4 falls sixteenfold when the step halves.
    let taylor = rows(0.28, 1, 4, TAYLOR);
    let error = |steps_per_period| {
        let rk4 = rows(0.28, 1, 4, Method::Rk4 { steps_per_period });
        let pairs = taylor[0].z()[0].iter().zip(&rk4[0].z()[0]);
        pairs.fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()))
    };
    let (coarse, fine) = (error(200), error(400));
    assert!(coarse < 1e-3 && fine > 1e-9, "{coarse:e} {fine:e}");
    assert!((8.0..32.0).contains(&(coarse / fine)), "{}", coarse / fine);
}
