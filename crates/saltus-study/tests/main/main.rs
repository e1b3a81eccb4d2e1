//! Every question, asked of systems that are no plate and hold no person.

#![allow(clippy::unwrap_used)]

use std::f64::consts::TAU;

use saltus_hybrid::{BuildError, Point, SystemBuilder, Transition};
use saltus_orbits::MotionKind;
use saltus_study::{
    Control, Flow, Grid, Measurement, OrbitSearch, Pass, Region, Search, StudyError, Subject,
    Sweep, census, follow, linspace, lyapunov, map, orbit, settle, sweep,
};

/// Duffing's oscillator with two wells: x'' + c x' - x + x^3 = f cos(omega t).
fn duffing(damping: f64, force: f64, omega: f64) -> Result<Flow, BuildError> {
    let mut b = SystemBuilder::new(2);
    let (x, v) = (b.state(0), b.state(1));
    let (cos, _) = b.drive(omega);
    let square = b.squares(&[x])[0];
    let cube = b.products(&[(square, x)])[0];
    let pull = b.linear(0.0, &[(1.0, x), (-1.0, cube), (-damping, v), (force, cos)]);
    b.derivative(0, v);
    b.derivative(1, pull);
    Ok(Flow::new(b.build(0.0)?))
}

/// A mass on a spring that meets a wall at `gap` and returns a part of its speed.
fn impacts(omega: f64) -> Result<Flow, BuildError> {
    let (gap, restitution, damping) = (0.5, 0.8, 0.05);
    let mut b = SystemBuilder::new(2);
    let (x, v) = (b.state(0), b.state(1));
    let (cos, _) = b.drive(omega);
    let pull = b.linear(0.0, &[(-1.0, x), (-2.0 * damping, v), (1.0, cos)]);
    let over = b.linear(-gap, &[(1.0, x)]);
    let rebound = b.linear(0.0, &[(-restitution, v)]);
    b.derivative(0, v);
    b.derivative(1, pull);
    b.unit(vec![vec![Transition::rising(over, 0).reset(1, rebound)]]);
    Ok(Flow::new(b.build(0.0)?))
}

fn well() -> Result<Flow, BuildError> {
    duffing(0.15, 0.1, 1.0)
}

#[test]
fn the_attractors_of_a_double_well_are_its_two_wells_and_their_shares_are_alike() {
    let region = Region {
        count: 64,
        ranges: vec![[-2.0, 2.0], [-1.5, 1.5]],
    };
    let found = census(
        &well().unwrap(),
        &region,
        &Search::default(),
        &Control::default(),
    )
    .unwrap();
    // by the symmetry x(t + T/2) -> -x(t) each motion in one well has its twin in the other
    let kinds: Vec<MotionKind> = found
        .attractors
        .iter()
        .map(|one| one.entry.attractor.kind)
        .collect();
    let mut means: Vec<f64> = Vec::new();
    for one in &found.attractors {
        let x = &one.arrival.section[0];
        means.push(x.iter().sum::<f64>() / x.len() as f64);
    }
    assert!(found.attractors.len() >= 2, "{kinds:?}");
    assert!(
        means.iter().any(|x| *x > 0.5) && means.iter().any(|x| *x < -0.5),
        "{means:?}"
    );
    for one in &found.attractors {
        assert!(one.entry.attractor.multiplier.unwrap() < 1.0);
    }
}

