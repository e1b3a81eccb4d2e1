//! Names.

use super::exponents::{HENON_CLASSIC, fed, golden, record};
use super::maps::{CIRCLE, DELAYED, DOUBLING, HENON, LOGISTIC, TENT, Toy, place};
use saltus_orbits::{
    Criteria, Follower, MotionKind, Recurrence, Spectrum, UndecidedReason, Verdict, judge,
};

/// With no help from recurrence.
fn open(spectrum: &Spectrum) -> Verdict {
    judge(spectrum, Recurrence::Open, &Criteria::default())
}

fn on_cycle(spectrum: &Spectrum, period: u32) -> Verdict {
    let recurs = Recurrence::Recurs { period, rest: 1e-9 };
    judge(spectrum, recurs, &Criteria::default())
}

fn is_undecided(verdict: &Verdict) -> bool {
    let undecided = verdict.kind == MotionKind::Undecided;
    assert_eq!(undecided, verdict.doubt.is_some(), "{verdict:?}");
    undecided
}

#[test]
fn known_chaos_is_chaotic() {
    for (map, parameters, start) in [
        (&HENON, &HENON_CLASSIC[..], &[0.1, 0.1][..]),
        (&DELAYED, &[2.27], &[0.1, 0.1]),
        (&LOGISTIC, &[4.0], &[0.1234]),
        (&TENT, &[1.9], &[0.1234]),
        (&LOGISTIC, &[3.8282], &[0.3]),
    ] {
        let verdict = open(&record(map, parameters, start, 10_000));
        assert_eq!(
            verdict.kind,
            MotionKind::Chaotic,
            "{parameters:?}: {verdict:?}"
        );
        assert!(verdict.confidence >= 0.999 && !verdict.needs_more());
    }
}

#[test]
fn known_tori_are_quasi_periodic() {
    for (map, parameters, start) in [
        (&CIRCLE, &[golden(0.5), 0.5][..], &[0.1][..]),
        (&CIRCLE, &[golden(0.0), 0.0], &[0.1]),
        (&DELAYED, &[2.05], &[0.1, 0.1]),
        (&DELAYED, &[2.1], &[0.1, 0.1]),
    ] {
        let verdict = open(&record(map, parameters, start, 10_000));
        assert_eq!(
            verdict.kind,
            MotionKind::QuasiPeriodic,
            "{parameters:?}: {verdict:?}"
        );
        assert!(verdict.confidence >= 0.999);
    }
}

#[test]
fn a_cycle_is_periodic_only_where_it_recurs() {
    // the middle of the window of period three
    let spectrum = record(&LOGISTIC, &[3.83], &[0.3], 2000);
    assert_eq!(on_cycle(&spectrum, 3).kind, MotionKind::Periodic(3));
    assert_eq!(open(&spectrum).doubt, Some(UndecidedReason::NoPeriod));
    let drifts = judge(&spectrum, Recurrence::Drifting, &Criteria::default());
    assert_eq!(drifts.doubt, Some(UndecidedReason::Drift));
    let far = Recurrence::Recurs {
        period: 3,
        rest: 0.1,
    };
    assert!(judge(&spectrum, far, &Criteria::default()).needs_more());
    assert_eq!(
        on_cycle(&record(&LOGISTIC, &[2.0], &[0.5], 100), 1).kind,
        MotionKind::Periodic(1)
    );
}

#[test]
fn an_unstable_cycle_is_no_chaos_and_more_iterates_do_not_help() {
    // in binary the doubling map ends on 0 after 53 iterates, with exponent ln 2
    let spectrum = record(&DOUBLING, &[], &[0.1234], 1000);
    let recurs = Recurrence::Recurs {
        period: 1,
        rest: 0.0,
    };
    let verdict = judge(&spectrum, recurs, &Criteria::default());
    assert_eq!(verdict.doubt, Some(UndecidedReason::UnstableCycle));
    assert!(!verdict.needs_more());
}

#[test]
fn leaving_an_unstable_fixed_point_is_no_chaos() {
    // 1 - 1/r is left by 1.2 per iterate: growth without a doubt, for as long as rounding lasts
    let leaving = |iterates| {
        let start = place(&[1.0 - 1.0 / 3.2 + 1e-15]);
        saltus_orbits::spectrum_of(&LOGISTIC, &[3.2], start, 0, iterates, 1).unwrap()
    };
    let verdict = open(&leaving(150));
    assert!(verdict.exponent.positive(0.0) > 0.999, "{verdict:?}");
    assert_eq!(verdict.doubt, Some(UndecidedReason::Growth));
    assert!(verdict.needs_more());
    assert_eq!(on_cycle(&leaving(2000), 2).kind, MotionKind::Periodic(2));
}

