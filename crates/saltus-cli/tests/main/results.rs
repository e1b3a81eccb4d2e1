//! Commands on a saved result: its works cited, the same asked again.

use crate::common::underway::small;
use crate::common::{Desk, files, json, program, saltus};
use predicates::prelude::*;
use predicates::str::contains;
use saltus_results::manifest::sha256;
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use std::process::{Command as Process, Stdio};

/// Few periods of the condensed model: the shortest way to a result with tables.
const SHORT: [&str; 4] = [
    "--set",
    "plate.inertia=condensed",
    "--set",
    "simulate.periods=3",
];

/// A sweep of few values.
const SWEEP: [&str; 8] = [
    "--set",
    "plate.inertia=condensed",
    "--set",
    "sweep.count=3",
    "--set",
    "sweep.transient=20",
    "--set",
    "sweep.record=4",
];

/// Writes a result into the folder `out`.
fn write(desk: &Desk, command: &str, out: &str, more: &[&str]) {
    let (sets, plane): (&[&str], _) = match command {
        "map" | "basins" => (&[], small(command, 4)),
        "sweep" => (&SWEEP, vec![]),
        "simulate" => (&SHORT, vec![]),
        _ => (&[], vec![]),
    };
    saltus(&[command, &desk.paper(), "--quiet", "--out", &desk.str(out)])
        .args(sets)
        .args(plane)
        .args(more)
        .assert()
        .success();
}

fn manifest(folder: &Path) -> Value {
    serde_json::from_slice(&fs::read(folder.join("saltus-result.json")).unwrap()).unwrap()
}

/// Changes the manifest, which has no checksum of its own.
fn forge(folder: &Path, change: impl FnOnce(&mut Value)) {
    let mut manifest = manifest(folder);
    change(&mut manifest);
    fs::write(folder.join("saltus-result.json"), manifest.to_string()).unwrap();
}

/// Puts a text in place of another in a file.
fn alter(file: &Path, from: &str, to: &str) {
    let text = fs::read_to_string(file).unwrap();
    assert!(text.contains(from), "{text}");
    fs::write(file, text.replacen(from, to, 1)).unwrap();
}

/// As [`alter`], so that the manifest does not tell.
fn tamper(folder: &Path, name: &str, from: &str, to: &str) {
    alter(&folder.join(name), from, to);
    let bytes = fs::read(folder.join(name)).unwrap();
    forge(folder, |manifest| {
        let records = manifest["files"].as_array_mut().unwrap();
        let record = records.iter_mut().find(|file| file["name"] == name);
        let record = record.unwrap();
        record["sha256"] = json!(sha256(&bytes));
        record["bytes"] = json!(bytes.len());
    });
}

/// The keys that `saltus cite` gives.
fn keys(path: &str) -> Vec<String> {
    let document = json(&mut saltus(&["cite", path, "--json"]));
    let works = document["citations"].as_array().unwrap().clone();
    let key = |work: Value| work["key"].as_str().unwrap().to_owned();
    works.into_iter().map(key).collect()
}

#[test]
fn a_result_is_cited_with_what_each_work_was_used_for() {
    let desk = Desk::new();
    write(&desk, "simulate", "motion", &[]);
    let printed = saltus(&["cite", &desk.str("motion")]).assert().success();
    let text = String::from_utf8(printed.get_output().stdout.clone()).unwrap();
    assert!(text.starts_with("% the program\n@misc{saltus,\n"), "{text}");
    assert!(text.contains("\n\n% integration by Taylor series\n@article{JZ2005,\n"));
    let entries = text.split("\n\n");
    assert!(entries.clone().all(|entry| entry.starts_with("% ")));
    assert_eq!(entries.count(), keys(&desk.str("motion")).len());
    assert_eq!(
        json!(keys(&desk.str("motion"))),
        manifest(&desk.path("motion"))["about"]["citations"]
    );
}

