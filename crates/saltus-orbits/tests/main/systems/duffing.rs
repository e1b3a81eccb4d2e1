//! Duffing's oscillator x'' + d x' + a x + x^3 = f cos(omega t).

use std::f64::consts::TAU;

use saltus_hybrid::{System, SystemBuilder};
use saltus_orbits::{
    BranchWithOrigin, BranchesOptions, ContinuationOptions, CurvePoint, End, ParameterRange,
    Special, SpecialKind, branches,
};

use super::independent::{characteristic, newton, rk4};
use super::machine::{along, both, curve, exponents, kinds, map, orbit, place, settled};

/// d where a = 1.
const DAMPING: f64 = 0.2;

/// Of the parameters (f, omega).
fn duffing(d: f64, a: f64, [f, omega]: [f64; 2]) -> Result<System, String> {
    let mut b = SystemBuilder::new(2);
    let (x, v) = (b.state(0), b.state(1));
    let (cos, _) = b.drive(omega);
    let square = b.squares(&[x])[0];
    let cube = b.products(&[(square, x)])[0];
    let acceleration = b.linear(0.0, &[(-a, x), (-d, v), (-1.0, cube), (f, cos)]);
    b.derivative(0, v);
    b.derivative(1, acceleration);
    b.build(0.0).map_err(|error| error.to_string())
}

/// x, v and the two tangent columns after `part` of a period, by steps with errors of 1e-12 to 1e-10.
fn way([x, v]: [f64; 2], [f, omega]: [f64; 2], part: f64) -> ([f64; 2], [[f64; 2]; 2]) {
    let field = |t: f64, &[x, v, dx, dv, ex, ev]: &[f64; 6]| {
        let pull = |x: f64, v: f64, k: f64| -DAMPING * v - k * x;
        let (push, slope) = (f * (omega * t).cos(), 1.0 + 3.0 * x * x);
        let rate = push + pull(x, v, 1.0 + x * x);
        [v, rate, dv, pull(dx, dv, slope), ev, pull(ex, ev, slope)]
    };
    let start = [x, v, 1.0, 0.0, 0.0, 1.0];
    let y = rk4(field, start, 0.0, part * TAU / omega, 12000);
    ([y[0], y[1]], [[y[2], y[4]], [y[3], y[5]]])
}

/// The parameter near `guess` at which the orbit near (x, v) has the multiplier `mu`: three equations.
/// Over half a period a symmetric orbit comes to its mirror image, and breaks its symmetry where the
/// derivative of minus that half has the multiplier -1.
fn critical(x: &[f64], guess: f64, with: impl Fn(f64) -> [f64; 2], mu: f64, half: bool) -> f64 {
    let (part, sign) = if half { (0.5, -1.0) } else { (1.0, 1.0) };
    let equations = |&[x, v, p]: &[f64; 3]| {
        let (end, m) = way([x, v], with(p), part);
        let m = m.map(|row| row.map(|entry| sign * entry));
        [sign * end[0] - x, sign * end[1] - v, characteristic(m, mu)]
    };
    // Off by far more than what is tested.
    newton(equations, [x[0] + 1e-4, x[1] - 1e-4, guess + 1e-4])[2]
}

#[test]
fn the_resonance_folds_where_a_runge_kutta_method_says() {
    let map = map(2, |p: &[f64]| duffing(DAMPING, 1.0, [p[0], p[1]]));
    let at = settled(&map, &[0.3, 0.5], place(&[], &[0.0, 0.0]), 30);
    let start = orbit(&map, &[0.3, 0.5], at);
    let (force, frequency) = (along(0, 0.05, 0.6), along(1, 0.3, 2.5));
    let branch = both(&map, &start, &frequency);
    assert_eq!(kinds(&branch), ["LP", "LP"]);
    for fold in &branch.specials {
        let x = &fold.orbit.places[0].x;
        let omega = critical(x, fold.parameter, |omega| [0.3, omega], 1.0, false);
        assert!(
            (fold.parameter - omega).abs() < 1e-9,
            "{} {omega}",
            fold.parameter
        );
    }
    // Both folds lie on one curve over the plane, with a cusp between them.
    let points = curve(&map, &branch.specials[0], [&frequency, &force]);
    let most = ContinuationOptions::default().largest;
    let met = |fold: &Special| {
        let here = [fold.parameter, 0.3];
        let near =
            |point: &CurvePoint| (0..2).all(|i| (point.parameters[i] - here[i]).abs() < most);
        points.iter().any(near)
    };
    assert!(branch.specials.iter().all(met));
    for point in points.iter().step_by(10) {
        let ([omega, f], x) = (point.parameters, &point.orbit.places[0].x);
        let (end, m) = way([x[0], x[1]], [f, omega], 1.0);
        let off = [end[0] - x[0], end[1] - x[1], characteristic(m, 1.0)];
        assert!(
            off.iter().all(|off| off.abs() < 1e-9),
            "{omega} {f} {off:?}"
        );
    }
}

