//! The program as its users meet it: exit codes, streams, files.

use crate::common::{Desk, json, program, saltus};
use predicates::prelude::*;
use predicates::str::contains;
use std::fs;
use std::path::Path;
use std::process::{Command as Process, Stdio};

#[test]
fn help_names_commands_and_exit_codes() {
    let help = saltus(&["--help"])
        .assert()
        .success()
        .stderr("")
        .get_output()
        .stdout
        .clone();
    let help = String::from_utf8(help).unwrap();
    for word in [
        "reproduce",
        "init",
        "check",
        "schema",
        "frequencies",
        "simulate",
        "sweep",
        "map",
        "basins",
        "Exit codes",
    ] {
        assert!(help.contains(word), "{word}");
    }
    for code in ["0", "1", "2", "3", "130", "141"] {
        assert!(help.contains(&format!("\n  {code:<5}")), "{code}");
    }
    saltus(&["--version"])
        .assert()
        .success()
        .stdout(contains("saltus 0."));
    for command in [
        "reproduce",
        "init",
        "check",
        "schema",
        "frequencies",
        "simulate",
        "sweep",
        "map",
        "basins",
    ] {
        saltus(&[command, "--help"])
            .assert()
            .success()
            .stdout(contains("--out"));
    }
}

#[test]
fn wrong_usage_ends_with_2() {
    for args in [
        &[][..],
        &["jump"],
        &["check"],
        &["check", "a", "b"],
        &["init", "other"],
        &["simulate", "x.toml", "--periods", "0"],
        &["sweep", "x.toml", "--threads", "0"],
        &["map", "x.toml", "--resume"],
        &["check", "x.toml", "--set"],
    ] {
        saltus(args)
            .assert()
            .code(2)
            .stdout("")
            .stderr(contains("Usage").or(contains("--help")));
    }
}

#[test]
fn what_init_writes_check_accepts() {
    let desk = Desk::new();
    saltus(&["check", &desk.paper()])
        .assert()
        .success()
        .stdout(contains("valid").and(contains("2.5373 Hz")));
    let text = saltus(&["init", "paper"])
        .assert()
        .success()
        .get_output()
        .stdout
        .clone();
    assert_eq!(text, fs::read(desk.path("paper.toml")).unwrap());
    saltus(&["check", "-"]).write_stdin(text).assert().success();
    saltus(&["check", &desk.paper(), "--quiet"])
        .assert()
        .success()
        .stdout("");
}

#[test]
fn check_json_is_one_document_with_the_resolved_study() {
    let desk = Desk::new();
    let set = [
        "--set",
        "jumper.damping_ratio=0.28",
        "--set",
        "base.frequency=2.5",
    ];
    let report = json(saltus(&["check", &desk.paper(), "--json"]).args(set));
    assert_eq!(report["valid"], true);
    assert_eq!(report["study"]["jumper"][0]["damping_ratio"], 0.28);
    assert_eq!(report["study"]["base"]["frequency"], 2.5);
    assert!(report["study"]["base"].get("frequency_ratio").is_none());
    assert_eq!(report["warnings"].as_array().unwrap().len(), 0);
}

#[test]
fn check_says_what_each_question_costs_if_asked() {
    let desk = Desk::new();
    let short = ["--set", "plate.inertia=condensed", "--set", "map.x.count=2"];
    let check = |more: &[&str]| {
        let mut check = saltus(&["check", &desk.paper()]);
        check.args(short).args(more);
        check
    };
    let report = json(&mut check(&["--cost", "--json"]));
    let of = |one: &serde_json::Value| one["command"].as_str().unwrap().to_owned();
    let costs = report["cost"].as_array().unwrap();
    let asked = [
        "simulate",
        "sweep",
        "map",
        "basins",
        "continue",
        "lyapunov",
        "attractors",
    ];
    assert_eq!(costs.iter().map(of).collect::<Vec<_>>(), asked);
    for cost in costs {
        assert!(cost["seconds"].as_f64().unwrap() > 0.0, "{cost}");
        assert!(cost["probed"].as_u64().unwrap() > 0, "{cost}");
    }
    // it changes from run to run, so it is not in what everybody sees
    assert!(json(&mut check(&["--json"])).get("cost").is_none());
    check(&["--cost"])
        .assert()
        .success()
        .stdout(contains("cost       map: about "));
    check(&[]).assert().success().stdout(contains("cost").not());
}