#[test]
fn a_chaotic_transient_that_has_ended_is_no_chaos() {
    // the logistic map at r = 4 for 600 iterates, then a slow contraction
    let mut x = 0.3;
    let chaos = (0..600).map(|_| {
        let slope: f64 = 4.0 * (1.0 - 2.0 * x);
        x = 4.0 * x * (1.0 - x);
        slope.abs().ln()
    });
    let spectrum = fed(chaos.chain((0..700).map(|_| -0.01)));
    let verdict = open(&spectrum);
    assert!(verdict.exponent.per_iterate > 0.2);
    assert_ne!(verdict.kind, MotionKind::Chaotic, "{verdict:?}");
}

#[test]
fn growth_that_wanders_is_no_chaos_however_far_it_wanders() {
    // steps up and down by the turn of a coin
    let coin = |seed: f64| {
        let mut x = seed;
        move |_| {
            x = 4.0 * x * (1.0 - x);
            if x < 0.5 { -3.0 } else { 3.0 }
        }
    };
    let records = (1..=50).map(|k| fed((0..2000).map(coin(0.019 * f64::from(k)))));
    let all: Vec<Verdict> = records.map(|record| open(&record)).collect();
    // its standard deviation is 3 sqrt(2000) = 134
    let far = |verdict: &&Verdict| verdict.exponent.per_iterate * 2000.0 > 36.1;
    assert!(all.iter().filter(far).count() > 5);
    assert!(
        all.iter()
            .all(|verdict| verdict.doubt == Some(UndecidedReason::Sign))
    );
}

#[test]
fn growth_that_is_made_up_for_later_is_no_torus() {
    let verdict = open(&fed((0..4000).map(|k| if k < 2000 { 0.01 } else { -0.01 })));
    assert!(verdict.exponent.per_iterate.abs() < 1e-12);
    assert_eq!(verdict.doubt, Some(UndecidedReason::Sign), "{verdict:?}");
}

/// Feigenbaum's point (3.569 945 672), where all cycles of length 2^n have lost their stability, and the first
/// doubling: at both the exponent is zero, and no finite record shows it.
#[test]
fn at_a_bifurcation_nothing_is_decided() {
    for r in [
        3.0,
        3.569_945_672,
        1.0 + 6.0_f64.sqrt(),
        1.0 + 8.0_f64.sqrt(),
    ] {
        for iterates in [300, 1000, 3000, 10_000, 100_000] {
            let verdict = open(&record(&LOGISTIC, &[r], &[0.3], iterates));
            assert!(is_undecided(&verdict), "{r}, {iterates}: {verdict:?}");
        }
    }
}

#[test]
fn regular_motion_is_never_called_chaos_even_if_no_period_is_known() {
    for k in 0..=300 {
        let r = 2.9 + 0.669_9 * f64::from(k) / 300.0;
        let verdict = open(&record(&LOGISTIC, &[r], &[0.3], 3000));
        assert!(is_undecided(&verdict), "{r}: {verdict:?}");
    }
}

#[test]
fn chaos_and_its_windows_are_never_called_a_torus() {
    let of = |k| {
        let r = 3.57 + 0.43 * f64::from(k) / 300.0;
        open(&record(&LOGISTIC, &[r], &[0.3], 3000)).kind
    };
    let all: Vec<MotionKind> = (0..=300).map(of).collect();
    assert!(!all.contains(&MotionKind::QuasiPeriodic));
    let chaotic = all
        .iter()
        .filter(|kind| **kind == MotionKind::Chaotic)
        .count();
    // of 301; at ten times the iterates 271
    assert!((255..=275).contains(&chaotic), "{chaotic}");
}

/// Iterates until a name is found, looking each time the record has doubled.
fn needed(map: &Toy, parameters: &[f64], start: &[f64]) -> (usize, MotionKind) {
    let mut follower = Follower::new(map, parameters, place(start), 1).unwrap();
    follower.advance(1000).unwrap();
    follower.forget();
    let mut made = 100;
    follower.advance(made).unwrap();
    while open(follower.spectrum()).needs_more() && made < 100_000 {
        follower.advance(made).unwrap();
        made *= 2;
    }
    (made, open(follower.spectrum()).kind)
}

#[test]
fn strong_chaos_is_known_early_and_weak_chaos_later() {
    let (strong, kind) = needed(&LOGISTIC, &[4.0], &[0.3]);
    assert_eq!(kind, MotionKind::Chaotic);
    let (weak, kind) = needed(&LOGISTIC, &[3.572], &[0.3]);
    assert_eq!(kind, MotionKind::Chaotic);
    // 36 / 0.69 = 52 and 36 / 0.05 = 720 iterates make the growth
    assert!(
        strong <= 200 && (800..=3200).contains(&weak),
        "{strong} {weak}"
    );
}

#[test]
fn too_few_iterates_say_nothing() {
    for iterates in 0..20 {
        let spectrum = record(&LOGISTIC, &[4.0], &[0.3], iterates);
        assert_eq!(open(&spectrum).doubt, Some(UndecidedReason::Sign));
        assert_eq!(on_cycle(&spectrum, 1).doubt, Some(UndecidedReason::Sign));
        assert!(open(&spectrum).needs_more());
    }
}
