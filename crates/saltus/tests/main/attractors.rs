//! Maps of parameters and of starts: the same answers as single motions, early or late, in any order.

use saltus::model::{ModelError, PreparedPlate, Setup};
use saltus::orbits::MotionKind;
use saltus::physics::PhysicsError;
use saltus::study::{
    AttractorCatalogue, Bodies, Control, Effects, Found, Grid, Lost, Search, StudyError,
    attractors, linspace, map, simulate,
};
use std::sync::Arc;

/// A coarse map of the paper's case.
fn grid() -> Grid {
    Grid {
        x: linspace(0.1, 0.5, 7),
        y: linspace(0.85, 1.15, 6),
    }
}

fn plate() -> Arc<PreparedPlate> {
    PreparedPlate::new(&Setup::dias_del_prado(0.3, 1.0).plate).expect("the paper's plate")
}

fn found(pixels: &[usize], search: &Search, threads: usize) -> Vec<(usize, Found)> {
    let (grid, plate) = (grid(), plate());
    let control = Control {
        threads,
        ..Control::default()
    };
    let model_at = |x: f64, y: f64| {
        let model = Setup::dias_del_prado(x, y).model_on(&plate)?;
        let start = model.start(3.0, 2.0);
        Ok((model, start))
    };
    let mut out = Vec::new();
    map(
        &grid,
        pixels.iter().copied(),
        model_at,
        search,
        &control,
        |pixel, found| {
            out.push((pixel, found));
            Ok::<(), StudyError>(())
        },
    )
    .expect("runs");
    out.sort_by_key(|(pixel, _)| *pixel);
    out
}

fn kind(found: &Found) -> Option<MotionKind> {
    found.attractor.as_ref().ok().map(|a| a.kind)
}

#[test]
fn pixels_are_the_same_bits_alone_in_any_order_and_on_any_threads() {
    let all: Vec<usize> = (0..grid().len()).collect();
    let search = Search {
        transient: 120,
        ..Search::default()
    };
    let one = found(&all, &search, 1);
    let backwards: Vec<usize> = all.iter().rev().copied().collect();
    assert_eq!(found(&backwards, &search, 3), one);
    for pixel in [0, 17, 41] {
        assert_eq!(found(&[pixel], &search, 1)[0], one[pixel]);
    }
}

#[test]
fn stopping_early_changes_no_label_and_saves_a_third() {
    let all: Vec<usize> = (0..grid().len()).collect();
    // chaos is watched for as long with and without it
    let early = Search {
        watch: 0,
        ..Search::default()
    };
    let full = Search {
        early_stop: false,
        ..early
    };
    let early = found(&all, &early, 0);
    let late = found(&all, &full, 0);
    let periods = |found: &[(usize, Found)]| found.iter().map(|(_, f)| f.periods).sum::<u64>();
    assert!(3 * periods(&early) < 2 * periods(&late));
    for ((pixel, early), (_, late)) in early.iter().zip(&late) {
        assert_eq!(kind(early), kind(late), "{:?}", grid().at(*pixel));
        let (Ok(early), Ok(late)) = (&early.attractor, &late.attractor) else {
            panic!("{:?}", grid().at(*pixel));
        };
        if let MotionKind::Periodic(_) = early.kind {
            // the transient left out is below 1e-6 eta; accelerations are some ten m/s^2
            assert!((early.contact_ratio[0] - late.contact_ratio[0]).abs() < 1e-6);
            assert!((early.peak_reaction()[0] - late.peak_reaction()[0]).abs() < 1e-5);
            assert!((early.peak_acceleration() - late.peak_acceleration()).abs() < 1e-4);
        }
    }
}

#[test]
fn labels_are_those_of_the_paper() {
    // DP Fig. 3b, 3e, and 2b at small damping.
    for (zeta, ratio, expected) in [
        (0.35, 0.9, MotionKind::Periodic(1)),
        (0.28, 1.0, MotionKind::Periodic(2)),
        (0.12, 1.0, MotionKind::Chaotic),
    ] {
        let model = Setup::dias_del_prado(zeta, ratio).model().expect("valid");
        let mut labels = Vec::new();
        let start_at = |_| Ok((model.clone(), model.start(3.0, 2.0)));
        attractors(
            [0],
            start_at,
            &Search::default(),
            &Control::default(),
            |_, found| {
                labels.extend(kind(&found));
                Ok::<(), StudyError>(())
            },
        )
        .expect("runs");
        assert_eq!(labels, [expected], "{zeta} {ratio}");
    }
}

