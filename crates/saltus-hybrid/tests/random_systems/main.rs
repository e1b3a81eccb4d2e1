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
use std::io::Write;

use saltus_hybrid::{Method, Options, Recording, Segment, Status, SwitchKind, record};

use case::Case;
use generate::{Kinds, Random};
use plain::{Ending, Run};

/// The kinds that are compared.
const ALL: Kinds = Kinds {
    moved_guards: true,
    on_samples: true,
    wrong_sides: true,
    lasting: true,
    // The series of a product of states is cut where the states' own are: its root is beside that of the states at it by
    // the tolerance, and now and then such a guard fires once more, 1e-12 later.
    curved_guards: true,
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

fn integrate(segment: &Segment, method: Method) -> Recording {
    let options = Options {
        method,
        max_switches: plain::MOST,
        ..Options::default()
    };
    record(segment, &options).unwrap()
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
    let segment = case.segment().map_err(|error| Failure {
        kind: "build",
        found: error.to_string(),
    })?;
    let tangents = tangents(case, &segment, TAYLOR);
    let growth = tangents.iter().fold(1.0, |m: f64, c| m.max(c.abs()));
    if growth > 1e3 {
        return Ok(Verdict::LeftOut("errors grow"));
    }
    for (name, method) in [("taylor", TAYLOR), ("rk4", RK4)] {
        against_plain(name, &integrate(&segment, method), &plain, VALUES * growth)?;
    }
    if plain.ending != Ending::Completed {
        return Ok(Verdict::Agree(Some("no end")));
    }
    against_differences(case, &segment, &tangents, growth).map(Verdict::Agree)
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
fn tangents(case: &Case, segment: &Segment, method: Method) -> Vec<f64> {
    let n = case.rates.len();
    let system = segment.system.with_tangents(n).unwrap();
    let mut start = system.point(&segment.start.modes, &segment.start.x);
    let columns = system.columns_mut(&mut start.x);
    (0..n).for_each(|i| columns[i * n + i] = 1.0);
    let end = integrate(
        &Segment {
            system: system.clone(),
            start,
            periods: segment.periods,
        },
        method,
    );
    system.columns(&end.end.point.x).to_vec()
}

/// Differences of the flow by state `i`, ahead and behind; `None` if a neighbour switches otherwise.
fn differences(segment: &Segment, own: &Recording, i: usize) -> Option<[Vec<f64>; 2]> {
    let sequence = |run: &Recording| -> Vec<_> {
        switches(run)
            .iter()
            .map(|s| (s.unit, s.from, s.to))
            .collect()
    };
    let difference = |by: f64| {
        let mut segment = segment.clone();
        segment.start.x[i] += by;
        let run = integrate(&segment, TAYLOR);
        let alike = run.end.status == Status::Completed && sequence(&run) == sequence(own);
        let pairs = run.end.point.x.iter().zip(&own.end.point.x);
        alike.then(|| pairs.map(|(a, b)| (a - b) / by).collect())
    };
    Some([difference(1e-6)?, difference(-1e-6)?])
}

/// Why tangents could not be compared, if so.
fn against_differences(
    case: &Case,
    segment: &Segment,
    tangents: &[f64],
    growth: f64,
) -> Result<Option<&'static str>, Failure> {
    let n = case.rates.len();
    let own = integrate(segment, TAYLOR);
    for (i, column) in tangents.chunks(n).enumerate() {
        let Some([ahead, behind]) = differences(segment, &own, i) else {
            return Ok(Some("a neighbour switches otherwise"));
        };
        let gap = |a: &[f64], b: &[f64]| {
            a.iter()
                .zip(b)
                .fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()))
        };
        if gap(&ahead[..n], &behind) > 1e-3 * growth {
            return Ok(Some("not smooth"));
        }
        let mean: Vec<f64> = ahead
            .iter()
            .zip(&behind)
            .map(|(a, b)| 0.5 * (a + b))
            .collect();
        // Where the flow has a slight kink at the start, a column is the slope of one of its sides.
        if gap(column, &mean) > 1e-5 * growth + gap(&ahead[..n], &behind) {
            return fail(
                "tangents",
                format!("column {i}: {column:?}\ndifferences: {mean:?}"),
            );
        }
    }
    let rk4 = self::tangents(case, segment, RK4);
    let gap = tangents
        .iter()
        .zip(&rk4)
        .fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
    if gap > 1e-5 * growth {
        return fail("tangents of rk4", format!("{tangents:?}\n{rk4:?}"));
    }
    Ok(None)
}

