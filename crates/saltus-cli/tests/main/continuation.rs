//! `saltus continue` as its users meet it.

use crate::common::{Desk, files, json, saltus};
use predicates::prelude::*;
use predicates::str::contains;
use serde_json::Value;
use std::fs;

/// Branches alone.
const SMALL: [&str; 8] = [
    "--set",
    "plate.inertia=condensed",
    "--set",
    "continue.doublings=1",
    "--set",
    "continue.cloud=0",
    // a point that is not there: no curves
    "--set",
    "continue.second.curves=[\"NS7\"]",
];

/// One period doubling.
const AT_0_9: [&str; 2] = ["--set", "base.frequency_ratio=0.9"];

fn branches(desk: &Desk, args: &[&str]) -> Value {
    let paper = desk.paper();
    json(
        saltus(&["continue", &paper, "--json"])
            .args(SMALL)
            .args(args),
    )
}

/// The points of a branch.
fn points(found: &Value, branch: u64) -> impl Iterator<Item = &Value> {
    let all = found["points"].as_array().unwrap().iter();
    all.filter(move |point| point["branch"] == branch)
}

/// Labels and values.
fn specials(found: &Value) -> Vec<(String, f64)> {
    let all = found["special_points"].as_array().unwrap().iter();
    all.map(|special| {
        let label = special["label"].as_str().unwrap().to_owned();
        (label, special["value"].as_f64().unwrap())
    })
    .collect()
}

/// The values are those of the same branches with steps of 0.05 instead of 0.02, and of the branch of period 1
/// where it meets that of period 2. Special points are located to some 1e-10.
fn assert_specials(found: &Value, expected: &[(&str, f64)]) {
    let found = specials(found);
    for &(label, value) in expected {
        let here = found.iter().find(|(known, _)| known == label);
        let off = here.map(|(_, found)| (found - value).abs());
        assert!(off.is_some_and(|off| off < 1e-9), "{label}: {found:?}");
    }
}

#[test]
fn the_branch_at_0_9_doubles_once() {
    let desk = Desk::new();
    let found = branches(
        &desk,
        &[
            &AT_0_9[..],
            &["--set", "continue.cloud=9", "--out", &desk.str("results")],
        ]
        .concat(),
    );
    assert_specials(&found, &[("PD1", 0.1892865091)]);
    assert_eq!(found["special_points"].as_array().unwrap().len(), 1);
    assert_eq!(found["parameter"], "jumper.damping_ratio");
    let special = &found["special_points"][0];
    assert_eq!(
        (&special["kind"], &special["period"]),
        (&"PD".into(), &1.into())
    );
    assert_eq!(
        (&special["outside_before"], &special["outside_after"]),
        (&1.into(), &0.into())
    );
    let limbs = found["branches"].as_array().unwrap();
    let told: Vec<_> = limbs.iter().map(|l| (&l["origin"], &l["period"])).collect();
    assert_eq!(
        told,
        [(&Value::Null, &1.into()), (&"PD1".into(), &2.into())]
    );
    for end in ["end_first", "end_last"] {
        assert_eq!(limbs[0][end], "end of the range");
    }
    let points: Vec<&Value> = points(&found, 0).collect();
    assert_eq!(limbs[0]["points"], points.len());
    let value = |point: &Value| point["value"].as_f64().unwrap();
    assert_eq!(
        (value(points[0]), value(points[points.len() - 1])),
        (0.1, 0.5)
    );
    for point in points {
        let stable = value(point) > value(special);
        let expected = if stable { "stable" } else { "unstable" };
        assert_eq!(point["stability"], expected, "{point}");
    }
    let written = files(&desk.path("results"));
    let names: Vec<&str> = written.keys().map(String::as_str).collect();
    assert_eq!(
        names,
        [
            "branches.csv",
            "branches.pdf",
            "branches.png",
            "branches.svg",
            "continue.json",
            "continue.nc",
            "curves.csv",
            "ends.csv",
            "saltus-result.json",
            "special_points.csv",
            "study.toml",
        ]
    );
    let document: Value = serde_json::from_slice(&written["continue.json"]).unwrap();
    assert_eq!(document, found);
    let text = |name: &str| String::from_utf8(written[name].clone()).unwrap();
    let rows = |name: &str| {
        text(name)
            .lines()
            .filter(|line| !line.starts_with('#'))
            .count()
            - 1
    };
    let orbits = limbs.iter().map(|limb| {
        limb["points"].as_u64().unwrap() as usize * limb["period"].as_u64().unwrap() as usize
    });
    assert_eq!(rows("branches.csv"), orbits.sum::<usize>());
    assert_eq!(
        [
            rows("special_points.csv"),
            rows("ends.csv"),
            rows("curves.csv")
        ],
        [1, 2, 0]
    );
    let svg = text("branches.svg");
    assert!(
        ["PD1", "Unstable", "Long-term motion"]
            .iter()
            .all(|word| svg.contains(word))
    );
}

