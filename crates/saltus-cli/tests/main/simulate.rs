//! `saltus simulate` as its users meet it.

use crate::common::{Desk, files, json, program, saltus};
use predicates::prelude::*;
use predicates::str::contains;
use serde_json::Value;
use std::fs;
use std::process::{Command as Process, Stdio};

const FAST: [&str; 2] = ["--set", "plate.inertia=condensed"];

/// Two people of unlike weight.
const TWO: &str = "jumper=[\
    { x = 7.0, y = 5.0, mass = 76.64, stiffness = 18600.0, damping_ratio = 0.28 }, \
    { x = 4.0, y = 5.0, mass = 60.0, stiffness = 18600.0, damping_ratio = 0.35 }]";

fn simulate(desk: &Desk, args: &[&str]) -> Value {
    let paper = desk.paper();
    json(
        saltus(&["simulate", &paper, "--json"])
            .args(FAST)
            .args(args),
    )
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

#[test]
fn json_tells_section_switches_and_energy() {
    let found = simulate(&Desk::new(), &["--periods", "12"]);
    assert_eq!(found["status"], "completed");
    assert_eq!(found["periods_run"], 12);
    assert!((number(&found["base_frequency"]) - 2.5373).abs() < 5e-5);
    assert!(
        (number(&found["forcing_period"]) * number(&found["base_frequency"]) - 1.0).abs() < 1e-12
    );
    assert!(found["steps"].as_u64().unwrap() > 12);
    let section = found["section"].as_array().unwrap();
    assert_eq!(section.len(), 12);
    for point in section {
        assert!(point["z"][0].is_f64() && point["v"][0].is_f64());
        assert_eq!(point["w"].as_array().unwrap().len(), 4);
        assert!(["contact", "flight"].contains(&point["phase"][0].as_str().unwrap()));
    }
    let ratio = number(&found["mean_contact_ratio"][0]);
    assert!(0.0 < ratio && ratio < 1.0, "{ratio}");
    assert!(number(&found["peak_reaction"][0]) > 1.0);
    assert_eq!(found["energy"].as_array().unwrap().len(), 12);
    // the tolerance of the run is 1e-10
    assert!(number(&found["energy_max_relative_residual"]) < 1e-9);
    assert_eq!(found["study"]["simulate"]["periods"], 12);
}

#[test]
fn take_offs_and_touch_downs_alternate_in_time() {
    let found = simulate(&Desk::new(), &["--periods", "12"]);
    let switches = found["switches"].as_array().unwrap();
    assert!(switches.len() > 4);
    let landing_first = switches[0]["kind"] == "touch-down";
    assert!(landing_first, "the usual start is in the air");
    for pair in switches.windows(2) {
        assert!(number(&pair[0]["time_s"]) < number(&pair[1]["time_s"]));
        assert_ne!(pair[0]["kind"], pair[1]["kind"]);
        assert_eq!(pair[0]["jumper"], 0);
    }
    let last = number(&switches.last().unwrap()["time_s"]);
    assert!(last <= 12.0 * number(&found["forcing_period"]));
}

#[test]
fn the_first_state_is_in_the_papers_units() {
    let desk = Desk::new();
    let start = ["--periods", "2", "--set", "start.z=3", "--set", "start.v=2"];
    assert_eq!(
        simulate(&desk, &start)["section"],
        simulate(&desk, &["--periods", "2"])["section"]
    );
    // higher than one period's free fall, gravity -1 in these units: a parabola until touch-down
    let high = [
        "--periods",
        "1",
        "--set",
        "start.z=60",
        "--set",
        "start.v=2",
    ];
    let found = simulate(&desk, &high);
    let point = &found["section"][0];
    let omega = (18_600.0_f64 / 76.64).sqrt();
    let t = number(&found["forcing_period"]) * omega;
    assert_eq!(point["phase"][0], "flight");
    // rounding of a few operations on numbers near 60
    assert!((number(&point["z"][0]) - (60.0 + 2.0 * t - 0.5 * t * t)).abs() < 1e-10);
    assert!((number(&point["v"][0]) - (2.0 - t)).abs() < 1e-12);
}

#[test]
fn several_jumpers_give_lists_and_none_empty_ones() {
    let desk = Desk::new();
    let two = simulate(&desk, &["--periods", "3", "--set", TWO]);
    for key in ["z", "v", "phase"] {
        assert_eq!(two["section"][2][key].as_array().unwrap().len(), 2, "{key}");
    }
    for key in ["mean_contact_ratio", "peak_reaction"] {
        assert_eq!(two[key].as_array().unwrap().len(), 2, "{key}");
    }
    let empty = [
        "--periods",
        "3",
        "--set",
        "jumper=[]",
        "--set",
        "base.reference=plate",
    ];
    let none = simulate(&desk, &empty);
    assert_eq!(none["section"][2]["z"], serde_json::json!([]));
    assert_eq!(none["section"][2]["w"].as_array().unwrap().len(), 4);
    assert_eq!(none["switches"], serde_json::json!([]));
}

#[test]
fn full_and_condensed_agree_over_some_periods() {
    let desk = Desk::new();
    let full = ["--periods", "3", "--set", "plate.inertia=full"];
    let (full, condensed) = (simulate(&desk, &full), simulate(&desk, &["--periods", "3"]));
    let z = |found: &Value| number(&found["section"][2]["z"][0]);
    // in-plane inertia moves the paper's orbit by about 1e-4
    assert!((z(&full) - z(&condensed)).abs() < 1e-2);
    assert_ne!(z(&full), z(&condensed));
}

#[test]
fn out_is_a_whole_folder_and_again_replaces_it() {
    let desk = Desk::new();
    let out = desk.str("deep/results");
    let args = [
        "--periods",
        "8",
        "--set",
        "simulate.transient=5",
        "--out",
        &out,
    ];
    let printed = simulate(&desk, &args);
    let first = files(&desk.path("deep/results"));
    let names: Vec<&str> = first.keys().map(String::as_str).collect();
    assert_eq!(
        names,
        [
            "energy.csv",
            "history.csv",
            "history.pdf",
            "history.png",
            "history.svg",
            "portrait.pdf",
            "portrait.png",
            "portrait.svg",
            "saltus-result.json",
            "section.csv",
            "simulate.json",
            "simulate.nc",
            "study.toml",
            "switches.csv",
        ]
    );
    assert_eq!(
        serde_json::from_slice::<Value>(&first["simulate.json"]).unwrap(),
        printed
    );
    let lines = |name: &str| {
        let text = String::from_utf8(first[name].clone()).unwrap();
        text.lines().filter(|line| !line.starts_with('#')).count()
    };
    assert_eq!(lines("section.csv"), 1 + 8);
    assert_eq!(lines("energy.csv"), 1 + 8);
    // the periods after the transient
    assert_eq!(lines("history.csv"), 1 + 3 * 400);
    assert_eq!(
        lines("switches.csv"),
        1 + printed["switches"].as_array().unwrap().len()
    );
    // the resolved study gives the same again
    let resolved = desk.str("deep/results/study.toml");
    let again = json(&mut saltus(&[
        "simulate", &resolved, "--json", "--out", &out,
    ]));
    assert_eq!(again, printed);
    assert_eq!(files(&desk.path("deep/results")), first);
    assert_eq!(desk.names(), ["deep", "paper.toml"]);
}

#[test]
fn the_empty_plate_has_a_figure_of_its_own() {
    let desk = Desk::new();
    let out = desk.str("results");
    let empty = ["--set", "jumper=[]", "--set", "base.reference=plate"];
    let args = ["--periods", "3", "--out", &out];
    simulate(&desk, &[empty.as_slice(), &args].concat());
    assert!(desk.path("results/section.svg").exists());
    assert!(!desk.path("results/portrait.svg").exists());
}

#[test]
fn a_foreign_folder_is_left_alone() {
    let desk = Desk::new();
    let folder = desk.folder.path().display().to_string();
    let paper = desk.paper();
    saltus(&["simulate", &paper, "--periods", "1", "--out", &folder])
        .assert()
        .code(3)
        .stdout("")
        .stderr(contains("not empty"));
    assert_eq!(desk.names(), ["paper.toml"]);
}

#[test]
fn the_summary_is_for_people() {
    let desk = Desk::new();
    let paper = desk.paper();
    let run = |more: &[&str]| {
        saltus(&["simulate", &paper, "--periods", "6"])
            .args(FAST)
            .args(more)
            .assert()
    };
    run(&[]).success().stderr("").stdout(
        contains("completed")
            .and(contains("2.5373 Hz"))
            .and(contains("% of the time"))
            .and(contains("body weights"))
            .and(contains("take-offs"))
            .and(contains("residual")),
    );
    run(&["--quiet"]).success().stderr("").stdout("");
    let crowd = std::fs::read_to_string(&paper).unwrap();
    let person = crowd
        .split("[[jumper]]")
        .nth(1)
        .unwrap()
        .split("[contact]")
        .next()
        .unwrap();
    let crowd = format!("{crowd}\n") + &format!("[[jumper]]{person}\n").repeat(19);
    std::fs::write(&paper, crowd).unwrap();
    let text = run(&[]).success().stderr("").get_output().stdout.clone();
    let text = String::from_utf8(text).unwrap();
    assert!(
        text.contains("20 x ") && text.contains("z/eta_0-19"),
        "{text}"
    );
    assert!(
        text.lines().all(|line| line.chars().count() <= 100),
        "{text}"
    );
}

#[test]
fn a_size_of_figures_that_is_none_is_refused_before_any_work() {
    let desk = Desk::new();
    let (paper, out) = (desk.paper(), desk.str("results"));
    for sizes in [
        vec!["--figure-width", "85"],
        vec!["--figure-width", "NaNmm"],
        vec!["--figure-width", "85mm", "--font-size", "0pt"],
    ] {
        saltus(&["simulate", &paper, "--out", &out])
            .args(&sizes)
            .assert()
            .code(2)
            .stderr(contains("such as 8").and(contains(sizes[sizes.len() - 1])));
        assert!(!desk.path("results").exists());
    }
}

#[test]
fn a_run_that_ends_early_is_told_in_full_and_ends_with_1() {
    let desk = Desk::new();
    let (paper, out) = (desk.paper(), desk.str("results"));
    let few = ["--set", "solver.max_switches=1", "--json", "--out", &out];
    let ended = saltus(&["simulate", &paper]).args(FAST).args(few).assert();
    let ended = ended
        .code(1)
        .stderr(contains("chattering").and(contains("solver.max_switches")));
    let found: Value = serde_json::from_slice(&ended.get_output().stdout).unwrap();
    assert_eq!(found["status"], "chattering");
    assert_eq!(
        found["section"].as_array().unwrap().len() as u64,
        found["periods_run"].as_u64().unwrap()
    );
    assert!(
        found["peak_reaction"][0].is_null(),
        "the history was not reached"
    );
    let kept = fs::read(desk.path("results/simulate.json")).unwrap();
    assert_eq!(serde_json::from_slice::<Value>(&kept).unwrap(), found);
    assert!(desk.path("results/portrait.png").exists());
}

#[test]
fn rk4_agrees_with_taylor_and_refuses_an_unstable_step() {
    let desk = Desk::new();
    let paper = desk.paper();
    let rk4 = ["--set", "solver.method=rk4"];
    // what is stiff is in-plane motion with its own inertia
    let coarse = [
        "--set",
        "solver.steps_per_period=500",
        "--set",
        "plate.inertia=full",
    ];
    for command in ["simulate", "sweep"] {
        saltus(&[command, &paper, "--json", "--out", &desk.str("no")])
            .args(rk4)
            .args(coarse)
            .assert()
            .code(2)
            .stdout("")
            .stderr(contains("solver.steps_per_period = 500").and(contains("at least 1195")));
    }
    assert_eq!(desk.names(), ["paper.toml"]);
    let args = ["--periods", "3"];
    let z = |found: &Value| number(&found["section"][2]["z"][0]);
    let with_rk4 = simulate(&desk, &[args.as_slice(), &rk4].concat());
    // both solve to far below this; the figure would show 1e-3
    assert!((z(&with_rk4) - z(&simulate(&desk, &args))).abs() < 1e-6);
}

#[cfg(target_os = "linux")]
#[test]
fn an_interrupted_run_leaves_nothing_and_ends_with_130() {
    let desk = Desk::new();
    let (paper, out) = (desk.paper(), desk.str("deep/results"));
    let swept = ["--set", "sweep.transient=10000000"];
    let long = ["--periods", "10000000"];
    for args in [
        ["simulate", &paper].iter().chain(&long),
        ["sweep", &paper].iter().chain(&swept),
    ] {
        let mut child = Process::new(program())
            .args(args)
            .args(FAST)
            .args(["--json", "--out", &out])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        wait_for_handler(&mut child);
        interrupt(child.id());
        let output = child.wait_with_output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(130), "{said}");
        assert!(
            said.contains("interrupted") && output.stdout.is_empty(),
            "{said}"
        );
        assert_eq!(desk.names(), ["paper.toml"]);
    }
}

/// Until the program catches SIGTERM, as Linux tells of each process.
#[cfg(target_os = "linux")]
fn wait_for_handler(child: &mut std::process::Child) {
    let status = format!("/proc/{}/status", child.id());
    loop {
        assert_eq!(child.try_wait().unwrap(), None, "it ended by itself");
        let text = fs::read_to_string(&status).unwrap();
        let caught = text
            .lines()
            .find_map(|line| line.strip_prefix("SigCgt:"))
            .unwrap();
        if u64::from_str_radix(caught.trim(), 16).unwrap() >> 14 & 1 == 1 {
            return;
        }
        std::thread::yield_now();
    }
}

#[cfg(target_os = "linux")]
fn interrupt(id: u32) {
    let sent = Process::new("kill")
        .args(["-TERM", &id.to_string()])
        .status()
        .unwrap();
    assert!(sent.success());
}
