//! Ranges of attractors along the parameter, and loops of hysteresis.

use super::Found;
use crate::data::{Of, values, wholes, without};
use crate::quantities as q;
use saltus::study::{AttractorRange, Hysteresis, Range, RangeEnd};
use saltus_results::{Dataset, Table};

const RANGES: [Of<AttractorRange, f64>; 6] = [
    (q::FIRST, |one| one.first),
    (q::LAST, |one| one.last),
    (q::BIRTH_LOW, |one| end(between(one.birth), 0)),
    (q::BIRTH_HIGH, |one| end(between(one.birth), 1)),
    (q::DEATH_LOW, |one| end(between(one.death), 0)),
    (q::DEATH_HIGH, |one| end(between(one.death), 1)),
];

const BEYOND: [Of<AttractorRange, usize>; 2] = [
    (q::BIRTH_TO, |one| beyond(one.birth)),
    (q::DEATH_TO, |one| beyond(one.death)),
];

/// Begin and end of each attractor, and the attractor that its motion jumps to beyond.
pub(super) fn ranges(set: Dataset, found: &Found) -> Dataset {
    let (over, all) = ("attractor", &found.all.identities);
    let set = counts(
        values_of(set, found, over, all, &RANGES),
        over,
        all,
        &BEYOND,
    );
    set.table(
        Table::new("ranges", &[over])
            .columns(&["attractor", "first", "last"])
            .columns(&["birth_low", "birth_high", "birth_to"])
            .columns(&["death_low", "death_high", "death_to"]),
    )
}

const LOOPS: [Of<Hysteresis, f64>; 6] = [
    (q::LOOP_FROM, |one| one.from),
    (q::LOOP_TO, |one| one.to),
    (q::LOOP_JUMP_UP_LOW, |one| end(one.jump_up, 0)),
    (q::LOOP_JUMP_UP_HIGH, |one| end(one.jump_up, 1)),
    (q::LOOP_JUMP_DOWN_LOW, |one| end(one.jump_down, 0)),
    (q::LOOP_JUMP_DOWN_HIGH, |one| end(one.jump_down, 1)),
];

const WAYS: [Of<Hysteresis, usize>; 4] = [
    (q::LOOP_UP, |one| one.up + 1),
    (q::LOOP_DOWN, |one| one.down + 1),
    (q::LOOP_PERIOD_UP, |one| {
        one.kinds.0.period().unwrap_or(0) as usize
    }),
    (q::LOOP_PERIOD_DOWN, |one| {
        one.kinds.1.period().unwrap_or(0) as usize
    }),
];

/// Loops of hysteresis; none without a parameter.
pub(super) fn loops(set: Dataset, found: &Found) -> Dataset {
    let (over, all) = ("loop", &found.all.loops);
    let set = set.dimension(over, all.len());
    let set = counts(values_of(set, found, over, all, &LOOPS), over, all, &WAYS);
    let table = Table::new("loops", &[over]);
    let table = without("loop_", table, &["from", "to", "up", "down"]);
    let table = without("loop_", table, &["period_up", "period_down"]);
    let table = without("loop_", table, &["jump_up_low", "jump_up_high"]);
    set.table(without(
        "loop_",
        table,
        &["jump_down_low", "jump_down_high"],
    ))
}

/// Adds values of the parameter; without one nothing is known of them.
fn values_of<T>(
    set: Dataset,
    found: &Found,
    over: &str,
    all: &[T],
    each: &[Of<T, f64>],
) -> Dataset {
    each.iter().fold(set, |set, (quantity, of)| {
        let at = all.iter().map(of);
        set.variable(match &found.parameter {
            Some(parameter) => values(parameter, &[over], at.collect())
                .named(quantity.name)
                .long_name(quantity.meaning),
            None => quantity.over(&[over], at.map(|_| f64::NAN).collect::<Vec<f64>>()),
        })
    })
}

/// Adds whole numbers; 0 stands for none.
fn counts<T>(set: Dataset, over: &str, all: &[T], each: &[Of<T, usize>]) -> Dataset {
    each.iter().fold(set, |set, (quantity, of)| {
        let numbers = wholes(all.iter().map(of));
        set.variable(quantity.over(&[over], numbers).gap(0))
    })
}

fn between(turn: Option<RangeEnd>) -> Option<Range> {
    turn.map(|turn| turn.between)
}

fn end(between: Option<Range>, part: usize) -> f64 {
    between.map_or(f64::NAN, |between| between[part])
}

/// Number of the attractor that a motion jumps to, 0 if that is not known.
fn beyond(turn: Option<RangeEnd>) -> usize {
    turn.and_then(|turn| turn.to).map_or(0, |to| to + 1)
}