/// Motion that the paper's start leads to.
fn pixel(zeta: f64, ratio: f64, search: &Search) -> Found {
    let model = Setup::dias_del_prado(zeta, ratio).model().expect("valid");
    let start_at = |_| Ok((model.clone(), model.start(3.0, 2.0)));
    let mut one = None;
    attractors([0], start_at, search, &Control::default(), |_, found| {
        one = Some(found);
        Ok::<(), StudyError>(())
    })
    .expect("runs");
    one.expect("an answer")
}

#[test]
fn the_shortest_period_wins_where_the_double_return_is_closer() {
    // 6-cycles with a multiplier near -1: 20 000 periods and Newton's method
    for zeta in [0.211_159_686, 0.219_996_601] {
        let found = pixel(zeta, 1.034_652_482, &Search::default());
        assert_eq!(kind(&found), Some(MotionKind::Periodic(6)), "{zeta}");
    }
}

#[test]
fn a_slow_approach_to_a_cycle_is_decided_by_its_multipliers() {
    // undecided after 4168 periods without them; the multipliers are those of an orbit after 20 000 periods
    for (zeta, ratio, period, multiplier) in [
        (0.138_499, 0.940_715, 2, 0.986_625_f64.hypot(0.149_927)),
        (0.170_492, 0.954_346, 2, 0.996_063),
        (0.373_270, 1.105_301, 4, 0.994_764),
    ] {
        let found = pixel(zeta, ratio, &Search::default());
        assert_eq!(kind(&found), Some(MotionKind::Periodic(period)), "{zeta}");
        let motion = found.attractor.expect("a motion");
        let largest = motion.multiplier.expect("Newton's method was asked");
        // places are rounded to six digits, and multipliers move by some 1e-5 from there
        assert!((largest - multiplier).abs() < 1e-4, "{zeta}: {largest}");
        assert_eq!(motion.z()[0].len(), period as usize);
    }
}

#[test]
fn a_torus_is_told_by_averages_over_one_long_piece() {
    // the largest exponents over 8000 periods are zero within 2e-5, and no cycle of up to 32 periods is near
    for (zeta, ratio) in [(0.10, 0.953), (0.106, 0.9532), (0.11, 0.953)] {
        let found = pixel(zeta, ratio, &Search::default());
        assert_eq!(
            kind(&found),
            Some(MotionKind::QuasiPeriodic),
            "{zeta} {ratio}"
        );
        let motion = found.attractor.expect("a motion");
        assert!(motion.confidence >= Some(0.999));
    }
}

#[test]
fn chaos_says_over_how_many_periods_it_was_seen() {
    let hasty = Search {
        watch: 0,
        ..Search::default()
    };
    let [short, long] = [hasty, Search::default()].map(|search| pixel(0.12, 1.0, &search));
    assert_eq!([&short, &long].map(kind), [Some(MotionKind::Chaotic); 2]);
    // run on for its time, and one period more for a last look
    let more = long.periods - short.periods;
    assert_eq!(more, Search::default().watch + 1);
}

