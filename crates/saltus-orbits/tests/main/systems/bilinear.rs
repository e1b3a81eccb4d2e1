//! x'' + 2 zeta x' + k x = cos(omega t), with k = 1 for x < 0 and another k for x > 0.

use std::f64::consts::TAU;

use saltus_hybrid::{System, SystemBuilder, Transition};

use super::independent::{newton, product, steady, swing};
use super::machine::{map, orbit, place, settled};

const ZETA: f64 = 0.1;
const OMEGA: f64 = 0.7;

/// Of the parameter k.
fn bilinear(k: f64) -> Result<System, String> {
    let mut b = SystemBuilder::new(2);
    let (x, v) = (b.state(0), b.state(1));
    let (cos, _) = b.drive(OMEGA);
    let side = b.reserve_unit();
    let spring = b.gate(side, &[-1.0, -k], x);
    let acceleration = b.linear(0.0, &[(1.0, spring), (-2.0 * ZETA, v), (1.0, cos)]);
    b.derivative(0, v);
    b.derivative(1, acceleration);
    b.define_unit(
        side,
        vec![
            vec![Transition::rising(x, 1)],
            vec![Transition::falling(x, 0)],
        ],
    );
    b.build(0.0).map_err(|error| error.to_string())
}

/// From (0, v) at t0 to t1 with the stiffness k.
fn piece(k: f64, v: f64, t0: f64, t1: f64) -> [f64; 2] {
    let [from, to] = [t0, t1].map(|t| steady(ZETA, k, OMEGA, t));
    let (e, off) = (swing(ZETA, k, t1 - t0), [-from[0], v - from[1]]);
    [0, 1].map(|i| to[i] + e[i][0] * off[0] + e[i][1] * off[1])
}

#[test]
fn multipliers_are_those_of_two_exponentials_between_switches_of_the_closed_form() {
    let map = map(2, |p: &[f64]| bilinear(p[0]));
    let period = TAU / OMEGA;
    for k in [1.0, 2.0, 3.0] {
        let start = settled(&map, &[k], place(&[0], &[-1.0, 0.0]), 40);
        let orbit = orbit(&map, &[k], start);
        let way = &orbit.crossings[0];
        assert_eq!(way.len(), 2);
        // Up through zero at t0 with the speed v, down at t1, and up again a period later.
        let up = way.iter().find(|crossing| crossing.to == 1).unwrap();
        let down = way.iter().find(|crossing| crossing.to == 0).unwrap();
        let (t0, t1) = (up.at * period, down.at * period);
        let t1 = if t1 < t0 { t1 + period } else { t1 };
        let exact = newton(
            |&[t0, t1, v]| {
                let top = piece(k, v, t0, t1);
                let back = piece(1.0, top[1], t1, t0 + period);
                [top[0], back[0], back[1] - v]
            },
            [t0 + 1e-3, t1 - 1e-3, 1.0],
        );
        assert!(
            (exact[0] - t0).abs() < 1e-10 && (exact[1] - t1).abs() < 1e-10,
            "{exact:?} {t0} {t1}"
        );
        let m = product(swing(ZETA, 1.0, period + t0 - t1), swing(ZETA, k, t1 - t0));
        let (trace, det) = (m[0][0] + m[1][1], m[0][0] * m[1][1] - m[0][1] * m[1][0]);
        for mu in &orbit.multipliers {
            let re = mu.re * mu.re - mu.im * mu.im - trace * mu.re + det;
            let im = 2.0 * mu.re * mu.im - trace * mu.im;
            assert!(re.hypot(im) < 1e-10, "{mu:?} {trace} {det}");
        }
    }
}