#[test]
fn a_linear_oscillator_answers_with_its_formula() {
    // x'' + 2 zeta x' + x = cos(omega t): section, multipliers and exponents in closed form
    let (zeta, omega) = (0.1, 0.7_f64);
    let linear = |omega: f64| -> Result<Flow, BuildError> {
        let mut b = SystemBuilder::new(2);
        let (x, v) = (b.state(0), b.state(1));
        let (cos, _) = b.drive(omega);
        let pull = b.linear(0.0, &[(-1.0, x), (-2.0 * zeta, v), (1.0, cos)]);
        b.derivative(0, v);
        b.derivative(1, pull);
        Ok(Flow::new(b.build(0.0)?))
    };
    let amplitude = |omega: f64| {
        let (p, q) = (1.0 - omega * omega, 2.0 * zeta * omega);
        (p / (p * p + q * q), q * omega / (p * p + q * q))
    };
    let control = Control::default();
    let flow = linear(omega).unwrap();
    let start = flow.start(&vec![0.0, 0.0]);
    let (x, v) = amplitude(omega);

    let settled = settle(&[(flow.clone(), start.clone())], 60, 4, &control).unwrap();
    assert!((settled[0].section[0][3] - x).abs() < 1e-8);

    let search = OrbitSearch {
        transient: 20,
        ..OrbitSearch::default()
    };
    let found = orbit(&flow, &start, &search, &control).unwrap();
    assert_eq!(found.period(), 1);
    assert!((found.places[0].x[0] - x).abs() < 1e-11 && (found.places[0].x[1] - v).abs() < 1e-11);
    let decay = -zeta * TAU / omega;
    for multiplier in &found.multipliers {
        assert!((multiplier.modulus() - decay.exp()).abs() < 1e-10);
    }

    let how = Measurement {
        exponents: 2,
        transient: 20,
        periods: 50,
        replicas: 2,
    };
    for exponent in lyapunov(&flow, &start, &how, &control).unwrap().exponents() {
        assert!((exponent.per_iterate - decay).abs() < 1e-8);
    }

    let asked = Sweep {
        values: linspace(0.3, 2.0, 18),
        passes: vec![Pass::Up, Pass::Start(vec![3.0, 0.0])],
        start: vec![0.0, 0.0],
        transient: 80,
        record: 3,
    };
    for row in sweep(&asked, linear, &control).unwrap() {
        let (x, v) = amplitude(row.value);
        assert!((row.section[0][2] - x).abs() < 1e-6, "{row:?}");
        assert!((row.section[1][2] - v).abs() < 1e-6, "{row:?}");
        assert!(row.contact_ratio.is_empty());
    }
}

#[test]
fn basins_and_attractors_along_a_parameter_are_found_for_any_system() {
    let grid = Grid {
        x: linspace(-1.5, 1.5, 6),
        y: linspace(-1.0, 1.0, 5),
    };
    let control = Control::default();
    let mut found = vec![None; grid.len()];
    let begin = |x: f64, v: f64| {
        let flow = well()?;
        let start = flow.start(&vec![x, v]);
        Ok((flow, start))
    };
    map(
        &grid,
        0..grid.len(),
        begin,
        &Search::default(),
        &control,
        |pixel, motion| {
            found[pixel] = Some(motion.attractor.is_ok());
            Ok::<(), StudyError<BuildError>>(())
        },
    )
    .unwrap();
    assert!(found.iter().all(|answer| *answer == Some(true)));

    let region = Region {
        count: 16,
        ranges: vec![[-1.5, 1.5], [-1.0, 1.0]],
    };
    let values = linspace(0.02, 0.12, 6);
    let force = |force: f64| duffing(0.15, force, 1.0);
    let along = follow(&values, force, &region, &Search::default(), &control).unwrap();
    assert_eq!(along.rows.len(), values.len());
    // at a weak force there is one cycle in each well, and each keeps its number
    assert_eq!(along.rows[0].attractors().len(), 2);
    assert!(along.identities.len() >= 2 && along.identities[0].first == 0.02);
}

#[test]
fn impacts_repeat_as_often_as_they_are_known_to() {
    // omega = 2.8: one impact in each period, by the closed form of its orbit
    let flow = impacts(2.8).unwrap();
    let start: Point = flow.start(&vec![0.0, 0.0]);
    let search = OrbitSearch {
        transient: 300,
        ..OrbitSearch::default()
    };
    let found = orbit(&flow, &start, &search, &Control::default()).unwrap();
    let switches: usize = found.crossings.iter().map(Vec::len).sum();
    // each impact multiplies areas by restitution^2, and damping by exp(-2 zeta T)
    let decay = -2.0 * 0.05 * TAU / 2.8 * found.period() as f64;
    let areas = 0.8_f64.powi(2 * switches as i32) * decay.exp();
    let product: f64 = found.multipliers.iter().map(|m| m.modulus()).product();
    assert!((product / areas - 1.0).abs() < 1e-8, "{found:?}");
}

#[test]
fn a_subject_without_a_section_is_refused() {
    let nothing = well().unwrap().showing(&[]);
    let region = Region {
        count: 4,
        ranges: vec![[0.0, 1.0]; 2],
    };
    let refused = census(&nothing, &region, &Search::default(), &Control::default());
    assert_eq!(refused, Err(StudyError::NoSection));
}
