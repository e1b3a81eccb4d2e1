//! `saltus lyapunov` as its users meet it.

use crate::common::{Desk, files, json, saltus};
use predicates::str::contains;
use serde_json::Value;

/// Seconds of work.
const SMALL: [&str; 6] = [
    "--set",
    "plate.inertia=condensed",
    "--set",
    "lyapunov.transient=300",
    "--set",
    "lyapunov.periods=100",
];

/// zeta_h 0.12 at Omega = 1.0 is chaotic (DP Fig. 2b).
const CHAOS: [&str; 2] = ["--set", "jumper.damping_ratio=0.12"];
/// zeta_h 0.28 at Omega = 1.0 is 2T (DP Fig. 3e).
const CYCLE: [&str; 2] = ["--set", "jumper.damping_ratio=0.28"];
const ONE: [&str; 2] = ["--set", "lyapunov.exponents=1"];

fn lyapunov(desk: &Desk, args: &[&str]) -> Value {
    let paper = desk.paper();
    json(
        saltus(&["lyapunov", &paper, "--json"])
            .args(SMALL)
            .args(args),
    )
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

#[test]
fn chaos_has_a_positive_exponent_and_the_sum_is_the_divergence() {
    // chaos is more growth than leaving an unstable cycle shows, 36 / 0.26 periods of it
    let long = ["--set", "lyapunov.periods=200"];
    let found = lyapunov(&Desk::new(), &[CHAOS, long].concat());
    let exponents = found["exponents"].as_array().unwrap();
    assert_eq!(exponents.len(), 10);
    assert_eq!(found["states"], 10);
    assert_eq!(found["periods_measured"], 1600);
    let largest = &exponents[0];
    let (rate, error) = (
        number(&largest["exponent"]),
        number(&largest["exponent_error"]),
    );
    assert!(error > 0.0 && rate > 4.0 * error, "{rate} {error}");
    let seconds = rate / number(&found["forcing_period"]);
    assert!((number(&largest["exponent_per_second"]) - seconds).abs() < 1e-12);
    assert_eq!(found["nature"], "chaotic");
    assert!(number(&found["confidence"]) > 0.999);
    assert_eq!(found["period"], Value::Null);
    assert_eq!(found["divergence_must_agree"], true);
    // period by period; the tolerance of the run is 1e-10
    assert!(number(&found["divergence_difference"]).abs() < 1e-6);
    let sum: f64 = exponents.iter().map(|e| number(&e["exponent"])).sum();
    assert!((sum - number(&found["divergence"])).abs() < 1e-6);
    // one direction that expands, and less than the whole section
    let dimension = number(&found["kaplan_yorke"]);
    assert!(1.0 < dimension && dimension < 10.0, "{dimension}");
}

#[test]
fn a_cycle_is_periodic_with_its_period() {
    let found = lyapunov(&Desk::new(), &[CYCLE, ONE].concat());
    assert_eq!(found["nature"], "periodic");
    assert_eq!(found["period"], 2);
    assert!(number(&found["exponents"][0]["exponent"]) < 0.0);
    assert_eq!(found["divergence_must_agree"], false);
    assert_eq!(found["divergence_difference"], Value::Null);
    assert_eq!(found["study"]["lyapunov"]["exponents"], 1);
}

/// 800 periods end within a cycle for the columns of a complex pair; multipliers know nothing of that.
#[test]
fn exponents_of_a_cycle_are_those_of_its_orbit() {
    let desk = Desk::new();
    let found = lyapunov(&desk, &CYCLE);
    assert_eq!(found["exponents_from"], "orbit");
    let paper = desk.paper();
    let orbit = json(saltus(&["orbit", &paper, "--json"]).args(SMALL).args(CYCLE));
    let multipliers = orbit["multipliers"].as_array().unwrap();
    let exponents = found["exponents"].as_array().unwrap();
    assert_eq!((exponents.len(), multipliers.len()), (10, 10));
    for (exponent, multiplier) in exponents.iter().zip(multipliers) {
        let modulus = number(&multiplier["modulus"]);
        let (rate, error) = (
            number(&exponent["exponent"]),
            number(&exponent["exponent_error"]),
        );
        assert!(
            (rate - modulus.ln() / 2.0).abs() <= 2.0 * error,
            "{exponent} {modulus}"
        );
        assert!(error < 1e-6, "{exponent}");
    }
    let difference = number(&found["divergence_difference"]);
    assert!(difference.abs() < 1e-8, "{difference}");
}

/// At Omega/omega_h = 1.1, zeta_h = 0.32 two bands mix within hundreds of periods, and the motion from here is a
/// thousand periods in the calmer one. The long-run value, from 96 000 periods, is 0.0704 +- 0.0017 (example `coverage`).
#[test]
fn replicas_of_a_motion_that_mixes_slowly_do_not_see_the_same_band_eight_times() {
    let slow = [
        "--set",
        "base.frequency_ratio=1.1",
        "--set",
        "jumper.damping_ratio=0.32",
        "--set",
        "start.z=3.548",
        "--set",
        "lyapunov.periods=500",
        "--set",
        "lyapunov.transient=400",
    ];
    let found = lyapunov(&Desk::new(), &[slow.as_slice(), &ONE].concat());
    assert_eq!(found["exponents_from"], "record");
    let largest = &found["exponents"][0];
    let end = |key: &str| number(&largest[key]);
    let (low, high) = (end("exponent_low"), end("exponent_high"));
    assert!(low < 0.0704 && 0.0704 < high, "{largest}");
    assert!(high - low < 0.15, "{largest}");
}

#[test]
fn an_empty_plate_settles_to_the_period_of_the_base() {
    let empty = ["--set", "jumper=[]", "--set", "base.reference=plate"];
    let found = lyapunov(&Desk::new(), &[empty.as_slice(), &ONE].concat());
    assert_eq!(found["nature"], "periodic");
    assert_eq!(found["period"], 1);
}

#[test]
fn a_leg_that_forgets_its_length_has_an_exponent_of_minus_infinity() {
    let desk = Desk::new();
    let law = [
        "--set",
        "contact.law=relaxing-leg",
        "--set",
        "lyapunov.periods=20",
    ];
    let found = lyapunov(&desk, &law);
    assert_eq!(found["states"], 11);
    assert_eq!(found["exponents"][10]["exponent"], Value::Null);
    assert_eq!(found["exponents"][10]["exponent_error"], 0.0);
    let reason = found["divergence_text"].as_str().unwrap();
    assert!(reason.contains("forgets its length"), "{reason}");
    saltus(&["lyapunov", &desk.paper()])
        .args(SMALL)
        .args(law)
        .assert()
        .success()
        .stdout(contains("\n      11  -inf"));
}

#[test]
fn more_exponents_than_states_are_refused() {
    saltus(&["lyapunov", &Desk::new().paper()])
        .args(SMALL)
        .args(["--set", "lyapunov.exponents=11"])
        .assert()
        .code(2)
        .stdout("")
        .stderr(contains("lyapunov.exponents = 11"))
        .stderr(contains("10 states"))
        .stderr(contains("1 to 10 would do, or 0 for all"));
}

#[test]
fn out_is_a_folder_with_the_document_the_table_and_the_figure() {
    let desk = Desk::new();
    let out = desk.str("results");
    let args = [
        CHAOS.as_slice(),
        &["--set", "lyapunov.exponents=2", "--out", &out],
    ];
    let printed = lyapunov(&desk, &args.concat());
    let found = files(&desk.path("results"));
    let names: Vec<&str> = found.keys().map(String::as_str).collect();
    assert_eq!(
        names,
        [
            "convergence.csv",
            "convergence.pdf",
            "convergence.png",
            "convergence.svg",
            "lyapunov.json",
            "lyapunov.nc",
            "saltus-result.json",
            "study.toml",
        ]
    );
    let document: Value = serde_json::from_slice(&found["lyapunov.json"]).unwrap();
    assert_eq!(document, printed);
    let table = String::from_utf8(found["convergence.csv"].clone()).unwrap();
    let lines: Vec<&str> = table
        .lines()
        .filter(|line| !line.starts_with('#'))
        .collect();
    assert_eq!(lines[0], "periods,exponent_1,error_1,exponent_2,error_2");
    let last: Vec<f64> = lines[lines.len() - 1]
        .split(',')
        .map(|cell| cell.parse().unwrap())
        .collect();
    let whole = &printed["exponents"][0];
    assert_eq!(last[0], 100.0);
    assert_eq!(last[1], number(&whole["exponent"]));
    assert_eq!(last[2], number(&whole["exponent_error"]));
}

#[test]
fn a_motion_that_ends_has_no_exponents() {
    let desk = Desk::new();
    let out = desk.str("results");
    let chatter = ["--set", "solver.max_switches=1", "--out", &out];
    saltus(&["lyapunov", &desk.paper()])
        .args(SMALL)
        .args(chatter)
        .assert()
        .code(1)
        .stdout("")
        .stderr(contains("chattering"));
    assert_eq!(desk.names(), ["paper.toml"]);
}