#[test]
fn check_warns_of_what_moves_nothing_or_cannot_move() {
    let desk = Desk::new();
    let set = "plate.modes={ u = [], v = [], w = [[2, 1]] }";
    saltus(&["check", &desk.paper(), "--set", set])
        .assert()
        .success()
        .stdout(contains("nodal line"));
    saltus(&["check", &desk.paper(), "--set", "plate.modes=4x4"])
        .assert()
        .success()
        .stdout(contains("\"slow-manifold\" with 16 w terms: at most 9"));
}

#[test]
fn check_warns_of_a_branch_that_cannot_begin() {
    let desk = Desk::new();
    saltus(&["check", &desk.paper(), "--set", "jumper.damping_ratio=0.05"])
        .assert()
        .success()
        .stdout(contains("[continue] cannot run").and(contains("outside 0.1 to 0.5")));
}

#[test]
fn check_out_leaves_the_resolved_study() {
    let desk = Desk::new();
    let out = desk.str("deep/results");
    saltus(&[
        "check",
        &desk.paper(),
        "--set",
        "jumper.mass=80",
        "--out",
        &out,
    ])
    .assert()
    .success();
    let resolved = Path::new(&out).join("study.toml");
    assert!(
        fs::read_to_string(&resolved)
            .unwrap()
            .contains("mass = 80.0")
    );
    saltus(&["check", &resolved.display().to_string()])
        .assert()
        .success();
}

#[test]
fn a_mistake_is_shown_with_file_line_and_key() {
    let desk = Desk::new();
    let text = fs::read_to_string(desk.path("paper.toml")).unwrap();
    fs::write(
        desk.path("bad.toml"),
        text.replace("\nthickness = 0.10", "\nthickness = -0.1"),
    )
    .unwrap();
    let line = text
        .lines()
        .position(|l| l.starts_with("thickness"))
        .unwrap()
        + 1;
    for command in ["check", "frequencies", "simulate", "sweep"] {
        saltus(&[command, &desk.str("bad.toml"), "--json"])
            .assert()
            .code(2)
            .stdout("")
            .stderr(
                contains(format!("bad.toml:{line}:"))
                    .and(contains("plate.thickness = -0.1"))
                    .and(contains("(m)")),
            )
            .stderr(contains('\u{1b}').not());
    }
}

#[test]
fn a_wrong_override_is_named() {
    let desk = Desk::new();
    for (set, said) in [
        ("plate.lenght=3", "did you mean plate.length?"),
        ("jumper.mass", "no `=`"),
        ("jumper.3.mass=80", "there is no jumper.3"),
        ("jumper.mass=nan", "jumper.0.mass = nan"),
        ("contact.law=magnet", "reaction-force"),
    ] {
        saltus(&["check", &desk.paper(), "--set", set])
            .assert()
            .code(2)
            .stdout("")
            .stderr(contains(format!("--set {set}")).and(contains(said)));
    }
}

#[test]
fn unreadable_files_end_with_3() {
    let desk = Desk::new();
    let missing = desk.str("none.toml");
    saltus(&["check", &missing])
        .assert()
        .code(3)
        .stderr(contains(&missing).and(contains("no such file")));
    let folder = desk.folder.path().display().to_string();
    saltus(&["simulate", &folder])
        .assert()
        .code(3)
        .stderr(contains(&folder).and(contains("directory")));
    saltus(&["check", "-"])
        .write_stdin([0xff])
        .assert()
        .code(3)
        .stderr(contains("UTF-8"));
    saltus(&["check", "-"])
        .write_stdin("")
        .assert()
        .code(2)
        .stderr(contains("[plate] is missing"));
}

#[test]
fn unwritable_paths_end_with_3_and_leave_nothing() {
    let desk = Desk::new();
    let (paper, inside) = (desk.paper(), desk.str("paper.toml/out"));
    let missing = desk.str("no/such/folder.toml");
    let folder = desk.folder.path().display().to_string();
    for args in [
        &["init", "paper", "--out", &missing][..],
        &["init", "paper", "--out", &folder],
        &["schema", "--out", &missing],
        &["check", &paper, "--out", &inside],
        &["frequencies", &paper, "--out", &inside],
        &["simulate", &paper, "--out", &inside],
        &["sweep", &paper, "--out", &inside],
    ] {
        let path = args[args.len() - 1];
        saltus(args)
            .assert()
            .code(3)
            .stdout("")
            .stderr(contains("cannot").and(contains(path)));
    }
    assert_eq!(desk.names(), ["paper.toml"]);
}

