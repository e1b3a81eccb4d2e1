//! Work that many processes share: `--shard`, `--merge`, and what may go wrong with them.

use crate::common::underway::{Underway, count_pieces, small};
use crate::common::{Desk, files, json, program, saltus};
use predicates::prelude::*;
use predicates::str::contains;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Child, Command as Process, Stdio};

/// Restarts with labels and exponents: 3 passes of 19 values, in 8 pieces, the last with one value.
const RESTARTS: [&str; 8] = [
    "plate.inertia=condensed",
    "sweep.direction=restarts",
    "sweep.starts=[[3.0, 2.0], [-1.0, 0.0], [1.0, 1.0]]",
    "sweep.count=19",
    "sweep.transient=30",
    "sweep.record=5",
    "sweep.exponents=2",
    "sweep.exponent_periods=100",
];

/// A study that has 36 pieces, or 8 if it is a sweep.
fn sets(command: &str) -> Vec<String> {
    let of_sweep = RESTARTS
        .iter()
        .flat_map(|set| ["--set".to_owned(), (*set).to_owned()]);
    match command {
        "sweep" => of_sweep.collect(),
        _ => small(command, 24),
    }
}

fn start(desk: &Desk, command: &str, out: &str, more: &[&str]) -> assert_cmd::Command {
    let mut run = saltus(&[
        command,
        &desk.paper(),
        "--out",
        &desk.str(out),
        "--threads",
        "2",
    ]);
    run.args(sets(command)).args(more);
    run
}

/// Makes a shard and gives what it says.
fn shard(desk: &Desk, command: &str, out: &str, shard: &str) -> Value {
    json(&mut start(
        desk,
        command,
        out,
        &["--shard", shard, "--json"],
    ))
}

/// The folder that one run makes.
fn plain(desk: &Desk, command: &str) -> BTreeMap<String, Vec<u8>> {
    start(desk, command, "plain", &["--quiet"])
        .assert()
        .success();
    files(&desk.path("plain"))
}

fn numbers(list: &Value) -> Vec<u64> {
    list.as_array()
        .unwrap()
        .iter()
        .map(|n| n.as_u64().unwrap())
        .collect()
}

#[test]
fn shards_in_any_order_merge_to_the_bits_of_one_run() {
    for (command, pieces) in [("map", 36), ("basins", 36), ("sweep", 8)] {
        let desk = Desk::new();
        for which in ["3/3", "1/3", "2/3"] {
            let said = shard(&desk, command, "out", which);
            let first: u64 = which[..1].parse::<u64>().unwrap() - 1;
            let own: Vec<u64> = (first..pieces).step_by(3).collect();
            assert_eq!(said["pieces"], pieces);
            assert_eq!(numbers(&said["made"]), own, "strided: {said}");
            assert!(numbers(&said["found"]).is_empty());
            assert!(!desk.path("out").exists(), "no results yet");
        }
        start(&desk, command, "out", &["--merge", "--quiet"])
            .assert()
            .success()
            .stderr("");
        assert!(
            files(&desk.path("out")) == plain(&desk, command),
            "{command}"
        );
        assert_eq!(
            desk.names(),
            ["out", "paper.toml", "plain"],
            "no pieces are left"
        );
    }
}

#[test]
fn a_sweep_that_is_killed_goes_on_to_the_same_bits() {
    let desk = Desk::new();
    shard(&desk, "sweep", "out", "2/4");
    start(&desk, "sweep", "out", &[])
        .assert()
        .code(3)
        .stderr(contains("--resume"));
    start(&desk, "sweep", "out", &["--resume"])
        .assert()
        .success()
        .stderr(contains("piece 0 is missing").and(contains("piece 1 is").not()));
    assert!(files(&desk.path("out")) == plain(&desk, "sweep"));
}

#[test]
fn a_shard_that_was_killed_does_only_what_is_missing() {
    let desk = Desk::new();
    let mut run = Underway::start(
        &desk,
        "map",
        24,
        "out",
        &["--shard", "1/1", "--threads", "1"],
    );
    run.until(5);
    run.kill();
    let left = count_pieces(&desk.path(".out.saltus-pieces"));
    let said = shard(&desk, "map", "out", "1/1");
    assert_eq!(numbers(&said["found"]).len(), left);
    assert_eq!(numbers(&said["made"]).len(), 36 - left);
    let again = shard(&desk, "map", "out", "1/1");
    assert!(numbers(&again["made"]).is_empty());
    start(&desk, "map", "out", &["--merge"]).assert().success();
    assert!(files(&desk.path("out")) == plain(&desk, "map"));
}

/// Runs of these shards, all at once.
fn at_once(desk: &Desk, more: &[&[&str]]) -> Vec<Child> {
    let spawn = |more: &&[&str]| {
        Process::new(program())
            .args(["map", &desk.paper(), "--quiet", "--out", &desk.str("out")])
            .args(sets("map"))
            .args(*more)
            .stderr(Stdio::piped())
            .stdout(Stdio::null())
            .spawn()
            .unwrap()
    };
    more.iter().map(spawn).collect()
}

