//! The format of a study, and the hash by which results know it.

use saltus_config::{Study, StudyErrorKind, paper_template, parse};

#[test]
fn a_study_of_a_newer_version_is_told_before_its_unknown_keys() {
    let text = Study::paper()
        .to_toml()
        .replace("format = 1", "format = 2")
        .replace("length =", "span =");
    let error = parse("study.toml", &text, &["plate.span=3".to_owned()]).unwrap_err();
    assert_eq!((error.key(), error.line()), (Some("format"), Some(1)));
    assert_eq!(error.kind(), StudyErrorKind::Value);
    let message = error.to_string();
    assert!(
        message.starts_with("format = 2: this study needs a newer saltus; saltus "),
        "{message}"
    );
    assert!(message.ends_with("reads formats up to 1"), "{message}");
    assert_eq!(error.advice(), Some("update saltus"));
    assert!(error.others().is_empty());

    let json = Study::from_json(r#"{"format": 7, "slab": {}}"#, &[]).unwrap_err();
    assert!(json.to_string().starts_with("format = 7: "), "{json}");
}

#[test]
fn a_study_without_a_format_is_of_the_present_one() {
    let text = paper_template();
    let without: String = text
        .lines()
        .filter(|line| !line.starts_with("format"))
        .map(|line| format!("{line}\n"))
        .collect();
    assert_ne!(text, without);
    let study = parse("old", &without, &[]).unwrap();
    assert_eq!(
        (study.format, study.hash()),
        (Study::FORMAT, Study::paper().hash())
    );
}

#[test]
fn a_hash_is_that_of_the_resolved_text() {
    // sha256sum of what `saltus check` writes for the paper's case; a change here changes what results carry
    assert_eq!(
        Study::paper().hash(),
        "cbd26fffeb39e6c94450522b24e53e3a36046291df3fe20f7360f35d5dd32d73"
    );
    let other = Study::paper().set("jumper.mass", 80.0).unwrap();
    assert_ne!(other.hash(), Study::paper().hash());
}