#[test]
fn init_replaces_a_file_whole() {
    let desk = Desk::new();
    fs::write(desk.path("paper.toml"), "x".repeat(100_000)).unwrap();
    saltus(&["init", "paper", "--out", &desk.paper()])
        .assert()
        .success();
    saltus(&["check", &desk.paper()]).assert().success();
    assert_eq!(desk.names(), ["paper.toml"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_ends_with_3() {
    let desk = Desk::new();
    let paper = desk.paper();
    for args in [
        &["--help"][..],
        &["schema"],
        &["init", "paper"],
        &["check", &paper],
        &["check", &paper, "--json"],
        &["frequencies", &paper],
        &["simulate", &paper, "--periods", "1"],
        &["simulate", &paper, "--periods", "1", "--json"],
    ] {
        let full = fs::OpenOptions::new()
            .write(true)
            .open("/dev/full")
            .unwrap();
        let output = Process::new(program())
            .args(args)
            // where an answer is kept that has no other place
            .env("TMPDIR", desk.folder.path())
            .stdout(full)
            .stderr(Stdio::piped())
            .output()
            .unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(3), "{args:?}: {said}");
        assert!(
            said.contains("standard output") && !said.contains("panicked"),
            "{said}"
        );
    }
    saltus(&["schema", "--out", "/dev/full"])
        .assert()
        .code(3)
        .stderr(contains("/dev/full"));
}

#[cfg(unix)]
#[test]
fn a_closed_pipe_ends_quietly() {
    let desk = Desk::new();
    let paper = desk.paper();
    for args in [
        &["schema"][..],
        &["init", "paper"],
        &["check", &paper, "--json"],
        &["simulate", &paper, "--periods", "1", "--json"],
        &["--help"],
    ] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let output = Process::new(program())
            .args(args)
            .stdout(writer)
            .stderr(Stdio::piped())
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(141), "{args:?}");
        assert!(output.stderr.is_empty(), "{args:?}");
    }
}

#[cfg(unix)]
#[test]
fn a_closed_standard_error_changes_no_exit_code() {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    for (args, code) in [(&["check", "none.toml"][..], 3), (&["jump"], 2)] {
        let status = Process::new(program())
            .args(args)
            .stderr(writer.try_clone().unwrap())
            .status()
            .unwrap();
        assert_eq!(status.code(), Some(code), "{args:?}");
    }
}

#[test]
fn schema_is_a_json_schema() {
    let schema = json(&mut saltus(&["schema"]));
    assert_eq!(
        schema["$schema"],
        "https://json-schema.org/draft/2020-12/schema"
    );
    let mass = &schema["properties"]["jumper"]["items"]["properties"]["mass"];
    assert!(
        mass["description"].as_str().unwrap().contains("(kg)"),
        "{mass}"
    );
}

#[test]
fn frequencies_are_the_papers() {
    let desk = Desk::new();
    let found = json(&mut saltus(&["frequencies", &desk.paper(), "--json"]));
    let near = |value: &serde_json::Value, expected: f64| {
        // the paper prints three decimals
        assert!(
            (value.as_f64().unwrap() - expected).abs() < 5e-4,
            "{value} is not {expected}"
        );
    };
    near(&found["plate"][0], 2.297);
    near(&found["occupied"][0], 2.243);
    near(&found["occupied"][1], 2.537);
    near(&found["body"], 2.537);
    near(&found["base"], 2.537);
    near(&found["free"][0], 2.4794);
    for list in ["plate", "occupied", "in_plane"] {
        let hz: Vec<f64> = serde_json::from_value(found[list].clone()).unwrap();
        assert!(hz.is_sorted() && !hz.is_empty(), "{list}");
    }
    saltus(&["frequencies", &desk.paper()])
        .assert()
        .success()
        .stdout(contains("2.2969"));
}

#[test]
fn frequencies_of_the_empty_plate_need_no_body() {
    let desk = Desk::new();
    let empty = ["--set", "jumper=[]", "--set", "base.reference=plate"];
    let found = json(saltus(&["frequencies", &desk.paper(), "--json"]).args(empty));
    let first = |list: &str| found[list][0].as_f64().unwrap();
    // one by formula, one by eigenvalues: they differ in the last bits
    assert!((first("plate") - first("occupied")).abs() < 1e-12);
    assert!(found["body"].is_null());
    saltus(&["check", &desk.paper()])
        .args(empty)
        .assert()
        .success()
        .stdout(contains("[sweep] cannot run"));
}

#[test]
fn frequencies_out_leaves_data_and_study() {
    let desk = Desk::new();
    let out = desk.str("results");
    let printed = json(&mut saltus(&[
        "frequencies",
        &desk.paper(),
        "--json",
        "--out",
        &out,
    ]));
    let written = fs::read(desk.path("results/frequencies.json")).unwrap();
    assert_eq!(
        serde_json::from_slice::<serde_json::Value>(&written).unwrap(),
        printed
    );
    assert!(desk.path("results/study.toml").exists());
}
