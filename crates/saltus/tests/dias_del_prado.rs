//! The statements of Dias & Del Prado, section 4 and abstract, as tests: what `saltus reproduce` says
//! must not change without notice.

#![allow(clippy::unwrap_used)]

use saltus::orbits::Nature;
use saltus::physics::FrequencyReference::{Free, Occupied};
use saltus::study::Control;
use saltus::study::paper::{
    Effort, PanelBranches, Verdict, compare_inertia, diagrams, facts, misprints, panel_branches,
    regimes, run_cases,
};

/// A tenth of the resolution of `saltus reproduce`: seconds.
fn effort() -> Effort {
    Effort {
        values: 41,
        law_values: 21,
        transient: 250,
        record: 50,
        starts: vec![(3.0, 2.0)],
        full_values: 3,
        full_periods: (120, 20),
        exponent_periods: 1500,
        panel_exponent_periods: 60,
        census_values: 17,
        census_starts: 8,
        doublings: 1,
        cascade_period: 4,
    }
}

/// Each was found by continuation with the tangent flow; the second method takes differences of the flow at given
/// damping ratios.
fn special_points(branches: &[PanelBranches]) {
    let mut all = Vec::new();
    for panel in branches {
        for point in &panel.transitions {
            let second = point.second.unwrap_or(f64::NAN);
            let difference = (second - point.damping_ratio).abs();
            assert!(
                difference < 1e-8,
                "{} {}: {difference}",
                panel.ratio,
                point.label
            );
            all.push((
                panel.ratio,
                point.kind.short(),
                point.period,
                point.damping_ratio,
            ));
        }
    }
    for (ratio, kind, period, zeta) in [
        (0.9, "PD", 1, 0.1892865091),
        (1.0, "HP", 2, 0.4609559739),
        (1.0, "GR", 2, 0.3377229746),
        (1.0, "LP", 2, 0.2821760888),
        (1.0, "LP", 2, 0.2159641559),
        (1.0, "PD", 2, 0.2232987278),
        (1.0, "PD", 4, 0.1992401784),
        (1.1, "GR", 2, 0.4875185673),
        (1.1, "PD", 2, 0.4076286268),
        (1.1, "PD", 4, 0.3608913025),
    ] {
        let is_it = |p: &&(f64, &str, usize, f64)| p.0 == ratio && p.1 == kind && p.2 == period;
        let mut there = all.iter().filter(is_it);
        assert!(
            there.any(|p| (p.3 - zeta).abs() < 1e-9),
            "{ratio} {kind} {zeta}: {all:?}"
        );
    }
}

#[test]
fn every_statement_has_its_verdict() {
    let (effort, control) = (effort(), Control::default());
    let diagrams = diagrams(&effort, &control).unwrap();
    let occupied = run_cases(Occupied, &effort, &control).unwrap();
    let free = run_cases(Free, &effort, &control).unwrap();
    let branches = panel_branches(&effort, &control).unwrap();
    special_points(&branches);
    let facts = facts(&diagrams, &occupied, &free, &branches, &control).unwrap();
    let verdicts: Vec<(&str, Verdict)> = facts.iter().map(|f| (f.id, f.verdict)).collect();
    use Verdict::{Departure, Reproduced};
    // F6: at zeta_h = 0.32 the paper sees a torus where the exponent is positive (narrow chaotic
    // bands), and at 0.36 four points that are four close pairs.
    let expected = [
        ("F1", Reproduced),
        ("F2", Reproduced),
        ("F3", Reproduced),
        ("F4", Reproduced),
        ("F5", Reproduced),
        ("F6", Departure),
        ("F7", Reproduced),
        ("F8", Reproduced),
    ];
    assert_eq!(verdicts, expected, "{facts:#?}");

    // Fig. 3, panel by panel, with the occupied frequency.
    let periods: Vec<Option<u32>> = occupied.iter().map(|c| c.recurrence).collect();
    assert_eq!(
        periods,
        [
            Some(2),
            Some(1),
            None,
            Some(4),
            Some(2),
            None,
            Some(8),
            Some(2)
        ]
    );
    for chaotic in [2, 5] {
        assert_eq!(occupied[chaotic].verdict.nature, Nature::Chaotic);
    }
    // With the free frequency 0.32 is 4T and 0.36 is 2T: two statements contradicted.
    assert_eq!((free[5].recurrence, free[6].recurrence), (Some(4), Some(2)));

    // Every law shows 2T and then 1T at Omega = 0.9, with a threshold between 0.17 and 0.21.
    for diagram in diagrams
        .iter()
        .filter(|d| d.ratio == 0.9 && d.reference == Occupied)
    {
        let up = regimes(diagram, 0);
        let last_2t = up.iter().rfind(|r| r.period == Some(2)).unwrap().to;
        assert!(
            (0.17..0.21).contains(&last_2t),
            "{}: {last_2t}",
            diagram.law.name()
        );
        assert_eq!(up.last().unwrap().period, Some(1));
    }
}

#[test]
fn misprints_have_the_effect_that_the_documents_state() {
    let table = misprints(&Control::default()).unwrap();
    let effect = |place: &str| {
        &table
            .iter()
            .find(|m| m.place.contains(place))
            .unwrap()
            .effect
    };
    assert!(effect("16 coordinates").contains("2.5382 Hz without w_31"));
    assert!(effect("k_h and omega_h").contains("2.5378 Hz from 2.48"));
    assert!(effect("Eq. (10)").contains("-751.8 N"));
    assert_eq!(table.len(), 7);
}

#[test]
fn condensing_the_in_plane_motion_moves_a_settled_orbit_by_less_than_a_thousandth() {
    // zeta_h = 0.5 in each panel: far from bifurcations, settled after 120 periods to 1e-5.
    let comparison = compare_inertia(&effort(), &Control::default()).unwrap();
    for row in comparison
        .rows
        .iter()
        .filter(|row| row.damping_ratio == 0.5)
    {
        let difference = row.difference.unwrap();
        assert!(
            difference > 0.0 && difference < 1e-3,
            "{}: {difference}",
            row.ratio
        );
    }
}
