//! `saltus map` and `saltus basins` as their users meet them.

use crate::common::underway::{Underway, count_pieces, small};
use crate::common::{Desk, files, json, saltus};
use predicates::prelude::*;
use predicates::str::contains;
use serde_json::Value;
use std::fs;
use std::process::Command as Process;

fn run(desk: &Desk, command: &str, args: &[&str]) -> Value {
    let paper = desk.paper();
    json(
        saltus(&[command, &paper, "--json"])
            .args(small(command, 6))
            .args(args),
    )
}

/// Number of pixels with this status.
fn pixels(found: &Value, status: &str) -> u64 {
    let all = found["outcomes"].as_array().unwrap().iter();
    let of = all.filter(|outcome| outcome["status"] == status);
    of.map(|outcome| outcome["pixels"].as_u64().unwrap()).sum()
}

#[test]
fn json_tells_axes_and_counts() {
    let found = run(&Desk::new(), "map", &[]);
    assert_eq!(found["x_parameter"], "jumper.damping_ratio");
    assert_eq!(found["y_parameter"], "base.frequency_ratio");
    assert_eq!(found["x_count"], 6);
    assert_eq!(found["pixels"], 36);
    let outcomes = found["outcomes"].as_array().unwrap();
    let sum: u64 = outcomes.iter().map(|n| n["pixels"].as_u64().unwrap()).sum();
    assert_eq!(sum, 36);
    let periodic: u64 = found["periods"]
        .as_array()
        .unwrap()
        .iter()
        .map(|p| p["pixels"].as_u64().unwrap())
        .sum();
    assert_eq!(pixels(&found, "periodic"), periodic);
    assert!(found["contact_ratio_min"][0].as_f64().unwrap() > 0.0);
    assert!(found["contact_ratio_max"][0].as_f64().unwrap() < 1.0);
    assert!(found["peak_reaction_min"][0].as_f64().unwrap() > 1.0);
    assert!(found["peak_acceleration_max"].as_f64().unwrap() > 1.0);
    assert!(found["first_failure_status"].is_null() && found["first_failure_x"].is_null());
    // transient and record, once more with four times the patience, then the exponent and 40 before it; and chaos is
    // watched for a quarter of that
    let most = 5 * 40 + 2 * 8 + 100 + 40 + 5 * 25 + 2;
    assert!(found["periods_run_total"].as_u64().unwrap() <= 36 * most);
}

#[test]
fn basins_number_attractors_by_their_share() {
    let found = run(
        &Desk::new(),
        "basins",
        &[
            "--set",
            "jumper.damping_ratio=0.15",
            "--set",
            "base.frequency_ratio=0.9",
            "--set",
            "basins.transient=400",
            "--set",
            "basins.x.count=16",
            "--set",
            "basins.y.count=16",
        ],
    );
    let attractors = found["attractors"].as_array().unwrap();
    assert_eq!(attractors.len(), 2, "two 2-cycles coexist: {attractors:?}");
    assert!(attractors[0]["share"].as_f64() > attractors[1]["share"].as_f64());
    for (place, attractor) in attractors.iter().enumerate() {
        assert_eq!(attractor["attractor"], place + 1);
        assert_eq!(attractor["period"], 2);
        let z = attractor["z"][0].as_array().unwrap();
        assert!(z.len() == 2 && z[0].as_f64() < z[1].as_f64());
    }
}