#[test]
fn shards_at_once_and_the_same_one_twice_do_no_harm() {
    let desk = Desk::new();
    let which = ["1/2", "2/2", "1/2", "2/2", "1/3"];
    let args: Vec<[&str; 2]> = which.iter().map(|which| ["--shard", which]).collect();
    let args: Vec<&[&str]> = args.iter().map(<[_; 2]>::as_slice).collect();
    for run in at_once(&desk, &args) {
        let output = run.wait_with_output().unwrap();
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
    }
    start(&desk, "map", "out", &["--merge"]).assert().success();
    assert!(files(&desk.path("out")) == plain(&desk, "map"));
}

#[test]
fn of_two_mergers_at_once_one_writes_the_folder() {
    let desk = Desk::new();
    shard(&desk, "map", "out", "1/1");
    let merge: &[&str] = &["--merge"];
    let ended = at_once(&desk, &[merge, merge, merge]);
    let codes: Vec<_> = ended
        .into_iter()
        .map(|run| run.wait_with_output().unwrap().status.code())
        .collect();
    assert!(codes.contains(&Some(0)), "{codes:?}");
    // refused: the folder of pieces is in use, or gone already
    assert!(
        codes.iter().all(|code| [Some(0), Some(3)].contains(code)),
        "{codes:?}"
    );
    assert!(files(&desk.path("out")) == plain(&desk, "map"));
}

/// Pieces of 36 of which 3 is missing, 7 truncated, 8 altered, 9 another one, 10 of other work.
fn spoil(desk: &Desk) {
    for which in ["1/4", "2/4", "3/4", "4/4"] {
        shard(desk, "map", "out", which);
    }
    start(
        desk,
        "map",
        "other",
        &["--shard", "1/1", "--set", "jumper.mass=80"],
    )
    .assert()
    .success();
    let file = |out: &str, n: u32| desk.path(&format!(".{out}.saltus-pieces/piece-{n:06}.bin"));
    fs::remove_file(file("out", 3)).unwrap();
    let bytes = fs::read(file("out", 7)).unwrap();
    fs::write(file("out", 7), &bytes[..bytes.len() - 1]).unwrap();
    let mut bytes = fs::read(file("out", 8)).unwrap();
    *bytes.last_mut().unwrap() ^= 1;
    fs::write(file("out", 8), bytes).unwrap();
    fs::copy(file("out", 11), file("out", 9)).unwrap();
    fs::copy(file("other", 10), file("out", 10)).unwrap();
}

#[test]
fn a_merge_names_every_bad_piece_and_uses_none() {
    let desk = Desk::new();
    spoil(&desk);
    let before = files(&desk.path(".out.saltus-pieces"));
    let refused = start(&desk, "map", "out", &["--merge"])
        .assert()
        .code(3)
        .stdout("");
    let said = String::from_utf8(refused.get_output().stderr.clone()).unwrap();
    assert!(said.contains("5 of 36 pieces"), "{said}");
    for (piece, problem, shard) in [
        (3, "missing", "4/4"),
        (7, "bytes of content, not", "4/4"),
        (8, "its checksum does not match", "1/4"),
        (9, "it is piece 11", "2/4"),
        (10, "it belongs to other work", "3/4"),
    ] {
        let line = said
            .lines()
            .find(|line| line.contains(&format!("piece-{piece:06}.bin")))
            .unwrap();
        assert!(
            line.contains(&format!("piece {piece} "))
                && line.contains(problem)
                && line.contains(&format!("--shard {shard} makes it")),
            "{line}"
        );
    }
    assert!(said.contains("--resume"), "{said}");
    assert!(!desk.path("out").exists());
    let after = files(&desk.path(".out.saltus-pieces"));
    let pieces = |all: &BTreeMap<String, Vec<u8>>| {
        let all = all.clone().into_iter();
        all.filter(|(name, _)| name.starts_with("piece-"))
            .collect::<Vec<_>>()
    };
    assert!(pieces(&before) == pieces(&after), "all stay as they are");
}

#[test]
fn what_a_merge_refuses_shards_or_a_run_make_again_to_the_same_bits() {
    let desk = Desk::new();
    spoil(&desk);
    start(&desk, "map", "out", &["--shard", "4/4"])
        .assert()
        .success()
        .stdout(contains("2 of the 36 pieces made, 7 there before"))
        .stderr(contains("piece-000007.bin"));
    start(&desk, "map", "out", &["--resume"])
        .assert()
        .success()
        .stderr(
            contains("piece 8 is damaged (its checksum")
                .and(contains("piece 9 is"))
                .and(contains("piece 10 is")),
        );
    assert!(files(&desk.path("out")) == plain(&desk, "map"));
}

