//! A ball that bounces on a table at w = -A cos t under gravity 1, with restitution e. A is what is often called
//! Gamma, the largest acceleration of the table over that of gravity. Nothing is assumed about how high it flies.
//!
//! Once in a period it bounces where the table moves at A sin t = pi (1 - e)/(1 + e), up at the speed pi.

use std::f64::consts::{PI, TAU};

use saltus_hybrid::{System, SystemBuilder, Transition};
use saltus_orbits::{Branch, End, MapPoint, NewtonOptions, NoImage, NotFound, Orbit, find_orbit};

use super::machine::{along, both, curve, kinds, map, orbit, place};

/// The table's speed at the bounce: below it as the largest one there is no such motion.
fn speed(e: f64) -> f64 {
    PI * (1.0 - e) / (1.0 + e)
}

/// The A at which the motion doubles its period. The derivative from one bounce to the next has the determinant
/// e^4 and -1 among its multipliers where the table decelerates at 2 (1 + e^2)/(1 + e)^2.
fn flip(e: f64) -> f64 {
    speed(e).hypot(2.0 * (1.0 + e * e) / (1.0 + e).powi(2))
}

/// Of the parameters (A, e), with the table at -A cos(t + phase).
fn ball([a, e]: [f64; 2], phase: f64) -> Result<System, String> {
    let mut b = SystemBuilder::new(2);
    let (y, v) = (b.state(0), b.state(1));
    let (cos, sin) = b.drive(1.0);
    let (s, c) = phase.sin_cos();
    let gap = b.linear(0.0, &[(1.0, y), (a * c, cos), (-a * s, sin)]);
    let kick = (1.0 + e) * a;
    let rebound = b.linear(0.0, &[(-e, v), (kick * c, sin), (kick * s, cos)]);
    let fall = b.linear(-1.0, &[]);
    b.derivative(0, v);
    b.derivative(1, fall);
    b.unit(vec![vec![Transition::falling(gap, 0).reset(1, rebound)]]);
    b.build(0.0).map_err(|error| error.to_string())
}

/// Where the ball is at t = 0 if it bounces `before` that at table phase `at`, up at the speed pi.
fn after_bounce(a: f64, at: f64, before: f64) -> MapPoint {
    let y = -a * at.cos() + PI * before - before * before / 2.0;
    place(&[0], &[y, PI - before])
}

fn bounce(orbit: &Orbit) -> f64 {
    TAU * orbit.crossings[0][0].at
}

#[test]
fn a_ball_that_bounces_once_a_period_folds_and_flips_where_formulas_say() {
    let map = map(2, |p: &[f64]| ball([p[0], p[1]], 0.0));
    // The stable motion bounces while the table slows down.
    let bounces = |a: f64| PI - (speed(0.8) / a).asin();
    let at = after_bounce(0.6, bounces(0.6), TAU - bounces(0.6));
    let start = orbit(&map, &[0.6, 0.8], at);
    assert!(start.stable() && (bounce(&start) - bounces(0.6)).abs() < 1e-10);
    let (range, restitution) = (along(0, 0.2, 1.2), along(1, 0.6, 0.95));
    let branch = both(&map, &start, &range);
    assert_eq!(kinds(&branch), ["LP", "PD"]);
    for (special, exact) in branch.specials.iter().zip([speed, flip]) {
        let off = special.parameter - exact(0.8);
        assert!(off.abs() < 1e-11, "{} {off}", special.label);
        for point in curve(&map, special, [&range, &restitution]) {
            let [a, e] = point.parameters;
            assert!((a - exact(e)).abs() < 1e-9, "{} {a} {e}", special.label);
        }
    }
    // Beyond the fold the other motion, with the bounce before the table is fastest, comes back.
    let [other, stable] = [0, branch.points.len() - 1].map(|i| &branch.points[i]);
    assert_eq!([other.parameter, stable.parameter], [1.2, 1.2]);
    assert!((bounce(&stable.orbit) - bounces(1.2)).abs() < 1e-10);
    assert!((bounce(&other.orbit) - (PI - bounces(1.2))).abs() < 1e-10);
}

/// The branch from a bounce at the table phase at which it is for `start`, with the sampling instant where it is for
/// A = 0.7. It comes the later the larger A is.
fn through_the_instant(start: f64) -> Branch {
    let bounces = |a: f64| PI - (speed(0.8) / a).asin();
    let (at, phase) = (bounces(start), bounces(0.7));
    let map = map(2, |p: &[f64]| ball([p[0], p[1]], phase));
    let before = (phase - at).rem_euclid(TAU);
    let start = orbit(&map, &[start, 0.8], after_bounce(start, at, before));
    both(&map, &start, &along(0, 0.5, 1.0))
}

#[test]
fn a_bounce_may_wander_through_the_sampling_instant() {
    let branch = through_the_instant(0.6);
    assert_eq!(branch.ends, [End::RangeEnd, End::RangeEnd]);
    assert!(branch.specials.is_empty());
}

#[test]
fn a_bounce_may_wander_through_the_sampling_instant_the_other_way() {
    let branch = through_the_instant(0.8);
    assert_eq!(branch.ends, [End::RangeEnd, End::RangeEnd]);
    assert!(branch.specials.is_empty());
}

#[test]
fn a_ball_that_comes_to_rest_is_said_to_chatter() {
    // Below the fold the table cannot make up for the losses, and near the table the bounces accumulate.
    let map = map(2, |p: &[f64]| ball([p[0], p[1]], 0.0));
    let start = [place(&[0], &[0.1, 0.0])];
    let answer = find_orbit(&map, &[0.1, 0.5], &start, &NewtonOptions::default());
    let Err(NotFound::NoImage {
        reason: NoImage::Ended(why),
        ..
    }) = answer
    else {
        panic!("{answer:?}");
    };
    assert!(why.contains("chattering"), "{why}");
}
