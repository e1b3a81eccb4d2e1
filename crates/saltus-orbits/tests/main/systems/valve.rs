//! A pressure relief valve: a disc on a spring, x'' + kappa x' + x + delta = p, thrown back with restitution r by its
//! seat at x = 0, and a vessel that is filled at the rate q, p' = beta (q - x sqrt p). The equations are those of
//! Hos & Champneys 2012, Physica D 241, 2068.
//!
//! A square root is no sum or product, so s = sqrt p is the state, with s' = p'/(2 s), and u = 1/s is another one,
//! with u' = -u^2 s' + RATE u (1 - u s). The last term vanishes where u s = 1 and draws u s there. Without it u s
//! would be a constant of the motion with a multiplier 1 of its own, and no orbit would be isolated.

use saltus_hybrid::{System, SystemBuilder, Transition};
use saltus_orbits::{Image, MapPoint, MapRequest, ParametricMap, SpecialKind};

use super::independent::{bisected, newton, rk4};
use super::machine::{along, both, curve, kinds, map, only, orbit, place, settled};

const KAPPA: f64 = 1.25;
const DELTA: f64 = 10.0;
const BETA: f64 = 20.0;

/// Between the other contraction rates at rest, which are 0 and some 8.
const RATE: f64 = 5.0;

/// Some 1.2 rad of the oscillation that begins at the Hopf point: not near a resonance.
const INTERVAL: f64 = 0.4;

/// Of the parameters (q, kappa), with the seat at x = `seat`.
fn valve([q, kappa]: [f64; 2], seat: f64) -> Result<System, String> {
    let mut b = SystemBuilder::new(4);
    let [x, v, s, u] = [0, 1, 2, 3].map(|i| b.state(i));
    let pressure = b.squares(&[s])[0];
    let products = b.products(&[(x, s), (u, s)]);
    let filling = b.linear(BETA * q / 2.0, &[(-BETA / 2.0, products[0])]);
    let ds = b.products(&[(filling, u)])[0];
    let shrinking = b.products(&[(u, ds)])[0];
    let growth = b.linear(RATE, &[(-RATE, products[1]), (-1.0, shrinking)]);
    let du = b.products(&[(u, growth)])[0];
    let acceleration = b.linear(-DELTA, &[(-kappa, v), (-1.0, x), (1.0, pressure)]);
    for (i, rate) in [v, acceleration, ds, du].into_iter().enumerate() {
        b.derivative(i, rate);
    }
    let lift = b.linear(-seat, &[(1.0, x)]);
    let back = b.linear(0.0, &[(-0.8, v)]);
    b.unit(vec![vec![Transition::falling(lift, 0).reset(1, back)]]);
    b.build(INTERVAL).map_err(|error| error.to_string())
}

fn at_rest(x: f64) -> MapPoint {
    let s = (x + DELTA).sqrt();
    place(&[0], &[x, 0.0, s, 1.0 / s])
}

/// The q that holds the valve open by x.
fn flow(x: f64) -> f64 {
    x * (x + DELTA).sqrt()
}

/// The opening at which rest loses stability, and the frequency. About rest, with b = beta x/(2 s), eigenvalues obey
/// (l + b)(l^2 + kappa l + 1) + beta s = 0, two of which are +-i omega where
/// (kappa + b)(1 + kappa b) = b + beta s, omega^2 = 1 + kappa b.
fn hopf(kappa: f64) -> (f64, f64) {
    let rate = |x: f64| BETA * x / (2.0 * (x + DELTA).sqrt());
    let balance = |x: f64| {
        let b = rate(x);
        (kappa + b) * (1.0 + kappa * b) - b - BETA * (x + DELTA).sqrt()
    };
    let x = bisected(balance, 0.1, 10.0);
    (x, (1.0 + kappa * rate(x)).sqrt())
}

