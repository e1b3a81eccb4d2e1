//! x'' + 2 zeta x' + x = cos(omega t) before a wall at x = sigma. Its amplitude is known, so
//! the wall that it grazes is.

use saltus_hybrid::{System, SystemBuilder, Transition, testing};
use saltus_orbits::{Branch, End, Multiplier, ParametricMap, Special};

use super::independent::steady;
use super::machine::{along, both, curve, map, only, orbit, place};

const ZETA: f64 = 0.05;
const OMEGA: f64 = 0.8;

/// Of the parameters (sigma, omega): a wall that throws back with restitution 0.8.
fn hard([sigma, omega]: [f64; 2]) -> Result<System, String> {
    let mut b = SystemBuilder::new(2);
    let (x, v) = (b.state(0), b.state(1));
    let (cos, _) = b.drive(omega);
    let acceleration = b.linear(0.0, &[(-1.0, x), (-2.0 * ZETA, v), (1.0, cos)]);
    let gap = b.linear(sigma, &[(-1.0, x)]);
    let back = b.linear(0.0, &[(-0.8, v)]);
    b.derivative(0, v);
    b.derivative(1, acceleration);
    b.unit(vec![vec![Transition::falling(gap, 0).reset(1, back)]]);
    b.build(0.0).map_err(|error| error.to_string())
}

/// The same with a wall that is a spring of stiffness 1, so the force is continuous.
fn soft([sigma, omega]: [f64; 2]) -> Result<System, String> {
    let mut b = SystemBuilder::new(2);
    let (x, v) = (b.state(0), b.state(1));
    let (cos, _) = b.drive(omega);
    let over = b.linear(-sigma, &[(1.0, x)]);
    let side = b.reserve_unit();
    let spring = b.gate(side, &[0.0, -1.0], over);
    let terms = [(-1.0, x), (-2.0 * ZETA, v), (1.0, cos), (1.0, spring)];
    let acceleration = b.linear(0.0, &terms);
    b.derivative(0, v);
    b.derivative(1, acceleration);
    b.define_unit(
        side,
        vec![
            vec![Transition::rising(over, 1)],
            vec![Transition::falling(over, 0)],
        ],
    );
    b.build(0.0).map_err(|error| error.to_string())
}

/// Largest displacement without a wall: 2.711630723 at 0.8.
fn amplitude(omega: f64) -> f64 {
    1.0 / (1.0 - omega * omega).hypot(2.0 * ZETA * omega)
}

/// The branch from a wall out of reach to one at 2, where there is one switch, or two, in a period.
fn towards(map: &impl ParametricMap, switches: usize) -> Branch {
    let start = place(&[0], &steady(ZETA, 1.0, OMEGA, 0.0));
    let branch = both(map, &orbit(map, &[3.0, OMEGA], start), &along(0, 2.0, 3.2));
    assert_eq!(branch.ends, [End::RangeEnd, End::RangeEnd]);
    let ends = [0, branch.points.len() - 1].map(|i| &branch.points[i]);
    let count = ends.map(|point| (point.parameter, point.orbit.crossings[0].len()));
    assert_eq!(count, [(2.0, switches), (3.2, 0)]);
    branch
}

#[test]
fn a_wall_that_only_tells_the_side_changes_nothing_but_the_switches() {
    let system = |p: &[f64]| Ok(testing::forced_oscillator(ZETA, 1.0, p[1], p[0]));
    let branch = towards(&map(2, system), 2);
    let grazing = only(&branch, "GR");
    assert!((grazing.parameter - amplitude(OMEGA)).abs() < 1e-9);
    assert_eq!((branch.specials.len(), &grazing.remark), (1, &None));
    let there = grazing.orbit.multipliers[0];
    let off = |mu: Multiplier| (mu.re - there.re).hypot(mu.im - there.im);
    let mut points = branch.points.iter();
    // What the tangent flow is solved to.
    assert!(points.all(|point| off(point.orbit.multipliers[0]) < 1e-12));
}

#[test]
fn a_soft_wall_is_grazed_at_the_amplitude_and_the_branch_goes_on() {
    let map = map(2, |p: &[f64]| soft([p[0], p[1]]));
    let branch = towards(&map, 2);
    let grazing = only(&branch, "GR");
    assert!((grazing.parameter - amplitude(OMEGA)).abs() < 1e-9);
    assert_eq!((branch.specials.len(), &grazing.remark), (1, &None));
    assert_curve(&map, grazing);
}

/// The curve of a grazing over wall and frequency begins at the wall, and keeps 1e-9 off it.
fn assert_curve(map: &impl ParametricMap, grazing: &Special) {
    let over = [&along(0, 2.0, 3.2), &along(1, 0.7, 0.9)];
    for point in curve(map, grazing, over) {
        let [sigma, omega] = point.parameters;
        let off = sigma - amplitude(omega);
        assert!((-1e-10..2e-9).contains(&off), "{off} {omega}");
    }
}

#[test]
fn at_a_hard_wall_stability_is_lost_by_a_jump() {
    // With v = 0 at contact the derivative of an impact is infinite, by a square root.
    let branch = towards(&map(2, |p: &[f64]| hard([p[0], p[1]])), 1);
    let grazing = only(&branch, "GR");
    assert_eq!((branch.specials.len(), grazing.outside), (1, [1, 0]));
    let remark = grazing.remark.as_ref().unwrap();
    assert!(remark.contains("without a multiplier"), "{remark}");
}

#[test]
fn a_hard_wall_is_grazed_at_the_amplitude() {
    // Far nearer than the differences over the parameter reach.
    let branch = towards(&map(2, |p: &[f64]| hard([p[0], p[1]])), 1);
    let off = only(&branch, "GR").parameter - amplitude(OMEGA);
    assert!(off.abs() < 1e-9, "{off}");
}

#[test]
fn the_grazing_of_a_hard_wall_lies_on_the_curve_of_amplitudes() {
    let map = map(2, |p: &[f64]| hard([p[0], p[1]]));
    assert_curve(&map, only(&towards(&map, 1), "GR"));
}
