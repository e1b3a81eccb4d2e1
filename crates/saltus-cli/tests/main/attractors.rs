//! `saltus attractors` as its users meet it.

use crate::common::{Desk, files, json, saltus};
use predicates::prelude::*;
use predicates::str::contains;
use serde_json::Value;

/// Overrides as arguments, with the fast plate.
fn sets(more: &[&str]) -> Vec<String> {
    let all = ["plate.inertia=condensed"].iter().chain(more);
    all.flat_map(|set| ["--set".to_owned(), (*set).to_owned()])
        .collect()
}

/// The loop known between 0.22 and 0.28 at the body's frequency on the plate.
const LOOP: [&str; 5] = [
    "base.frequency_ratio=1.0",
    "attractors.from=0.205",
    "attractors.to=0.295",
    "attractors.count=7",
    "attractors.starts=16",
];

/// The paper's study without a parameter that changes in [attractors].
fn census() -> String {
    let text = saltus_init();
    let (before, table) = text.split_once("\n[attractors]").unwrap();
    let swept = |line: &&str| {
        let key = line.split_whitespace().next().unwrap_or_default();
        !["parameter", "from", "to", "count"].contains(&key)
    };
    let table: Vec<&str> = table.lines().filter(swept).collect();
    format!("{before}\n[attractors]{}", table.join("\n"))
}

fn saltus_init() -> String {
    let output = saltus(&["init", "paper"]).assert().success();
    String::from_utf8(output.get_output().stdout.clone()).unwrap()
}

fn followed(desk: &Desk, more: &[&str], args: &[&str]) -> Value {
    let paper = desk.paper();
    json(
        saltus(&["attractors", &paper, "--json"])
            .args(sets(more))
            .args(args),
    )
}

