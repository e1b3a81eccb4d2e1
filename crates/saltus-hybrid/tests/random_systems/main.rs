//! Random small switching systems, three ways: Taylor series, Runge-Kutta with located switches, and a plain
//! stepper that knows nothing of the engine. Values, switches, and tangents against differences.
//!
//! A case that fails is made small and added to `kept.txt`, which is run first ever after.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod case;
mod generate;
mod plain;
mod shrink;

use std::collections::BTreeMap;

use saltus_hybrid::{Leg, Method, Options, Recording, Status, SwitchKind, record};

use case::Case;
use generate::{Kinds, Random};
use plain::{Ending, Run};

/// Every kind there is.
const ALL: Kinds = Kinds {
    moved_guards: true,
    on_samples: true,
    wrong_sides: true,
    lasting: true,
};

/// Cases in a run: unoptimised code is a hundred times slower.
const CASES: u64 = if cfg!(debug_assertions) { 60 } else { 3000 };

/// Taylor at 1e-13 against the plain stepper, for each unit of growth of the tangents: 600 steps of RK4 in a period
/// of at most 10.5 make (0.0175)^4/120 = 8e-10 at rates near 1, and several times that for cubic forces.
const VALUES: f64 = 3e-7;

/// A failure: its kind, and what was found.
#[derive(Debug)]
struct Failure {
    kind: &'static str,
    found: String,
}

fn fail<T>(kind: &'static str, found: String) -> Result<T, Failure> {
    Err(Failure { kind, found })
}