#[test]
fn the_branch_at_1_folds_doubles_and_meets_half_its_period() {
    let desk = Desk::new();
    let found = branches(
        &desk,
        &["--out", &desk.str("first"), "--set", "continue.doublings=0"],
    );
    assert_specials(
        &found,
        &[
            ("PD1", 0.2232987278),
            ("LP1", 0.2821760888),
            ("LP2", 0.2159641559),
            ("HP1", 0.4609559739),
        ],
    );
    assert_eq!(found["branches"][0]["period"], 2);
    assert_eq!(
        found["branches"][0]["end_last"],
        "meets the branch of half its period"
    );
    a_result_is_gone_on_from(&desk);
}

fn a_result_is_gone_on_from(desk: &Desk) {
    let from = |label: &'static str| ["--at", label].map(str::to_owned);
    let first = desk.str("first");
    let run = |label, more: &[&str]| {
        let at = from(label);
        let at: Vec<&str> = at.iter().map(String::as_str).collect();
        branches(desk, &[&["--from", &first][..], &at, more].concat())
    };
    let doubled = run(
        "PD1",
        &["--set", "continue.from=0.2", "--set", "continue.to=0.25"],
    );
    assert_specials(&doubled, &[("PD1", 0.2232987278)]);
    assert_eq!(
        doubled["study"]["jumper"][0]["damping_ratio"],
        specials(&doubled)[0].1
    );
    let periods: Vec<&Value> = doubled["branches"]
        .as_array()
        .unwrap()
        .iter()
        .map(|b| &b["period"])
        .collect();
    assert_eq!(periods, [2, 4]);
    let halved = run("HP1", &["--set", "continue.from=0.45"]);
    assert_eq!(halved["branches"][0]["period"], 1);
    assert_specials(&halved, &[("PD1", 0.4609559739)]);
    // over another parameter, the special point is where the new branch begins
    let other = [
        "--set",
        "continue.parameter=base.amplitude",
        "--set",
        "continue.from=0.012",
        "--set",
        "continue.to=0.014",
    ];
    let across = run(
        "LP1",
        &[&other[..], &["--set", "continue.doublings=0"]].concat(),
    );
    assert!(across["branches"][0]["end_first"].is_string());
    assert!(points(&across, 0).count() > 2);
    let paper = desk.paper();
    for (args, said) in [
        (
            ["--at", "PD7", "--set", "continue.cloud=0"],
            "those found: PD1, LP1, LP2, GR1, HP1",
        ),
        (
            ["--at", "PD1", "--set", "plate.inertia=full"],
            "plate.inertia is not the same",
        ),
        (
            ["--at", "PD1", "--set", "continue.from=0.3"],
            "lies outside 0.3 to 0.5",
        ),
    ] {
        saltus(&["continue", &paper, "--from", &first])
            .args(SMALL)
            .args(args)
            .assert()
            .code(2)
            .stdout("")
            .stderr(contains(said));
    }
}

#[test]
fn threads_do_not_move_special_points() {
    let desk = Desk::new();
    let run = |threads| {
        specials(&branches(
            &desk,
            &[&AT_0_9[..], &["--threads", threads]].concat(),
        ))
    };
    let (one, two) = (run("1"), run("2"));
    assert_eq!(one.len(), 1);
    for (a, b) in one.iter().zip(&two) {
        // columns of derivatives are shared out in another way, which rounds in another way
        assert!(a.0 == b.0 && (a.1 - b.1).abs() < 1e-9, "{a:?} {b:?}");
    }
}

