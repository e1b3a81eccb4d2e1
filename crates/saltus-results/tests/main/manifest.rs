//! A manifest says what a folder holds, notices what changed since, and names what is wrong with itself.

use saltus_results::folder::MARKER;
use saltus_results::manifest::sha256;
use saltus_results::{Manifest, ResultFolder, ResultsError};
use std::fs;
use std::path::Path;

fn folder(dir: &Path) {
    let mut folder = ResultFolder::stage(dir).unwrap();
    folder.about(serde_json::json!({ "request": "sweep", "study": sha256("[jumper.0]") }));
    folder.write("data/points.csv", "once").unwrap();
    folder.write("data/points.csv", "x\n1\n").unwrap();
    // Longer than any buffer on the way.
    folder
        .write_with("long.txt", |file| {
            (0..100_000).try_for_each(|i| writeln!(file, "{i}"))
        })
        .unwrap();
    folder.write("empty", "").unwrap();
    folder.commit().unwrap();
}

#[test]
fn the_manifest_names_every_file_with_its_checksum() {
    let home = tempfile::tempdir().unwrap();
    folder(home.path());
    let manifest = Manifest::read(home.path()).unwrap();
    assert_eq!(manifest.about["request"], "sweep");
    assert_eq!(manifest.version, env!("CARGO_PKG_VERSION"));
    let names: Vec<&str> = manifest
        .files
        .iter()
        .map(|file| file.name.as_str())
        .collect();
    assert_eq!(names, ["data/points.csv", "long.txt", "empty"]);
    for file in &manifest.files {
        let content = fs::read(home.path().join(&file.name)).unwrap();
        assert_eq!(file.bytes, content.len() as u64);
        assert_eq!(file.sha256, sha256(content), "{}", file.name);
    }
    // NIST FIPS 180-4, example of the empty message.
    let empty = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
    assert_eq!(manifest.files[2].sha256, empty);
    assert_eq!(manifest.verify(home.path()), []);
}

#[test]
fn equal_runs_are_equal_folders() {
    let (one, two) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    folder(one.path());
    folder(two.path());
    let manifest = |dir: &Path| fs::read(dir.join(MARKER)).unwrap();
    assert_eq!(manifest(one.path()), manifest(two.path()));
}

#[test]
fn what_changed_since_is_named() {
    let home = tempfile::tempdir().unwrap();
    folder(home.path());
    let manifest = Manifest::read(home.path()).unwrap();
    fs::write(home.path().join("data/points.csv"), "x\n2\n").unwrap();
    fs::write(home.path().join("long.txt"), "0\n").unwrap();
    fs::remove_file(home.path().join("empty")).unwrap();
    fs::write(home.path().join("notes.txt"), "mine").unwrap();
    let problems = manifest.verify(home.path());
    let said: Vec<String> = problems.iter().map(ToString::to_string).collect();
    let expected = [
        "`data/points.csv` was altered: its checksum is another",
        "`long.txt` has 2 bytes, not 588890",
        "`empty` is missing",
    ];
    assert_eq!(said, expected);
}

#[test]
fn what_is_no_result_is_told_why() {
    let home = tempfile::tempdir().unwrap();
    let file = home.path().join("file");
    fs::write(&file, "").unwrap();
    let cases = [
        (home.path().join("nowhere"), "there is no such folder"),
        (file, "it is a file, not a folder"),
        (
            home.path().to_path_buf(),
            "it holds no `saltus-result.json`",
        ),
    ];
    for (path, words) in cases {
        let error = Manifest::read(&path).unwrap_err();
        assert!(matches!(error, ResultsError::NotAResult { .. }), "{error}");
        assert!(error.to_string().contains(words), "{error}");
    }
}