#[test]
fn the_valve_begins_to_flutter_at_the_hopf_point() {
    let map = map(4, |p: &[f64]| valve([p[0], p[1]], 0.0));
    let start = orbit(&map, &[flow(3.0), KAPPA], at_rest(3.0));
    let range = along(0, 6.0, 11.0);
    let branch = both(&map, &start, &range);
    assert_eq!(kinds(&branch), ["NS"]);
    let (point, (x, omega)) = (only(&branch, "NS"), hopf(KAPPA));
    // 8.491118
    let off = point.parameter - flow(x);
    assert!(off.abs() < 1e-10, "{off}");
    assert_eq!(point.outside, [2, 0]);
    let SpecialKind::NeimarkSacker { angle } = point.kind else {
        panic!("{:?}", point.kind);
    };
    assert!((angle - omega * INTERVAL).abs() < 1e-10);
    // The state that was added has the multiplier it was given.
    let added = (-RATE * INTERVAL).exp();
    let mut multipliers = point.orbit.multipliers.iter();
    assert!(multipliers.any(|mu| (mu.re - added).hypot(mu.im) < 1e-10));
    for point in curve(&map, point, [&range, &along(1, 1.0, 1.5)]) {
        let [q, kappa] = point.parameters;
        assert!((q - flow(hopf(kappa).0)).abs() < 1e-9, "{q} {kappa}");
    }
}

/// The next two cycles of a motion, with what happens on the way: 12 intervals.
fn cycles(map: &impl ParametricMap, q: f64, mut at: MapPoint) -> Vec<Image> {
    let next = |_| {
        let shot = MapRequest {
            parameters: &[q, KAPPA],
            start: &at,
            derivative: true,
        };
        let image = map.images(&[shot]).remove(0).unwrap();
        at = image.place.clone();
        image
    };
    (0..12).map(next).collect()
}

#[test]
fn the_flutter_grazes_the_seat_where_a_boundary_value_problem_says() {
    // With the seat lowered to -1 the cycle is smooth and its lowest opening a function of q. It draws
    // neighbours to it by 0.98 in an interval: 1500 of them leave 1e-13.
    let smooth = map(4, |p: &[f64]| valve([p[0], p[1]], -1.0));
    let mut at = at_rest(2.0);
    at.x[1] = 0.1;
    at = settled(&smooth, &[7.6, KAPPA], at, 500);
    let mut lowest = |q: f64| {
        at = settled(&smooth, &[q, KAPPA], at.clone(), 1500);
        let images = cycles(&smooth, q, at.clone());
        let lows = images.iter().flat_map(|image| &image.touches);
        lows.map(|touch| touch.value - 1.0)
            .fold(f64::INFINITY, f64::min)
    };
    // The secant method takes four steps from here to rounding.
    let (mut a, mut b) = (7.6, 7.57);
    let (mut at_a, mut at_b) = (lowest(a), lowest(b));
    for _ in 0..4 {
        let next = b - at_b * (b - a) / (at_b - at_a);
        (a, at_a) = (b, at_b);
        (b, at_b) = (next, lowest(next));
    }
    // From (0, 0, p) back to it after T, at q: three equations for (p, T, q).
    let field =
        |q: f64, [x, v, p]: [f64; 3]| [v, p - KAPPA * v - x - DELTA, BETA * (q - x * p.sqrt())];
    let [_, _, q] = newton(
        |&[p, t, q]: &[f64; 3]| {
            let end = rk4(|_, y| field(q, *y), [0.0, 0.0, p], 0.0, t, 4000);
            [end[0], end[1], end[2] - p]
        },
        [15.0, 2.5, b + 1e-3],
    );
    assert!((b - q).abs() < 1e-8, "{b} {q}");
    // With the seat in its place it is missed on one side of that and hit on the other.
    let map = map(4, |p: &[f64]| valve([p[0], p[1]], 0.0));
    for (q, hit) in [(q + 1e-6, false), (q - 1e-6, true)] {
        let at = settled(&smooth, &[q, KAPPA], at.clone(), 1500);
        let mut images = cycles(&map, q, at).into_iter();
        assert_eq!(images.any(|image| !image.crossings.is_empty()), hit, "{q}");
    }
}
