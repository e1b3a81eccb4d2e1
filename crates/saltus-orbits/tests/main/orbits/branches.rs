//! Branches and what happens on them.

use super::maps::{
    Smooth, at, bouncing_ball, circle, delayed_logistic, henon, logistic, pitchfork,
};
use proptest::prelude::*;
use saltus_orbits::{
    Branch, BranchWithOrigin, BranchesOptions, ContinuationError, ContinuationOptions, End,
    MapPoint, NewtonOptions, Orbit, ParameterRange, ParametricMap, Special, SpecialKind, branches,
    find_orbit, follow, follow_both,
};
use std::f64::consts::{FRAC_PI_3, PI};
use std::sync::atomic::Ordering;

fn orbit(family: &impl ParametricMap, parameters: &[f64], start: &[&[f64]]) -> Orbit {
    let start: Vec<MapPoint> = start.iter().map(|x| at(x)).collect();
    find_orbit(family, parameters, &start, &NewtonOptions::default()).unwrap()
}

fn along(parameter: usize, from: f64, to: f64) -> ParameterRange {
    ParameterRange {
        parameter,
        from,
        to,
    }
}

fn both(family: &impl ParametricMap, start: &Orbit, along: &ParameterRange) -> Branch {
    let options = ContinuationOptions::default();
    follow_both(family, start, along, &options, &mut |_| true).unwrap()
}

fn summary(branch: &Branch) -> Vec<(&str, f64)> {
    let one = |special: &Special| (special.kind.short(), special.parameter);
    branch.specials.iter().map(one).collect()
}

/// Special points are located to 1e-10 of a range of some units; 1e-9 leaves room for rounding.
fn assert_specials(branch: &Branch, expected: &[(&str, f64)]) {
    let found = summary(branch);
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert_eq!(found.0, expected.0);
        assert!(
            (found.1 - expected.1).abs() < 1e-9,
            "{found:?} {expected:?}"
        );
    }
}

#[test]
fn the_fixed_point_of_the_logistic_map_doubles_at_3_and_meets_zero_at_1() {
    let map = logistic();
    let start = orbit(&map, &[2.0], &[&[0.5]]);
    let branch = both(&map, &start, &along(0, 0.5, 4.0));
    assert_specials(&branch, &[("BP", 1.0), ("PD", 3.0)]);
    assert_eq!(branch.ends, [End::RangeEnd, End::RangeEnd]);
    let ends = [0, branch.points.len() - 1].map(|i| branch.points[i].parameter);
    assert_eq!(ends, [0.5, 4.0]);
    for point in &branch.points {
        let exact = 1.0 - 1.0 / point.parameter;
        assert!((point.orbit.places[0].x[0] - exact).abs() < 1e-10);
        let inside = (1.0..3.0).contains(&point.parameter);
        assert_eq!(point.stable, inside);
    }
}

#[test]
fn the_three_window_of_the_logistic_map_opens_at_1_plus_sqrt_8() {
    let map = logistic();
    let start = orbit(&map, &[3.835], &[&[0.152], &[0.494], &[0.958]]);
    let branch = both(&map, &start, &along(0, 3.8, 3.9));
    // As z^2 + c with r = 1 + sqrt(1 - 4 c) a 3-cycle of multiplier mu obeys c^3 + 2 c^2 + m c + m^2 = 0 with
    // m = 1 - mu/8: mu = 1 gives c = -7/4, mu = -1 the other number.
    assert_specials(
        &branch,
        &[("LP", 1.0 + 8_f64.sqrt()), ("PD", 3.841_499_007_543)],
    );
}

#[test]
fn fixed_points_of_henon_fold_and_double_where_the_formulas_say() {
    let (map, b) = (henon(), 0.3_f64);
    let start = orbit(&map, &[0.1, b], &[&[0.1, 0.1]]);
    let branch = both(&map, &start, &along(0, -1.0, 1.0));
    let square = (1.0 - b) * (1.0 - b);
    let mut found = summary(&branch);
    found.sort_by(|a, b| a.1.total_cmp(&b.1));
    assert_eq!(found.len(), 2);
    assert!((found[0].1 + square / 4.0).abs() < 1e-10 && found[0].0 == "LP");
    assert!((found[1].1 - 0.75 * square).abs() < 1e-9 && found[1].0 == "PD");
    // A run can be begun again at a special point, even at the fold.
    let fold = branch.specials.iter().find(|s| s.label == "LP1").unwrap();
    let again = both(&map, &fold.orbit, &along(0, -1.0, 1.0));
    assert!(
        again
            .specials
            .iter()
            .any(|s| s.kind == SpecialKind::PeriodDoubling)
    );
    assert_eq!(again.ends, [End::RangeEnd, End::RangeEnd]);
}