#[test]
fn peaks_are_the_tops_of_the_motion_between_samples() {
    let search = Search {
        transient: 12,
        record: 8,
        early_stop: false,
        exponent: 0,
        ..Search::default()
    };
    for (zeta, ratio) in [(0.3, 1.0), (0.12, 1.0), (0.15, 1.1)] {
        let model = Setup::dias_del_prado(zeta, ratio).model().expect("valid");
        let start = model.start(3.0, 2.0);
        let mut peaks = None;
        let start_at = |_| Ok((model.clone(), start.clone()));
        attractors([0], start_at, &search, &Control::default(), |_, found| {
            peaks = found.attractor.ok();
            Ok::<(), StudyError>(())
        })
        .expect("runs");
        let peaks = peaks.expect("a motion");
        let run = |points| simulate(&model, &start, 20, 8, points, &Control::default());
        let run = [10, 4000].map(|points| run(points).expect("runs"));
        // however few points the history has
        assert_eq!(run[0].peak_reaction, run[1].peak_reaction);
        assert!((run[0].peak_reaction[0] / peaks.peak_reaction()[0] - 1.0).abs() < 1e-9);
        let states = &run[1].history.states;
        let reaction = |i: usize| states[i].prf[0];
        let highest = (1..states.len() - 1)
            .max_by(|&a, &b| reaction(a).total_cmp(&reaction(b)))
            .expect("states");
        assert!(run[1].peak_reaction[0] >= reaction(highest));
        // the parabola through the three highest of 4000 readings per period has an error of fourth order in 1/4000
        let [before, top, after] = [highest - 1, highest, highest + 1].map(reaction);
        let vertex = top + (after - before).powi(2) / (8.0 * (2.0 * top - before - after));
        let error = run[1].peak_reaction[0] / vertex - 1.0;
        assert!(error.abs() < 1e-9, "{zeta} {ratio}: {error:e}");
        // second differences, of second order, kept within each step of the motion
        let h = model.scales().period() / 4000.0;
        let second = |w: &[saltus::model::Observation]| {
            ((w[0].floor[0] - 2.0 * w[1].floor[0] + w[2].floor[0]) / (h * h)).abs()
        };
        let acceleration = states.windows(3).map(second).fold(0.0, f64::max);
        let error = peaks.peak_acceleration() / acceleration - 1.0;
        assert!(error.abs() < 2e-4, "{zeta} {ratio}: {error}");
    }
}

#[test]
fn coexisting_attractors_are_told_apart_and_shifts_of_one_are_not() {
    // zeta_h 0.15 at 0.9: two 2-cycles, one of them rare.
    let model = Setup::dias_del_prado(0.15, 0.9).model().expect("valid");
    let starts = [
        (-2.0, -4.0),
        (0.5, 1.0),
        (4.933_333_333_333_334, 0.8),
        (3.0, 2.0),
    ];
    let start_at = |i: usize| Ok((model.clone(), model.start(starts[i].0, starts[i].1)));
    let mut motions = vec![None; starts.len()];
    attractors(
        0..starts.len(),
        start_at,
        &Search::default(),
        &Control::default(),
        |i, found| {
            motions[i] = found.attractor.ok();
            Ok::<(), StudyError>(())
        },
    )
    .expect("runs");
    let mut all = AttractorCatalogue::default();
    let numbers: Vec<_> = motions
        .into_iter()
        .enumerate()
        .map(|(i, motion)| all.file(i, motion.expect("a motion")))
        .collect();
    assert_eq!(numbers, [Some(0), Some(0), Some(1), Some(0)]);
    let (entries, _) = all.ranked();
    assert!(
        entries
            .iter()
            .all(|e| e.attractor.kind == MotionKind::Periodic(2))
    );
}

#[test]
fn a_pixel_without_model_and_one_of_another_structure_are_answers_too() {
    let setups = |i: usize| {
        let mut setup = Setup::dias_del_prado(0.3, 0.9);
        match i {
            0 => setup.plate.thickness = -1.0,
            1 => setup.inertia = saltus::model::Inertia::Full,
            _ => {}
        }
        setup
    };
    let start_at = |i: usize| {
        let model = setups(i).model()?;
        let start = model.start(3.0, 2.0);
        Ok((model, start))
    };
    let search = Search {
        transient: 4,
        record: 4,
        early_stop: true,
        exponent: 0,
        ..Search::default()
    };
    let mut answers = vec![None; 4];
    attractors(0..4, start_at, &search, &Control::default(), |i, found| {
        answers[i] = Some(found);
        Ok::<(), StudyError>(())
    })
    .expect("runs");
    let answer = |i: usize| answers[i].as_ref().expect("an answer");
    assert!(matches!(
        answer(0).attractor,
        Err(Lost::NoModel(ModelError::Physics(
            PhysicsError::OutOfRange { .. }
        )))
    ));
    assert!(answer(1).attractor.is_ok());
    assert_eq!(answer(2), answer(3));
}

#[test]
fn a_sink_that_refuses_ends_the_search() {
    let model = Setup::dias_del_prado(0.3, 0.9).model().expect("valid");
    let start_at = |_| Ok((model.clone(), model.start(3.0, 2.0)));
    #[derive(Debug, PartialEq)]
    struct Full;
    impl From<StudyError> for Full {
        fn from(_: StudyError) -> Self {
            panic!("no error of the study")
        }
    }
    let refused = attractors(
        0..100,
        start_at,
        &Search::default(),
        &Control::default(),
        |_, _| Err(Full),
    );
    assert_eq!(refused, Err(Full));
}