#[test]
fn pieces_of_another_study_are_refused_and_the_difference_named() {
    let desk = Desk::new();
    shard(&desk, "map", "out", "1/4");
    let before = files(&desk.path(".out.saltus-pieces"));
    for how in [&["--shard", "2/4"][..], &["--merge"], &["--resume"]] {
        start(
            &desk,
            "map",
            "out",
            &[how, &["--set", "jumper.mass=80"]].concat(),
        )
        .assert()
        .code(3)
        .stdout("")
        .stderr(contains("jumper.0.mass is `76.64` there and `80.0` here"));
    }
    // as a study from another version would be, or a machine that rounds otherwise
    let manifest = desk.path(".out.saltus-pieces/saltus-pieces.json");
    let text = fs::read_to_string(&manifest).unwrap();
    assert!(text.contains("rounding"), "{text}");
    let version = env!("CARGO_PKG_VERSION");
    fs::write(
        &manifest,
        text.replace(&format!("\"{version}\""), "\"99.0.0\""),
    )
    .unwrap();
    start(&desk, "map", "out", &["--merge"])
        .assert()
        .code(3)
        .stderr(contains(format!(
            "saltus is `99.0.0` there and `{version}` here"
        )));
    fs::write(&manifest, text).unwrap();
    assert!(
        files(&desk.path(".out.saltus-pieces"))
            .keys()
            .eq(before.keys())
    );
}

#[test]
fn a_merge_without_pieces_says_so_and_leaves_nothing() {
    let desk = Desk::new();
    start(&desk, "map", "out", &["--merge"])
        .assert()
        .code(3)
        .stdout("")
        .stderr(contains(".out.saltus-pieces").and(contains("--shard")));
    assert_eq!(desk.names(), ["paper.toml"]);
}

#[test]
fn a_shard_that_is_none_is_told_what_would_be_one() {
    let desk = Desk::new();
    for (which, said) in [
        ("0/4", "1/4 to 4/4"),
        ("5/4", "1/4 to 4/4"),
        ("1/0", "1/1"),
        ("3", "3/64"),
        ("a/b", "3/64"),
        ("-1/4", "3/64"),
    ] {
        let option = format!("--shard={which}");
        start(&desk, "map", "out", &[&option])
            .assert()
            .code(2)
            .stdout("")
            .stderr(contains(said));
    }
    for both in [
        ["--shard=1/2", "--resume"],
        ["--shard=1/2", "--merge"],
        ["--merge", "--resume"],
    ] {
        start(&desk, "map", "out", &both).assert().code(2);
    }
    saltus(&["map", &desk.paper(), "--shard", "1/2"])
        .assert()
        .code(2)
        .stderr(contains("--out"));
    assert_eq!(desk.names(), ["paper.toml"]);
}

#[test]
fn a_shard_with_nothing_to_do_says_so() {
    let desk = Desk::new();
    start(&desk, "map", "out", &["--shard", "37/40"])
        .assert()
        .success()
        .stdout(contains("nothing to do").and(contains("36 pieces")));
    start(&desk, "map", "out", &["--shard", "36/40"])
        .assert()
        .success()
        .stdout(contains("1 of the 36 pieces made"));
}

#[test]
fn states_that_are_carried_on_cannot_be_shared_out() {
    let desk = Desk::new();
    for direction in ["up", "down", "both"] {
        for how in [&["--shard", "1/2"][..], &["--merge"], &["--resume"]] {
            let set = format!("sweep.direction={direction}");
            start(&desk, "sweep", "out", &[how, &["--set", &set]].concat())
                .assert()
                .code(2)
                .stdout("")
                .stderr(
                    contains(format!("sweep.direction = \"{direction}\""))
                        .and(contains("restarts")),
                );
        }
    }
    assert_eq!(desk.names(), ["paper.toml"]);
}

/// A file size limit stands for a full disk: writing beyond it is refused in the same way.
#[cfg(target_os = "linux")]
#[test]
fn a_disk_that_is_full_leaves_no_half_piece() {
    let desk = Desk::new();
    // pieces of 40 pixels, some 7 kB; the study takes 3 kB
    let args = |which: &str| {
        let fixed = [
            "map",
            &desk.paper(),
            "--out",
            &desk.str("out"),
            "--shard",
            which,
            "--set",
        ];
        let fixed: Vec<String> = fixed.iter().map(|arg| (*arg).to_owned()).collect();
        [fixed, vec!["map.exponent=0".to_owned()], small("map", 100)].concat()
    };
    let run = |limit: &str, which: &str| {
        let script = format!("ulimit -f {limit}; trap '' XFSZ; exec \"$0\" \"$@\"");
        let mut run = assert_cmd::Command::new("bash");
        run.args(["-c", &script, program()])
            .args(args(which))
            .assert()
    };
    run("unlimited", "1/250").success();
    let pieces = desk.path(".out.saltus-pieces");
    let whole = files(&pieces);
    // in kB
    run("5", "2/250")
        .code(3)
        .stdout("")
        .stderr(contains("piece-000001.bin").and(contains("too large")));
    assert!(files(&pieces) == whole, "nothing was left half");
    run("unlimited", "2/250")
        .success()
        .stdout(contains("1 of the 250 pieces made"));
    assert_is_piece(&pieces, 1);
}

#[cfg(target_os = "linux")]
fn assert_is_piece(folder: &Path, number: u32) {
    let bytes = fs::read(folder.join(format!("piece-{number:06}.bin"))).unwrap();
    assert!(bytes.starts_with(b"saltuspc"));
}
