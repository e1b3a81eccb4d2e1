//! All attractors of the paper's case: counted at one value, followed along the damping ratio.

use saltus::model::{Model, ModelError, PreparedPlate, Setup};
use saltus::orbits::MotionKind;
use saltus::physics::BaseFrequency;
use saltus::study::{
    AttractorCatalogue, AttractorCensus, BasinFraction, Bodies, ContinuedAttractors, Control, Pass,
    Search, Starts, StudyError, Sweep, attractors, census, follow, recurrence, sweep,
};
use std::sync::{Arc, LazyLock};

static PLATE: LazyLock<Arc<PreparedPlate>> = LazyLock::new(|| {
    PreparedPlate::new(&Setup::dias_del_prado(0.3, 1.0).plate).expect("the paper's plate")
});

fn model(zeta: f64, ratio: f64) -> Result<Model, ModelError> {
    Setup::dias_del_prado(zeta, ratio).model_on(&PLATE)
}

/// The box of the basins that are known: z in [-2, 6], v in [-4, 4], plate at rest.
fn starts(count: usize) -> Starts {
    Starts {
        count,
        z: [-2.0, 6.0],
        v: [-4.0, 4.0],
        plate: 0.0,
    }
}

fn control(threads: usize) -> Control {
    Control {
        threads,
        ..Control::default()
    }
}

fn followed(values: &[f64], ratio: f64, count: usize, threads: usize) -> ContinuedAttractors {
    let model_at = |zeta| model(zeta, ratio);
    let (starts, search) = (starts(count), Search::default());
    follow(values, model_at, &starts, &search, &control(threads)).expect("runs")
}

/// All starts that came to something else than an attractor.
fn without(census: &AttractorCensus) -> u64 {
    census.undecided.count + census.lost.count
}

#[test]
fn two_attractors_share_the_starts() {
    // zeta_h 0.15 at 0.9: two 2-cycles, one of them rare
    let model = model(0.15, 0.9).expect("valid");
    let found = census(&model, &starts(64), &Search::default(), &control(0)).expect("runs");
    let [often, rare] = &found.attractors[..] else {
        panic!("{:?}", found.attractors)
    };
    assert_eq!(often.entry.attractor.kind, MotionKind::Periodic(2));
    assert_eq!(rare.entry.attractor.kind, MotionKind::Periodic(2));
    assert!(rare.fraction.value() < 0.1 && rare.fraction.count > 0);
    let counts = often.fraction.count + rare.fraction.count;
    assert_eq!(counts + without(&found), 64);
    assert_eq!(often.arrival.section[0].len(), 2);
    assert_eq!((often.identity, rare.identity), (0, 1));
}

#[test]
fn a_slow_transient_is_no_attractor_and_counts_for_what_it_becomes() {
    // zeta_h 0.17 at 1.0: what is left of chaos dies out slowly towards an 8-cycle
    let (model, starts) = (model(0.17, 1.0).expect("valid"), starts(24));
    let mut kinds = Vec::new();
    let start_at = |number| Ok((model.clone(), starts.point(&model, number)));
    // one that does not ask for exponents, which would see the end of the transient
    let hasty = Search {
        exponent: 0,
        ..Search::default()
    };
    attractors(0..24, start_at, &hasty, &control(0), |_, found| {
        kinds.extend(found.attractor.ok().map(|motion| motion.kind));
        Ok::<(), StudyError>(())
    })
    .expect("runs");
    let of = |kind| kinds.iter().filter(|&&other| other == kind).count() as u64;
    let (band, cycle) = (of(MotionKind::NotPeriodic), of(MotionKind::Periodic(8)));
    assert!(band > 0 && cycle > 0, "{kinds:?}");
    let found = census(&model, &starts, &hasty, &control(0)).expect("runs");
    assert_eq!(found.attractors.len(), 1);
    assert_eq!(
        found.attractors[0].entry.attractor.kind,
        MotionKind::Periodic(8)
    );
    // and those that one search leaves undecided
    assert!(found.attractors[0].fraction.count >= band + cycle);
    assert_eq!(found.attractors[0].fraction.count + without(&found), 24);
}