#[test]
fn out_is_a_whole_folder_and_threads_do_not_change_a_bit() {
    let desk = Desk::new();
    let paper = desk.paper();
    for (command, names) in [
        (
            "map",
            &[
                "layers.pdf",
                "layers.png",
                "layers.svg",
                "map.json",
                "map.nc",
                "map.pdf",
                "map.png",
                "map.svg",
                "saltus-result.json",
                "study.toml",
            ][..],
        ),
        (
            "basins",
            &[
                "attractors.csv",
                "basins.json",
                "basins.nc",
                "basins.pdf",
                "basins.png",
                "basins.svg",
                "layers.pdf",
                "layers.png",
                "layers.svg",
                "saltus-result.json",
                "study.toml",
            ][..],
        ),
    ] {
        let run = |threads: &str| {
            let name = format!("{command}-{threads}");
            let mut command = saltus(&[command, &paper, "--json", "--threads", threads]);
            command
                .args(small(command_of(&name), 6))
                .args(["--out", &desk.str(&name)]);
            let printed = command.assert().success().get_output().stdout.clone();
            (printed, files(&desk.path(&name)))
        };
        let one = run("1");
        let found: Vec<&str> = one.1.keys().map(String::as_str).collect();
        assert_eq!(found, names);
        let document: Value = serde_json::from_slice(&one.1[&format!("{command}.json")]).unwrap();
        assert_eq!(document, serde_json::from_slice::<Value>(&one.0).unwrap());
        assert!(one.1[&format!("{command}.nc")].starts_with(b"\x89HDF"));
        for threads in ["2", "3"] {
            assert!(run(threads) == one, "{command}: {threads} threads");
        }
    }
    assert!(
        desk.names().iter().all(|name| !name.starts_with('.')),
        "nothing is left over"
    );
}

fn command_of(name: &str) -> &str {
    name.split('-').next().unwrap()
}

#[test]
fn a_pixel_is_what_sweep_gives() {
    let desk = Desk::new();
    let paper = desk.paper();
    let sets = |more: &[&str]| -> Vec<String> {
        let all = ["plate.inertia=condensed", "base.frequency_ratio=0.9"];
        let all = all.iter().chain(more);
        all.flat_map(|set| ["--set".to_owned(), (*set).to_owned()])
            .collect()
    };
    let swept = sets(&[
        "sweep.direction=restarts",
        "sweep.starts=[[3.0, 2.0]]",
        "sweep.count=3",
    ]);
    let swept = json(saltus(&["sweep", &paper, "--json"]).args(swept));
    let mapped = sets(&[
        "map.x.count=3",
        "map.y.from=0.9",
        "map.y.to=0.95",
        "map.y.count=2",
    ]);
    let mapped = json(saltus(&["map", &paper, "--json"]).args(mapped));
    // at 0.9 2T below some damping and 1T above it (DP Fig. 2a); nothing else at 0.95 is 1T at 0.5
    let of_sweep: Vec<u64> = swept["rows"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| row["period"].as_u64().unwrap())
        .collect();
    assert_eq!(of_sweep, [2, 1, 1]);
    assert!(pixels(&mapped, "periodic") >= 4, "{mapped}");
}

#[test]
fn parameters_of_plate_and_person_can_change() {
    let desk = Desk::new();
    for (parameter, from, to) in [
        ("plate.thickness", "0.09", "0.11"),
        ("plate.poisson_ratio", "0", "0.3"),
        ("base.amplitude", "0", "0.013"),
        ("jumper.x", "3", "7"),
    ] {
        let sets = [
            format!("map.y.parameter={parameter}"),
            format!("map.y.from={from}"),
            format!("map.y.to={to}"),
        ];
        let args: Vec<&str> = sets.iter().flat_map(|set| ["--set", set]).collect();
        let found = run(&desk, "map", &args);
        let failure = &found["first_failure_status_text"];
        assert!(failure.is_null(), "{parameter}: {found}");
    }
}

#[test]
fn a_pixel_that_fails_says_why_and_all_of_them_end_the_run() {
    let desk = Desk::new();
    let found = run(&desk, "map", &["--set", "solver.max_switches=2"]);
    assert!(pixels(&found, "chattering") > 0);
    assert_eq!(found["first_failure_status"], "chattering");
    let text = found["first_failure_status_text"].as_str().unwrap();
    assert!(text.contains("solver.max_switches"), "{text}");

    let paper = desk.paper();
    saltus(&["map", &paper, "--out", &desk.str("no")])
        .args(small("map", 6))
        .args(["--set", "solver.max_switches=1"])
        .assert()
        .code(1)
        .stdout("")
        .stderr(contains("no pixel").and(contains("chattering")));
    assert_eq!(desk.names(), ["paper.toml"]);
}

