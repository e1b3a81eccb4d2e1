//! Small systems with known answers, for tests of steppers and of analyses.

use crate::builder::SystemBuilder;
use crate::program::{BuildError, Transition};
use crate::system::System;

/// A ball under gravity `g` that bounces with restitution `e`: states height and speed, one mode.
/// Dropped from height H it comes to rest, after infinitely many bounces, at
/// sqrt(2 H/g) (1 + e)/(1 - e).
///
/// # Panics
/// If a number is not finite or the interval not positive.
pub fn bouncing_ball(g: f64, e: f64, interval: f64) -> System {
    let mut b = SystemBuilder::new(2);
    let (height, speed) = (b.state(0), b.state(1));
    let fall = b.linear(-g, &[]);
    let rebound = b.linear(0.0, &[(-e, speed)]);
    b.derivative(0, speed);
    b.derivative(1, fall);
    b.unit(vec![vec![Transition::falling(height, 0).reset(1, rebound)]]);
    finish(b.build(interval))
}

/// x'' + 2 zeta x' + x = a cos(omega t), with a wall at x = `wall` that only marks the side: mode 0
/// while x < wall, mode 1 while x > wall, and nothing else happens there.
///
/// # Panics
/// If a number is not finite or omega not positive.
pub fn forced_oscillator(zeta: f64, a: f64, omega: f64, wall: f64) -> System {
    let mut b = SystemBuilder::new(2);
    let (x, v) = (b.state(0), b.state(1));
    let (cos, _) = b.drive(omega);
    let acceleration = b.linear(0.0, &[(-1.0, x), (-2.0 * zeta, v), (a, cos)]);
    let over = b.linear(-wall, &[(1.0, x)]);
    b.derivative(0, v);
    b.derivative(1, acceleration);
    b.unit(vec![
        vec![Transition::rising(over, 1)],
        vec![Transition::falling(over, 0)],
    ]);
    finish(b.build(0.0))
}

/// x'' = -stiffness(side) x: free oscillation of a bilinear spring, soft (1) for x < 0 and stiff (k)
/// for x > 0. Its period is pi (1 + 1/sqrt(k)) and x' at x = 0 keeps its size.
///
/// # Panics
/// If k is not finite or the interval not positive.
pub fn bilinear_oscillator(k: f64, interval: f64) -> System {
    let mut b = SystemBuilder::new(2);
    let (x, v) = (b.state(0), b.state(1));
    let side = b.reserve_unit();
    let force = b.gate(side, &[-1.0, -k], x);
    b.derivative(0, v);
    b.derivative(1, force);
    b.define_unit(
        side,
        vec![
            vec![Transition::rising(x, 1)],
            vec![Transition::falling(x, 0)],
        ],
    );
    finish(b.build(interval))
}

/// y' = 1 with a unit that follows the sign of the product of (y - root): a guard with as many
/// crossings as there are roots (at most 4).
///
/// # Panics
/// If a root is not finite, there are none, or the interval is not positive.
pub fn ramp_with_roots(roots: &[f64], interval: f64) -> System {
    let mut b = SystemBuilder::new(1);
    let y = b.state(0);
    let one = b.linear(1.0, &[]);
    b.derivative(0, one);
    let factors: Vec<_> = roots.iter().map(|&r| b.linear(-r, &[(1.0, y)])).collect();
    let guard = factors[1..]
        .iter()
        .fold(factors[0], |product, &f| b.dot(&[(product, f)]));
    b.unit(vec![
        vec![Transition::falling(guard, 1)],
        vec![Transition::rising(guard, 0)],
    ]);
    finish(b.build(interval))
}

fn finish(built: Result<System, BuildError>) -> System {
    built.unwrap_or_else(|e| panic!("a test system with impossible numbers: {e}"))
}