/// The attractors that `count` starts lead to.
fn counted(zeta: f64, ratio: f64, count: usize) -> AttractorCensus {
    let model = model(zeta, ratio).expect("valid");
    census(&model, &starts(count), &Search::default(), &control(0)).expect("runs")
}

#[test]
fn chaos_that_ends_is_a_transient_with_a_lifetime() {
    // of eight chaotic motions seven reached the cycle within 12 000 periods, and four at zeta_h 0.155
    for (zeta, ratio) in [(0.1565, 1.0), (0.155, 1.0)] {
        let found = counted(zeta, ratio, 16);
        for one in &found.attractors {
            let motion = &one.entry.attractor;
            assert!(
                matches!(motion.kind, MotionKind::Periodic(_)),
                "{zeta}: {motion:?}"
            );
            assert!(motion.multiplier.is_some_and(|largest| largest < 1.0));
        }
        let [chaos] = &found.transients[..] else {
            panic!("{zeta}: {:?}", found.transients)
        };
        assert!(chaos.survival.ended > 0 && chaos.survival.motions == 8);
        let [mean, low, high] = chaos.survival.lifetime();
        assert!(1e3 < mean && mean < 1e5, "{zeta}: {mean}");
        assert!(low < mean && mean < high);
        // its starts count for what it ends on
        assert!(found.attractors[chaos.to].fraction.count >= chaos.fraction.count);
        let counts = found.attractors.iter().map(|one| one.fraction.count);
        assert_eq!(counts.sum::<u64>() + without(&found), 16);
    }
}

#[test]
fn chaos_that_lasts_is_an_attractor_with_a_bound_on_its_lifetime() {
    let found = counted(0.12, 1.0, 4);
    let [chaos] = &found.attractors[..] else {
        panic!("{:?}", found.attractors)
    };
    assert_eq!(chaos.entry.attractor.kind, MotionKind::Chaotic);
    let survival = chaos.survival.expect("it was watched");
    assert_eq!((survival.motions, survival.ended), (8, 0));
    let [mean, low, _] = survival.lifetime();
    assert!(mean == f64::INFINITY && low > 30_000.0, "{low}");
    assert_eq!(found.transients, []);
}

#[test]
fn a_slow_spiral_and_an_unstable_cycle_are_no_attractors() {
    // at (1.1, 0.445) one 2-cycle, to which motions spiral so slowly that they come back best after 14 periods; at
    // (1.0, 0.46) the 2-cycle beside the doubling at 0.46096
    for (zeta, ratio) in [(0.445, 1.1), (0.46, 1.0)] {
        let found = counted(zeta, ratio, 32);
        let kinds: Vec<MotionKind> = found
            .attractors
            .iter()
            .map(|one| one.entry.attractor.kind)
            .collect();
        assert_eq!(kinds, [MotionKind::Periodic(2)], "{zeta} {ratio}");
        let section = &found.attractors[0].arrival.section[0];
        assert!((section[0] - section[1]).abs() > 1e-3, "{section:?}");
    }
    // the same from a motion carried from beyond the doubling, which sits on the unstable cycle
    let found = followed(&[0.46, 0.462], 1.0, 1, 0);
    let kinds = found.rows.iter().map(|row| {
        let kinds = row.attractors().iter().map(|one| one.entry.attractor.kind);
        kinds.collect::<Vec<_>>()
    });
    let [two, one] = [MotionKind::Periodic(2), MotionKind::Periodic(1)];
    assert_eq!(kinds.collect::<Vec<_>>(), [[two], [one]]);
}