#[test]
fn the_delayed_logistic_map_begins_an_invariant_curve_at_2_with_60_degrees() {
    let map = delayed_logistic();
    let start = orbit(&map, &[1.5], &[&[0.33, 0.33]]);
    let branch = both(&map, &start, &along(0, 1.2, 2.5));
    assert_specials(&branch, &[("NS", 2.0)]);
    let SpecialKind::NeimarkSacker { angle } = branch.specials[0].kind else {
        panic!();
    };
    assert!((angle - FRAC_PI_3).abs() < 1e-8);
    assert_eq!(branch.specials[0].outside, [0, 2]);
}

#[test]
fn real_multipliers_that_collide_outside_the_circle_are_no_bifurcation() {
    // Multipliers p +- sqrt(p^2 - 4), so complex pairs of modulus 2 between real ones outside.
    let map = Smooth::new(|p, [x, y]| {
        let t = 2.0 * p[0];
        ([t * x - 4.0 * y, x], [[t, -4.0], [1.0, 0.0]])
    });
    let start = orbit(&map, &[1.0], &[&[0.0, 0.0]]);
    let branch = both(&map, &start, &along(0, -2.4, 2.4));
    assert_specials(&branch, &[]);
    assert!(branch.points.iter().all(|point| point.outside == 2));
}

#[test]
fn a_pitchfork_is_a_branch_point() {
    let map = pitchfork();
    let start = orbit(&map, &[-0.5], &[&[0.0]]);
    let branch = both(&map, &start, &along(0, -0.6, 0.6));
    assert_specials(&branch, &[("BP", 0.0)]);
    // From the side branch x^2 = a the same point is found.
    let start = orbit(&map, &[0.25], &[&[0.5]]);
    let branch = both(&map, &start, &along(0, -0.6, 0.6));
    let found = summary(&branch);
    assert!(
        found.len() == 1 && found[0].0 == "BP" && found[0].1.abs() < 1e-8,
        "{found:?}"
    );
}

#[test]
fn a_closed_curve_of_orbits_is_followed_once() {
    let map = circle();
    let start = orbit(&map, &[0.3], &[&[0.9]]);
    let branch = both(&map, &start, &along(0, -2.0, 2.0));
    assert_eq!(branch.ends, [End::Start, End::Closed]);
    assert_specials(&branch, &[("LP", 1.0), ("LP", -1.0)]);
}

#[test]
fn one_impact_per_period_of_a_ball_folds_and_doubles_where_the_formulas_say() {
    // tau = 2 pi and w = pi, so gamma cos t = pi (1 - e)/(1 + e); the multipliers have the product e^2 and
    // pass -1 where gamma sin t = 2 (1 + e^2)/(1 + e)^2 (Holmes 1982 for high bounces, exact here).
    let (map, e) = (bouncing_ball(), 0.8);
    let least = PI * (1.0 - e) / (1.0 + e);
    let start = orbit(&map, &[0.7, e], &[&[(least / 0.7).acos(), PI]]);
    let branch = both(&map, &start, &along(0, 0.2, 2.0));
    let found = summary(&branch);
    let of = |short| found.iter().find(|s| s.0 == short).unwrap().1;
    assert!((of("LP") - least).abs() < 1e-10);
    let doubling = least.hypot(2.0 * (1.0 + e * e) / ((1.0 + e) * (1.0 + e)));
    assert!((of("PD") - doubling).abs() < 1e-9);
    assert_eq!(found.len(), 2, "{found:?}");
    for multipliers in branch.points.iter().map(|p| &p.orbit.multipliers) {
        let [a, b] = multipliers[..] else { panic!() };
        assert!((a.re * b.re - a.im * b.im - e * e).abs() < 1e-9);
    }
}

