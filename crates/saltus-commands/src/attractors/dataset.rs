//! Attractors as a dataset for xarray and its like: numbers of each over value and attractor, and the sections of
//! all motions one after the other.

use super::Run;
use super::evidence::Passing;
use super::report::{Attractor, Report, Row, Share};
use crate::dataset::motion::{HEIGHT, VELOCITY, jumpers};
use crate::dataset::{about, coordinate, name, numbered, padded, values, variable, wholes};
use crate::per_jumper::PerJumper;
use saltus_results::Dataset;

pub(super) fn dataset(run: &Run, report: &Report) -> Dataset {
    let mut set = about(
        "Coexisting attractors of people on a vibrating plate",
        &run.study,
    )
    .coordinate(jumpers(run.study.jumper.len()))
    .coordinate(numbered(
        "attractor",
        1,
        report.attractors.len(),
        "Number of the attractor, which stays along the parameter",
    ));
    if let Some(parameter) = &run.parameter {
        let found: Vec<f64> = run.found.rows.iter().map(|row| row.value).collect();
        set = set.coordinate(coordinate(parameter, &found));
    }
    set = shares(set, run, report);
    set = sections(set, run, report);
    set = transients(set, run, report);
    loops(set, run, report)
}

/// Chaos that ends.
fn transients(set: Dataset, run: &Run, report: &Report) -> Dataset {
    let rows = report.rows.iter();
    let all: Vec<(&Row, &Passing)> = rows
        .flat_map(|row| row.transients.iter().map(move |one| (row, one)))
        .collect();
    let over = ["transient"];
    let mut set = set.dimension(over[0], all.len());
    if let Some(parameter) = &run.parameter {
        let at = all.iter().map(|(row, _)| row.value.unwrap_or(f64::NAN));
        let name = format!("transient_{}", name(parameter));
        set = set.variable(values(name, &over, parameter, at.collect()));
    }
    let counts: [Quantity<Count>; 4] = [
        (
            "transient_starts",
            |one| one.drawn.starts,
            (
                "First states that were in it when their search was over",
                "1",
            ),
        ),
        (
            "transient_attractor",
            |one| one.to as u64,
            (
                "Attractor that they count for: most watched motions ended on it",
                "1",
            ),
        ),
        (
            "transient_ended",
            |one| one.watched.ended.into(),
            ("Watched motions that left it", "1"),
        ),
        (
            "transient_periods",
            |one| one.watched.periods,
            ("Forcing periods of chaos of all watched motions", "1"),
        ),
    ];
    for (name, of, meaning) in counts {
        let counts = wholes(all.iter().map(|(_, one)| of(one)));
        set = set.variable(variable(name, &over, counts, meaning));
    }
    let lifetimes = [
        ("transient_lifetime", "Mean lifetime in forcing periods"),
        (
            "transient_lifetime_low",
            "Lower end of its 95 % confidence interval",
        ),
        (
            "transient_lifetime_high",
            "Upper end of its 95 % confidence interval",
        ),
    ];
    for (part, (name, meaning)) in lifetimes.into_iter().enumerate() {
        let periods = |(_, one): &(&Row, &Passing)| one.watched.lifetime[part].unwrap_or(f64::NAN);
        let periods: Vec<f64> = all.iter().map(periods).collect();
        set = set.variable(variable(name, &over, periods, (meaning, "1")));
    }
    set
}

/// Name of the dimension of values, if there is one.
fn value(run: &Run) -> Option<String> {
    run.parameter.as_ref().map(name)
}

