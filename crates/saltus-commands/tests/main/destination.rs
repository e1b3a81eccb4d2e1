//! An answer finds a place: the one that was asked for, one beside it, or one among temporary files.

use saltus_commands::{CommandError, Destination, Request, RunContext};
use saltus_config::{Study, paper_template, parse};
use saltus_results::Manifest;
use std::fs;

fn study() -> Study {
    let sets = ["plate.inertia=condensed", "simulate.periods=2"].map(str::to_owned);
    parse("paper.toml", &paper_template(), &sets).unwrap()
}

/// Tries the place `out`, spoils it, and stores an answer there.
fn stored(
    home: &std::path::Path,
    spoil: impl FnOnce(&std::path::Path),
) -> Result<(), CommandError> {
    let (study, context) = (study(), RunContext::default());
    let request = Request::Simulate;
    let destination = Destination {
        request: &request,
        study: &study,
        context: &context,
    };
    let out = home.join("out");
    destination.try_out(&out).unwrap();
    assert!(!out.exists());
    let answer = request.ask(&study, &context).unwrap();
    spoil(&out);
    destination.store(&out, answer.as_ref())
}

#[test]
fn an_answer_is_kept_beside_a_folder_that_somebody_made_meanwhile() {
    let home = tempfile::tempdir().unwrap();
    let outcome = stored(home.path(), |out| {
        fs::create_dir(out).unwrap();
        fs::write(out.join("mine"), "years").unwrap();
    });
    let failure = outcome.unwrap_err();
    let said = failure.to_string();
    assert!(said.contains("is not empty"), "{said}");
    let CommandError::Elsewhere { folder, .. } = failure else {
        panic!("{said}");
    };
    assert!(said.contains(&folder.display().to_string()), "{said}");
    assert_eq!(folder.parent(), Some(home.path()));
    assert_eq!(Manifest::read(&folder).unwrap().verify(&folder), []);
    let name = folder.file_name().unwrap().to_str().unwrap();
    assert!(name.starts_with("out-kept-"), "{name}");
    // what is somebody else's stays as it was, and nothing is left in the making
    assert_eq!(
        fs::read_to_string(home.path().join("out/mine")).unwrap(),
        "years"
    );
    assert_eq!(fs::read_dir(home.path()).unwrap().count(), 2);
}

#[test]
fn an_answer_is_kept_among_temporary_files_if_nothing_beside_its_place_can_be_written() {
    let home = tempfile::tempdir().unwrap();
    let deep = home.path().join("deep");
    fs::create_dir(&deep).unwrap();
    let outcome = stored(&deep, |out| {
        // a file where the folder was: neither it nor what is beside it can be made
        fs::remove_dir(out.parent().unwrap()).unwrap();
        fs::write(out.parent().unwrap(), "").unwrap();
    });
    let Err(CommandError::Elsewhere { folder, reason }) = outcome else {
        panic!("it is nowhere");
    };
    assert!(
        reason.to_string().contains("is a file, not a folder"),
        "{reason}"
    );
    assert_eq!(folder.parent(), Some(&*std::env::temp_dir()));
    assert_eq!(Manifest::read(&folder).unwrap().verify(&folder), []);
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_place_that_stays_is_where_the_answer_is() {
    let home = tempfile::tempdir().unwrap();
    stored(home.path(), |_| {}).unwrap();
    assert!(home.path().join("out/simulate.json").is_file());
    assert_eq!(fs::read_dir(home.path()).unwrap().count(), 1);
}