#[test]
fn where_the_map_ends_the_branch_ends_in_words() {
    let mut map = logistic();
    map.until = 3.3;
    let start = orbit(&map, &[2.5], &[&[0.6]]);
    let branch = both(&map, &start, &along(0, 2.0, 4.0));
    let last = branch.points.last().unwrap().parameter;
    assert!(branch.ends[1].to_string().contains("no map above 3.3"));
    // Within the smallest step.
    assert!((3.3 - 1e-6..=3.3).contains(&last), "{last}");
    assert_specials(&branch, &[("PD", 3.0)]);
}

#[test]
fn interruption_and_limits_end_a_branch_and_keep_it() {
    let options = ContinuationOptions {
        points: 7,
        ..ContinuationOptions::default()
    };
    let (map, range) = (logistic(), along(0, 1.5, 4.0));
    let start = orbit(&map, &[2.0], &[&[0.5]]);
    let branch = follow(&map, &start, &range, true, &options, &mut |_| true).unwrap();
    assert_eq!(
        (branch.points.len(), &branch.ends[1]),
        (7, &End::PointLimit)
    );
    let mut seen = 0;
    let stop = &mut |_: &_| {
        seen += 1;
        seen < 4
    };
    let branch = follow(&map, &start, &range, true, &options, stop).unwrap();
    assert_eq!(
        (branch.points.len(), &branch.ends[1]),
        (4, &End::Interrupted)
    );
    let mut map = logistic();
    map.patience = 12;
    let branch = both(&map, &start, &range);
    assert_eq!(branch.ends[1], End::Interrupted);
    assert!(!branch.points.is_empty());
}

#[test]
fn questions_without_sense_are_errors() {
    let (map, options) = (logistic(), ContinuationOptions::default());
    let start = orbit(&map, &[2.0], &[&[0.5]]);
    let ask = |along: ParameterRange, options: &ContinuationOptions| {
        follow(&map, &start, &along, true, options, &mut |_| true).unwrap_err()
    };
    let no = ContinuationError::NoParameter { index: 1, count: 1 };
    assert_eq!(ask(along(1, 0.0, 1.0), &options), no);
    let range = along(0, f64::NAN, 1.0);
    assert!(matches!(
        ask(range, &options),
        ContinuationError::BadRange { .. }
    ));
    let outside = ContinuationError::OutsideRange { value: 2.0 };
    assert_eq!(ask(along(0, 3.0, 4.0), &options), outside);
    let steps = ContinuationOptions {
        smallest: 1.0,
        ..options.clone()
    };
    assert_eq!(ask(along(0, 1.0, 4.0), &steps), ContinuationError::BadSteps);
}

#[test]
fn a_cascade_is_followed_by_itself_and_its_ratios_approach_feigenbaums() {
    let map = logistic();
    let start = orbit(&map, &[2.5], &[&[0.6]]);
    let options = BranchesOptions {
        crossings: false,
        ..BranchesOptions::default()
    };
    let all = branches(&map, &start, &along(0, 2.0, 3.6), &options, &mut |_| true).unwrap();
    let doublings: Vec<f64> = all
        .iter()
        .map(|limb| {
            let mut all = limb.branch.specials.iter();
            all.find(|s| s.kind == SpecialKind::PeriodDoubling)
                .unwrap()
                .parameter
        })
        .collect();
    assert_eq!(all.len(), 7);
    for (i, limb) in all.iter().enumerate() {
        assert_eq!(limb.branch.points[0].orbit.period(), 1 << i);
    }
    assert!((doublings[1] - (1.0 + 6_f64.sqrt())).abs() < 1e-9);
    let ratio =
        |i: usize| (doublings[i - 1] - doublings[i - 2]) / (doublings[i] - doublings[i - 1]);
    // 4.6692016 (Feigenbaum 1978); the error falls about fivefold from one to the next.
    assert!((ratio(6) - 4.669_201_6).abs() < 2e-3, "{doublings:?}");
    assert_eq!(all[1].origin.as_deref(), Some("PD1"));
}

