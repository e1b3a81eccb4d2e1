//! Beginnings of `[continue]` and its curves, and the sweep of `[attractors]`.

use saltus_config::{AttractorsTable, Study, paper_template, parse};

fn study(sets: &[&str]) -> Study {
    let sets: Vec<String> = sets.iter().map(|s| (*s).to_owned()).collect();
    parse("paper", &paper_template(), &sets).unwrap()
}

fn start(study: &Study) -> Result<f64, String> {
    let table = study.continuation.as_ref().unwrap();
    table.start(study).map_err(|e| e.to_string())
}

fn start_of_curves(study: &Study) -> Result<f64, String> {
    let second = study.continuation.as_ref().unwrap().second.as_ref();
    second.unwrap().start(study).map_err(|e| e.to_string())
}

#[test]
fn a_branch_begins_at_the_studys_own_value() {
    assert_eq!(start(&study(&[])), Ok(0.3));
    assert_eq!(start_of_curves(&study(&[])), Ok(1.0));
    let downwards = study(&[
        "jumper.damping_ratio=0.28",
        "continue.from=0.5",
        "continue.to=0.28",
    ]);
    assert_eq!(start(&downwards), Ok(0.28));
}

#[test]
fn a_value_outside_the_range_is_good_for_other_questions_but_no_start() {
    let outside = study(&["jumper.damping_ratio=0.05", "base.frequency_ratio=1.3"]);
    let said = start(&outside).unwrap_err();
    assert!(
        said.contains("0.05, to begin with, lies outside 0.1 to 0.5"),
        "{said}"
    );
    let said = start_of_curves(&outside).unwrap_err();
    assert!(
        said.contains("1.3, to begin with, lies outside 0.85 to 1.15"),
        "{said}"
    );
}

#[test]
fn a_value_that_the_study_does_not_give_is_no_start() {
    let hertz = study(&["base.frequency=2.5"]);
    let said = start_of_curves(&hertz).unwrap_err();
    assert!(said.contains("gives no value"), "{said}");
    let nobody = study(&["jumper=[]", "base.reference=plate"]);
    let said = start(&nobody).unwrap_err();
    assert!(said.contains("no [[jumper]]"), "{said}");
}

#[test]
fn people_who_differ_give_no_start_but_one_of_them_does() {
    let mut two = study(&[]);
    two.jumper.push(two.jumper[0].clone());
    assert_eq!(start(&two), Ok(0.3));
    two.jumper[1].damping_ratio = 0.4;
    let said = start(&two).unwrap_err();
    assert!(said.contains("differ"), "{said}");
    two.continuation.as_mut().unwrap().parameter = "jumper.1.damping_ratio".to_owned();
    assert_eq!(start(&two), Ok(0.4));
}

#[test]
fn attractors_are_swept_or_sought_at_one_value() {
    let swept = study(&[]).attractors.sweep().unwrap().values();
    assert_eq!((swept.len(), swept[0], swept[40]), (41, 0.1, 0.5));
    assert_eq!(AttractorsTable::default().sweep(), None);
}

#[test]
fn every_part_of_a_sweep_that_is_missing_is_named() {
    let alone = "attractors.count=3".to_owned();
    let mut study = Study::paper();
    study.attractors = AttractorsTable::default();
    let error = parse("study.toml", &study.to_toml(), &[alone]).unwrap_err();
    let others = error.others().iter();
    let missing: Vec<&str> = std::iter::once(&error)
        .chain(others)
        .filter_map(|e| e.key())
        .collect();
    assert_eq!(
        missing,
        ["attractors.parameter", "attractors.from", "attractors.to"]
    );
}

#[test]
fn ranges_are_checked_where_no_file_was_read() {
    let mut study = Study::paper();
    study.continuation.as_mut().unwrap().step = f64::NAN;
    let error = study.validate().unwrap_err();
    assert_eq!(error.key(), Some("continue.step"), "{error}");
    let mut study = Study::paper();
    study.attractors.z[1] = f64::INFINITY;
    let error = study.validate().unwrap_err();
    assert_eq!(error.key(), Some("attractors.z.1"), "{error}");
    assert!(
        error
            .to_string()
            .contains("attractors.z.1 = inf: a number from"),
        "{error}"
    );
}
