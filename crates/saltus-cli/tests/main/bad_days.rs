//! Bad days: signals, threads that are refused, places that fail, folders and files of strangers.

#![cfg(unix)]
use crate::common::underway::{Underway, count_pieces, small};
use crate::common::{Desk, files, program, saltus};
use predicates::prelude::*;
use predicates::str::contains;
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use std::process::{Command as Process, Stdio};

/// The shortest way to a result with tables and figures.
const SHORT: [&str; 4] = [
    "--set",
    "plate.inertia=condensed",
    "--set",
    "simulate.periods=3",
];

/// Few values of the condensed model.
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

fn short(desk: &Desk, command: &str, sets: &[&str], out: &str) -> assert_cmd::Command {
    let mut run = saltus(&[command, &desk.paper(), "--quiet", "--out", &desk.str(out)]);
    run.args(sets);
    run
}

fn simulated(desk: &Desk, out: &str) {
    short(desk, "simulate", &SHORT, out).assert().success();
}

fn manifest(folder: &Path) -> Value {
    serde_json::from_slice(&fs::read(folder.join("saltus-result.json")).unwrap()).unwrap()
}

fn forge(folder: &Path, change: impl FnOnce(&mut Value)) {
    let mut manifest = manifest(folder);
    change(&mut manifest);
    fs::write(folder.join("saltus-result.json"), manifest.to_string()).unwrap();
}

/// Nothing but lines of text.
fn plain() -> impl Predicate<str> {
    predicate::function(|text: &str| text.chars().all(|c| c == '\n' || !c.is_control()))
}

/// Puts a pipe that nobody writes to in place of a file.
fn pipe(path: &Path) {
    let _ = fs::remove_file(path);
    let made = Process::new("mkfifo").arg(path).status();
    assert!(made.unwrap().success());
}

#[cfg(target_os = "linux")]
#[test]
fn a_signal_that_is_ignored_at_the_start_stays_ignored() {
    let desk = Desk::new();
    let child = Process::new("sh")
        .args(["-c", "trap '' HUP; exec \"$@\"", "sh", program()])
        .args(["map", &desk.paper(), "--quiet", "--out", &desk.str("map")])
        .args(small("map", 16))
        .stdin(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let id = child.id();
    let pieces = desk.path(".map.saltus-pieces");
    let mut run = Underway { child, pieces };
    // with a piece there, the program has long decided what it catches
    run.until(1);
    let status = fs::read_to_string(format!("/proc/{id}/status")).unwrap();
    let holds = |name: &str, signal: u32| {
        let mask = status.lines().find_map(|line| line.strip_prefix(name));
        u64::from_str_radix(mask.unwrap().trim(), 16).unwrap() >> (signal - 1) & 1 == 1
    };
    let (hangup, terminate) = (1, 15);
    if run.child.try_wait().unwrap().is_none() {
        assert!(
            holds("SigIgn:", hangup) && !holds("SigCgt:", hangup),
            "{status}"
        );
        assert!(holds("SigCgt:", terminate), "{status}");
    }
    let sent = Process::new("kill")
        .args(["-HUP", &id.to_string()])
        .status();
    assert!(sent.unwrap().success());
    let output = run.child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert!(desk.path("map/map.json").is_file());
}

#[test]
fn without_more_threads_the_work_is_done_by_those_there_are_to_the_same_bits() {
    let desk = Desk::new();
    let sweep: Vec<&str> = SWEEP
        .iter()
        .copied()
        .chain(["--set", "sweep.exponents=1"])
        .collect();
    for (command, sets) in [("simulate", &SHORT[..]), ("sweep", &sweep)] {
        let alone = format!("{command}-alone");
        short(&desk, command, sets, command).assert().success();
        // no room for a stack: every thread beside the first is refused
        short(&desk, command, sets, &alone)
            .args(["--threads", "8"])
            .env("RUST_MIN_STACK", "99999999999999")
            .assert()
            .success();
        assert!(
            files(&desk.path(command)) == files(&desk.path(&alone)),
            "{command}"
        );
    }
    let map: Vec<String> = small("map", 4);
    let map: Vec<&str> = map.iter().map(String::as_str).collect();
    short(&desk, "map", &map, "map")
        .env("RUST_MIN_STACK", "99999999999999")
        .assert()
        .success();
}

#[test]
fn a_folder_is_of_one_question() {
    let desk = Desk::new();
    let out = desk.path("out");
    let more = [&SWEEP[..], &["--set", "sweep.exponents=2"]].concat();
    short(&desk, "sweep", &more, "out").assert().success();
    assert!(out.join("exponents.svg").is_file());
    fs::write(out.join("notes.txt"), "mine").unwrap();
    for (command, sets) in [("sweep", &SWEEP[..]), ("simulate", &SHORT[..])] {
        short(&desk, command, sets, "out").assert().success();
        short(&desk, command, sets, "fresh").assert().success();
        let mut found = files(&out);
        assert_eq!(found.remove("notes.txt"), Some(b"mine".to_vec()));
        assert!(found == files(&desk.path("fresh")), "{:?}", found.keys());
        fs::remove_dir_all(desk.path("fresh")).unwrap();
    }
    // a study alone takes the place of another one, and of no answer
    let check = |out: &str| saltus(&["check", &desk.paper(), "--quiet", "--out", &desk.str(out)]);
    let before = files(&out);
    check("out").assert().code(3).stderr(contains(
        "out` holds an answer, which a study alone does not replace",
    ));
    assert!(files(&out) == before);
    check("study").assert().success();
    check("study").assert().success();
}

#[test]
fn an_answer_without_a_place_is_kept_in_another_which_is_named() {
    let desk = Desk::new();
    let spare = desk.path("spare");
    fs::create_dir(&spare).unwrap();
    for json in [true, false] {
        let full = fs::OpenOptions::new()
            .write(true)
            .open("/dev/full")
            .unwrap();
        let mut run = Process::new(program());
        run.args(["simulate", &desk.paper()]).args(SHORT);
        if json {
            run.arg("--json");
        }
        let run = run
            .env("TMPDIR", &spare)
            .stdout(full)
            .stderr(Stdio::piped());
        let output = run.spawn().unwrap().wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(3));
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(said.contains("the whole answer is kept in `"), "{said}");
        let kept = said.split('`').nth(1).unwrap().to_owned();
        assert!(Path::new(&kept).starts_with(&spare), "{said}");
        saltus(&["rerun", &kept])
            .assert()
            .success()
            .stdout(contains("Same bits"));
    }
}

