//! Studies written as JSON: the same study, the same refusals.

use proptest::prelude::*;
use saltus_config::{Study, StudyError, StudyErrorKind, parse};
use serde_json::{Value, json};

fn paper() -> Value {
    serde_json::from_str(&Study::paper().to_json()).unwrap()
}

/// The paper's study with the value at a JSON pointer replaced.
fn with(pointer: &str, value: Value) -> Result<Study, StudyError> {
    let mut study = paper();
    *study.pointer_mut(pointer).unwrap() = value;
    Study::from_json(&study.to_string(), &[])
}

#[test]
fn the_paper_comes_back() {
    let study = Study::from_json(&Study::paper().to_json(), &[]).unwrap();
    assert_eq!(study, Study::paper());
    assert_eq!(study.to_toml(), Study::paper().to_toml());
}

#[test]
fn defaults_overrides_and_whole_numbers_are_as_in_a_file() {
    let text = r#"{"plate": {"length": 14, "width": 10, "thickness": 0.1, "youngs_modulus": 27000000000,
        "density": 2500, "poisson_ratio": 0.2, "damping_ratio": 0.02,
        "modes": {"u": [[2, 1]], "v": [[1, 2]], "w": [[1, 1]]}},
        "contact": {"law": "gap"}, "base": {"amplitude": 0.013, "frequency": 2},
        "jumper": [{"x": 7, "y": 5, "mass": 80, "stiffness": 18600, "damping_ratio": 0.3}]}"#;
    let study = Study::from_json(text, &["jumper.0.mass=81".to_owned()]).unwrap();
    assert_eq!((study.plate.length, study.jumper[0].mass), (14.0, 81.0));
    assert_eq!(parse("same", &study.to_toml(), &[]).unwrap(), study);
}

/// (where, what, the whole message)
fn refused() -> Vec<(&'static str, Value, &'static str)> {
    let number = "a number from 0.001 to 10000 (m) is needed";
    let length =
        |given: &str| -> &'static str { format!("plate.length = {given}: {number}").leak() };
    vec![
        ("/plate/length", json!("nan"), length("nan")),
        ("/plate/length", json!("-inf"), length("-inf")),
        ("/plate/length", json!(-1), length("-1")),
        (
            "/plate/length",
            json!("long"),
            "plate.length = \"long\": text was given, a number from 0.001 to 10000 (m) is needed",
        ),
        (
            "/plate/length",
            Value::Null,
            "plate.length = null: a number from 0.001 to 10000 (m) is needed; leave out a key that has no value",
        ),
        (
            "/attractors/z/1",
            Value::Null,
            "attractors.z.1 = null: a number from -1e6 to 1e6 is needed; leave out a key that has no value",
        ),
        (
            "/attractors/z/1",
            json!("inf"),
            "attractors.z.1 = inf: a number from -1e6 to 1e6 is needed",
        ),
        (
            "/sweep/record",
            json!(1.5),
            "sweep.record = 1.5: a number with a decimal point was given, a whole number from 1 to 1e7 is needed",
        ),
        (
            "/sweep/record",
            json!(u64::MAX),
            "sweep.record = 18446744073709552000.0: a whole number from 1 to 1e7 is needed",
        ),
        (
            "/jumper/0/x",
            json!(14),
            "jumper.0.x = 14.0: outside the plate, 0 < x < plate.length = 14 m is needed",
        ),
    ]
}

#[test]
fn what_is_wrong_is_named_by_key_and_value() {
    for (pointer, value, message) in refused() {
        let error = with(pointer, value.clone()).expect_err(message);
        assert_eq!(error.to_string(), message);
        assert_eq!((error.line(), error.others().len()), (None, 0), "{message}");
        let key = pointer[1..].replace('/', ".");
        assert_eq!(error.key(), Some(key.as_str()));
    }
}

#[test]
fn messages_are_those_of_a_file() {
    let text = Study::paper().to_toml();
    for (key, toml, json) in [
        ("start.z", "nan", json!("nan")),
        ("start.z", "2e6", json!(2e6)),
        ("simulate.periods", "-1", json!(-1)),
        ("sweep.parameter", "\"start\"", json!("start")),
        ("contact.law", "\"gaps\"", json!("gaps")),
        ("plate.modes", "\"3by3\"", json!("3by3")),
    ] {
        let (table, name) = key.split_once('.').unwrap();
        let mut file: toml::Table = text.parse().unwrap();
        file[table][name] = toml.parse().unwrap();
        let file = parse("study.toml", &file.to_string(), &[]).unwrap_err();
        let other = with(&format!("/{table}/{name}"), json).unwrap_err();
        assert_eq!(file.to_string(), other.to_string());
        assert_eq!((file.advice(), file.key()), (other.advice(), other.key()));
    }
}

#[test]
fn unknown_and_missing_keys_are_told_at_once() {
    let mut study = paper();
    let plate = study["plate"].as_object_mut().unwrap();
    plate.remove("width");
    plate.insert("lenght".to_owned(), json!(14.0));
    let error = Study::from_json(&study.to_string(), &[]).unwrap_err();
    assert_eq!(error.to_string(), "unknown key plate.lenght");
    assert!(
        error
            .advice()
            .unwrap()
            .starts_with("did you mean plate.length?")
    );
    assert_eq!(
        error.others()[0].to_string(),
        "plate.width is missing from [plate]"
    );
}

#[test]
fn text_that_is_no_object_is_refused() {
    let deep = "[".repeat(100_000);
    for text in [
        "",
        "{",
        "[]",
        "3",
        "null",
        "{\"plate\": NaN}",
        "{} {}",
        &deep,
    ] {
        let error = Study::from_json(text, &[]).unwrap_err();
        assert!(
            !error.to_string().is_empty() && error.advice().is_some(),
            "{text}"
        );
        let kinds = [StudyErrorKind::Syntax, StudyErrorKind::Value];
        assert!(kinds.contains(&error.kind()), "{text}: {error}");
    }
    let error = Study::from_json("{}", &[]).unwrap_err();
    assert_eq!(error.to_string(), "the table [plate] is missing");
}

proptest! {
    #[test]
    fn any_number_that_is_accepted_round_trips(value in any::<f64>()) {
        let mut study = Study::paper();
        study.start.z = value;
        if study.validate().is_ok() {
            let again = Study::from_json(&study.to_json(), &[]);
            prop_assert_eq!(again.map(|s| s.start.z.to_bits()), Ok(value.to_bits()));
        }
    }

    #[test]
    fn no_text_makes_it_panic(text in any::<String>()) {
        let _ = Study::from_json(&text, &[]);
    }
}