#[test]
fn several_jumpers_have_layers_of_their_own() {
    let two = "jumper=[\
        { x = 7.0, y = 5.0, mass = 76.64, stiffness = 18600.0, damping_ratio = 0.3 }, \
        { x = 4.0, y = 5.0, mass = 60.0, stiffness = 18600.0, damping_ratio = 0.3 }]";
    let found = run(&Desk::new(), "map", &["--set", two]);
    assert_eq!(found["contact_ratio_min"].as_array().unwrap().len(), 2);
    let found = run(&Desk::new(), "basins", &["--set", two]);
    let first = &found["attractors"][0];
    assert_eq!(first["contact_ratio"].as_array().unwrap().len(), 2);
}

#[test]
fn a_question_that_is_missing_or_makes_no_sense_ends_with_2() {
    let desk = Desk::new();
    let text = fs::read_to_string(desk.path("paper.toml")).unwrap();
    let (without, _) = text.split_once("\n[sweep]").unwrap();
    for (command, said) in [("map", "[map.x]"), ("basins", "[basins.x]")] {
        saltus(&[command, "-"])
            .write_stdin(without)
            .assert()
            .code(2)
            .stdout("")
            .stderr(contains(format!("no [{command}] table")).and(contains(said)));
        saltus(&[
            command,
            &desk.paper(),
            "--set",
            "jumper=[]",
            "--set",
            "base.reference=plate",
        ])
        .assert()
        .code(2)
        .stdout("")
        .stderr(contains("[[jumper]]"));
        saltus(&[command, &desk.paper(), "--resume"])
            .assert()
            .code(2)
            .stdout("")
            .stderr(contains("--out"));
    }
}

#[test]
fn the_summary_is_for_people() {
    let desk = Desk::new();
    let paper = desk.paper();
    let run = |command: &str, more: &[&str]| {
        saltus(&[command, &paper])
            .args(small(command, 6))
            .args(more)
            .assert()
    };
    run("map", &[]).success().stderr("").stdout(
        contains("6 x 6 pixels")
            .and(contains(" %  "))
            .and(contains("floor acceleration")),
    );
    run("basins", &[])
        .success()
        .stderr("")
        .stdout(contains("6 x 6 pixels").and(contains("attractors")));
    run("map", &["--quiet"]).success().stderr("").stdout("");
}

#[test]
fn killed_at_any_time_a_run_goes_on_to_the_same_bits() {
    let desk = Desk::new();
    for command in ["map", "basins"] {
        let whole = format!("{command}-whole");
        saltus(&[
            command,
            &desk.paper(),
            "--quiet",
            "--threads",
            "1",
            "--out",
            &desk.str(&whole),
        ])
        .args(small(command, 24))
        .assert()
        .success();
        let torn = format!("{command}-torn");
        // 36 pieces: killed before the first, between, and with nearly all
        for pieces in [0, 1, 4, 5, 13, 22, 34, 36] {
            let mut run =
                Underway::start(&desk, command, 24, &torn, &["--resume", "--threads", "3"]);
            run.until(pieces);
            run.kill();
        }
        let mut last = saltus(&[
            command,
            &desk.paper(),
            "--quiet",
            "--resume",
            "--out",
            &desk.str(&torn),
        ]);
        last.args(small(command, 24))
            .assert()
            .success()
            .stdout("")
            .stderr("");
        assert!(
            files(&desk.path(&torn)) == files(&desk.path(&whole)),
            "{command}: the bits differ"
        );
    }
    // a kill while files are staged leaves the staging folder, which no later run minds
    let mut names = desk.names();
    names.retain(|name| !name.starts_with(".saltus-staging-"));
    let expected = [
        "basins-torn",
        "basins-whole",
        "map-torn",
        "map-whole",
        "paper.toml",
    ];
    assert_eq!(names, expected);
}

