//! Orbits in families: quantities that a flow keeps make a multiplier 1, on either side of which rounding puts it.

use saltus_hybrid::{System, SystemBuilder};
use saltus_orbits::{NewtonOptions, Stability, find_orbit};

use super::machine::{map, orbit, place, settled};

/// A driven pendulum with sine and cosine as states: s' = c w, c' = -s w, w' = -s - 0.5 w + A cos(2 t / 3).
/// Whatever s^2 + c^2 is, it stays.
fn pendulum(amplitude: f64) -> System {
    let mut b = SystemBuilder::new(3);
    let (cos, _) = b.drive(2.0 / 3.0);
    let [s, c, w] = [0, 1, 2].map(|i| b.state(i));
    let products = b.products(&[(c, w), (s, w)]);
    let down = b.linear(0.0, &[(-1.0, products[1])]);
    let torque = b.linear(0.0, &[(-1.0, s), (-0.5, w), (amplitude, cos)]);
    b.derivative(0, products[0]);
    b.derivative(1, down);
    b.derivative(2, torque);
    b.build(1.0).unwrap()
}

/// w = 1.956 208 44 and the multipliers are those of the pendulum in its angle and rate, where nothing is kept.
#[test]
fn of_a_family_the_member_is_found_that_has_what_is_kept_from_the_start() {
    let family = map(3, |p: &[f64]| Ok(pendulum(p[0])));
    let mut met = 0;
    for k in 0..24 {
        let angle = -0.6 + 0.05 * f64::from(k);
        let start = place(&[], &[angle.sin(), angle.cos(), 1.9]);
        let Ok(found) = find_orbit(&family, &[1.07], &[start], &NewtonOptions::default()) else {
            continue;
        };
        let x = &found.places[0].x;
        assert!((x[0].hypot(x[1]) - 1.0).abs() < 1e-9, "{angle}: {x:?}");
        // there are other orbits
        if (x[2] - 1.956_208_44).abs() > 1e-3 {
            continue;
        }
        met += 1;
        assert!((x[2] - 1.956_208_44).abs() < 1e-8, "{x:?}");
        assert!(found.in_family());
        assert_eq!(found.stability(), Stability::Unstable);
        let re = |k: usize| found.multipliers[k].re;
        assert!(
            (re(0) + 1.129_628_97).abs() < 1e-8,
            "{:?}",
            found.multipliers
        );
        assert!((re(1) - 1.0).abs() <= found.multipliers[1].error);
        assert!((re(2) + 0.007_952_43).abs() < 1e-8);
    }
    assert!(met >= 5, "{met}");
}

/// Below its first doubling the same orbit is neither stable nor unstable: the length of (s, c) is not attracted.
#[test]
fn a_multiplier_that_is_one_to_rounding_is_neutral() {
    let family = map(3, |p: &[f64]| Ok(pendulum(p[0])));
    let start = settled(&family, &[0.9], place(&[], &[0.0, 1.0, 1.0]), 100);
    let found = orbit(&family, &[0.9], start);
    let x = &found.places[0].x;
    assert!((x[0].hypot(x[1]) - 1.0).abs() < 1e-9, "{x:?}");
    assert_eq!(
        found.stability(),
        Stability::Neutral,
        "{:?}",
        found.multipliers
    );
    assert_eq!(found.stability().is_stable(), None);
    assert_eq!(found.outside(), 0);
    assert!(!found.stable() && found.in_family());
}

/// x'' = -x is back after each of its own periods from everywhere.
#[test]
fn where_every_point_is_an_orbit_the_start_is_it() {
    let family = map(2, |_: &[f64]| {
        let mut b = SystemBuilder::new(2);
        let (x, v) = (b.state(0), b.state(1));
        b.derivative(0, v);
        let back = b.linear(0.0, &[(-1.0, x)]);
        b.derivative(1, back);
        Ok(b.build(std::f64::consts::TAU).unwrap())
    });
    let found = orbit(&family, &[], place(&[], &[0.3, -0.7]));
    assert_eq!(found.places[0].x, [0.3, -0.7]);
    assert_eq!(found.stability(), Stability::Neutral);
}

/// Two tanks that exchange what they hold, x' = -k x + y (1 + cos / 2), y' = -x': x + y stays, and the start has 3 of it.
#[test]
fn a_linear_quantity_is_kept_too() {
    let family = map(2, |_: &[f64]| {
        let mut b = SystemBuilder::new(2);
        let (cos, _) = b.drive(1.0);
        let (x, y) = (b.state(0), b.state(1));
        let product = b.products(&[(y, cos)]);
        let there = b.linear(0.0, &[(-0.4, x), (1.0, y), (0.5, product[0])]);
        let back = b.linear(0.0, &[(-1.0, there)]);
        b.derivative(0, there);
        b.derivative(1, back);
        Ok(b.build(1.0).unwrap())
    });
    let found = orbit(&family, &[], place(&[], &[2.5, 0.5]));
    let x = &found.places[0].x;
    assert!((x[0] + x[1] - 3.0).abs() < 1e-11, "{x:?}");
    assert!(found.in_family() && found.stability() == Stability::Neutral);
}