#[test]
fn works_follow_from_what_was_asked_and_a_file_stands_for_its_folder() {
    let desk = Desk::new();
    write(&desk, "frequencies", "frequencies", &[]);
    assert_eq!(keys(&desk.str("frequencies")), ["saltus", "DP"]);
    write(&desk, "map", "map", &[]);
    // exponents tell what is chaotic there
    assert!(keys(&desk.str("map/map.nc")).contains(&"Benettin1980".to_owned()));
    saltus(&["cite", "map.nc"])
        .current_dir(desk.path("map"))
        .assert()
        .success();
}

#[test]
fn the_program_cited_is_the_one_that_computed() {
    let desk = Desk::new();
    write(&desk, "frequencies", "out", &[]);
    forge(&desk.path("out"), |manifest| {
        manifest["version"] = json!("0.0.7");
    });
    saltus(&["cite", &desk.str("out")])
        .assert()
        .success()
        .stdout(contains("version 0.0.7"));
}

#[test]
fn what_is_no_result_is_refused_and_why() {
    let desk = Desk::new();
    fs::create_dir(desk.path("empty")).unwrap();
    saltus(&["check", &desk.paper(), "--out", &desk.str("study")])
        .assert()
        .success();
    write(&desk, "frequencies", "newer", &[]);
    forge(&desk.path("newer"), |manifest| {
        manifest["format_version"] = json!(2);
        manifest["version"] = json!("9.1.0");
    });
    write(&desk, "frequencies", "unknown", &[]);
    forge(&desk.path("unknown"), |manifest| {
        manifest["about"]["request"]["command"] = json!("dance");
    });
    for (name, code, why) in [
        ("nowhere", 3, "there is no such folder"),
        ("paper.toml", 3, "it is a file, not a folder"),
        ("empty", 3, "it holds no `saltus-result.json`"),
        ("study", 2, "it holds a study alone"),
        ("newer", 3, "written by saltus 9.1.0 in format 2"),
        ("unknown", 3, "`dance`"),
    ] {
        for command in ["cite", "rerun"] {
            saltus(&[command, &desk.str(name)])
                .assert()
                .code(code)
                .stdout("")
                .stderr(contains(why));
        }
    }
}

#[test]
fn another_number_in_the_study_is_seen_and_another_comment_is_not_minded() {
    let desk = Desk::new();
    write(&desk, "simulate", "out", &[]);
    let study = desk.path("out/study.toml");
    alter(&study, "periods = 3", "periods = 3 # few");
    assert!(!keys(&desk.str("out")).is_empty());
    alter(&study, "periods = 3", "periods = 4");
    saltus(&["cite", &desk.str("out")])
        .assert()
        .code(3)
        .stderr(contains("study.toml` was altered"));
}

#[test]
fn asked_again_the_answers_are_the_same_bits() {
    let desk = Desk::new();
    for command in ["frequencies", "simulate", "sweep", "map", "basins"] {
        write(&desk, command, command, &["--threads", "2"]);
        let before = files(&desk.path(command));
        let result = desk.str(command);
        let told = json(&mut saltus(&["rerun", &result, "--threads", "1", "--json"]));
        assert_eq!(told["identical"], true, "{told:#}");
        assert_eq!(told["request"]["command"], command);
        assert_eq!(told["files"].as_array().unwrap().len(), before.len());
        assert_eq!(told["reasons"], json!([]));
        assert!(files(&desk.path(command)) == before);
    }
    let names = [
        "basins",
        "frequencies",
        "map",
        "paper.toml",
        "simulate",
        "sweep",
    ];
    assert_eq!(desk.names(), names);
}

#[test]
fn the_new_result_is_kept_where_it_was_asked_for_and_never_in_place_of_the_old() {
    let desk = Desk::new();
    write(&desk, "simulate", "out", &[]);
    saltus(&["rerun", &desk.str("out"), "--out", &desk.str("again")])
        .assert()
        .success()
        .stdout(contains("Same bits: all ").and(contains("again`")));
    assert!(files(&desk.path("out")) == files(&desk.path("again")));
    saltus(&["rerun", ".", "--out", "../out"])
        .current_dir(desk.path("out"))
        .assert()
        .code(2)
        .stderr(contains("is the result itself"));
}

