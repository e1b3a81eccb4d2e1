//! `saltus sweep` as its users meet it.

use crate::common::{Desk, files, json, saltus};
use predicates::prelude::*;
use predicates::str::contains;
use serde_json::Value;

/// Seven values, a few periods each.
const SMALL: [&str; 8] = [
    "--set",
    "plate.inertia=condensed",
    "--set",
    "sweep.count=7",
    "--set",
    "sweep.transient=6",
    "--set",
    "sweep.record=4",
];

fn sweep(desk: &Desk, args: &[&str]) -> Value {
    let paper = desk.paper();
    json(saltus(&["sweep", &paper, "--json"]).args(SMALL).args(args))
}

fn rows(found: &Value) -> &Vec<Value> {
    found["rows"].as_array().unwrap()
}

#[test]
fn json_tells_passes_and_rows() {
    let found = sweep(&Desk::new(), &[]);
    assert_eq!(found["parameter"], "jumper.damping_ratio");
    assert_eq!(found["unit"], "-");
    assert!(found["label"].as_str().unwrap().contains("ζ_h"));
    for (i, direction) in ["up", "down"].into_iter().enumerate() {
        let expected = serde_json::json!({
            "direction": direction, "start_z": 3.0, "start_v": 2.0
        });
        assert_eq!(found["passes"][i], expected);
    }
    let rows = rows(&found);
    assert_eq!(rows.len(), 14);
    for (i, row) in rows.iter().enumerate() {
        assert_eq!(row["direction"], ["up", "down"][i / 7]);
        assert_eq!(
            (&row["start_z"], &row["start_v"]),
            (&3.0.into(), &2.0.into())
        );
        assert_eq!(row["status"], "completed");
        for key in ["z", "v"] {
            assert_eq!(row[key].as_array().unwrap().len(), 1);
            assert_eq!(row[key][0].as_array().unwrap().len(), 4);
            assert!(row[key][0][3].is_f64());
        }
        assert!(row["label"].is_string() && row.get("recurrence").is_none());
        assert_eq!(row["period"].is_u64(), row["label"] == "periodic");
        let ratio = row["contact_ratio"][0].as_f64().unwrap();
        assert!((0.0..=1.0).contains(&ratio), "{ratio}");
    }
    for pass in [0, 7] {
        assert_eq!(rows[pass]["value"], 0.1);
        assert_eq!(rows[pass + 6]["value"], 0.5);
    }
}

#[test]
fn the_state_is_carried_on_or_begun_anew() {
    let desk = Desk::new();
    let anew = [
        "--set",
        "sweep.direction=restarts",
        "--set",
        "sweep.starts=[[3.0, 2.0], [-1.0, 0.0]]",
    ];
    let (both, restarts) = (sweep(&desk, &[]), sweep(&desk, &anew));
    assert_eq!(restarts["passes"][1]["direction"], "start -1 0");
    assert_eq!(restarts["passes"][1]["start_z"], -1.0);
    assert_eq!(restarts["passes"][1]["start_v"], 0.0);
    let z = |found: &Value, row: usize| rows(found)[row]["z"].clone();
    // all begin from the first start where nothing was carried on yet
    assert_eq!(z(&both, 0), z(&restarts, 0));
    assert_eq!(z(&both, 13), z(&restarts, 6));
    assert_ne!(z(&both, 1), z(&restarts, 1));
    assert_ne!(z(&restarts, 0), z(&restarts, 7));
}

#[test]
fn a_row_is_what_simulate_gives() {
    let desk = Desk::new();
    let anew = ["--set", "sweep.direction=restarts"];
    let swept = sweep(&desk, &anew);
    let paper = desk.paper();
    let last = &rows(&swept)[6];
    let mut run = saltus(&["simulate", &paper, "--json", "--periods", "10"]);
    run.args([
        "--set",
        "plate.inertia=condensed",
        "--set",
        "jumper.damping_ratio=0.5",
    ]);
    let run = json(&mut run);
    for (sample, period) in (6..10).enumerate() {
        let point = &run["section"][period];
        assert_eq!(last["z"][0][sample], point["z"][0], "the same bits");
        assert_eq!(last["v"][0][sample], point["v"][0]);
    }
}

#[test]
fn threads_do_not_change_a_bit() {
    let desk = Desk::new();
    let paper = desk.paper();
    let ways = [
        ["--set", "sweep.direction=both"],
        ["--set", "sweep.direction=restarts"],
    ];
    for (way, set) in ways.iter().enumerate() {
        let run = |threads: &str| {
            let name = format!("out-{way}-{threads}");
            let mut command = saltus(&["sweep", &paper, "--json", "--threads", threads]);
            command
                .args(SMALL)
                .args(set)
                .args(["--out", &desk.str(&name)]);
            let printed = command.assert().success().get_output().stdout.clone();
            (printed, files(&desk.path(&name)))
        };
        let one = run("1");
        assert_eq!(one.1.len(), 9, "{:?}", one.1.keys());
        for threads in ["2", "3"] {
            let more = run(threads);
            assert!(more.0 == one.0, "{threads} threads print another document");
            assert!(more.1 == one.1, "{threads} threads write other files");
        }
    }
}

