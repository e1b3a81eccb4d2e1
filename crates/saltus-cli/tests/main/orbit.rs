//! `saltus orbit` as its users meet it.

use crate::common::{Desk, files, json, saltus};
use predicates::prelude::*;
use predicates::str::contains;
use serde_json::Value;

/// DP Fig. 3a: two forcing periods.
const FIG_3A: [&str; 6] = [
    "--set",
    "plate.inertia=condensed",
    "--set",
    "jumper.damping_ratio=0.15",
    "--set",
    "base.frequency_ratio=0.9",
];

fn orbit(desk: &Desk, args: &[&str]) -> Value {
    let paper = desk.paper();
    json(saltus(&["orbit", &paper, "--json"]).args(FIG_3A).args(args))
}

fn numbers(value: &Value) -> Vec<f64> {
    let all = value.as_array().unwrap().iter();
    all.map(|number| number.as_f64().unwrap()).collect()
}

#[test]
fn json_tells_the_orbit() {
    let found = orbit(&Desk::new(), &[]);
    assert_eq!(found["period"], 2);
    assert_eq!(found["period_asked"], Value::Null);
    assert_eq!(found["stability"], "stable");
    assert_eq!(found["outside"], 0);
    assert_eq!(found["sequence"], "TL|TL");
    assert!(found["residual"].as_f64().unwrap() < 1e-11);
    let section = found["section"].as_array().unwrap();
    assert_eq!(section.len(), 2);
    assert!(section[1]["z"][0].is_f64() && section[1]["v"][0].is_f64());
    assert_eq!(section[0]["w"].as_array().unwrap().len(), 4);
    assert_eq!(section[0]["phase"][0], "contact");
    let multipliers = found["multipliers"].as_array().unwrap();
    let moduli: Vec<f64> = multipliers
        .iter()
        .map(|m| m["modulus"].as_f64().unwrap())
        .collect();
    // four plate terms and a body, two states each
    assert_eq!(moduli.len(), 10);
    assert!(moduli[0] < 1.0 && moduli.is_sorted_by(|a, b| a >= b));
    let kinds: Vec<&str> = found["switches"]
        .as_array()
        .unwrap()
        .iter()
        .map(|switch| switch["kind"].as_str().unwrap())
        .collect();
    assert_eq!(kinds, ["take-off", "touch-down", "take-off", "touch-down"]);
    assert_eq!(numbers(&found["touch_down_phase"][0]).len(), 2);
    assert!(found["contact_ratio"][0].is_f64() && found["peak_reaction"][0].is_f64());
    assert!(found["study"]["jumper"][0]["damping_ratio"] == 0.15);
}

#[test]
fn the_long_term_motion_is_on_it() {
    let desk = Desk::new();
    let (found, paper) = (orbit(&desk, &[]), desk.paper());
    let mut run = saltus(&["simulate", &paper, "--json", "--periods", "400"]);
    let run = json(run.args(FIG_3A));
    let last = run["section"][399]["z"][0].as_f64().unwrap();
    let points = found["section"].as_array().unwrap().iter();
    let off = points.map(|point| (point["z"][0].as_f64().unwrap() - last).abs());
    // 0.77 per orbit has forgotten the start; what is left is the tolerance of the run
    assert!(off.fold(f64::INFINITY, f64::min) < 1e-7);
}

#[test]
fn an_orbit_that_closes_sooner_than_asked_is_told() {
    let desk = Desk::new();
    let asked = ["--set", "orbit.period=4"];
    let found = orbit(&desk, &asked);
    assert_eq!(
        (&found["period"], &found["period_asked"]),
        (&2.into(), &4.into())
    );
    saltus(&["orbit", &desk.paper()])
        .args(FIG_3A)
        .args(asked)
        .assert()
        .success()
        .stderr("")
        .stdout(contains("closes after 2 forcing periods; 4 were asked for"));
}

#[test]
fn an_unstable_orbit_is_found_where_it_is_asked_for() {
    let chaos = [
        "--set",
        "jumper.damping_ratio=0.12",
        "--set",
        "base.frequency_ratio=1.0",
    ];
    let desk = Desk::new();
    let paper = desk.paper();
    saltus(&["orbit", &paper, "--out", &desk.str("no")])
        .args(FIG_3A)
        .args(chaos)
        .assert()
        .code(1)
        .stdout("")
        .stderr(contains("does not come back").and(contains("orbit.period")));
    assert_eq!(desk.names(), ["paper.toml"]);
    let found = orbit(&desk, &[&chaos[..], &["--set", "orbit.period=1"]].concat());
    assert_eq!(
        (&found["period"], &found["stability"]),
        (&1.into(), &"unstable".into())
    );
    assert!(found["outside"].as_u64().unwrap() > 0);
}

#[test]
fn out_is_a_whole_folder() {
    let desk = Desk::new();
    let printed = orbit(&desk, &["--out", &desk.str("results")]);
    let found = files(&desk.path("results"));
    let names: Vec<&str> = found.keys().map(String::as_str).collect();
    assert_eq!(
        names,
        [
            "history.csv",
            "multipliers.csv",
            "multipliers.pdf",
            "multipliers.png",
            "multipliers.svg",
            "orbit.json",
            "orbit.nc",
            "portrait.pdf",
            "portrait.png",
            "portrait.svg",
            "saltus-result.json",
            "section.csv",
            "study.toml",
            "switches.csv",
        ]
    );
    let document: Value = serde_json::from_slice(&found["orbit.json"]).unwrap();
    assert_eq!(document, printed);
    let lines = |name: &str| {
        let text = String::from_utf8(found[name].clone()).unwrap();
        text.lines().filter(|line| !line.starts_with('#')).count()
    };
    assert_eq!(
        ["section.csv", "switches.csv", "multipliers.csv"].map(lines),
        [3, 5, 11]
    );
}

#[test]
fn two_people_have_lists_and_an_empty_plate_has_an_orbit() {
    let desk = Desk::new();
    let two = "jumper=[\
        { x = 7.0, y = 5.0, mass = 76.64, stiffness = 18600.0, damping_ratio = 0.45 }, \
        { x = 4.0, y = 5.0, mass = 60.0, stiffness = 18600.0, damping_ratio = 0.45 }]";
    let found = orbit(&desk, &["--set", two]);
    assert_eq!(found["contact_ratio"].as_array().unwrap().len(), 2);
    assert_eq!(found["touch_down_phase"].as_array().unwrap().len(), 2);
    assert!(found["sequence"].as_str().unwrap().contains("T2"));
    let paper = desk.paper();
    let mut empty = saltus(&["orbit", &paper, "--json", "--out", &desk.str("empty")]);
    empty.args(["--set", "plate.inertia=condensed", "--set", "jumper=[]"]);
    let found = json(empty.args(["--set", "base.reference=plate"]));
    assert_eq!(
        (&found["period"], &found["stability"]),
        (&1.into(), &"stable".into())
    );
    assert!(!desk.path("empty").join("portrait.svg").exists());
}