#[test]
fn names_of_strangers_are_shown_and_not_obeyed() {
    let desk = Desk::new();
    let study = fs::read_to_string(desk.paper()).unwrap();
    saltus(&["check", "-"])
        .write_stdin(format!("{study}\"\\u001b]0;pwned\\u0007\\n\" = 1\n"))
        .assert()
        .code(2)
        .stderr(plain().and(contains("\\u{1b}]0;pwned\\u{7}\\n")));
    simulated(&desk, "out");
    forge(&desk.path("out"), |manifest| {
        let files = manifest["files"].as_array_mut().unwrap();
        files.push(json!({ "name": "\u{1b}[31mred\n", "bytes": 1, "sha256": "" }));
    });
    saltus(&["rerun", &desk.str("out")])
        .assert()
        .code(3)
        .stderr(plain().and(contains("`\\u{1b}[31mred\\n` is missing")));
    let red = "\u{1b}[31m\u{9b}";
    for args in [
        ["cite", red].as_slice(),
        &["rerun", red],
        &[red],
        &["check", &desk.paper(), red],
        &["check", red],
        &["check", &desk.paper(), "--set", red],
        &["simulate", &desk.paper(), "--periods", red],
        &[
            "continue",
            &desk.paper(),
            "--from",
            &desk.str("out"),
            "--at",
            red,
        ],
        &[
            "check",
            &desk.paper(),
            "--out",
            &format!("{}/{red}", desk.paper()),
        ],
    ] {
        let refused = saltus(args).assert().failure().stdout("");
        refused.stderr(plain());
    }
    fs::copy(desk.paper(), desk.path(red)).unwrap();
    saltus(&["check", &desk.str(red)])
        .assert()
        .success()
        .stdout(plain());
}