#[test]
fn out_is_a_whole_folder() {
    let desk = Desk::new();
    let out = desk.str("results");
    let printed = sweep(&desk, &["--out", &out]);
    let found = files(&desk.path("results"));
    let names: Vec<&str> = found.keys().map(String::as_str).collect();
    assert_eq!(
        names,
        [
            "bifurcation.pdf",
            "bifurcation.png",
            "bifurcation.svg",
            "rows.csv",
            "saltus-result.json",
            "study.toml",
            "sweep.csv",
            "sweep.json",
            "sweep.nc",
        ]
    );
    assert_eq!(
        serde_json::from_slice::<Value>(&found["sweep.json"]).unwrap(),
        printed
    );
    let lines = |name: &str| {
        let text = String::from_utf8(found[name].clone()).unwrap();
        text.lines().filter(|line| !line.starts_with('#')).count()
    };
    assert_eq!(lines("sweep.csv"), 1 + 14 * 4);
    assert_eq!(lines("rows.csv"), 1 + 14);
}

/// Chaos, 4T and 2T at the frequency ratio 1.0 (DP Fig. 2b).
const THREE: [&str; 14] = [
    "--set",
    "sweep.from=0.12",
    "--set",
    "sweep.to=0.3",
    "--set",
    "sweep.count=3",
    "--set",
    "sweep.transient=300",
    "--set",
    "sweep.direction=restarts",
    "--set",
    "sweep.starts=[[3.0, 2.0]]",
    "--set",
    "sweep.exponent_periods=60",
];

#[test]
fn motions_have_labels_and_only_doubtful_ones_an_exponent() {
    let found = sweep(&Desk::new(), &THREE);
    let [chaos, cycles @ ..] = &rows(&found)[..] else {
        panic!("{found}")
    };
    assert_eq!(chaos["label"], "chaotic");
    assert!(chaos["confidence"].as_f64().unwrap() >= 0.999);
    assert!(chaos["exponent"][0].as_f64().unwrap() > 0.0);
    for (cycle, period) in cycles.iter().zip([4, 2]) {
        assert_eq!(
            (&cycle["label"], &cycle["period"]),
            (&"periodic".into(), &period.into())
        );
        assert_eq!(cycle["confidence"], Value::Null);
        assert_eq!(cycle["exponent"], serde_json::json!([]));
    }
    let desk = Desk::new();
    let paper = desk.paper();
    let text = saltus(&["sweep", &paper]).args(SMALL).args(THREE).assert();
    text.success()
        .stdout(contains("1 x 2T, 1 x 4T, 1 chaotic\n"));
}

#[test]
fn exponents_are_followed_along_each_pass() {
    let desk = Desk::new();
    let out = desk.str("results");
    let more = [
        "--set",
        "sweep.direction=both",
        "--set",
        "sweep.exponents=2",
        "--out",
        &out,
    ];
    let found = sweep(&desk, &[&THREE[..], &more].concat());
    for row in rows(&found) {
        let [exponents, errors] = ["exponent", "error"].map(|key| row[key].as_array().unwrap());
        assert_eq!((exponents.len(), errors.len()), (2, 2));
        assert!(errors.iter().all(|error| error.as_f64().unwrap() > 0.0));
        let largest = exponents[0].as_f64().unwrap();
        assert_eq!(row["label"] == "chaotic", largest > 0.0, "{row}");
    }
    let folder = files(&desk.path("results"));
    let table = String::from_utf8(folder["rows.csv"].clone()).unwrap();
    assert!(table.contains("status_text,exponent_1,error_1,exponent_2,error_2"));
    let svg = String::from_utf8(folder["exponents.svg"].clone()).unwrap();
    for words in ["rising", "falling", "Chaotic", "Zero"] {
        assert!(svg.contains(words), "{words}");
    }
}

#[test]
fn more_exponents_than_states_are_refused_by_key() {
    let desk = Desk::new();
    let paper = desk.paper();
    saltus(&["sweep", &paper])
        .args(SMALL)
        .args(["--set", "sweep.exponents=11"])
        .assert()
        .code(2)
        .stderr(contains("sweep.exponents = 11").and(contains("10 states")));
}