#[test]
fn a_manifest_that_cannot_be_used_is_told_why() {
    let home = tempfile::tempdir().unwrap();
    let cases = [
        ("{", "it is damaged (EOF"),
        ("[]", "its `format` is null"),
        (r#"{"format": "saltus-pieces"}"#, "not \"saltus-result\""),
        (r#"{"format": "saltus-result"}"#, "no `format_version`"),
        (
            r#"{"format": "saltus-result", "format_version": 1, "version": "0.1.0", "about": {}}"#,
            "missing field `files`",
        ),
        (
            r#"{"format": "saltus-result", "format_version": 2, "version": "3.0.0"}"#,
            "it was written by saltus 3.0.0 in format 2; this is saltus",
        ),
        (
            r#"{"format": "saltus-result", "version": "0.1.0", "files": ["a.csv"]}"#,
            "written by saltus 0.1.0, before manifests had checksums",
        ),
        (
            r#"{"format": "saltus-result", "format_version": 1, "version": "0.1.0", "about": {},
                "files": [{"name": "../../secret", "bytes": 1, "sha256": ""}]}"#,
            "`../../secret` is no name for a file",
        ),
        (
            r#"{"format": "saltus-result", "format_version": 1, "version": "0.1.0", "about": {},
                "files": [{"name": "a\u001b[31m/", "bytes": 1, "sha256": ""}]}"#,
            "`a\\u{1b}[31m/` is no name for a file",
        ),
        (
            r#"{"format": "saltus-result", "format_version": 1, "version": "0.1.0", "about": {},
                "files": [{"name": "a", "bytes": 1, "sha256": ""}, {"name": "a", "bytes": 1, "sha256": ""}]}"#,
            "it names `a` twice",
        ),
        (
            r#"{"format": "saltus-result", "format_version": 1, "version": "1}} @evil{x, title={", "about": {}}"#,
            "its `version` is \"1}} @evil{x, title={\", which is none",
        ),
        (
            r#"{"format": "saltus-result", "format_version": 2, "version": "\u001b[31m"}"#,
            "which is none; it would be as 0.1.0",
        ),
    ];
    for (text, words) in cases {
        fs::write(home.path().join(MARKER), text).unwrap();
        let error = Manifest::read(home.path()).unwrap_err();
        assert!(matches!(error, ResultsError::Manifest { .. }), "{error}");
        assert!(error.to_string().contains(words), "{error}");
    }
}

#[test]
fn a_folder_with_a_marker_of_the_first_versions_is_still_ours() {
    let home = tempfile::tempdir().unwrap();
    let old = r#"{"format": "saltus-result", "version": "0.1.0", "files": ["data/points.csv"]}"#;
    fs::write(home.path().join(MARKER), old).unwrap();
    folder(home.path());
    assert_eq!(Manifest::read(home.path()).unwrap().files.len(), 3);
}

/// Makes a pipe that nobody writes to.
#[cfg(unix)]
fn pipe(path: &Path) {
    let made = std::process::Command::new("mkfifo").arg(path).status();
    assert!(made.unwrap().success());
}

#[cfg(unix)]
#[test]
fn what_is_no_ordinary_file_is_named_and_not_waited_for() {
    let home = tempfile::tempdir().unwrap();
    folder(home.path());
    let manifest = Manifest::read(home.path()).unwrap();
    fs::remove_file(home.path().join("empty")).unwrap();
    pipe(&home.path().join("empty"));
    fs::remove_file(home.path().join("long.txt")).unwrap();
    std::os::unix::fs::symlink("/dev/zero", home.path().join("long.txt")).unwrap();
    let problems = manifest.verify(home.path());
    let said: Vec<String> = problems.iter().map(ToString::to_string).collect();
    assert_eq!(said.len(), 2, "{said:?}");
    for one in said {
        assert!(
            one.contains("cannot be read: it is a pipe or a device"),
            "{one}"
        );
    }
    let marker = home.path().join(MARKER);
    fs::remove_file(&marker).unwrap();
    pipe(&marker);
    let error = Manifest::read(home.path()).unwrap_err().to_string();
    assert!(error.contains("it is a pipe or a device"), "{error}");
}

#[test]
fn a_manifest_without_measure_is_refused_unread() {
    let home = tempfile::tempdir().unwrap();
    let file = fs::File::create(home.path().join(MARKER)).unwrap();
    // a terabyte that takes no room
    file.set_len(1 << 40).unwrap();
    let error = Manifest::read(home.path()).unwrap_err().to_string();
    assert!(error.contains("it is larger than 4 MiB"), "{error}");
}