#[test]
fn a_work_folder_left_over_is_refused_unless_it_fits_and_was_asked_for() {
    let desk = Desk::new();
    let mut run = Underway::start(&desk, "map", 200, "out", &[]);
    run.until(2);
    // while it runs nobody else may work in its folder
    let again = |more: &[&str]| {
        let mut again = saltus(&["map", &desk.paper(), "--out", &desk.str("out")]);
        again
            .args(small("map", 200))
            .args(more)
            .assert()
            .code(3)
            .stdout("")
    };
    again(&["--resume"]).stderr(contains("in use"));
    run.kill();
    again(&[]).stderr(
        contains(".out.saltus-pieces")
            .and(contains("--resume"))
            .and(contains("remove it")),
    );
    again(&["--resume", "--set", "jumper.mass=80"])
        .stderr(contains("jumper.0.mass").and(contains("80")));
    // what does not change a pixel is no difference
    let left = count_pieces(&desk.path(".out.saltus-pieces"));
    assert!(left >= 2);
    fs::remove_dir_all(desk.path(".out.saltus-pieces")).unwrap();
    assert_eq!(desk.names(), ["paper.toml"]);
}

#[test]
fn a_damaged_piece_is_made_again() {
    let desk = Desk::new();
    let mut run = Underway::start(&desk, "map", 24, "torn", &[]);
    run.until(3);
    run.kill();
    let pieces = desk.path(".torn.saltus-pieces");
    let piece = pieces.join("piece-000000.bin");
    if let Ok(mut bytes) = fs::read(&piece) {
        let last = bytes.len() - 1;
        bytes[last] ^= 1;
        fs::write(&piece, bytes).unwrap();
        saltus(&["map", &desk.paper(), "--resume", "--out", &desk.str("torn")])
            .args(small("map", 24))
            .assert()
            .success()
            .stderr(contains("piece 0").and(contains("damaged")));
    }
    saltus(&["map", &desk.paper(), "--out", &desk.str("whole")])
        .args(small("map", 24))
        .assert()
        .success();
    assert!(files(&desk.path("torn")) == files(&desk.path("whole")));
}

#[cfg(unix)]
#[test]
fn asked_to_stop_it_says_how_to_go_on() {
    let desk = Desk::new();
    let mut run = Underway::start(&desk, "map", 200, "out", &[]);
    run.until(1);
    let id = run.child.id().to_string();
    assert!(
        Process::new("kill")
            .args(["-TERM", &id])
            .status()
            .unwrap()
            .success()
    );
    let output = run.child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(
        said.contains("--resume") && said.contains(".out.saltus-pieces"),
        "{said}"
    );
    assert!(!desk.path("out").exists());
    assert!(count_pieces(&run.pieces) >= 1);
}

#[test]
fn basins_take_the_numbers_that_attractors_have_along_their_sweep() {
    let sweep = [
        "attractors.from=0.26",
        "attractors.to=0.34",
        "attractors.count=3",
        "attractors.starts=8",
        "attractors.transient=100",
    ];
    let sweep: Vec<&str> = sweep.iter().flat_map(|set| ["--set", set]).collect();
    let desk = Desk::new();
    let plain = run(&desk, "basins", &sweep);
    let matched = run(&desk, "basins", &[&["--match"], &sweep[..]].concat());
    let list = |found: &Value| found["attractors"].as_array().unwrap().clone();
    for (without, with) in list(&plain).iter().zip(list(&matched)) {
        assert!(without["matched"].is_null());
        // at zeta_h 0.3 only the 2-cycle on which every sweep ends
        assert_eq!(with["matched"].is_null(), with["period"].is_null());
        assert_eq!(without["share"], with["share"]);
    }
    assert!(!list(&matched)[0]["matched"].is_null());
}