/// What became of a case.
enum Verdict {
    /// Values and switches agree, and tangents unless there is a reason.
    Agree(Option<&'static str>),
    LeftOut(&'static str),
}

fn integrate(leg: &Leg, method: Method) -> Recording {
    let options = Options {
        method,
        max_switches: plain::MOST,
        ..Options::default()
    };
    record(leg, &options).unwrap()
}

const TAYLOR: Method = Method::Taylor {
    tolerance: 1e-14,
    order: 20,
};
const RK4: Method = Method::Rk4 {
    steps_per_period: plain::STEPS,
};

/// The switches, without tangencies.
fn switches(run: &Recording) -> Vec<plain::Switch> {
    let known = run.switches.iter().filter_map(|s| match s.kind {
        SwitchKind::Mode { from, to } => Some(plain::Switch {
            time: s.time,
            unit: s.unit,
            from,
            to,
        }),
        SwitchKind::Tangency => None,
    });
    known.collect()
}

fn check(case: &Case) -> Result<Verdict, Failure> {
    let plain = match plain::run(case, false) {
        Ok(plain) => plain,
        Err(doubt) => return Ok(Verdict::LeftOut(doubt)),
    };
    if plain.tie {
        match plain::run(case, true) {
            Ok(other) if other.samples == plain.samples => {}
            Err(doubt) => return Ok(Verdict::LeftOut(doubt)),
            Ok(_) => {
                return Ok(Verdict::LeftOut(
                    "two switches at once, and their order matters",
                ));
            }
        }
    }
    let leg = case.leg().map_err(|error| Failure {
        kind: "build",
        found: error.to_string(),
    })?;
    let tangents = tangents(case, &leg, TAYLOR);
    let growth = tangents.iter().fold(1.0, |m: f64, c| m.max(c.abs()));
    if growth > 1e3 {
        return Ok(Verdict::LeftOut("errors grow"));
    }
    for (name, method) in [("taylor", TAYLOR), ("rk4", RK4)] {
        against_plain(name, &integrate(&leg, method), &plain, VALUES * growth)?;
    }
    if plain.ending != Ending::Completed {
        return Ok(Verdict::Agree(Some("no end")));
    }
    against_differences(case, &leg, &tangents, growth).map(Verdict::Agree)
}

fn against_plain(
    name: &'static str,
    run: &Recording,
    plain: &Run,
    tolerance: f64,
) -> Result<(), Failure> {
    let found = switches(run);
    let show = || {
        format!(
            "{name}: {:?}\n  {:?}\n  {:?}\nplain: {:?}\n  {:?}\n  {:?}",
            run.end.status,
            &found[..found.len().min(8)],
            run.samples,
            plain.ending,
            plain.switches,
            plain.samples
        )
    };
    match (&run.end.status, &plain.ending) {
        (Status::Completed, Ending::Completed) => {}
        (Status::Chattering { time, .. }, Ending::Chattering(expected))
            if (time - expected).abs() < 1e-3 =>
        {
            return Ok(());
        }
        _ => return fail("status", show()),
    }
    let same = |(a, b): (&plain::Switch, &plain::Switch)| {
        (a.time - b.time).abs() < 100.0 * tolerance
            && (a.unit, a.from, a.to) == (b.unit, b.from, b.to)
    };
    let equal = found.len() == plain.switches.len();
    if !equal || !plain.tie && !found.iter().zip(&plain.switches).all(same) {
        return fail("switches", show());
    }
    for (point, (modes, x)) in run.samples.iter().zip(&plain.samples) {
        let near = x
            .iter()
            .zip(&point.x)
            .all(|(a, b)| (a - b).abs() < tolerance);
        if point.modes != *modes || !near {
            return fail("values", show());
        }
    }
    Ok(())
}

/// Columns of the derivative of the end by the start, one after the other.
fn tangents(case: &Case, leg: &Leg, method: Method) -> Vec<f64> {
    let n = case.rates.len();
    let system = leg.system.with_tangents(n).unwrap();
    let mut start = system.point(&leg.start.modes, &leg.start.x);
    let columns = system.columns_mut(&mut start.x);
    (0..n).for_each(|i| columns[i * n + i] = 1.0);
    let end = integrate(
        &Leg {
            system: system.clone(),
            start,
            periods: leg.periods,
        },
        method,
    );
    system.columns(&end.end.point.x).to_vec()
}

/// Central differences of the flow by state `i`; `None` if a neighbour switches otherwise.
fn difference(leg: &Leg, i: usize, by: f64, n: usize) -> Option<Vec<f64>> {
    let sequence = |run: &Recording| -> Vec<_> {
        switches(run)
            .iter()
            .map(|s| (s.unit, s.from, s.to))
            .collect()
    };
    let near = [-by, by].map(|by| {
        let mut leg = leg.clone();
        leg.start.x[i] += by;
        integrate(&leg, TAYLOR)
    });
    let [behind, ahead] = &near;
    let own = sequence(&integrate(leg, TAYLOR));
    let alike = near
        .iter()
        .all(|run| run.end.status == Status::Completed && sequence(run) == own);
    let slope = |j: usize| (ahead.end.point.x[j] - behind.end.point.x[j]) / (2.0 * by);
    alike.then(|| (0..n).map(slope).collect())
}

/// Why tangents could not be compared, if so.
fn against_differences(
    case: &Case,
    leg: &Leg,
    tangents: &[f64],
    growth: f64,
) -> Result<Option<&'static str>, Failure> {
    let n = case.rates.len();
    for (i, column) in tangents.chunks(n).enumerate() {
        let [wide, narrow] = [2e-6, 1e-6].map(|by| difference(leg, i, by, n));
        let (Some(wide), Some(narrow)) = (wide, narrow) else {
            return Ok(Some("a neighbour switches otherwise"));
        };
        let gap = |a: &[f64], b: &[f64]| {
            a.iter()
                .zip(b)
                .fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()))
        };
        if gap(&wide, &narrow) > 1e-6 * growth {
            return Ok(Some("differences are not accurate"));
        }
        if gap(column, &narrow) > 1e-5 * growth {
            return fail(
                "tangents",
                format!("column {i}: {column:?}\ndifferences: {narrow:?}"),
            );
        }
    }
    let rk4 = self::tangents(case, leg, RK4);
    let gap = tangents
        .iter()
        .zip(&rk4)
        .fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
    if gap > 1e-5 * growth {
        return fail("tangents of rk4", format!("{tangents:?}\n{rk4:?}"));
    }
    Ok(None)
}

#[test]
fn survey() {
    let mut counts: BTreeMap<String, (u64, Option<String>)> = BTreeMap::new();
    let first: u64 = std::env::var("FIRST").map_or(0, |s| s.parse().unwrap());
    let cases: u64 = std::env::var("CASES").map_or(CASES, |s| s.parse().unwrap());
    for seed in first..first + cases {
        let case = generate::case(&mut Random(seed), ALL);
        let (key, text) = match check(&case) {
            Ok(Verdict::Agree(None)) => ("agree".to_owned(), None),
            Ok(Verdict::Agree(Some(why))) => (format!("agree, but tangents: {why}"), None),
            Ok(Verdict::LeftOut(why)) => (format!("left out: {why}"), None),
            Err(failure) => {
                let new = !counts.contains_key(&format!("FAIL {}", failure.kind))
                    || std::env::var("EACH").is_ok();
                let text = new.then(|| {
                    let same = |c: &Case| check(c).is_err_and(|f| f.kind == failure.kind);
                    let small = shrink::shrink(case, same);
                    let f = check(&small).err().unwrap();
                    format!("seed {seed}\n{small}{}\n", f.found)
                });
                (format!("FAIL {}", failure.kind), text)
            }
        };
        let entry = counts.entry(key).or_default();
        entry.0 += 1;
        if let Some(text) = text {
            println!("---- {text}");
        }
    }
    for (key, (count, _)) in counts {
        println!("{count:6} {key}");
    }
}
