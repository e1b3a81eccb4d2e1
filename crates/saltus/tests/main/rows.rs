//! Labels and exponents of the rows of a sweep, of the paper's case.

use saltus::model::{Model, ModelError, PreparedPlate, Setup};
use saltus::orbits::MotionKind;
use saltus::physics::ContactLaw;
use saltus::study::{
    Bodies, Control, Pass, StudyError, Sweep, SweepRow, exponents, labels, recurrence, sweep,
};
use std::sync::{Arc, LazyLock};

static PLATE: LazyLock<Arc<PreparedPlate>> = LazyLock::new(|| {
    PreparedPlate::new(&Setup::dias_del_prado(0.3, 1.0).plate).expect("the paper's plate")
});

/// At the frequency ratio 1.0, DP Fig. 2b; there is none at 0.2.
fn model(zeta: f64) -> Result<Model, ModelError> {
    let mut setup = Setup::dias_del_prado(zeta, 1.0);
    if zeta == 0.2 {
        setup.plate.thickness = -1.0;
        return setup.model();
    }
    setup.model_on(&PLATE)
}

fn control(threads: usize) -> Control {
    Control {
        threads,
        ..Control::default()
    }
}

fn rows(values: &[f64], transient: u64) -> Vec<SweepRow> {
    let question = Sweep {
        values: values.to_vec(),
        passes: vec![Pass::Start((3.0, 2.0))],
        start: (3.0, 2.0),
        transient,
        record: 8,
    };
    sweep(&question, model, &control(0)).expect("runs")
}

#[test]
fn the_papers_motions_have_their_names_and_signs() {
    // chaos, 4T and 2T of DP Fig. 2b; a value without a model keeps its place
    let rows = rows(&[0.12, 0.2, 0.21, 0.28], 400);
    let labels = labels(&rows, model, &control(0)).expect("runs");
    let kinds: Vec<Option<MotionKind>> = labels
        .iter()
        .map(|l| l.as_ref().map(|label| label.kind))
        .collect();
    let periodic = |n| Some(MotionKind::Periodic(n));
    assert_eq!(
        kinds,
        [Some(MotionKind::Chaotic), None, periodic(4), periodic(2)]
    );
    let chaos = labels[0].as_ref().expect("a label");
    assert!(chaos.confidence >= Some(0.999), "{chaos:?}");
    assert!(chaos.exponent.expect("it took one").per_iterate > 0.0);
    // returns told that these are cycles
    assert_eq!(labels[3].as_ref().and_then(|label| label.exponent), None);

    let found = exponents(&rows, &labels, model, 2, 200, &control(0)).expect("runs");
    assert_eq!(found.iter().map(Vec::len).collect::<Vec<_>>(), [2, 0, 2, 2]);
    let far = |row: usize| found[row][0].per_iterate / found[row][0].standard_error;
    // 200 periods give an error of a third of the exponent of the 4-cycle
    assert!(far(0) > 5.0 && far(2) < -3.0 && far(3) < -5.0, "{found:?}");
}

#[test]
fn exponents_are_of_the_motion_the_row_shows() {
    // where an up and a down sweep are on different 2-cycles (`lineages.rs`)
    let question = Sweep {
        values: vec![0.21, 0.225, 0.26, 0.295],
        passes: vec![Pass::Up, Pass::Down],
        start: (3.0, 2.0),
        transient: 3000,
        record: 8,
    };
    let rows = sweep(&question, model, &control(0)).expect("runs");
    let labels = labels(&rows, model, &control(0)).expect("runs");
    let found = exponents(&rows, &labels, model, 1, 100, &control(0)).expect("runs");
    let apart =
        |value: usize| (found[value][0].per_iterate - found[4 + value][0].per_iterate).abs();
    // on the same cycle they agree to what 3000 periods and the averages over 100 leave
    assert!(apart(3) < 1e-3 && apart(1) > 1e-2, "{found:?}");
}

#[test]
fn threads_change_no_bit() {
    let rows = rows(&[0.12, 0.13, 0.15, 0.17, 0.21], 50);
    let all = |threads| {
        let control = control(threads);
        let labels = labels(&rows, model, &control).expect("runs");
        let exponents = exponents(&rows, &labels, model, 1, 40, &control).expect("runs");
        (labels, exponents)
    };
    assert_eq!(all(1), all(3));
}

#[test]
fn models_of_several_programs_keep_their_order() {
    // whose feet leave the floor with the leg relaxed has one state more
    let at = |zeta: f64| {
        let mut setup = Setup::dias_del_prado(zeta, 1.0);
        if zeta == 0.35 {
            setup.contact = ContactLaw::RelaxingLeg;
        }
        setup.model_on(&PLATE)
    };
    let [one, other] = [0.3, 0.35].map(|zeta| at(zeta).expect("valid"));
    assert!(!one.system().same_structure(other.system()));
    let alone = |value: f64| {
        let question = Sweep {
            values: vec![value],
            passes: vec![Pass::Start((3.0, 2.0))],
            start: (3.0, 2.0),
            transient: 50,
            record: 8,
        };
        sweep(&question, at, &control(0)).expect("runs")
    };
    let rows = [0.3, 0.35, 0.4].map(alone).concat();
    let of = |rows: &[SweepRow]| {
        let labels = labels(rows, at, &control(0)).expect("runs");
        exponents(rows, &labels, at, 1, 40, &control(0)).expect("runs")
    };
    for (row, together) in rows.iter().zip(&of(&rows)) {
        let alone = of(std::slice::from_ref(row));
        assert_eq!(alone[0], *together, "at {}", row.value);
    }
}

#[test]
fn label_and_exponent_are_of_what_follows_a_chaotic_transient() {
    // at 0.17 chaos dies out slowly towards an 8-cycle (`lineages.rs`); it outlives some rows
    let start = |i: u32| Pass::Start((f64::from(i), 2.0));
    let question = Sweep {
        values: vec![0.17],
        passes: (0..16).map(start).collect(),
        start: (3.0, 2.0),
        transient: 200,
        record: 16,
    };
    let rows = sweep(&question, model, &control(0)).expect("runs");
    let labels = labels(&rows, model, &control(0)).expect("runs");
    let found = exponents(&rows, &labels, model, 1, 60, &control(0)).expect("runs");
    for (label, exponents) in labels.iter().flatten().zip(&found) {
        assert_eq!(label.kind, MotionKind::Periodic(8));
        assert!(exponents[0].per_iterate < 0.0, "{label:?} {exponents:?}");
    }
    let late = |row: &&SweepRow| recurrence(&row.z()[0], &row.v()[0], 1e-2).is_none();
    assert!(rows.iter().filter(late).count() > 0);
}

#[test]
fn more_exponents_than_states_are_refused() {
    let rows = rows(&[0.3], 4);
    let labels = labels(&rows, model, &control(0)).expect("runs");
    let refused = exponents(&rows, &labels, model, 1000, 10, &control(0));
    assert!(
        matches!(refused, Err(StudyError::Exponents(_))),
        "{refused:?}"
    );
}
