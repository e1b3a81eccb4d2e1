//! Summary of `saltus attractors` for people.

use super::data::{exponent, first_failure, share};
use super::{Found, name};
use saltus::orbits::MotionKind;
use saltus::study::{
    AttractorCensus, BasinFraction, CountedAttractor, Effects, Hysteresis, RangeEnd, Row, Transient,
};
use std::fmt::Write;

/// Lines of a list.
const LISTED: usize = 12;

pub(super) fn text(found: &Found) -> String {
    let (table, all) = (&found.study.attractors, &found.all);
    let mut text = format!(
        "{} initial conditions, z/η from {} to {} and ż/(η ω_h) from {} to {}",
        table.starts, table.z[0], table.z[1], table.v[0], table.v[1]
    );
    let lists = match &found.parameter {
        None => {
            let met = found.met().map(|(_, one)| in_words(one));
            let passing = found
                .transients()
                .map(|(row, one)| in_words_passing(row, one));
            vec![met.collect(), passing.collect()]
        }
        Some(parameter) => {
            let values = all.rows.iter().map(|row| short(row.value));
            let mut ends = values.clone();
            let _ = write!(
                text,
                ", at each of {} values of {} from {} to {}",
                values.count(),
                parameter.label(),
                ends.next().unwrap_or(f64::NAN),
                ends.next_back().unwrap_or(f64::NAN)
            );
            let ranges = 0..all.identities.len();
            let ranges: Vec<String> = ranges.map(|identity| range(found, identity)).collect();
            vec![ranges, all.loops.iter().map(in_words_loop).collect()]
        }
    };
    let _ = writeln!(text, ": {} attractors", all.identities.len());
    for lines in lists {
        for line in lines.iter().take(LISTED) {
            // writing to a string cannot fail
            let _ = writeln!(text, "  {line}");
        }
        if lines.len() > LISTED {
            let _ = writeln!(text, "  and {} more", lines.len() - LISTED);
        }
    }
    text + &doubts(found)
}

fn in_words(one: &CountedAttractor) -> String {
    let each = |list: &[f64]| {
        let list: Vec<String> = list.iter().map(|x| format!("{x:.3}")).collect();
        list.join(" and ")
    };
    let motion = &one.entry.attractor;
    format!(
        "{:>3}  {}  {}, contact {}, peak reaction {}; {}",
        one.identity + 1,
        percent(one.fraction),
        name(one),
        each(&motion.contact_ratio),
        each(motion.peak_reaction()),
        evidence(one)
    )
}

fn percent(fraction: BasinFraction) -> String {
    let [value, low, high] = share(fraction).map(|share| 100.0 * share);
    format!("{value:>5.1} % ({low:.1} to {high:.1} %)")
}

/// Evidence that it is an attractor.
fn evidence(one: &CountedAttractor) -> String {
    if let Some(multiplier) = one.entry.attractor.multiplier {
        return format!("stable, largest multiplier {multiplier:.4}");
    }
    let exponent = exponent(one).map(|e| {
        let (mean, error) = (e.per_iterate, e.standard_error);
        format!("exponent {mean:.4} ± {error:.4}")
    });
    let survival = one.survival.map(|seen| {
        format!(
            "none of {} motions left it in {} periods: lifetime above {:.0} with 95 % confidence",
            seen.motions,
            seen.periods,
            seen.lifetime()[1]
        )
    });
    let parts: Vec<String> = exponent.into_iter().chain(survival).collect();
    parts.join(", ")
}

fn in_words_passing(row: &Row, one: &Transient) -> String {
    let [mean, low, high] = one.survival.lifetime();
    format!(
        "     {} initial conditions in chaos that ends: {} of {} motions left it, lifetime {mean:.0} periods \
         ({low:.0} to {high:.0}); counted for {}",
        one.fraction.count,
        one.survival.ended,
        one.survival.motions,
        row.attractors()[one.to].identity + 1
    )
}

fn range(found: &Found, identity: usize) -> String {
    let range = &found.all.identities[identity];
    let end = |what: &str, turn: Option<RangeEnd>| {
        turn.map_or(String::new(), |turn| {
            let to = turn.to.map(|to| format!(", beyond on {}", to + 1));
            let [low, high] = turn.between.map(short);
            format!(
                "; {what} between {low} and {high}{}",
                to.unwrap_or_default()
            )
        })
    };
    format!(
        "{:>3}  {} to {}: {}{}{}",
        identity + 1,
        short(range.first),
        short(range.last),
        found.kinds(identity),
        end("begins", range.birth),
        end("ends", range.death)
    )
}

fn in_words_loop(one: &Hysteresis) -> String {
    let jump = |jump: Option<[f64; 2]>| {
        jump.map_or("without a jump".to_owned(), |jump| {
            let [low, high] = jump.map(short);
            format!("jumps between {low} and {high}")
        })
    };
    let cycle = |kind: MotionKind| {
        let period = kind.period().map(|n| format!("{n}T"));
        period.unwrap_or_else(|| "not periodic".to_owned())
    };
    format!(
        "hysteresis from {} to {}: on {} ({}) upwards, {}; on {} ({}) downwards, {}",
        short(one.from),
        short(one.to),
        one.up + 1,
        cycle(one.kinds.0),
        jump(one.jump_up),
        one.down + 1,
        cycle(one.kinds.1),
        jump(one.jump_down)
    )
}

/// Six digits of a number: 0.1 + 0.2 is 0.3 to people.
fn short(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(x)
}

/// The largest share of initial conditions that came to no attractor, and where, if there are any.
fn worst(what: &str, found: &Found, of: fn(&AttractorCensus) -> BasinFraction) -> String {
    let all = found.all.rows.iter();
    let all = all.filter_map(|row| Some((of(row.census.as_ref().ok()?).value(), row)));
    let most = all.max_by(|a, b| a.0.total_cmp(&b.0));
    let some = most.filter(|(share, _)| *share > 0.0);
    some.map_or(String::new(), |(share, row)| {
        let place = found.value(row).map_or(String::new(), |value| {
            format!(" at {}, the most at any value", short(value))
        });
        format!("  {:.1} % {what}{place}\n", 100.0 * share)
    })
}

/// Chaos that is no attractor, over a parameter.
fn passing(found: &Found) -> String {
    let all = found.transients();
    let all = all.filter(|(row, _)| found.value(row).is_some());
    let longest = all.clone().max_by_key(|(_, one)| one.survival.periods);
    longest.map_or(String::new(), |(row, one)| {
        format!(
            "  chaos that ends, at {} values; the longest at {}:\n{}\n",
            all.count(),
            short(row.value),
            in_words_passing(row, one)
        )
    })
}

/// Initial conditions without a verdict, and the bound on basins that no initial condition met.
fn doubts(found: &Found) -> String {
    let mut text = passing(found);
    text += &worst("undecided", found, |census| census.undecided);
    text += &worst("lost", found, |census| census.lost);
    if let Some(failure) = found.all.rows.iter().find_map(first_failure) {
        let _ = writeln!(text, "  first failure: {}", failure.reason);
    }
    if found.all.unfinished > 0 {
        let _ = writeln!(
            text,
            "  {} motions were still being carried on: some attractors may have several numbers",
            found.all.unfinished
        );
    }
    let _ = writeln!(
        text,
        "Intervals are of 95 % confidence; a basin that no initial condition met has less than {:.1} % of the box.",
        100.0 * BasinFraction::unseen(found.study.attractors.starts.into())
    );
    text
}