#[test]
fn a_doubling_becomes_a_curve_and_what_has_none_is_told() {
    let desk = Desk::new();
    let sets = [
        "--set",
        "continue.second.curves=[\"pd\", \"GR5\"]",
        "--set",
        "continue.second.from=0.88",
        "--set",
        "continue.second.to=0.92",
        "--set",
        "continue.from=0.15",
        "--set",
        "continue.doublings=0",
    ];
    let found = branches(
        &desk,
        &[&AT_0_9[..], &sets, &["--out", &desk.str("results")]].concat(),
    );
    let curves = found["curves"].as_array().unwrap();
    assert_eq!(
        (&curves[0]["label"], &curves[1]["label"]),
        (&"PD1".into(), &"GR5".into())
    );
    assert!(
        curves[1]["error"]
            .as_str()
            .unwrap()
            .contains("no such special point")
    );
    assert_eq!(found["second_parameter"], "base.frequency_ratio");
    let points = found["curve_points"].as_array().unwrap();
    assert_eq!(curves[0]["points"], points.len());
    let value = |point: &Value, which: &str| point[which].as_f64().unwrap();
    let ends = [&points[0], &points[points.len() - 1]].map(|point| value(point, "second_value"));
    assert!((ends[0] - ends[1]).abs() > 0.03, "{ends:?}");
    // it passes the doubling that it began with
    let near = points.iter().any(|point| {
        (value(point, "value") - 0.1892865091).abs() < 1e-8
            && (value(point, "second_value") - 0.9).abs() < 1e-8
    });
    assert!(near);
    assert!(desk.path("results").join("curves.svg").exists());
}

#[test]
fn a_question_that_is_missing_or_leads_nowhere_is_refused() {
    let desk = Desk::new();
    let (paper, out) = (desk.paper(), desk.str("no"));
    let text = std::fs::read_to_string(desk.path("paper.toml")).unwrap();
    let (without, _) = text.split_once("\n[continue]").unwrap();
    saltus(&["continue", "-"])
        .write_stdin(without)
        .assert()
        .code(2)
        .stdout("")
        .stderr(contains("no [continue] table").and(contains("parameter = \"jumper")));
    let run = |args: &[&str]| {
        saltus(&["continue", &paper, "--out", &out])
            .args(SMALL)
            .args(args)
            .assert()
            .stdout("")
    };
    run(&["--set", "jumper.damping_ratio=0.12"])
        .code(1)
        .stderr(contains("does not come back").and(contains("continue.transient")));
    run(&["--set", "jumper=[]", "--set", "base.reference=plate"])
        .code(2)
        .stderr(contains("[[jumper]]"));
    run(&["--from", &out]).code(2).stderr(contains("--at"));
    run(&["--from", &out, "--at", "PD1"])
        .code(3)
        .stderr(contains("continue.json"));
    assert_eq!(desk.names(), ["paper.toml"]);
}

#[test]
fn the_summary_has_a_line_for_each_special_point() {
    let desk = Desk::new();
    saltus(&["continue", &desk.paper()])
        .args(SMALL)
        .args(AT_0_9)
        .assert()
        .success()
        .stderr("")
        .stdout(
            contains("2 branches")
                .and(contains("branch 1: period 2 from PD1"))
                .and(contains("PD1   period doubling         0.18928651")),
        );
}

#[test]
fn curves_are_drawn_over_the_map_of_an_earlier_result() {
    let desk = Desk::new();
    let (paper, map, out) = (desk.paper(), desk.str("map"), desk.str("branches"));
    let condensed = [
        "--quiet",
        "--set",
        "plate.inertia=condensed",
        "--set",
        "continue.second.from=0.98",
        "--set",
        "continue.second.to=1.02",
    ];
    saltus(&["map", &paper, "--out", &map])
        .args(condensed)
        .args(["--set", "map.x.count=5", "--set", "map.y.count=4"])
        .args(["--set", "map.exponent=0", "--set", "map.transient=100"])
        .assert()
        .success();
    let asked = [
        "continue",
        &paper,
        "--set",
        "continue.cloud=0",
        "--set",
        "continue.doublings=0",
        "--set",
        "continue.second.curves=['LP1']",
    ];
    saltus(&asked)
        .args(condensed)
        .args(["--over", &map, "--out", &out])
        .assert()
        .success();
    let curves = fs::read_to_string(desk.path("branches/curves.svg")).unwrap();
    assert!(curves.contains("Every 2 periods") && curves.contains("Fold"));
    // neither a result of another question nor a map of other parameters is drawn under curves
    saltus(&asked)
        .args(condensed)
        .args(["--over", &out])
        .assert()
        .code(2)
        .stderr(contains("saltus continue").and(contains("--over takes")));
    saltus(&asked)
        .args(condensed)
        .args(["--set", "continue.second.parameter=base.amplitude"])
        .args([
            "--set",
            "continue.second.from=0.012",
            "--set",
            "continue.second.to=0.014",
        ])
        .args(["--over", &map])
        .assert()
        .code(2)
        .stderr(contains("its axes are"));
}
