//! Curves of special points over two parameters.

use super::maps::{Border, at, henon, logistic, trace_and_determinant};
use saltus_orbits::{
    ContinuationError, ContinuationOptions, Curve, End, MapPoint, NewtonOptions, ParameterRange,
    ParametricMap, Special, SpecialKind, find_orbit, follow_both, follow_curve,
};

fn along(parameter: usize, from: f64, to: f64) -> ParameterRange {
    ParameterRange {
        parameter,
        from,
        to,
    }
}

/// The first special point of a kind on the branch of a fixed point over parameter 0.
fn special(
    map: &impl ParametricMap,
    parameters: &[f64],
    start: MapPoint,
    range: &ParameterRange,
    short: &str,
) -> Special {
    let start = find_orbit(map, parameters, &[start], &NewtonOptions::default()).unwrap();
    let options = ContinuationOptions::default();
    let branch = follow_both(map, &start, range, &options, &mut |_| true).unwrap();
    let mut all = branch.specials.into_iter();
    all.find(|special| special.kind.short() == short).unwrap()
}

fn curve(map: &impl ParametricMap, start: &Special, over: [&ParameterRange; 2]) -> Curve {
    follow_curve(
        map,
        start,
        over,
        &ContinuationOptions::default(),
        &mut |_| true,
    )
    .unwrap()
}

#[test]
fn folds_and_doublings_of_henon_lie_on_their_parabolas() {
    let (map, range) = (henon(), along(0, -1.5, 2.0));
    for (short, factor) in [("LP", -0.25), ("PD", 0.75)] {
        let start = special(&map, &[0.1, 0.3], at(&[0.1, 0.1]), &range, short);
        let curve = curve(&map, &start, [&range, &along(1, -0.9, 0.9)]);
        for point in &curve.points {
            let [a, b] = point.parameters;
            assert!(
                (a - factor * (1.0 - b) * (1.0 - b)).abs() < 1e-9,
                "{short} {a} {b}"
            );
        }
        let mut ends = [0, curve.points.len() - 1].map(|i| curve.points[i].parameters[1]);
        ends.sort_by(f64::total_cmp);
        // 3/4 (1 - b)^2 reaches a = 2 before b = -0.9.
        let low = if short == "LP" {
            -0.9
        } else {
            1.0 - (8.0_f64 / 3.0).sqrt()
        };
        assert!(
            (ends[0] - low).abs() < 1e-9 && (ends[1] - 0.9).abs() < 1e-9,
            "{ends:?}"
        );
        assert_eq!(curve.ends, [End::RangeEnd, End::RangeEnd]);
    }
}

#[test]
fn neimark_sacker_points_end_where_their_pair_becomes_real() {
    // The product of the pair is q = 1 and its sum p = 2 cos(angle), so -2 < p < 2.
    let (map, over) = (
        trace_and_determinant(),
        [along(1, 0.5, 1.5), along(0, -3.0, 3.0)],
    );
    let start = special(&map, &[0.4, 0.8], at(&[0.0, 0.0]), &over[0], "NS");
    let curve = curve(&map, &start, [&over[0], &over[1]]);
    assert_eq!(curve.ends, [End::Resonance, End::Resonance]);
    for point in &curve.points {
        let ([q, p], pair) = (point.parameters, point.pair.unwrap());
        assert!((q - 1.0).abs() < 1e-9);
        // The angle is the root of the distance from the resonance, so it loses half the digits there.
        assert!((pair.argument().cos() - p / 2.0).abs() < 1e-8);
    }
    let mut ends = [0, curve.points.len() - 1].map(|i| curve.points[i].parameters[1]);
    ends.sort_by(f64::total_cmp);
    // Within some of the smallest steps of 1e-7 in a range of 6.
    assert!(
        (ends[0] + 2.0).abs() < 1e-5 && (ends[1] - 2.0).abs() < 1e-5,
        "{ends:?}"
    );
}

#[test]
fn a_grazing_is_followed_along_its_line() {
    // The fixed point mu/(1 - left) touches the wall at 1 for mu = 1 - left.
    let (left, range) = (along(1, -0.9, 0.9), along(0, -0.5, 2.5));
    let place = MapPoint {
        modes: vec![0],
        x: vec![0.0],
    };
    let start = special(&Border, &[0.0, 0.5, -0.4, 1.0], place, &range, "GR");
    let curve = curve(&Border, &start, [&range, &left]);
    assert_eq!(curve.ends, [End::RangeEnd, End::RangeEnd]);
    for point in &curve.points {
        let [mu, left] = point.parameters;
        // The guard is left at 1e-9 of zero, which is up to 1.9 times as far in mu.
        assert!((mu - (1.0 - left)).abs() < 3e-9, "{mu} {left}");
    }
}

#[test]
fn curves_of_what_has_none_are_refused_and_a_stop_ends_one() {
    let range = along(0, 0.5, 4.0);
    let map = logistic();
    let start = special(&map, &[2.5], at(&[0.6]), &range, "BP");
    let options = ContinuationOptions::default();
    let ask = |start, over| follow_curve(&map, start, over, &options, &mut |_| true);
    let no = |short| Err(ContinuationError::NoCurve { short });
    assert_eq!(ask(&start, [&range, &range]), no("BP"));
    let start = special(&map, &[2.5], at(&[0.6]), &range, "PD");
    assert_eq!(ask(&start, [&range, &range]), no("PD"));
    let map = henon();
    let start = special(
        &map,
        &[0.1, 0.3],
        at(&[0.1, 0.1]),
        &along(0, -1.0, 1.0),
        "PD",
    );
    assert_eq!(start.kind, SpecialKind::PeriodDoubling);
    let over = [&along(0, -1.0, 1.0), &along(1, -0.9, 0.9)];
    let curve = follow_curve(&map, &start, over, &options, &mut |_| false).unwrap();
    assert_eq!((curve.points.len(), &curve.ends[1]), (1, &End::Interrupted));
}
