//! What `saltus attractors` says to people.

use super::Run;
use super::evidence::Passing;
use super::report::{Attractor, End, Loop, Report, Row, Share, name};
use std::fmt::Write;

/// Lines of a list.
const LISTED: usize = 12;

pub(super) fn text(run: &Run, report: &Report) -> String {
    let table = &run.study.attractors;
    let mut text = format!(
        "{} first states, z/η from {} to {} and ż/(η ω_h) from {} to {}",
        report.starts, table.z[0], table.z[1], table.v[0], table.v[1]
    );
    let lists = match &run.parameter {
        None => {
            let rows = || report.rows.iter();
            let all = rows().flat_map(|row| &row.attractors).map(in_words);
            let passing = rows().flat_map(|row| &row.transients);
            vec![all.collect(), passing.map(Passing::in_words).collect()]
        }
        Some(parameter) => {
            let values = run.found.rows.iter().map(|row| short(row.value));
            let mut ends = values.clone();
            let _ = write!(
                text,
                ", at each of {} values of {} from {} to {}",
                values.count(),
                parameter.label(),
                ends.next().unwrap_or(f64::NAN),
                ends.next_back().unwrap_or(f64::NAN)
            );
            let spans: Vec<String> = (0..report.attractors.len())
                .map(|identity| span(run, report, identity))
                .collect();
            vec![spans, report.loops.iter().map(in_words_loop).collect()]
        }
    };
    let _ = writeln!(text, ": {} attractors", report.attractors.len());
    for lines in lists {
        for line in lines.iter().take(LISTED) {
            // writing to a string cannot fail
            let _ = writeln!(text, "  {line}");
        }
        if lines.len() > LISTED {
            let _ = writeln!(text, "  and {} more", lines.len() - LISTED);
        }
    }
    text + &doubts(report)
}

fn in_words(one: &Attractor) -> String {
    let each = |list: &[f64]| {
        let list: Vec<String> = list.iter().map(|x| format!("{x:.3}")).collect();
        list.join(" and ")
    };
    format!(
        "{:>3}  {}  {}, contact {}, peak reaction {}; {}",
        one.number,
        percent(one.drawn),
        one.name(),
        each(one.contact_ratio.as_slice()),
        each(one.peak_reaction.as_slice()),
        one.evidence.in_words()
    )
}

fn percent(Share { share, .. }: Share) -> String {
    let [value, low, high] = share.map(|share| 100.0 * share);
    format!("{value:>5.1} % ({low:.1} to {high:.1} %)")
}

fn span(run: &Run, report: &Report, identity: usize) -> String {
    let span = &report.attractors[identity];
    let [first, last] = [span.first, span.last].map(|end| short(end.unwrap_or(f64::NAN)));
    let end = |what: &str, end: &Option<End>| {
        end.as_ref().map_or(String::new(), |end| {
            let to = end
                .to
                .map_or(String::new(), |to| format!(", beyond on {to}"));
            let [low, high] = end.between.map(short);
            format!("; {what} between {low} and {high}{to}")
        })
    };
    format!(
        "{:>3}  {first} to {last}: {}{}{}",
        span.number,
        run.kinds(identity),
        end("begins", &span.birth),
        end("ends", &span.death)
    )
}

fn in_words_loop(one: &Loop) -> String {
    let jump = |jump: Option<[f64; 2]>| {
        jump.map_or("without a jump".to_owned(), |jump| {
            let [low, high] = jump.map(short);
            format!("jumps between {low} and {high}")
        })
    };
    format!(
        "hysteresis from {} to {}: on {} ({}) upwards, {}; on {} ({}) downwards, {}",
        short(one.from),
        short(one.to),
        one.up,
        name(one.period_up),
        jump(one.jump_up),
        one.down,
        name(one.period_down),
        jump(one.jump_down)
    )
}

/// Six digits of a number: 0.1 + 0.2 is 0.3 to people.
fn short(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(x)
}

/// The largest share of what came to no attractor, and where, if there is any.
fn worst(what: &str, report: &Report, of: fn(&Row) -> Share) -> String {
    let all = report.rows.iter().map(|row| (of(row).share[0], row.value));
    let most = all.max_by(|a, b| a.0.total_cmp(&b.0));
    let some = most.filter(|(share, _)| *share > 0.0);
    some.map_or(String::new(), |(share, value)| {
        let place = value.map_or(String::new(), |value| {
            format!(" at {}, the most at any value", short(value))
        });
        format!("  {:.1} % {what}{place}\n", 100.0 * share)
    })
}

/// Chaos that is no attractor, over a parameter.
fn passing(report: &Report) -> String {
    let rows = report.rows.iter().filter(|row| row.value.is_some());
    let all = rows.flat_map(|row| row.transients.iter().map(move |one| (row, one)));
    let longest = all.clone().max_by_key(|(_, one)| one.watched.periods);
    longest.map_or(String::new(), |(row, one)| {
        format!(
            "  chaos that ends, at {} values; the longest at {}:\n{}\n",
            all.count(),
            short(row.value.unwrap_or(f64::NAN)),
            one.in_words()
        )
    })
}

/// What was not decided, and what was not seen.
fn doubts(report: &Report) -> String {
    let mut text = passing(report);
    text += &worst("undecided", report, |row| row.undecided);
    text += &worst("lost", report, |row| row.lost);
    let failed = report
        .rows
        .iter()
        .find_map(|row| row.first_failure.as_ref());
    if let Some(failure) = failed {
        let _ = writeln!(text, "  first failure: {}", failure.status_text);
    }
    if report.unfinished > 0 {
        let _ = writeln!(
            text,
            "  {} motions were still being carried on: some attractors may have several numbers",
            report.unfinished
        );
    }
    let _ = writeln!(
        text,
        "Intervals are of 95 % confidence; a basin that no first state met has less than {:.1} % of the box.",
        100.0 * report.unseen
    );
    text
}
