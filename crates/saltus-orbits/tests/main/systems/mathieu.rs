//! Mathieu's equation x'' + 2 zeta x' + (a - 2 q cos 2t) x = 0.

use faer::{Mat, c64};
use saltus_hybrid::{System, SystemBuilder};
use saltus_orbits::{MapRequest, ParametricMap};

use super::machine::{along, both, kinds, map, orbit, place};

/// Harmonics to each side: the first one left out of a solution is below 1e-30 at q = 5.
const HARMONICS: usize = 24;

/// Of the parameter a.
fn mathieu(zeta: f64, q: f64, a: f64) -> Result<System, String> {
    let mut b = SystemBuilder::new(2);
    let (x, v) = (b.state(0), b.state(1));
    let (cos, _) = b.drive(2.0);
    let stiffness = b.linear(a, &[(-2.0 * q, cos)]);
    let force = b.products(&[(stiffness, x)])[0];
    let acceleration = b.linear(0.0, &[(-1.0, force), (-2.0 * zeta, v)]);
    b.derivative(0, v);
    b.derivative(1, acceleration);
    b.build(0.0).map_err(|error| error.to_string())
}

/// The real a, in rising order, for which a sum of c_n exp(i n t) over odd n, or even n, is a solution: eigenvalues of
/// -x'' - 2 zeta x' + 2 q cos(2t) x.
fn characteristic_values(zeta: f64, q: f64, odd: bool) -> Vec<f64> {
    let size = 2 * HARMONICS + usize::from(!odd);
    let hill = Mat::from_fn(size, size, |i, j| {
        let n = 2.0 * i as f64 - (size as f64 - 1.0);
        match i.abs_diff(j) {
            0 => c64::new(n * n, -2.0 * zeta * n),
            1 => c64::new(q, 0.0),
            _ => c64::new(0.0, 0.0),
        }
    });
    let all = hill.eigenvalues().unwrap();
    let real = all.iter().filter(|value| value.im.abs() < 1e-9);
    let mut real: Vec<f64> = real.map(|value| value.re).collect();
    real.sort_by(f64::total_cmp);
    real
}

#[test]
fn characteristic_values_have_multipliers_of_one() {
    // Abramowitz & Stegun, table 20.1, q = 5: a_0, b_2, a_2 with period pi and b_1, a_1 with twice that.
    let published = [
        (
            false,
            [-5.800_046_02, 2.099_460_45, 7.449_109_74].as_slice(),
        ),
        (true, [-5.790_080_60, 1.858_187_54].as_slice()),
    ];
    let map = map(2, |p: &[f64]| mathieu(0.0, 5.0, p[0]));
    for (odd, table) in published {
        let values = characteristic_values(0.0, 5.0, odd);
        for (&a, tabled) in values.iter().zip(table) {
            assert!((a - tabled).abs() < 1e-8, "{a} {tabled}");
            let shot = MapRequest {
                parameters: &[a],
                start: &place(&[], &[0.0, 0.0]),
                derivative: true,
            };
            let image = map.images(&[shot]).remove(0).unwrap();
            let m = image.derivative.unwrap();
            let (trace, sign) = (m[(0, 0)] + m[(1, 1)], if odd { -1.0 } else { 1.0 });
            // The multiplier is double, so it is known to the root of this only.
            assert!((trace - 2.0 * sign).abs() < 1e-10, "{a} {trace}");
            assert!((m.determinant() - 1.0).abs() < 1e-11);
        }
    }
}

#[test]
fn rest_loses_and_regains_stability_at_the_eigenvalues_of_hills_matrix() {
    let (zeta, q) = (0.05, 5.0);
    let map = map(2, |p: &[f64]| mathieu(zeta, q, p[0]));
    let start = orbit(&map, &[0.0], place(&[], &[0.0, 0.0]));
    let branch = both(&map, &start, &along(0, -3.0, 12.0));
    let all = branch
        .specials
        .iter()
        .map(|s| (s.kind.short(), s.parameter));
    // Branch points are interpolated, the others are not.
    for (odd, short, tolerance) in [(false, "BP", 1e-8), (true, "PD", 1e-10)] {
        let found: Vec<f64> = all.clone().filter(|s| s.0 == short).map(|s| s.1).collect();
        let mut exact = characteristic_values(zeta, q, odd);
        exact.retain(|a| (-3.0..=12.0).contains(a));
        assert_eq!(found.len(), exact.len(), "{found:?} {exact:?}");
        for (found, exact) in found.iter().zip(exact) {
            assert!((found - exact).abs() < tolerance, "{short} {found} {exact}");
        }
    }
    assert_eq!(all.count(), 5);
}

#[test]
fn rest_without_damping_has_no_neimark_sacker_points() {
    let map = map(2, |p: &[f64]| mathieu(0.0, 5.0, p[0]));
    let start = orbit(&map, &[0.0], place(&[], &[0.0, 0.0]));
    let branch = both(&map, &start, &along(0, -3.0, 12.0));
    assert_eq!(kinds(&branch), ["PD", "BP", "BP", "PD", "PD"]);
}
