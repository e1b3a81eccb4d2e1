//! Exponents of flows whose directions part by more than numbers hold in one period.

use std::sync::atomic::AtomicBool;

use saltus_hybrid::{Method, Options, Sample, Status, System, SystemBuilder, Transition};
use saltus_orbits::{Ascent, Climbed, Exponent, Start, climb};

const OPTIONS: Options = Options {
    method: Method::Taylor {
        tolerance: 1e-10,
        order: 14,
    },
    max_switches: 100,
    max_steps: 1_000_000,
    instructions: saltus_hybrid::Instructions::Best,
    samples_per_period: 1,
};

/// x' = A x, sampled once per unit of time.
fn linear(rows: &[&[f64]]) -> System {
    let mut b = SystemBuilder::new(rows.len());
    for (i, row) in rows.iter().enumerate() {
        let terms: Vec<_> = row
            .iter()
            .enumerate()
            .map(|(j, a)| (*a, b.state(j)))
            .collect();
        let rate = b.linear(0.0, &terms);
        b.derivative(i, rate);
    }
    b.build(1.0).unwrap()
}

fn climbed(system: &System, x: &[f64], modes: &[usize], transient: u64, periods: u64) -> Climbed {
    let start = Start {
        system: system.clone(),
        point: system.point(modes, x),
        watch: |_: &Sample<'_>| {},
    };
    let how = Ascent {
        columns: x.len(),
        transient,
        periods,
    };
    let mut found = climb(vec![start], &how, &OPTIONS, 1, &AtomicBool::new(false)).unwrap();
    found.remove(0)
}

#[track_caller]
fn assert_are(found: &[Exponent], exact: &[f64], off: f64) {
    for (found, exact) in found.iter().zip(exact) {
        let [low, high] = found.interval();
        assert!(low <= *exact && *exact <= high, "{exact}: {found:?}");
        assert!(
            (found.per_iterate - exact).abs() < off,
            "{exact}: {found:?}"
        );
        assert!(found.standard_error < 1e3 * off, "{exact}: {found:?}");
    }
}

/// Errors of 1e-10 per step: 1e-6 is more than the steps of a unit of time can add up to.
#[test]
fn stiff_directions_have_the_exponents_of_their_eigenvalues() {
    for (rows, exact) in [
        (&[&[-50.0, 0.0][..], &[0.0, -1.0]][..], &[-1.0, -50.0][..]),
        // neighbours that are no axes
        (
            &[&[-200.0, 900.0, 3.0], &[0.0, -1.0, 0.5], &[0.0, 0.0, -0.1]],
            &[-0.1, -1.0, -200.0],
        ),
        (&[&[20.0, 7.0], &[0.0, -50.0]], &[20.0, -50.0]),
        // more than the range of numbers in both directions
        (&[&[900.0, 0.0], &[5.0, -900.0]], &[900.0, -900.0]),
    ] {
        let system = linear(rows);
        let found = climbed(&system, &vec![0.0; exact.len()], &[], 30, 40);
        assert_eq!(found.end.status, Status::Completed);
        assert_are(&found.spectrum.estimate(), exact, 1e-6);
    }
}

/// x' = 80 (y - x), where y is a driven oscillator.
#[test]
fn a_stiff_follower_of_a_driven_oscillator_keeps_its_exponent() {
    let mut b = SystemBuilder::new(3);
    let (cos, _) = b.drive(1.0);
    let (x, v, follower) = (b.state(0), b.state(1), b.state(2));
    b.derivative(0, v);
    let force = b.linear(0.0, &[(-1.0, x), (-0.2, v), (1.0, cos)]);
    b.derivative(1, force);
    let chase = b.linear(0.0, &[(80.0, x), (-80.0, follower)]);
    b.derivative(2, chase);
    let system = b.build(1.0).unwrap();
    let found = climbed(&system, &[0.1, 0.0, 0.0], &[], 30, 200);
    let exponents = found.spectrum.estimate();
    let period = std::f64::consts::TAU;
    assert_are(&exponents[2..], &[-80.0 * period], 1e-5);
    // a complex pair: its two columns wander about -0.1
    let pair = exponents[0].per_iterate + exponents[1].per_iterate;
    assert!((pair + 0.2 * period).abs() < 1e-6, "{exponents:?}");
}

/// x' = 1 up to 1 and -1 down to 0, y' = -60 y, and z is set anew at each turn. What a switch takes away is -inf;
/// what the flow does is a number.
#[test]
fn a_direction_lost_by_a_switch_is_minus_infinity_and_one_lost_by_the_flow_is_not() {
    let mut b = SystemBuilder::new(3);
    let (x, y, z) = (b.state(0), b.state(1), b.state(2));
    let unit = b.reserve_unit();
    let one = b.linear(1.0, &[(0.0, x)]);
    let there_and_back = b.gate(unit, &[1.0, -1.0], one);
    let fast = b.linear(0.0, &[(-60.0, y)]);
    let slow = b.linear(0.0, &[(-0.5, z)]);
    for (i, rate) in [there_and_back, fast, slow].into_iter().enumerate() {
        b.derivative(i, rate);
    }
    let top = b.linear(-1.0, &[(1.0, x)]);
    b.define_unit(
        unit,
        vec![
            vec![Transition::rising(top, 1).reset(2, one)],
            vec![Transition::falling(x, 0).reset(2, one)],
        ],
    );
    let system = b.build(1.3).unwrap();
    let found = climbed(&system, &[0.35, 1.0, 1.0], &[0], 30, 100);
    assert_eq!(found.end.status, Status::Completed);
    let exponents = found.spectrum.estimate();
    // the phase of x is neither lost nor found
    assert_are(&exponents[..2], &[0.0, -78.0], 1e-5);
    assert_eq!(exponents[2].per_iterate, f64::NEG_INFINITY);
    assert_eq!(exponents[2].standard_error, 0.0);
}
