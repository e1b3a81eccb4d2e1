//! Files that cannot be read, and text that is anything at all.

use proptest::prelude::*;
use saltus_config::{StudyError, StudyErrorKind, load, paper_template, parse};
use std::path::Path;

fn refused(path: &Path) -> StudyError {
    let error = load(path, &[]).unwrap_err();
    assert_eq!(error.kind(), StudyErrorKind::Unreadable);
    assert!(
        error.to_string().contains(&path.display().to_string()),
        "{error}"
    );
    error
}

#[test]
fn unreadable_files_are_named() {
    let folder = tempfile::tempdir().unwrap();
    assert!(
        refused(&folder.path().join("none.toml"))
            .to_string()
            .contains("no such file")
    );
    assert!(refused(folder.path()).to_string().contains("directory"));

    let binary = folder.path().join("binary.toml");
    std::fs::write(&binary, [b'a', 0xff, 0xfe]).unwrap();
    assert!(refused(&binary).to_string().contains("byte 1"));

    let large = folder.path().join("large.toml");
    std::fs::write(&large, "#".repeat((4 << 20) + 1)).unwrap();
    assert!(refused(&large).to_string().contains("too large"));
}

#[test]
fn a_file_is_read_with_overrides() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("paper.toml");
    std::fs::write(&path, paper_template().replace('\n', "\r\n")).unwrap();
    let study = load(&path, &["jumper.damping_ratio=0.28".to_owned()]).unwrap();
    assert_eq!(study.jumper[0].damping_ratio, 0.28);
}

/// Text that is nearly a study: bits of TOML in any order.
fn fragments() -> impl Strategy<Value = String> {
    let words = prop::sample::select(vec![
        "[plate]",
        "[[jumper]]",
        "[jumper]",
        "[base]",
        "[sweep]",
        "length",
        "modes",
        "x",
        "u",
        "starts",
        " = ",
        "\n",
        ".",
        "1",
        "-1e308",
        "nan",
        "\"paper\"",
        "'3x3'",
        "[[1, 2]]",
        "{",
        "}",
        "[",
        "]",
        ",",
        "#",
        "é",
        "true",
        "2020-01-01",
    ]);
    prop::collection::vec(words, 0..40).prop_map(|words| words.concat())
}

proptest! {
    #[test]
    fn no_text_makes_it_panic(text in any::<String>(), set in any::<String>()) {
        let _ = parse("any", &text, &[]);
        let _ = parse("any", &paper_template(), &[set]);
    }

    #[test]
    fn no_fragments_make_it_panic(text in fragments(), set in fragments()) {
        let _ = parse("any", &text, std::slice::from_ref(&set));
        let _ = parse("any", &paper_template(), &[set]);
    }

    #[test]
    fn no_cut_or_inserted_text_makes_it_panic(at in 0..4000_usize, len in 0..60_usize, new in fragments()) {
        let template = paper_template();
        let chars: Vec<char> = template.chars().collect();
        let start = at.min(chars.len());
        let end = (start + len).min(chars.len());
        let text: String = chars[..start].iter().chain(&new.chars().collect::<Vec<_>>()).chain(&chars[end..]).collect();
        if let Err(error) = parse("any", &text, &[]) {
            prop_assert!(!error.to_string().is_empty());
            let _ = error.line();
        }
    }

    #[test]
    fn any_number_that_is_accepted_round_trips(value in any::<f64>()) {
        if let Ok(study) = parse("any", &paper_template(), &[format!("start.z={value:?}")]) {
            let again = parse("again", &study.to_toml(), &[]);
            prop_assert_eq!(again.map(|s| s.start.z.to_bits()), Ok(study.start.z.to_bits()));
        }
    }
}