#[test]
fn an_attractor_that_no_start_meets_is_found_from_its_neighbours() {
    // zeta_h 0.12 at 0.9, 4096 starts of this box: 97.0 % lead to one 2-cycle and 3.0 % to another, nine in ten
    // of these undecided after 400 periods since it is about to double its period
    let values = [0.10, 0.11, 0.12];
    let found = followed(&values, 0.9, 48, 0);
    let there = found.rows[2].attractors();
    let [often, rare] = there else {
        panic!("{there:?}")
    };
    assert_eq!(often.entry.attractor.kind, MotionKind::Periodic(2));
    assert_eq!(rare.entry.attractor.kind, MotionKind::Periodic(2));
    let [low, high] = often.fraction.interval();
    assert!(low < 0.970 && 0.970 < high, "{low} {high}");
    assert_eq!(rare.fraction.count, 0);
    assert!(0.030 < BasinFraction::unseen(48) && 0.030 < rare.fraction.interval()[1]);
    // it is the 4-cycle of smaller damping
    let before = &found.rows[1].attractors()[rare.identity];
    assert_eq!(before.identity, rare.identity);
    assert_eq!(before.entry.attractor.kind, MotionKind::Periodic(4));
    assert!(before.fraction.count > 0);
}

#[test]
fn one_attractor_is_one_number_and_no_loop() {
    // DP Fig. 2a: period 1 above zeta_h = 0.19; two values of the 2-cycle before it
    let values = [0.175, 0.18, 0.2, 0.3, 0.5];
    let found = followed(&values, 0.9, 8, 0);
    assert_eq!(found.identities.len(), 1);
    let only = &found.identities[0];
    assert_eq!((only.first, only.last), (0.175, 0.5));
    assert_eq!((only.birth, only.death), (None, None));
    assert_eq!((&found.loops[..], found.unfinished), (&[][..], 0));
    let kinds = found
        .rows
        .iter()
        .map(|row| row.attractors()[0].entry.attractor.kind);
    let [two, one] = [MotionKind::Periodic(2), MotionKind::Periodic(1)];
    assert_eq!(kinds.collect::<Vec<_>>(), [two, two, one, one, one]);
}

#[test]
fn a_loop_is_where_an_up_and_a_down_sweep_differ() {
    let values = [0.21, 0.225, 0.24, 0.26, 0.28, 0.295];
    let found = followed(&values, 1.0, 16, 0);
    let [one] = &found.loops[..] else {
        panic!("{:?}", found.loops)
    };
    assert_eq!(
        (one.jump_up, one.jump_down),
        (Some([0.28, 0.295]), Some([0.21, 0.225]))
    );
    let both = Sweep {
        values: values.to_vec(),
        passes: vec![Pass::Up, Pass::Down],
        start: (3.0, 2.0),
        transient: 3000,
        record: 64,
    };
    let rows = sweep(&both, |zeta| model(zeta, 1.0), &control(0)).expect("runs");
    let (up, down) = rows.split_at(values.len());
    let differs = |(up, down): (&saltus::study::SweepRow, &saltus::study::SweepRow)| {
        // two different 2-cycles, or a 4-cycle and a 2-cycle, are an eta apart; transients are gone
        let top = |z: &[f64]| z.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let apart = (top(&up.z()[0]) - top(&down.z()[0])).abs() > 0.01;
        let period = |row: &saltus::study::SweepRow| recurrence(&row.z()[0], &row.v()[0], 1e-3);
        (apart || period(up) != period(down)).then_some(up.value)
    };
    let differ: Vec<f64> = up.iter().zip(down).filter_map(differs).collect();
    assert_eq!(differ, [0.225, 0.24, 0.26, 0.28]);
    assert_eq!((one.from, one.to), (0.225, 0.28));
}

#[test]
fn numbers_are_the_same_bits_on_any_threads() {
    let values = [0.14, 0.15, 0.17, 0.19];
    assert_eq!(followed(&values, 0.9, 24, 1), followed(&values, 0.9, 24, 2));
}

