//! Result folders and files are whole or absent, and errors name the place and the reason.

use saltus_results::folder::{INDEX, MARKER};
use saltus_results::{
    Dataset, Manifest, ResultFolder, ResultsError, Staging, Table, Variable, csv,
    write_file_atomically,
};
use std::fs;
use std::path::Path;

fn names(dir: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(dir)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_new_folder_appears_whole_with_its_marker() {
    let home = tempfile::tempdir().unwrap();
    let target = home.path().join("a/b/results");
    let mut folder = ResultFolder::stage(&target).unwrap();
    folder.write(INDEX, "<html>").unwrap();
    folder.write("figures/one.svg", "<svg/>").unwrap();
    assert!(!target.exists());
    assert_eq!(folder.commit().unwrap(), target);
    assert_eq!(names(&target), ["figures", INDEX, MARKER]);
    assert_eq!(names(target.parent().unwrap()), ["results"]);
    let marker: serde_json::Value =
        serde_json::from_slice(&fs::read(target.join(MARKER)).unwrap()).unwrap();
    assert_eq!(marker["files"][1]["name"], "figures/one.svg");
}

#[test]
fn dropping_leaves_no_trace() {
    let home = tempfile::tempdir().unwrap();
    let mut folder = ResultFolder::stage(&home.path().join("a/b")).unwrap();
    folder.write("x", "y").unwrap();
    drop(folder);
    assert_eq!(names(home.path()), Vec::<String>::new());
}

#[test]
fn a_foreign_folder_is_refused_and_left_alone() {
    let home = tempfile::tempdir().unwrap();
    fs::write(home.path().join("thesis.tex"), "years").unwrap();
    let error = ResultFolder::stage(home.path()).unwrap_err();
    assert!(
        matches!(error, ResultsError::ForeignFolder { .. }),
        "{error}"
    );
    assert!(error.to_string().contains(MARKER));
    assert_eq!(names(home.path()), ["thesis.tex"]);
}

#[test]
fn a_folder_that_fills_in_between_is_refused_at_the_end() {
    let home = tempfile::tempdir().unwrap();
    let target = home.path().join("out");
    let folder = ResultFolder::stage(&target).unwrap();
    fs::create_dir(&target).unwrap();
    fs::write(target.join("other"), "x").unwrap();
    assert!(matches!(
        folder.commit(),
        Err(ResultsError::ForeignFolder { .. })
    ));
    assert_eq!(names(&target), ["other"]);
}

#[test]
fn an_empty_folder_and_our_own_are_filled_and_others_files_stay() {
    let home = tempfile::tempdir().unwrap();
    for text in ["old", "new"] {
        let mut folder = ResultFolder::stage(home.path()).unwrap();
        folder.write("data/table.csv", text).unwrap();
        folder.commit().unwrap();
        fs::write(home.path().join("notes.txt"), "mine").unwrap();
    }
    assert_eq!(names(home.path()), ["data", "notes.txt", MARKER]);
    assert_eq!(
        fs::read_to_string(home.path().join("data/table.csv")).unwrap(),
        "new"
    );
}

#[test]
fn names_stay_inside() {
    let home = tempfile::tempdir().unwrap();
    let mut folder = ResultFolder::stage(&home.path().join("out")).unwrap();
    for name in ["", "/etc/x", "../x", "a/../../x", "a/", "."] {
        assert!(
            matches!(folder.write(name, ""), Err(ResultsError::BadName { .. })),
            "{name:?}"
        );
    }
}

#[test]
fn a_path_below_a_file_says_so() {
    let home = tempfile::tempdir().unwrap();
    let file = home.path().join("file");
    fs::write(&file, "x").unwrap();
    let below = file.join("out");
    for error in [
        ResultFolder::stage(&below).unwrap_err(),
        ResultFolder::stage(&below.join("deep")).unwrap_err(),
        write_file_atomically(&below, "x").unwrap_err(),
    ] {
        assert!(
            error.to_string().contains("a part of the path is a file"),
            "{error}"
        );
        assert!(error.to_string().contains("out"), "{error}");
    }
    let error = ResultFolder::stage(&file).unwrap_err();
    assert!(matches!(
        error,
        ResultsError::WrongKind {
            expected: "folder",
            ..
        }
    ));
    assert!(matches!(
        write_file_atomically(home.path(), ""),
        Err(ResultsError::WrongKind {
            expected: "file",
            ..
        })
    ));
    assert_eq!(fs::read_to_string(&file).unwrap(), "x");
}

#[cfg(target_os = "linux")]
#[test]
fn an_unwritable_place_says_so() {
    // Not even root may create files here.
    let target = Path::new("/proc/saltus-results");
    assert!(matches!(
        ResultFolder::stage(target),
        Err(ResultsError::Io { .. })
    ));
    let error = write_file_atomically(target, "x").unwrap_err();
    assert!(
        error.to_string().contains("/proc/saltus-results"),
        "{error}"
    );
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_noticed_and_a_device_stays_a_device() {
    let full = Path::new("/dev/full");
    let error = write_file_atomically(full, "x").unwrap_err();
    assert_eq!(
        error.to_string(),
        "cannot write `/dev/full`: no space left on the device"
    );
    assert!(!fs::metadata(full).unwrap().is_file());

    let device = fs::OpenOptions::new().write(true).open(full).unwrap();
    let dataset = Dataset::new("full")
        .coordinate(Variable::coordinate("x", vec![1.0]))
        .table(Table::new("rows", &["x"]).columns(&["x"]));
    let error = csv(&dataset, &dataset.tables()[0], device).unwrap_err();
    assert!(error.to_string().contains("no space left"), "{error}");
}

#[test]
fn a_failed_file_is_not_part_of_the_folder() {
    let home = tempfile::tempdir().unwrap();
    let target = home.path().join("out");
    let mut folder = ResultFolder::stage(&target).unwrap();
    let full = || std::io::Error::from(std::io::ErrorKind::StorageFull);
    let error = folder
        .write_with("long.csv", |file| file.write_all(b"half").and(Err(full())))
        .unwrap_err();
    assert!(
        error.to_string().contains("long.csv") && error.to_string().contains("no space left"),
        "{error}"
    );
    drop(folder);
    assert!(!target.exists());
}

#[cfg(unix)]
#[test]
fn a_file_is_replaced_behind_its_link_and_readable_by_the_usual_people() {
    use std::os::unix::fs::PermissionsExt;
    let home = tempfile::tempdir().unwrap();
    let (file, link) = (home.path().join("file"), home.path().join("link"));
    fs::write(&file, "old").unwrap();
    let usual = fs::metadata(&file).unwrap().permissions().mode();
    std::os::unix::fs::symlink(&file, &link).unwrap();
    write_file_atomically(&link, "new").unwrap();
    assert_eq!(fs::read_to_string(&file).unwrap(), "new");
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(fs::metadata(&file).unwrap().permissions().mode(), usual);
    assert_eq!(names(home.path()), ["file", "link"]);
}

#[test]
fn of_two_writers_into_one_folder_the_last_is_there_whole() {
    let home = tempfile::tempdir().unwrap();
    for round in 0..20 {
        let target = home.path().join(format!("results-{round}"));
        let write = |text: &str| {
            let mut folder = ResultFolder::stage(&target).unwrap();
            for file in 0..30 {
                folder.write(&format!("{file}.txt"), text).unwrap();
            }
            folder.commit().unwrap();
        };
        std::thread::scope(|scope| {
            for text in ["one", "another"] {
                scope.spawn(move || write(text));
            }
        });
        let manifest = Manifest::read(&target).unwrap();
        assert_eq!(manifest.verify(&target), []);
    }
}

#[test]
fn a_folder_holds_the_files_of_one_result() {
    let home = tempfile::tempdir().unwrap();
    let put = |files: &[(&str, &str)]| {
        let mut folder = ResultFolder::stage(home.path()).unwrap();
        for (name, text) in files {
            folder.write(name, text).unwrap();
        }
        folder.commit().unwrap();
    };
    let earlier = [
        ("study.toml", "a"),
        ("map.json", "a"),
        ("figures/map.svg", "a"),
        ("figures/drawn.svg", "a"),
        ("data/deep/map.csv", "a"),
    ];
    put(&earlier);
    fs::write(home.path().join("notes.txt"), "mine").unwrap();
    fs::write(
        home.path().join("figures/drawn.svg"),
        "a, and some hours of mine",
    )
    .unwrap();
    put(&[("study.toml", "b"), ("sweep.json", "b")]);
    let expected = ["figures", "notes.txt", MARKER, "study.toml", "sweep.json"];
    assert_eq!(names(home.path()), expected);
    assert_eq!(names(&home.path().join("figures")), ["drawn.svg"]);
}

#[cfg(unix)]
#[test]
fn nothing_outside_is_removed_whatever_a_manifest_names() {
    let home = tempfile::tempdir().unwrap();
    let (out, other) = (home.path().join("out"), home.path().join("other"));
    let mut folder = ResultFolder::stage(&out).unwrap();
    folder.write("figures/thesis.tex", "years").unwrap();
    folder.write("linked.txt", "years").unwrap();
    folder.commit().unwrap();
    fs::rename(out.join("figures"), &other).unwrap();
    fs::rename(out.join("linked.txt"), home.path().join("linked.txt")).unwrap();
    std::os::unix::fs::symlink(&other, out.join("figures")).unwrap();
    std::os::unix::fs::symlink(home.path().join("linked.txt"), out.join("linked.txt")).unwrap();
    ResultFolder::stage(&out).unwrap().commit().unwrap();
    assert_eq!(names(&other), ["thesis.tex"]);
    assert_eq!(names(home.path()), ["linked.txt", "other", "out"]);
}

/// Names of the staging places in a folder.
fn staged(dir: &Path) -> Vec<String> {
    let mut names = names(dir);
    names.retain(|name| name.starts_with(".saltus-staging-"));
    names
}

#[test]
fn what_a_killed_process_staged_is_removed_by_the_next_one_with_its_target() {
    let home = tempfile::tempdir().unwrap();
    let out = home.path().join("out");
    let left = |dir: &Path, target: &Path| {
        let staging = Staging::folder(dir, target).unwrap();
        let name = staging.path().to_path_buf();
        drop(staging);
        // a file that nobody holds locked
        fs::create_dir_all(name.join("content")).unwrap();
        fs::write(name.join("alive"), "").unwrap();
        fs::write(name.join("content/map.csv"), "half").unwrap();
    };
    left(home.path(), &out);
    left(home.path(), &home.path().join("another"));
    let alive = ResultFolder::stage(&out).unwrap();
    assert_eq!(staged(home.path()).len(), 2, "one is another's, one alive");
    alive.commit().unwrap();
    assert_eq!(staged(home.path()).len(), 1);
    // one within the folder, and one beside it from before it was there
    left(&out, &out);
    left(home.path(), &out);
    let alive = ResultFolder::stage(&out).unwrap();
    let another = ResultFolder::stage(&out).unwrap();
    assert_eq!(staged(&out).len(), 2, "both are alive");
    alive.commit().unwrap();
    another.commit().unwrap();
    assert_eq!(names(&out), [MARKER]);
    assert_eq!(staged(home.path()).len(), 1);

    // the same for a file
    let file = home.path().join("study.toml");
    let place = Staging::folder(home.path(), &file).unwrap();
    let name = place.path().to_path_buf();
    drop(place);
    fs::write(name, "half").unwrap();
    write_file_atomically(&file, "whole").unwrap();
    assert_eq!(fs::read_to_string(&file).unwrap(), "whole");
    assert_eq!(staged(home.path()).len(), 1);
}