/// Cases that failed once, and must not again.
const KEPT: &str = include_str!("kept.txt");

/// Makes a failing case small, and writes it to the file of those.
fn keep(case: &Case, failure: &Failure) -> String {
    let same = |other: &Case| check(other).is_err_and(|f| f.kind == failure.kind);
    let small = shrink::shrink(case.clone(), same);
    let found = check(&small).err().map_or(String::new(), |f| f.found);
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/random_systems/kept.txt");
    let mut file = std::fs::OpenOptions::new().append(true).open(path).unwrap();
    write!(file, "\n# {}\n{small}", failure.kind).unwrap();
    format!("{}, kept in {path}:\n\n{small}\n{found}", failure.kind)
}

fn number(name: &str, default: u64) -> u64 {
    std::env::var(name).map_or(default, |text| text.parse().expect("a whole number"))
}

/// `RANDOM_FIRST` and `RANDOM_CASES` try others, or more.
#[test]
fn random_switching_systems_agree_three_ways() {
    let (first, cases) = (number("RANDOM_FIRST", 0), number("RANDOM_CASES", CASES));
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get() as u64);
    let part = |thread: u64| {
        let mut counts: BTreeMap<String, u64> = BTreeMap::new();
        for seed in (first + thread..first + cases).step_by(threads as usize) {
            let case = generate::case(&mut Random(seed), ALL);
            let outcome = match check(&case) {
                Ok(Verdict::Agree(None)) => "agree".to_owned(),
                Ok(Verdict::Agree(Some(why))) => format!("agree, tangents not compared: {why}"),
                Ok(Verdict::LeftOut(why)) => format!("left out: {why}"),
                Err(failure) => panic!("seed {seed}: {}", keep(&case, &failure)),
            };
            *counts.entry(outcome).or_default() += 1;
        }
        counts
    };
    let mut all: BTreeMap<String, u64> = BTreeMap::new();
    std::thread::scope(|scope| {
        let part = &part;
        let workers: Vec<_> = (0..threads).map(|t| scope.spawn(move || part(t))).collect();
        for worker in workers {
            let counts = worker
                .join()
                .unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            for (outcome, count) in counts {
                *all.entry(outcome).or_default() += count;
            }
        }
    });
    for (outcome, count) in &all {
        println!("{count:6} {outcome}");
    }
    if cases < 1000 {
        return; // too few for shares
    }
    let share = |which: &dyn Fn(&str) -> bool| {
        let some = all.iter().filter(|(outcome, _)| which(outcome));
        some.map(|(_, n)| n).sum::<u64>() as f64 / cases as f64
    };
    let not_compared = share(&|outcome| outcome.ends_with("(not compared)"));
    let doubtful = share(&|outcome| outcome.starts_with("left out")) - not_compared;
    let without_tangents = share(&|outcome| outcome.starts_with("agree, tangents"));
    assert!(doubtful < 0.03, "{doubtful:.3} are doubtful");
    assert!(not_compared < 0.15, "{not_compared:.3} are not compared");
    assert!(
        without_tangents < 0.3,
        "{without_tangents:.3} without tangents"
    );
}

#[test]
fn cases_that_failed_once_agree() {
    for text in KEPT.split("\n\n").filter(|text| text.contains("omega")) {
        let case: Case = text.parse().unwrap();
        match check(&case) {
            Ok(Verdict::Agree(_)) => {}
            Ok(Verdict::LeftOut(why)) => panic!("left out: {why}\n{text}"),
            Err(failure) => panic!("{}\n{text}\n{}", failure.kind, failure.found),
        }
    }
}

#[test]
fn a_case_reads_as_it_is_written() {
    for seed in 0..200 {
        let case = generate::case(&mut Random(seed), ALL);
        assert_eq!(case.to_string().parse(), Ok(case));
    }
}