#[test]
fn a_value_without_a_model_is_a_row_and_motions_cross_it() {
    let values = [0.14, 0.145, 0.15];
    let model_at = |zeta| {
        let mut setup = Setup::dias_del_prado(zeta, 0.9);
        if zeta == 0.145 {
            setup.plate.thickness = -1.0;
            return setup.model();
        }
        setup.model_on(&PLATE)
    };
    let search = Search::default();
    let found = follow(&values, model_at, &starts(64), &search, &control(0)).expect("runs");
    assert!(found.rows[1].census.is_err());
    assert_eq!(found.identities.len(), 2);
    for identity in &found.identities {
        assert_eq!((identity.first, identity.last), (0.14, 0.15));
        assert_eq!((identity.birth, identity.death), (None, None));
    }
}

#[test]
fn basins_at_a_value_share_its_numbers() {
    let found = followed(&[0.13, 0.15], 0.9, 64, 0);
    let model = model(0.15, 0.9).expect("valid");
    // the rare one first
    let places = [(4.933_333_333_333_334, 0.8), (3.0, 2.0)];
    let start_at = |i: usize| Ok((model.clone(), model.start(places[i].0, places[i].1)));
    let mut basins = AttractorCatalogue::default();
    let mut motions = vec![None; places.len()];
    attractors(
        0..places.len(),
        start_at,
        &Search::default(),
        &control(0),
        |i, found| {
            motions[i] = found.attractor.ok();
            Ok::<(), StudyError>(())
        },
    )
    .expect("runs");
    for (i, motion) in motions.into_iter().enumerate() {
        basins.file(i, motion.expect("a motion"));
    }
    let number = |i: usize| found.identity(0.15, &basins.entries()[i].attractor);
    assert_eq!([number(0), number(1)], [Some(1), Some(0)]);
}

#[test]
fn two_people_on_a_bent_plate_are_counted_too() {
    let mut setup = Setup::dias_del_prado(0.3, 0.9);
    let mut second = setup.jumpers[0];
    second.x *= 0.5;
    setup.jumpers.push(second);
    let (model, bent) = (setup.model().expect("valid"), starts(8));
    let bent = Starts { plate: 0.2, ..bent };
    let found = census(&model, &bent, &Search::default(), &control(0)).expect("runs");
    let counts = found
        .attractors
        .iter()
        .map(|one| one.fraction.count)
        .sum::<u64>();
    assert_eq!(counts + without(&found), 8);
    assert!(!found.attractors.is_empty());
    for one in &found.attractors {
        let [first, second] = one.arrival.z() else {
            panic!("two bodies")
        };
        assert!(!first.is_empty() && first.len() == second.len());
    }
}

#[test]
fn odd_questions_have_answers() {
    let mut empty = Setup::dias_del_prado(0.3, 0.9);
    empty.jumpers.clear();
    empty.base.frequency = BaseFrequency::Hertz(2.3);
    let search = Search::default();
    let empty = empty.model().expect("a plate alone moves too");
    let refused = census(&empty, &starts(4), &search, &control(0));
    assert_eq!(refused, Err(StudyError::NoSection));
    let model = model(0.3, 0.9).expect("valid");
    for z in [[f64::NEG_INFINITY, 1.0], [f64::NAN, 1.0]] {
        let wild = Starts { z, ..starts(4) };
        let found = census(&model, &wild, &search, &control(0)).expect("runs");
        assert_eq!(found.lost.count, 4, "{z:?}");
        assert!(found.attractors.is_empty() && found.first_lost.is_some());
    }
    // a body that falls for longer than anybody waits
    let far = Starts {
        z: [1e299, 1e300],
        ..starts(4)
    };
    let found = census(&model, &far, &search, &control(0)).expect("runs");
    assert_eq!(without(&found), 4);
    let none = census(&model, &starts(0), &search, &control(0)).expect("runs");
    assert_eq!(none, AttractorCensus::default());
    assert!(followed(&[], 0.9, 4, 0).rows.is_empty());
    let stopped = control(0);
    stopped
        .stop
        .store(true, std::sync::atomic::Ordering::Relaxed);
    let stopped = census(&model, &starts(4), &search, &stopped);
    assert!(stopped.is_err_and(|error| error.is_interrupt()));
}