fn list(value: &Value) -> &Vec<Value> {
    value.as_array().unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

#[test]
fn a_census_finds_both_attractors_and_bounds_the_rest() {
    let known = ["jumper.damping_ratio=0.12", "base.frequency_ratio=0.9"];
    let found = json(
        saltus(&["attractors", "-", "--json"])
            .write_stdin(census())
            .args(sets(&known)),
    );
    assert_eq!(found["parameter"], Value::Null);
    assert_eq!(found["starts_asked"], 128);
    assert_eq!(number(&found["unseen"]), 3.0 / 128.0);
    assert_eq!(list(&found["loops"]).len(), 0);
    let [row] = &list(&found["rows"])[..] else {
        panic!("{found}")
    };
    assert_eq!(row["value"], Value::Null);
    let there = list(&found["attractors"]);
    assert_eq!(there.len(), 2, "two 2-cycles coexist: {there:?}");
    let mut counted = 0;
    // 4096 initial conditions of this box: 97.0 % and 3.0 %
    for (place, (one, true_share)) in there.iter().zip([0.970, 0.030]).enumerate() {
        assert_eq!(one["attractor"], place + 1);
        assert_eq!(one["period"], 2);
        let [share, low, high] = ["share", "share_low", "share_high"].map(|key| number(&one[key]));
        assert!(low < share && share < high);
        assert!(low < true_share && true_share < high, "{low} {high}");
        let section = &list(&found["sections"])[place];
        assert_eq!(section["attractor"], place + 1);
        let z = list(&section["z"][0]);
        assert!(z.len() == 2 && number(&z[0]) < number(&z[1]));
        assert!((0.0..1.0).contains(&number(&one["contact_ratio"][0])));
        assert!(number(&one["peak_reaction"][0]) > 1.0);
        assert_eq!(one["kind"], "periodic");
        assert!((0.0..1.0).contains(&number(&one["multiplier"])));
        assert_eq!(one["watched_motions"], Value::Null);
        counted += one["starts"].as_u64().unwrap();
    }
    let without = ["undecided_starts", "lost_starts"].map(|key| row[key].as_u64().unwrap());
    assert_eq!(counted + without[0] + without[1], 128);
    assert_eq!(row["first_failure_status"], Value::Null);
    assert_eq!(list(&found["transients"]).len(), 0);
}

#[test]
fn chaos_that_ends_is_told_with_its_lifetime_in_every_format() {
    // seven of eight chaotic motions reach the cycle within 12 000 periods
    let known = [
        "jumper.damping_ratio=0.1565",
        "base.frequency_ratio=1.0",
        "attractors.starts=8",
    ];
    let desk = Desk::new();
    let run = |args: &[&str]| {
        let asked = saltus(&["attractors", "-"])
            .write_stdin(census())
            .args(sets(&known))
            .args(args)
            .assert()
            .success();
        String::from_utf8(asked.get_output().stdout.clone()).unwrap()
    };
    let text = run(&["--out", &desk.str("out")]);
    assert!(text.contains("in chaos that ends") && text.contains("counted for 1"));
    assert!(text.contains("stable, largest multiplier 0."), "{text}");
    let found = files(&desk.path("out"));
    let document: Value = serde_json::from_slice(&found["attractors.json"]).unwrap();
    let kinds = list(&document["attractors"]).iter().map(|one| &one["kind"]);
    assert!(kinds.clone().count() > 0 && kinds.clone().all(|kind| kind == "periodic"));
    let [chaos] = &list(&document["transients"])[..] else {
        panic!("{document}")
    };
    assert!(number(&chaos["ended"]) > 0.0 && chaos["motions"] == 8);
    let lifetime = ["lifetime", "lifetime_low", "lifetime_high"];
    let [mean, low, high] = lifetime.map(|key| number(&chaos[key]));
    assert!(low < mean && mean < high && mean < 1e5, "{chaos}");
    let table = String::from_utf8(found["transients.csv"].clone()).unwrap();
    let line = table.lines().last().unwrap();
    assert!(line.contains(&format!(",8,{},", chaos["ended"])), "{line}");
    let names = String::from_utf8_lossy(&found["attractors.nc"]).into_owned();
    assert!(names.contains("transient_lifetime_low") && names.contains("multiplier"));
}

#[test]
fn a_short_sweep_finds_the_known_loop() {
    let found = followed(&Desk::new(), &LOOP, &[]);
    assert_eq!(found["parameter"], "jumper.damping_ratio");
    assert_eq!(found["unfinished"], 0);
    assert_eq!(list(&found["rows"]).len(), 7);
    let [one] = &list(&found["loops"])[..] else {
        panic!("{}", found["loops"])
    };
    let jump = |way: &str| ["low", "high"].map(|end| number(&one[format!("jump_{way}_{end}")]));
    let [up, down] = ["up", "down"].map(jump);
    assert!(down[0] < 0.22 && 0.215 < down[1], "{down:?}");
    assert!(up[0] < 0.283 && 0.278 < up[1], "{up:?}");
    assert_eq!(
        (&one["period_up"], &one["period_down"]),
        (&2.into(), &2.into())
    );
    let [upwards, downwards] = ["up", "down"].map(|key| one[key].as_u64().unwrap());
    let ranges = list(&found["ranges"]);
    assert_eq!(ranges.len(), 2);
    let death = &ranges[upwards as usize - 1];
    assert_eq!(death["death_to"], downwards);
    assert_eq!(
        (&death["death_low"], &death["death_high"]),
        (&one["jump_up_low"], &one["jump_up_high"])
    );
    let birth = &ranges[downwards as usize - 1];
    assert_eq!(birth["birth_to"], upwards);
    assert_eq!(
        (&birth["birth_low"], &birth["birth_high"]),
        (&one["jump_down_low"], &one["jump_down_high"])
    );
    assert_eq!(birth["birth_high"], one["from"]);
}

#[test]
fn samples_of_a_cycle_connect_along_the_parameter() {
    let found = followed(&Desk::new(), &LOOP, &[]);
    let mut pairs = 0;
    for number_ in 1..=2 {
        let its: Vec<&Vec<Value>> = list(&found["sections"])
            .iter()
            .filter(|one| one["attractor"] == number_)
            .map(|one| list(&one["z"][0]))
            .filter(|z| z.len() == 2)
            .collect();
        for pair in its.windows(2) {
            let apart = |other: usize| (number(&pair[0][0]) - number(&pair[1][other])).abs();
            assert!(apart(0) < apart(1), "{pair:?}");
            pairs += 1;
        }
    }
    assert!(pairs > 5, "{pairs}");
}

#[test]
fn one_attractor_has_one_number_and_no_loop() {
    // DP Fig. 2a: period 1 above zeta_h = 0.19; from the highest value to the lowest it is the same
    let alone = [
        "base.frequency_ratio=0.9",
        "attractors.from=0.5",
        "attractors.to=0.2",
        "attractors.count=4",
        "attractors.starts=8",
    ];
    let found = followed(&Desk::new(), &alone, &[]);
    assert_eq!(found["loops"], serde_json::json!([]));
    let [only] = &list(&found["ranges"])[..] else {
        panic!("{}", found["ranges"])
    };
    let expected = serde_json::json!({
        "attractor": 1, "first": 0.2, "last": 0.5,
        "birth_low": null, "birth_high": null, "birth_to": null,
        "death_low": null, "death_high": null, "death_to": null,
    });
    assert_eq!(only, &expected);
    let there = list(&found["attractors"]);
    assert_eq!(there.len(), list(&found["rows"]).len());
    for one in there {
        assert_eq!(one["period"], 1);
        assert_eq!(one["starts"], 8);
    }
}

#[test]
fn out_is_a_whole_folder_and_threads_do_not_change_a_bit() {
    let desk = Desk::new();
    let run = |threads: &str| {
        let name = format!("out-{threads}");
        let out = desk.str(&name);
        let printed = followed(&desk, &LOOP, &["--threads", threads, "--out", &out]);
        (printed, files(&desk.path(&name)))
    };
    let (printed, found) = run("1");
    let names: Vec<&str> = found.keys().map(String::as_str).collect();
    assert_eq!(
        names,
        [
            "attractors.csv",
            "attractors.json",
            "attractors.nc",
            "attractors.pdf",
            "attractors.png",
            "attractors.svg",
            "loops.csv",
            "ranges.csv",
            "rows.csv",
            "saltus-result.json",
            "sections.csv",
            "study.toml",
            "transients.csv",
        ]
    );
    let document: Value = serde_json::from_slice(&found["attractors.json"]).unwrap();
    assert_eq!(document, printed);
    let lines = |name: &str| {
        let text = String::from_utf8(found[name].clone()).unwrap();
        text.lines().filter(|line| !line.starts_with('#')).count() - 1
    };
    let sections = list(&printed["sections"]).iter();
    let samples: usize = sections.map(|one| list(&one["z"][0]).len()).sum();
    for (name, rows) in [
        ("attractors.csv", list(&printed["attractors"]).len()),
        ("sections.csv", samples),
        ("loops.csv", 1),
        ("ranges.csv", 2),
        ("rows.csv", 7),
    ] {
        assert_eq!(lines(name), rows, "{name}");
    }
    let svg = String::from_utf8(found["attractors.svg"].clone()).unwrap();
    for label in [
        "2: 2T",
        "Hysteresis",
        "95 % confidence interval",
        "initial conditions",
    ] {
        assert!(svg.contains(label), "{label}");
    }
    assert!(
        run("2") == (printed, found),
        "two threads write other bytes"
    );
}

#[test]
fn a_census_has_a_figure_and_the_summary_is_for_people() {
    let desk = Desk::new();
    let run = |args: &[&str]| {
        saltus(&["attractors", "-"])
            .write_stdin(census())
            .args(sets(&["attractors.starts=4"]))
            .args(args)
            .assert()
            .success()
            .stderr("")
    };
    run(&["--out", &desk.str("out")]).stdout(
        contains("4 initial conditions")
            .and(contains("100.0 %"))
            .and(contains("95 % confidence"))
            .and(contains("less than 75.0 % of the box")),
    );
    let svg = String::from_utf8(files(&desk.path("out"))["attractors.svg"].clone()).unwrap();
    assert!(svg.contains("Velocity") && svg.contains("Height"));
    run(&["--quiet"]).stdout("");
    let paper = desk.paper();
    let swept = saltus(&["attractors", &paper]).args(sets(&LOOP)).assert();
    swept.success().stdout(
        contains("at each of 7 values of damping ratio ζ_h (-) from 0.205 to 0.295: 2 attractors")
            .and(contains("hysteresis from 0.22 to 0.28")),
    );
}

#[test]
fn two_people_have_lists_of_their_own() {
    let two = "jumper=[\
        { x = 7.0, y = 5.0, mass = 76.64, stiffness = 18600.0, damping_ratio = 0.4 }, \
        { x = 4.0, y = 5.0, mass = 60.0, stiffness = 18600.0, damping_ratio = 0.4 }]";
    let desk = Desk::new();
    let more = [
        two,
        "attractors.parameter=jumper.1.damping_ratio",
        "attractors.from=0.4",
        "attractors.count=2",
        "attractors.starts=2",
    ];
    let found = followed(&desk, &more, &["--out", &desk.str("out")]);
    let (one, section) = (&found["attractors"][0], &found["sections"][0]);
    for key in ["contact_ratio", "peak_reaction"] {
        assert_eq!(list(&one[key]).len(), 2, "{key}");
    }
    for key in ["z", "v"] {
        assert_eq!(list(&section[key]).len(), 2, "{key}");
    }
    assert_eq!(list(&section["z"][0]).len(), list(&section["z"][1]).len());
}

#[test]
fn what_cannot_be_asked_is_refused() {
    let desk = Desk::new();
    let paper = desk.paper();
    for (more, said) in [
        (
            &["attractors.starts=1000000"][..],
            "attractors.starts = 24390 at most",
        ),
        (&["attractors.parameter=start.z"], "attractors.z"),
        (&["attractors.z=[1.0, 0.0]"], "[lowest, highest]"),
        (&["jumper=[]", "base.reference=plate"], "[[jumper]]"),
    ] {
        saltus(&["attractors", &paper])
            .args(sets(more))
            .args(["--out", &desk.str("no")])
            .assert()
            .code(2)
            .stdout("")
            .stderr(contains(said));
    }
    assert_eq!(desk.names(), ["paper.toml"]);
}

#[test]
fn if_all_first_states_are_lost_the_first_reason_is_told() {
    let desk = Desk::new();
    let paper = desk.paper();
    saltus(&["attractors", &paper, "--json", "--out", &desk.str("no")])
        .args(sets(&LOOP))
        .args(["--set", "solver.max_switches=1"])
        .assert()
        .code(1)
        .stdout("")
        .stderr(contains("no initial condition").and(contains("chattering")));
    assert_eq!(desk.names(), ["paper.toml"]);
}