/// All branches over the force at omega = 1 that are connected with the motion at `f`.
fn limbs(f: f64, range: ParameterRange) -> Vec<BranchWithOrigin> {
    let map = map(2, |p: &[f64]| duffing(DAMPING, 1.0, [p[0], p[1]]));
    let start = settled(&map, &[f, 1.0], place(&[], &[0.0, 0.0]), 100);
    let options = BranchesOptions {
        continuation: ContinuationOptions {
            weight: 5.0,
            points: 500,
            ..ContinuationOptions::default()
        },
        doublings: 1,
        ..BranchesOptions::default()
    };
    let start = orbit(&map, &[f, 1.0], start);
    branches(&map, &start, &range, &options, &mut |_| true).unwrap()
}

#[test]
fn symmetry_is_broken_and_the_period_doubled_where_a_runge_kutta_method_says() {
    let limbs = limbs(22.0, along(0, 20.0, 37.0));
    let found: Vec<_> = limbs.iter().map(|limb| kinds(&limb.branch)).collect();
    // Two mirror images grow from the symmetric branch, and each of them doubles.
    let pair = vec!["PD", "LP", "LP", "LP", "LP", "PD"];
    assert_eq!(found, [vec!["BP"], pair, vec!["PD"], vec!["PD"]]);
    for special in limbs[..2].iter().flat_map(|limb| &limb.branch.specials) {
        let (x, there) = (&special.orbit.places[0].x, special.parameter);
        let (mu, half) = match special.kind {
            SpecialKind::BranchPoint => (-1.0, true),
            SpecialKind::PeriodDoubling => (-1.0, false),
            _ => (1.0, false),
        };
        let f = critical(x, there, |f| [f, 1.0], mu, half);
        assert!((there - f).abs() < 2e-9, "{} {there} {f}", special.label);
    }
}

#[test]
fn a_bubble_between_two_losses_of_symmetry_is_followed_once() {
    let found = limbs(1.0, along(0, 0.5, 14.0));
    let kinds: Vec<_> = found.iter().map(|limb| kinds(&limb.branch)).collect();
    assert_eq!(kinds, [vec!["BP", "BP"], vec!["BP"]]);
    assert_eq!(found[1].branch.ends[1], End::Closed);
}

#[test]
fn uedas_attractor_has_its_published_exponents() {
    // x'' + 0.05 x' + x^3 = 7.5 cos t: 0.1034 and -0.1534 (Sprott, Chaos and Time-Series Analysis, 2003,
    // appendix A). The standard error of this record is some 0.001.
    let system = duffing(0.05, 0.0, [7.5, 1.0]).unwrap();
    let starts: Vec<_> = (0..8)
        .map(|i| vec![2.5 + 0.01 * f64::from(i), 0.0])
        .collect();
    let record = exponents(&system, &starts, 100, 4000);
    for (exponent, published) in record.estimate().iter().zip([0.1034, -0.1534]) {
        let error = exponent.standard_error / TAU;
        let off = exponent.per_iterate / TAU - published;
        assert!(off.abs() < 4.0 * error && error < 2e-3, "{off} {error}");
    }
    assert!((record.sum().per_iterate / TAU + 0.05).abs() < 1e-12);
}