#[test]
fn a_cascade_for_its_stable_parts_has_the_same_doublings_and_stops_where_it_is_told() {
    let map = logistic();
    let start = orbit(&map, &[2.5], &[&[0.6]]);
    let of = |options: &BranchesOptions| {
        // far enough for branches to be unstable for longer than they are followed
        let all = branches(&map, &start, &along(0, 2.0, 3.9), options, &mut |_| true).unwrap();
        let doubling = |limb: &BranchWithOrigin| {
            let mut all = limb.branch.specials.iter();
            Some(
                all.find(|s| s.kind == SpecialKind::PeriodDoubling)?
                    .parameter,
            )
        };
        let doublings: Vec<f64> = all.iter().filter_map(doubling).collect();
        (all, doublings)
    };
    let whole = BranchesOptions {
        crossings: false,
        ..BranchesOptions::default()
    };
    let brief = BranchesOptions {
        entire: 1,
        longest: 16,
        ..whole.clone()
    };
    let ((_, known), (limbs, doublings)) = (of(&whole), of(&brief));
    assert_eq!(doublings.len(), 5, "1T to 16T");
    for (a, b) in known.iter().zip(&doublings) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
    assert_eq!(limbs[1].branch.ends[1], End::RangeEnd);
    assert_eq!(limbs[2].branch.ends[1], End::Unstable);
    // the third distance is 0.0193 (3.5441 to 3.5644 less): 8T is the last
    let near = BranchesOptions {
        closest: 0.03,
        ..brief
    };
    assert_eq!(of(&near).0.len(), 4);
}

#[test]
fn a_special_point_lies_behind_the_point_it_is_near() {
    let map = henon();
    let start = orbit(&map, &[0.0, 0.3], &[&[0.0, 0.0]]);
    let branch = both(&map, &start, &along(0, -0.2, 0.5));
    let points = &branch.points;
    assert_eq!(branch.specials.len(), 2);
    for special in &branch.specials {
        let [before, behind] = [0, 1].map(|i| points[special.near + i].orbit.places[0].x[0]);
        let here = special.orbit.places[0].x[0];
        assert!(
            (here - before) * (here - behind) <= 0.0,
            "{}",
            special.label
        );
    }
}

#[test]
fn the_other_branch_of_a_pitchfork_is_followed_both_ways_and_once() {
    let map = pitchfork();
    let start = orbit(&map, &[-0.5], &[&[0.0]]);
    let options = BranchesOptions::default();
    let all = branches(&map, &start, &along(0, -0.6, 0.6), &options, &mut |_| true).unwrap();
    assert_eq!(all.len(), 2);
    let points = &all[1].branch.points;
    let ends = [0, points.len() - 1].map(|i| points[i].orbit.places[0].x[0]);
    let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
    let root = 0.6_f64.sqrt();
    assert!((low + root).abs() < 1e-10 && (high - root).abs() < 1e-10);
}

#[test]
fn a_bubble_between_two_branch_points_is_followed_once() {
    // x^2 + p^2 = 0.1 crosses x = 0 twice.
    let map = Smooth::new(|p, [x]| {
        let growth = 0.1 - p[0] * p[0] - x * x;
        ([x + x * growth], [[1.0 + growth - 2.0 * x * x]])
    });
    let start = orbit(&map, &[0.0], &[&[0.0]]);
    let options = BranchesOptions::default();
    let all = branches(&map, &start, &along(0, -0.6, 0.6), &options, &mut |_| true).unwrap();
    let root = 0.1_f64.sqrt();
    assert_specials(&all[0].branch, &[("BP", -root), ("BP", root)]);
    assert_eq!(all.len(), 2);
    assert_eq!(all[1].branch.ends[1], End::Closed);
    let found = summary(&all[1].branch);
    // On the side of the bubble the branch point is an extremum, found less well.
    assert!(
        found.len() == 1 && (found[0].1 - root).abs() < 1e-7,
        "{found:?}"
    );
}

#[test]
fn a_bubble_of_period_two_is_followed_once() {
    let map = Smooth::new(|p, [x]| ([0.85 - p[0] * p[0] - x * x], [[-2.0 * x]]));
    let start = orbit(&map, &[0.4], &[&[0.45]]);
    let options = BranchesOptions::default();
    let all = branches(&map, &start, &along(0, -0.5, 0.5), &options, &mut |_| true).unwrap();
    // a - x^2 doubles at a = 3/4 and next at 5/4: 0.85 - p^2 passes 3/4 twice.
    let root = 0.1_f64.sqrt();
    assert_specials(&all[0].branch, &[("PD", -root), ("PD", root)]);
    assert_eq!(all.len(), 2);
    assert_eq!(all[1].branch.ends[1], End::Halved);
    assert_specials(&all[1].branch, &[("HP", root)]);
}