/// Name, how to take it, long name and unit.
type Quantity<F> = (&'static str, F, (&'static str, &'static str));
type Number = fn(&Attractor) -> f64;
type Bodies = fn(&Attractor) -> &PerJumper<f64>;
type Rest = fn(&Row) -> Share;
type Count = fn(&Passing) -> u64;

const NUMBERS: [Quantity<Number>; 8] = [
    (
        "multiplier",
        |a| a.evidence.multiplier.unwrap_or(f64::NAN),
        ("Largest modulus of the Floquet multipliers of a cycle", "1"),
    ),
    (
        "exponent",
        |a| a.evidence.exponent.unwrap_or(f64::NAN),
        (
            "Largest Lyapunov exponent per forcing period, where there is no cycle",
            "1",
        ),
    ),
    (
        "exponent_error",
        |a| a.evidence.exponent_error.unwrap_or(f64::NAN),
        ("Standard error of exponent", "1"),
    ),
    (
        "lifetime_low",
        |a| {
            let survival = a.evidence.survival;
            let low = survival.and_then(|watched| watched.lifetime[1]);
            low.unwrap_or(f64::NAN)
        },
        (
            "Forcing periods that the mean lifetime of chaos exceeds with 95 % confidence",
            "1",
        ),
    ),
    (
        "share",
        |a| a.drawn.share[0],
        ("Share of the first states", "1"),
    ),
    (
        "share_low",
        |a| a.drawn.share[1],
        ("Lower end of its 95 % confidence interval", "1"),
    ),
    (
        "share_high",
        |a| a.drawn.share[2],
        ("Upper end of its 95 % confidence interval", "1"),
    ),
    (
        "peak_acceleration",
        |a| a.peak_acceleration,
        (
            "Largest absolute vertical acceleration of the floor under the first jumper",
            "m s-2",
        ),
    ),
];

const BODIES: [Quantity<Bodies>; 2] = [
    (
        "contact_ratio",
        |a| &a.contact_ratio,
        ("Part of the time on the floor", "1"),
    ),
    (
        "peak_reaction",
        |a| &a.peak_reaction,
        ("Largest plate reaction force over body weight", "1"),
    ),
];

const REST: [Quantity<Rest>; 2] = [
    (
        "undecided",
        |row| row.undecided,
        ("Share of the first states left undecided", "1"),
    ),
    (
        "lost",
        |row| row.lost,
        ("Share of the first states without a long-term motion", "1"),
    ),
];

/// What is known of each attractor at each value; NaN where it was not met.
fn shares(mut set: Dataset, run: &Run, report: &Report) -> Dataset {
    let (value, people) = (value(run), run.study.jumper.len());
    let value: Vec<&str> = value.as_deref().into_iter().collect();
    let cell = [&value[..], &["attractor"]].concat();
    let body = [&cell[..], &["jumper"]].concat();
    let met = |row: &'_ Row, number| row.attractors.iter().position(|a| a.number == number);
    let each = report.rows.iter().flat_map(|row| {
        let numbers = report.attractors.iter().map(|span| span.number);
        numbers.map(|number| met(row, number).map(|at| &row.attractors[at]))
    });
    let each: Vec<Option<&Attractor>> = each.collect();
    let whole = |of: fn(&Attractor) -> u64| wholes(each.iter().map(|a| a.map_or(0, of)));
    set = set
        .variable(variable(
            "starts",
            &cell,
            whole(|a| a.drawn.starts),
            ("First states that lead to it", "1"),
        ))
        .variable(variable(
            "kind",
            &cell,
            whole(|a| a.evidence.code()),
            (
                "0 not met, 1 periodic, 2 quasi-periodic, 3 chaotic, 4 not periodic",
                "1",
            ),
        ))
        .variable(variable(
            "period",
            &cell,
            whole(|a| a.period.unwrap_or(0).into()),
            (
                "Period in forcing periods, 0 where it has none or was not met",
                "1",
            ),
        ));
    for (name, of, meaning) in NUMBERS {
        let numbers: Vec<f64> = each.iter().map(|a| a.map_or(f64::NAN, of)).collect();
        set = set.variable(variable(name, &cell, numbers, meaning));
    }
    for (name, of, meaning) in BODIES {
        let none: &[f64] = &[];
        let all = each.iter().map(|a| a.map_or(none, |a| of(a).as_slice()));
        let numbers: Vec<f64> = all.flat_map(|bodies| padded(bodies, people)).collect();
        set = set.variable(variable(name, &body, numbers, meaning));
    }
    for (name, of, meaning) in REST {
        let numbers: Vec<f64> = report.rows.iter().map(|row| of(row).share[0]).collect();
        set = set.variable(variable(name, &value, numbers, meaning));
    }
    set
}

/// The section of each attractor at each value where it was met: the points of a bifurcation diagram.
fn sections(mut set: Dataset, run: &Run, report: &Report) -> Dataset {
    let over = ["motion", "jumper", "sample"];
    let met = || {
        report
            .rows
            .iter()
            .flat_map(|row| row.attractors.iter().map(move |a| (row, a)))
    };
    let lengths = met().flat_map(|(_, a)| a.z.as_slice().iter().map(Vec::len));
    let longest = lengths.max().unwrap_or(0);
    let samples = |of: fn(&Attractor) -> &PerJumper<Vec<f64>>| -> Vec<f64> {
        let bodies = met().flat_map(|(_, a)| of(a).as_slice());
        bodies.flat_map(|body| padded(body, longest)).collect()
    };
    let numbers = wholes(met().map(|(_, a)| a.number));
    set = set
        .coordinate(numbered(
            "motion",
            0,
            numbers.len(),
            "Attractors of all values",
        ))
        .coordinate(numbered(
            "sample",
            1,
            longest,
            "Samples of a cycle connect along the parameter",
        ))
        .variable(variable(
            "motion_attractor",
            &over[..1],
            numbers,
            ("Number of the attractor", "1"),
        ))
        .variable(variable("z", &over, samples(|a| &a.z), HEIGHT))
        .variable(variable("v", &over, samples(|a| &a.v), VELOCITY));
    if let Some(parameter) = &run.parameter {
        let at = met()
            .map(|(row, _)| row.value.unwrap_or(f64::NAN))
            .collect();
        let name = format!("motion_{}", name(parameter));
        set = set.variable(values(name, &over[..1], parameter, at));
    }
    set
}

/// Loops of hysteresis; none without a parameter.
fn loops(set: Dataset, run: &Run, report: &Report) -> Dataset {
    let Some(parameter) = &run.parameter else {
        return set;
    };
    let (over, all) = (["loop"], &report.loops);
    let [up, down] = [
        wholes(all.iter().map(|l| l.up)),
        wholes(all.iter().map(|l| l.down)),
    ];
    let from = all.iter().map(|found| found.from).collect();
    let to = all.iter().map(|found| found.to).collect();
    set.dimension(over[0], all.len())
        .variable(values("loop_from", &over, parameter, from))
        .variable(values("loop_to", &over, parameter, to))
        .variable(variable(
            "loop_up",
            &over,
            up,
            ("Attractor of a motion carried upwards", "1"),
        ))
        .variable(variable(
            "loop_down",
            &over,
            down,
            ("Attractor of a motion carried downwards", "1"),
        ))
}
