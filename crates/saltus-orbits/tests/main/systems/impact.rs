//! The impact oscillator of Shaw & Holmes (1983, J. Sound Vib. 90, 129): x'' + 2 zeta x' + x = cos(omega t)
//! for x < sigma, thrown back there with restitution r.

use std::f64::consts::TAU;

use saltus_hybrid::{System, SystemBuilder, Transition};
use saltus_orbits::{MapPoint, NewtonOptions, Orbit, ParametricMap, find_orbit};

use super::independent::{bisected, characteristic, product, steady, swing};
use super::machine::{along, both, curve, kinds, map, place};

const ZETA: f64 = 0.02;
const R: f64 = 0.8;

/// Of the parameters (omega, sigma).
fn oscillator([omega, sigma]: [f64; 2]) -> Result<System, String> {
    let mut b = SystemBuilder::new(2);
    let (x, v) = (b.state(0), b.state(1));
    let (cos, _) = b.drive(omega);
    let acceleration = b.linear(0.0, &[(-1.0, x), (-2.0 * ZETA, v), (1.0, cos)]);
    let gap = b.linear(sigma, &[(-1.0, x)]);
    let back = b.linear(0.0, &[(-R, v)]);
    b.derivative(0, v);
    b.derivative(1, acceleration);
    b.unit(vec![vec![Transition::falling(gap, 0).reset(1, back)]]);
    b.build(0.0).map_err(|error| error.to_string())
}

/// One impact in n periods: the time of the impact, the speed after it, the derivative once around.
#[derive(Debug)]
struct Once {
    t: f64,
    v: f64,
    monodromy: [[f64; 2]; 2],
}

/// The orbits with one impact in n periods. With the steady solution (p, p') subtracted, the flight from
/// (d, v - p') to (d, -v/r - p') is linear: d and p' are multiples of v. And p = sigma - d and p' lie on the
/// ellipse of the steady solution, which is quadratic in v.
fn once([omega, sigma]: [f64; 2], n: usize) -> Vec<Once> {
    let flight = n as f64 * TAU / omega;
    let e = swing(ZETA, 1.0, flight);
    // (e11 - 1) d - e12 p' = -e12 v; e21 d + (1 - e22) p' = -(1/r + e22) v.
    let [a, b, c, f] = [e[0][0] - 1.0, -e[0][1], e[1][0], 1.0 - e[1][1]];
    let [g, h] = [-e[0][1], -1.0 / R - e[1][1]];
    let det = a * f - b * c;
    let (d, slope) = ((g * f - b * h) / det, (a * h - g * c) / det);
    let size = 1.0 / (1.0 - omega * omega).hypot(2.0 * ZETA * omega);
    let square = d * d + slope * slope / (omega * omega);
    let root = (sigma * d).powi(2) - square * (sigma * sigma - size * size);
    let both = [-1.0, 1.0].map(|sign| (sigma * d + sign * root.sqrt()) / square);
    // After the impact it flies away from the wall.
    let away = both.into_iter().filter(|v| *v < 0.0);
    away.map(|v| {
        // The steady solution is c0 cos(omega t) + s0 sin(omega t).
        let [c0, s0] = steady(ZETA, 1.0, omega, 0.0);
        let s0 = s0 / omega;
        let (p, q) = (sigma - d * v, slope * v / omega);
        let t = (s0 * p - c0 * q).atan2(c0 * p + s0 * q).rem_euclid(TAU) / omega;
        let acceleration = |v: f64| (omega * t).cos() - sigma - 2.0 * ZETA * v;
        let before = -v / R;
        let kick = (acceleration(v) + R * acceleration(before)) / before;
        Once {
            t,
            v,
            monodromy: product([[-R, 0.0], [kick, -R]], e),
        }
    })
    .collect()
}

/// Its places at the beginnings of n periods.
fn places([omega, sigma]: [f64; 2], n: usize, once: &Once) -> Vec<MapPoint> {
    let period = TAU / omega;
    let from = steady(ZETA, 1.0, omega, once.t);
    let off = [sigma - from[0], once.v - from[1]];
    let at = |k: usize| {
        let t = period * if k == 0 { n as f64 } else { k as f64 };
        let (to, e) = (steady(ZETA, 1.0, omega, t), swing(ZETA, 1.0, t - once.t));
        place(
            &[0],
            &[0, 1].map(|i| to[i] + e[i][0] * off[0] + e[i][1] * off[1]),
        )
    };
    (0..n).map(at).collect()
}

/// The orbit with one impact in n periods that flies off fastest, as the code under test finds it.
fn found(map: &impl ParametricMap, parameters: [f64; 2], n: usize) -> Orbit {
    let mut all = once(parameters, n);
    all.sort_by(|a, b| a.v.total_cmp(&b.v));
    let start = places(parameters, n, &all[0]);
    let orbit = find_orbit(map, &parameters, &start, &NewtonOptions::default()).unwrap();
    assert_eq!((orbit.period(), orbit.crossings.concat().len()), (n, 1));
    let impact = orbit.crossings[0][0].at * TAU / parameters[0];
    // Newton's tolerance.
    assert!((impact - all[0].t).abs() < 1e-10);
    let [a, b] = all[0].monodromy;
    let trace = orbit.multipliers[0].re + orbit.multipliers[1].re;
    assert!((trace - a[0] - b[1]).abs() < 1e-10, "{trace} {all:?}");
    orbit
}

fn doubling(omega: f64, sigma: f64, n: usize) -> f64 {
    characteristic(once([omega, sigma], n)[0].monodromy, -1.0)
}

#[test]
fn one_impact_in_a_period_doubles_where_the_closed_form_says() {
    let map = map(2, |p: &[f64]| oscillator([p[0], p[1]]));
    let range = along(0, 2.2, 2.9);
    let branch = both(&map, &found(&map, [2.5, 0.0], 1), &range);
    assert_eq!(kinds(&branch), ["PD"]);
    let exact = bisected(|omega| doubling(omega, 0.0, 1), 2.6, 2.7);
    assert!(
        (branch.specials[0].parameter - exact).abs() < 1e-10,
        "{exact}"
    );
    for point in curve(&map, &branch.specials[0], [&range, &along(1, -0.1, 0.1)]) {
        let [omega, sigma] = point.parameters;
        let off = doubling(omega, sigma, 1);
        assert!(off.abs() < 1e-9, "{omega} {sigma} {off}");
    }
}

#[test]
fn one_impact_in_two_periods_doubles_and_folds_where_the_closed_form_says() {
    let map = map(2, |p: &[f64]| oscillator([p[0], p[1]]));
    let branch = both(&map, &found(&map, [4.0, 0.0], 2), &along(0, 3.2, 4.8));
    let exact = [[3.3, 3.4], [4.6, 4.7]];
    let exact = exact.map(|[a, b]| bisected(|omega| doubling(omega, 0.0, 2), a, b));
    assert_eq!(kinds(&branch), ["PD", "PD"]);
    for (special, exact) in branch.specials.iter().zip(exact) {
        assert!((special.parameter - exact).abs() < 1e-10, "{exact}");
    }
    // With the wall a little off two solutions meet at the last frequency that has any.
    let branch = both(&map, &found(&map, [3.6, 0.2], 2), &along(0, 3.1, 4.0));
    let exact = bisected(|omega| once([omega, 0.2], 2).len() as f64 - 0.5, 3.7, 3.8);
    assert_eq!(kinds(&branch), ["LP"]);
    assert!(
        (branch.specials[0].parameter - exact).abs() < 1e-10,
        "{exact}"
    );
}
