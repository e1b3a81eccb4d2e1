//! Values of an axis: equally spaced, or one by one.

use saltus_config::{Study, StudyErrorKind, parse};

fn with(sets: &[&str]) -> Result<Study, saltus_config::StudyError> {
    let sets: Vec<String> = sets.iter().map(|s| (*s).to_owned()).collect();
    parse("study.toml", &Study::paper().to_toml(), &sets)
}

#[test]
fn values_given_one_by_one_are_those_of_the_question() {
    let list = "[0.1, 0.15, 0.3]";
    for name in ["sweep", "map.x", "attractors"] {
        let study = with(&[&format!("{name}.values={list}")]).unwrap();
        let axis = match name {
            "sweep" => study.sweep.unwrap().axis(),
            "map.x" => study.map.unwrap().x,
            _ => study.attractors.sweep().unwrap(),
        };
        assert_eq!(axis.values(), [0.1, 0.15, 0.3]);
        assert_eq!((axis.from(), axis.to(), axis.count()), (0.1, 0.3, 3));
        assert_eq!((axis.from, axis.to, axis.count), (None, None, None));
    }
    let descending = with(&["basins.x.values=[5, -1, -1.5]"]).unwrap().basins;
    assert_eq!(descending.unwrap().x.values(), [5.0, -1.0, -1.5]);
}

#[test]
fn a_list_comes_back_to_the_bit() {
    let third = 1.0 / 3.0;
    let mut study = Study::paper();
    let sweep = study.sweep.as_mut().unwrap();
    (sweep.from, sweep.to, sweep.count) = (None, None, None);
    sweep.values = Some(vec![0.1, 0.1 + f64::EPSILON, 0.1 + 0.2, third]);
    assert_eq!(parse("again", &study.to_toml(), &[]).unwrap(), study);
    assert_eq!(Study::from_json(&study.to_json(), &[]).unwrap(), study);
}

#[test]
fn a_list_as_long_as_allowed_fits_in_a_file() {
    let mut study = Study::paper();
    let sweep = study.sweep.as_mut().unwrap();
    (sweep.from, sweep.to, sweep.count) = (None, None, None);
    // of nearly the most digits that a number can have
    let values = (1..=100_000).map(|i| 1e-4 * f64::from(i) / 3.0);
    sweep.values = Some(values.collect());
    let again = saltus_config::read("long", study.to_toml().as_bytes(), &[]);
    assert_eq!(again.unwrap(), study);
}

#[test]
fn what_is_set_last_replaces_the_other_way() {
    let listed = with(&["map.y.values=[0.9, 1.0, 1.1]"]).unwrap();
    let text = listed.to_toml();
    let sets = ["map.y.from=0.9", "map.y.to=1.1", "map.y.count=5"].map(str::to_owned);
    let even = parse("study.toml", &text, &sets).unwrap().map.unwrap().y;
    assert_eq!((even.values.as_ref(), even.count()), (None, 5));
    let error = with(&["map.y.values=[0.9, 1.0]", "map.y.count=5"]).unwrap_err();
    assert!(
        error.to_string().contains("map.y.count is given too"),
        "{error}"
    );
}

#[test]
fn both_ways_at_once_are_refused_and_neither_names_what_is_missing() {
    let paper = Study::paper().to_toml();
    let both = paper.replace("count = 81", "count = 81\nvalues = [0.1, 0.2]");
    let error = parse("study.toml", &both, &[]).unwrap_err();
    assert_eq!(error.key(), Some("sweep.values"));
    assert_eq!(
        error.to_string(),
        "sweep.values = [0.1, 0.2]: sweep.from is given too"
    );
    assert!(error.line().is_some());

    let neither = paper.replace("from = 0.1\nto = 0.5\ncount = 81\n", "");
    let error = parse("study.toml", &neither, &[]).unwrap_err();
    assert_eq!(error.kind(), StudyErrorKind::Key);
    let missing: Vec<&str> = std::iter::once(&error)
        .chain(error.others())
        .filter_map(|e| e.key())
        .collect();
    assert_eq!(missing, ["sweep.from", "sweep.to", "sweep.count"]);
    assert!(error.advice().unwrap().contains("values, a list"));
}

#[test]
fn a_value_in_the_list_is_shown_where_it_stands() {
    let paper = Study::paper().to_toml();
    let lines = "values = [\n0.1,\n0.3,\n0.2,\n]";
    let text = paper.replace("from = 0.1\nto = 0.5\ncount = 81", lines);
    let begin = text.lines().position(|line| line == "values = [").unwrap();
    let error = parse("study.toml", &text, &[]).unwrap_err();
    assert_eq!(error.key(), Some("sweep.values.2"));
    assert_eq!(error.line(), Some(begin + 4));
}

#[test]
fn a_parameter_leaves_the_questions_as_they_are() {
    let study = with(&["sweep.values=[0.1, 0.2]", "map.x.values=[0.1, 0.2]"]).unwrap();
    let changed = study.set("jumper.mass", 80.0).unwrap();
    assert_ne!(changed, study);
    assert_eq!(changed.set("jumper.mass", 76.64).unwrap(), study);
}