#[test]
fn several_jumpers_have_lists_of_their_own() {
    let two = "jumper=[\
        { x = 7.0, y = 5.0, mass = 76.64, stiffness = 18600.0, damping_ratio = 0.3 }, \
        { x = 4.0, y = 5.0, mass = 60.0, stiffness = 18600.0, damping_ratio = 0.3 }]";
    let one = "sweep.parameter=jumper.1.damping_ratio";
    let found = sweep(&Desk::new(), &["--set", two, "--set", one]);
    let row = &rows(&found)[13];
    assert_eq!(row["z"].as_array().unwrap().len(), 2);
    assert_eq!(row["z"][1].as_array().unwrap().len(), 4);
    assert_eq!(row["contact_ratio"].as_array().unwrap().len(), 2);
}

#[test]
fn parameters_of_plate_and_base_can_change() {
    let desk = Desk::new();
    for (parameter, from, to) in [
        ("plate.thickness", "0.09", "0.11"),
        ("plate.poisson_ratio", "0", "0.3"),
        ("base.frequency_ratio", "0.9", "1.1"),
        ("base.amplitude", "0", "0.013"),
        ("jumper.x", "3", "7"),
    ] {
        let sets = [
            format!("sweep.parameter={parameter}"),
            format!("sweep.from={from}"),
            format!("sweep.to={to}"),
        ];
        let args = sets
            .iter()
            .flat_map(|set| ["--set", set])
            .collect::<Vec<_>>();
        let found = sweep(&desk, &args);
        assert!(
            rows(&found).iter().all(|row| row["status"] == "completed"),
            "{parameter}"
        );
        assert_ne!(rows(&found)[0]["z"], rows(&found)[6]["z"], "{parameter}");
    }
}

#[test]
fn a_value_that_fails_is_a_row_that_says_so() {
    let desk = Desk::new();
    // with little damping people meet the floor more than twice in a period
    let few = [
        "--set",
        "solver.max_switches=2",
        "--set",
        "sweep.direction=restarts",
    ];
    let long = ["--set", "sweep.transient=40"];
    let found = sweep(&desk, &[few.as_slice(), &long].concat());
    let with = |status: &str| {
        rows(&found)
            .iter()
            .filter(|row| row["status"] == status)
            .count()
    };
    assert!(with("completed") > 0 && with("chattering") > 0);
    assert_eq!(with("completed") + with("chattering"), 21);
    let failed = rows(&found)
        .iter()
        .find(|row| row["status"] == "chattering")
        .unwrap();
    assert!(
        failed["status_text"]
            .as_str()
            .unwrap()
            .contains("solver.max_switches")
    );
}

#[test]
fn if_all_values_fail_the_first_reason_is_told() {
    let desk = Desk::new();
    let paper = desk.paper();
    saltus(&["sweep", &paper, "--json", "--out", &desk.str("no")])
        .args(SMALL)
        .args(["--set", "solver.max_switches=1"])
        .assert()
        .code(1)
        .stdout("")
        .stderr(contains("no value").and(contains("chattering")));
    assert_eq!(desk.names(), ["paper.toml"]);
}

#[test]
fn a_question_that_is_missing_or_makes_no_sense_ends_with_2() {
    let desk = Desk::new();
    let text = std::fs::read_to_string(desk.path("paper.toml")).unwrap();
    let (without, _) = text.split_once("\n[sweep]").unwrap();
    saltus(&["sweep", "-"])
        .write_stdin(without)
        .assert()
        .code(2)
        .stdout("")
        .stderr(contains("no [sweep] table").and(contains("parameter = \"jumper.damping_ratio\"")));
    let paper = desk.paper();
    for (sets, said) in [
        (&["sweep.parameter=start.z"][..], "sweep.starts"),
        (
            &[
                "sweep.parameter=solver.tolerance",
                "sweep.from=1e-9",
                "sweep.to=1e-8",
            ],
            "saltus simulate",
        ),
        (&["jumper=[]", "base.reference=plate"], "[[jumper]]"),
    ] {
        let sets = sets.iter().flat_map(|set| ["--set", set]);
        saltus(&["sweep", &paper])
            .args(SMALL)
            .args(sets)
            .assert()
            .code(2)
            .stdout("")
            .stderr(contains(said));
    }
}

#[test]
fn the_summary_is_for_people() {
    let desk = Desk::new();
    let paper = desk.paper();
    let run = |more: &[&str]| saltus(&["sweep", &paper]).args(SMALL).args(more).assert();
    run(&[]).success().stderr("").stdout(
        contains("7 values")
            .and(contains("damping ratio ζ_h (-)"))
            .and(contains("up from [3, 2]"))
            .and(contains("down from [3, 2]")),
    );
    run(&["--quiet"]).success().stderr("").stdout("");
}