#[test]
fn from_the_end_of_a_doubled_branch_its_mother_is_found() {
    let map = logistic();
    // the 2-cycle at r = 3.2, in closed form
    let r: f64 = 3.2;
    let cycle =
        [1.0, -1.0].map(|sign| (r + 1.0 + sign * ((r + 1.0) * (r - 3.0)).sqrt()) / (2.0 * r));
    let start = orbit(&map, &[r], &[&[cycle[0]], &[cycle[1]]]);
    let options = BranchesOptions {
        doublings: 0,
        ..BranchesOptions::default()
    };
    let all = branches(&map, &start, &along(0, 2.5, 3.4), &options, &mut |_| true).unwrap();
    assert_specials(&all[0].branch, &[("HP", 3.0)]);
    assert_eq!((all.len(), all[1].origin.as_deref()), (2, Some("HP1")));
    assert_eq!(all[1].branch.points[0].orbit.period(), 1);
    assert_specials(&all[1].branch, &[("PD", 3.0)]);
}

#[test]
fn a_point_of_a_branch_costs_few_calls() {
    let map = henon();
    let start = orbit(&map, &[0.0, 0.3], &[&[0.0, 0.0]]);
    let before = map.calls.load(Ordering::Relaxed);
    let branch = both(&map, &start, &along(0, -0.1, 0.3));
    let calls = map.calls.load(Ordering::Relaxed) - before;
    // The prediction and two corrections.
    assert!(
        branch.specials.is_empty() && calls <= 3 * branch.points.len() + 2,
        "{calls}"
    );
}

#[test]
fn the_errors_of_a_flow_leave_special_points_where_they_are() {
    // Flows solved by Taylor series are known to some 1e-13, at which derivatives by the parameter are off by
    // 1e-8. The branch point suffers most: it is where the branches cannot be told apart.
    let mut map = logistic();
    map.noise = 1e-13;
    let start = orbit(&map, &[2.0], &[&[0.5]]);
    let branch = both(&map, &start, &along(0, 0.5, 3.4));
    let found = summary(&branch);
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(
        found[0].0 == "BP" && (found[0].1 - 1.0).abs() < 1e-7,
        "{found:?}"
    );
    assert!(
        found[1].0 == "PD" && (found[1].1 - 3.0).abs() < 1e-9,
        "{found:?}"
    );
    let start = orbit(&map, &[3.835], &[&[0.152], &[0.494], &[0.958]]);
    let branch = both(&map, &start, &along(0, 3.8, 3.9));
    assert_specials(
        &branch,
        &[("LP", 1.0 + 8_f64.sqrt()), ("PD", 3.841_499_007_543)],
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn branches_of_any_quadratic_map_end_in_words(c in prop::array::uniform8(-2.0..2.0_f64)) {
        let map = Smooth::new(|p, [x, y]| {
            let [t, a, b, c, d, e, f, g, h] = p[..] else { panic!() };
            (
                [t + a * x + b * y + c * x * x + d * x * y, e * x + f * y + g * y * y + h * t * x],
                [
                    [a + 2.0 * c * x + d * y, b + d * x],
                    [e + h * t, f + 2.0 * g * y],
                ],
            )
        });
        let parameters: Vec<f64> = std::iter::once(0.1).chain(c).collect();
        let start = find_orbit(&map, &parameters, &[at(&[0.1, 0.1])], &NewtonOptions::default());
        prop_assume!(start.is_ok());
        let options = BranchesOptions {
            doublings: 1,
            branches: 3,
            continuation: ContinuationOptions { points: 60, ..ContinuationOptions::default() },
            ..BranchesOptions::default()
        };
        let range = along(0, -1.0, 1.0);
        let all = branches(&map, &start.unwrap(), &range, &options, &mut |_| true).unwrap();
        for limb in &all {
            prop_assert!(limb.branch.ends.iter().all(|end| !end.to_string().is_empty()));
            for point in &limb.branch.points {
                let size = point.orbit.places.iter().flat_map(|p| &p.x).fold(1.0, |m: f64, x| m.max(x.abs()));
                prop_assert!(point.orbit.residual <= 1e-9 * size);
                prop_assert!((-1.0..=1.0).contains(&point.parameter));
            }
        }
    }
}
