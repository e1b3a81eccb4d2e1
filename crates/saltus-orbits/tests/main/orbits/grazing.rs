//! Branches whose switches change.

use super::maps::{Border, Clock, Nordmark, Root};
use saltus_orbits::{
    Branch, ContinuationOptions, End, MapPoint, NewtonOptions, Orbit, ParameterRange,
    ParametricMap, SpecialKind, find_orbit, follow_both,
};

fn orbit(family: &impl ParametricMap, parameters: &[f64], x: &[f64]) -> Orbit {
    let start = MapPoint {
        modes: vec![0],
        x: x.to_vec(),
    };
    find_orbit(family, parameters, &[start], &NewtonOptions::default()).unwrap()
}

fn both(family: &impl ParametricMap, start: &Orbit) -> Branch {
    let range = ParameterRange {
        parameter: 0,
        from: -0.5,
        to: 0.5,
    };
    let options = ContinuationOptions::default();
    follow_both(family, start, &range, &options, &mut |_| true).unwrap()
}

fn kinds(branch: &Branch) -> Vec<(&str, f64)> {
    let one = |s: &saltus_orbits::Special| (s.kind.short(), s.parameter);
    branch.specials.iter().map(one).collect()
}

#[test]
fn an_orbit_that_persists_across_the_border_is_followed_across() {
    // Slopes 0.5 and -0.5: a fixed point on either side, mu/(1 - slope).
    let start = orbit(&Border, &[-0.2, 0.5, -0.5, 0.0], &[-0.4]);
    let branch = both(&Border, &start);
    let found = kinds(&branch);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(branch.specials[0].kind, SpecialKind::Grazing { unit: 0 });
    assert!(found[0].1.abs() < 1e-9);
    assert_eq!(branch.ends, [End::RangeEnd, End::RangeEnd]);
    assert_eq!(branch.specials[0].remark, None);
}

#[test]
fn stability_lost_at_a_border_is_said_to_be_lost_there() {
    let start = orbit(&Border, &[-0.2, 0.5, -1.5, 0.0], &[-0.4]);
    let branch = both(&Border, &start);
    assert_eq!(kinds(&branch).len(), 1, "{:?}", kinds(&branch));
    assert_eq!(branch.specials[0].outside, [0, 1]);
    assert!(branch.specials[0].remark.is_some());
}

#[test]
fn a_fold_at_a_border_goes_back_the_way_it_came() {
    // Slopes 0.5 and 2: fixed points on both sides for mu < 0, none for mu > 0.
    let start = orbit(&Border, &[-0.2, 0.5, 2.0, 0.0], &[-0.4]);
    let branch = both(&Border, &start);
    let found = kinds(&branch);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].0 == "GR" && found[0].1.abs() < 1e-9, "{found:?}");
    let ends = [0, branch.points.len() - 1].map(|i| &branch.points[i]);
    assert!(ends.iter().all(|point| point.parameter == -0.5));
    assert!(ends[0].orbit.places[0].x[0] * ends[1].orbit.places[0].x[0] < 0.0);
}

#[test]
fn an_impact_with_a_square_root_is_found_and_passed() {
    // The fixed point without impact, x = rho/(1 - a + g), grazes at rho = 0. Beyond it the fixed point
    // with impact has sqrt x = (-1 + sqrt(1 + 4 rho (1 + g t^2)))/(2 (1 + g t^2)).
    let (a, g, t) = (0.4, 0.3, 0.8_f64);
    let start = orbit(&Nordmark, &[-0.2, a, g, t], &[-0.2, 0.06]);
    let branch = both(&Nordmark, &start);
    let found = kinds(&branch);
    assert_eq!(found[0].0, "GR", "{found:?} {:?}", branch.ends);
    assert!(found[0].1.abs() < 1e-8, "{found:?}");
    let last = branch.points.last().unwrap();
    assert_eq!((last.parameter, &branch.ends[1]), (0.5, &End::RangeEnd));
    let c = 1.0 + g * t * t;
    let root = (-1.0 + (1.0 + 2.0 * c).sqrt()) / (2.0 * c);
    assert!((last.orbit.places[0].x[0] - root * root).abs() < 1e-10);
}

#[test]
fn beyond_a_square_root_the_branch_comes_back_on_the_same_side() {
    // With the visit (1 - a) x - sqrt x = rho: for small x > 0 only at rho < 0, so the branch turns back at
    // rho = 0 with a vertical tangent, and once more, smoothly, at rho = -1/(4 (1 - a)).
    let a = 0.4_f64;
    let fold = -0.25 / (1.0 - a);
    let root = (1.0 - (1.0 - 0.8 * (1.0 - a)).sqrt()) / (2.0 * (1.0 - a));
    // From the side with the visit no touch tells that the grazing is near.
    for x in [-0.3, root * root] {
        let start = orbit(&Root, &[-0.2, a, 0.0], &[x]);
        let branch = both(&Root, &start);
        let mut found = kinds(&branch);
        found.sort_by(|a, b| b.1.total_cmp(&a.1));
        assert_eq!(found.len(), 2, "{found:?} {:?}", branch.ends);
        assert!(found[0].0 == "GR" && found[0].1.abs() < 1e-8, "{found:?}");
        assert!(
            found[1].0 == "LP" && (found[1].1 - fold).abs() < 1e-9,
            "{found:?}"
        );
        assert_eq!(branch.ends, [End::RangeEnd, End::RangeEnd]);
        let mut ends = [0, branch.points.len() - 1].map(|i| branch.points[i].parameter);
        ends.sort_by(f64::total_cmp);
        assert_eq!(ends, [-0.5, 0.5]);
        let grazing = branch
            .specials
            .iter()
            .find(|s| s.kind.short() == "GR")
            .unwrap();
        assert_eq!(grazing.outside.iter().sum::<usize>(), 1);
        assert!(grazing.remark.is_some());
    }
}

#[test]
fn where_nothing_lies_beyond_a_grazing_the_branch_ends_there() {
    // With the jump the only fixed point with a visit lies beyond x = 5.
    let start = orbit(&Root, &[-0.2, 0.4, 5.0], &[-0.3]);
    let branch = both(&Root, &start);
    assert_eq!(branch.ends[1], End::Grazing);
    assert!(kinds(&branch)[0].1.abs() < 1e-8);
    assert!(branch.ends[1].to_string().contains("no orbit"));
}

#[test]
fn switches_of_two_units_change_their_order_and_wander_through_the_sampling_instant() {
    // The switches of unit 0 meet those of unit 1 at p = 0.15, 0.25, 0.45, 0.55; at 0.4 one of them passes
    // the sampling instant, which changes the modes there and nothing else.
    let start = orbit(&Clock, &[0.05], &[0.1]);
    let range = ParameterRange {
        parameter: 0,
        from: 0.0,
        to: 0.6,
    };
    let options = ContinuationOptions::default();
    let branch = follow_both(&Clock, &start, &range, &options, &mut |_| true).unwrap();
    let found = kinds(&branch);
    assert_eq!(found.len(), 4, "{found:?}");
    for (found, expected) in found.iter().zip([0.15, 0.25, 0.45, 0.55]) {
        assert!(
            found.0 == "SO" && (found.1 - expected).abs() < 1e-9,
            "{found:?}"
        );
    }
    for point in &branch.points {
        let inside = (0.4..0.7).contains(&point.parameter);
        assert_eq!(point.orbit.places[0].modes, [usize::from(inside), 0]);
        assert!((point.orbit.places[0].x[0] - 2.0 * point.parameter).abs() < 1e-11);
    }
}