#[test]
fn a_file_that_is_not_as_it_was_written_is_named() {
    let desk = Desk::new();
    write(&desk, "simulate", "out", &[]);
    alter(&desk.path("out/section.csv"), "1", "2");
    fs::remove_file(desk.path("out/history.csv")).unwrap();
    let altered = contains("`section.csv` was altered");
    saltus(&["rerun", &desk.str("out")])
        .assert()
        .code(3)
        .stdout("")
        .stderr(altered.and(contains("`history.csv` is missing")));
}

#[test]
fn a_difference_is_told_with_its_size_and_its_place() {
    let desk = Desk::new();
    write(&desk, "simulate", "out", &[]);
    let folder = desk.path("out");
    let table = fs::read_to_string(folder.join("section.csv")).unwrap();
    let mut lines = table.lines().filter(|line| !line.starts_with('#'));
    let column = |name| {
        let mut header = table
            .lines()
            .find(|l| !l.starts_with('#'))
            .unwrap()
            .split(',');
        header.position(|cell| cell == name).unwrap()
    };
    let row = lines.nth(2).unwrap();
    let z = row.split(',').nth(column("z")).unwrap();
    let wrong = format!("{}", z.parse::<f64>().unwrap() + 0.25);
    tamper(&folder, "section.csv", z, &wrong);
    saltus(&["rerun", &desk.str("out")])
        .assert()
        .code(1)
        .stdout(
            contains("section.csv: 1 of ")
                .and(contains("at most by 2.5e-1 (column `z`, row 2"))
                .and(contains("same version, same arithmetic")),
        )
        .stderr(contains("is not the same bits"));
}

#[test]
fn known_reasons_for_differences_are_told() {
    let desk = Desk::new();
    write(&desk, "frequencies", "out", &[]);
    forge(&desk.path("out"), |manifest| {
        manifest["version"] = json!("0.0.7");
        manifest["about"]["arithmetic"]["architecture"] = json!("abacus");
    });
    let told = saltus(&["rerun", &desk.str("out"), "--json"])
        .assert()
        .code(1);
    let told: Value = serde_json::from_slice(&told.get_output().stdout).unwrap();
    assert_eq!(told["identical"], false);
    let reasons = told["reasons"].as_array().unwrap();
    assert_eq!(reasons.len(), 2);
    assert!(reasons[0].as_str().unwrap().contains("saltus 0.0.7"));
    assert!(reasons[1].as_str().unwrap().contains("on abacus with"));
    let outcomes = told["files"].as_array().unwrap();
    let different = outcomes
        .iter()
        .filter(|file| file["outcome"] != "identical");
    let names: Vec<&Value> = different.map(|file| &file["name"]).collect();
    assert_eq!(names, ["saltus-result.json"]);
}

#[test]
fn an_earlier_result_that_is_gone_is_named() {
    let desk = Desk::new();
    write(&desk, "frequencies", "out", &[]);
    forge(&desk.path("out"), |manifest| {
        let origin = json!({ "from": "old/branches", "at": "PD1" });
        manifest["about"]["request"] = json!({ "command": "continue", "origin": origin });
    });
    saltus(&["rerun", &desk.str("out")])
        .assert()
        .code(3)
        .stderr(contains("PD1").and(contains("`old/branches` is not there")));
}

#[cfg(unix)]
#[test]
fn interrupted_it_leaves_nothing() {
    let desk = Desk::new();
    write(&desk, "simulate", "out", &[]);
    tamper(
        &desk.path("out"),
        "study.toml",
        "periods = 3",
        "periods = 10000000",
    );
    let before = files(&desk.path("out"));
    let mut run = Process::new(program())
        .args(["rerun", &desk.str("out")])
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let begun = |name: &String| name.starts_with(".saltus-staging-");
    while !desk.names().iter().any(begun) {
        assert!(run.try_wait().unwrap().is_none());
    }
    let id = run.id().to_string();
    let asked = Process::new("kill").args(["-TERM", &id]).status();
    assert!(asked.unwrap().success());
    let output = run.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    assert!(output.stdout.is_empty());
    assert_eq!(desk.names(), ["out", "paper.toml"]);
    assert!(files(&desk.path("out")) == before);
}