#[test]
fn what_is_no_ordinary_file_in_a_result_is_refused_at_once() {
    let desk = Desk::new();
    for (name, fill) in [
        ("study.toml", None),
        ("saltus-result.json", None),
        ("study.toml", Some("/dev/zero")),
        ("saltus-result.json", Some("/dev/zero")),
        ("section.csv", None),
    ] {
        simulated(&desk, "out");
        let path = desk.path("out").join(name);
        match fill {
            None => pipe(&path),
            Some(device) => {
                fs::remove_file(&path).unwrap();
                std::os::unix::fs::symlink(device, &path).unwrap();
            }
        }
        let told = contains("a pipe or a device").or(contains("no `saltus-result.json`"));
        saltus(&["rerun", &desk.str("out")])
            .assert()
            .code(3)
            .stderr(told);
        fs::remove_dir_all(desk.path("out")).unwrap();
    }
    simulated(&desk, "out");
    std::os::unix::fs::symlink("/dev/zero", desk.path("out/continue.json")).unwrap();
    saltus(&[
        "continue",
        &desk.paper(),
        "--from",
        &desk.str("out"),
        "--at",
        "PD1",
    ])
    .assert()
    .code(3)
    .stderr(contains("continue.json`: it is a pipe or a device"));
}

#[test]
fn a_manifest_of_many_faults_is_told_in_twenty_lines() {
    let desk = Desk::new();
    simulated(&desk, "out");
    forge(&desk.path("out"), |manifest| {
        let files = manifest["files"].as_array_mut().unwrap();
        let gone = |number| json!({ "name": format!("gone-{number}"), "bytes": 1, "sha256": "" });
        files.extend((0..10_000).map(gone));
    });
    let refused = saltus(&["rerun", &desk.str("out")]).assert().code(3);
    let said = String::from_utf8(refused.get_output().stderr.clone()).unwrap();
    assert!(said.contains("and 9980 more"), "{said}");
    assert!(said.lines().count() < 30, "{said}");
}

#[test]
fn what_is_no_version_is_not_cited() {
    let desk = Desk::new();
    simulated(&desk, "out");
    for version in ["1}} @evil{x, title={", "", "0.1.0 ", "v1", "1\n2"] {
        forge(&desk.path("out"), |manifest| {
            manifest["version"] = json!(version);
        });
        saltus(&["cite", &desk.str("out")])
            .assert()
            .code(3)
            .stdout("")
            .stderr(contains("which is none"));
    }
    for version in ["0.1.0", "10.2.3-beta.1+7f"] {
        forge(&desk.path("out"), |manifest| {
            manifest["version"] = json!(version);
        });
        saltus(&["cite", &desk.str("out")])
            .assert()
            .success()
            .stdout(contains(version));
    }
}

#[test]
fn a_piece_too_many_is_told_to_be_removed_and_no_shard_to_make_it() {
    let desk = Desk::new();
    let sets = small("map", 4);
    let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
    let share = |more: &[&str]| short(&desk, "map", &[&sets, more].concat(), "out").assert();
    share(&["--shard", "1/1"]).success();
    let pieces = desk.path(".out.saltus-pieces");
    let count = count_pieces(&pieces);
    fs::copy(
        pieces.join("piece-000000.bin"),
        pieces.join("piece-999999.bin"),
    )
    .unwrap();
    share(&["--merge"]).code(3).stderr(
        contains("piece-999999.bin")
            .and(contains(format!(
                "too many, the work has {count}: remove it"
            )))
            .and(contains("makes it").not()),
    );
    fs::remove_file(pieces.join("piece-999999.bin")).unwrap();
    share(&["--merge"]).success();
}

#[test]
fn a_crowd_without_end_is_refused_before_anything_is_computed() {
    let desk = Desk::new();
    let paper = fs::read_to_string(desk.paper()).unwrap();
    let jumper = "[[jumper]]\nx=7.0\ny=5.0\nmass=76.0\nstiffness=2e4\ndamping_ratio=0.3\n";
    let crowd = desk.str("crowd.toml");
    fs::write(&crowd, paper + &jumper.repeat(40_000)).unwrap();
    for command in ["check", "frequencies", "simulate"] {
        let mut run = Process::new(program());
        run.args([command, &crowd]);
        let output = run.output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{command}");
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(
            said.contains("jumper: 40001 were given, at most 400"),
            "{said}"
        );
    }
}
