//! The numbers behind the figures of the paper, described once.

use super::Results;
use super::facts::Report;
use crate::data::{Listed, about, coordinate, padded, texts};
use crate::kinds;
use crate::quantities as q;
use crate::words::direction;
use saltus::study::{Bodies, Pass};
use saltus_config::Parameter;
use saltus_paper::{Detail, Diagram, Met, PanelBranches};
use saltus_results::{Dataset, Table, Variable};

/// Panels of Fig. 2.
const TAGS: [&str; 3] = ["a", "b", "c"];

pub(super) fn data(results: &Results) -> Dataset {
    let set = fig2(results);
    let set = regimes(set, results);
    let set = sweeps(set, results);
    let set = transitions(set, results);
    let set = branches(set, results);
    let set = exponents(set, results);
    let set = fig3(set, results);
    inertia(set, results)
}

/// The diagrams of the paper's law under the occupied reading, with what is behind them.
pub(super) fn panels(results: &Results) -> impl Iterator<Item = (&Diagram, &PanelBranches)> {
    let all = results.diagrams.iter().zip(&results.branches);
    all.filter(|(_, panel)| panel.detail.is_some())
}

/// Details of the paper's own panels.
pub(super) fn details(results: &Results) -> impl Iterator<Item = (f64, &Detail)> {
    let panels = results.branches.iter();
    panels.filter_map(|panel| Some((panel.ratio, panel.detail.as_ref()?)))
}

/// The clouds of Fig. 2 over panel, direction, damping ratio and sample, a table for each panel.
fn fig2(results: &Results) -> Dataset {
    let panels: Vec<&Diagram> = panels(results).map(|(diagram, _)| diagram).collect();
    let (passes, rows) = panels
        .first()
        .map_or((&[][..], &[][..]), |panel| (&panel.passes, &panel.rows));
    let values = rows.iter().filter(|row| row.pass == 0).map(|row| row.value);
    let values: Vec<f64> = values.collect();
    let record = results.effort.record as usize;
    let heights = panels.iter().flat_map(|panel| &panel.rows).flat_map(|row| {
        let samples = row.z().first().map_or(&[][..], Vec::as_slice);
        padded(samples, record)
    });
    let heights: Vec<f64> = heights.collect();
    let hertz: Vec<f64> = panels.iter().map(|panel| panel.hertz).collect();
    let tags = texts(TAGS.into_iter().take(panels.len()));
    let damping = damping(&values);
    let value = damping.name().to_owned();
    let over = ["panel", "direction", &value, "sample"];
    let set = about("Fig. 2 of Dias & Del Prado", &results.study)
        .header("coordinates", "base_frequency start_z start_v")
        .coordinate(q::PANEL.along(tags))
        .coordinate(q::DIRECTION.along(passes.iter().map(direction).collect::<Vec<String>>()))
        .coordinate(damping)
        .coordinate(q::SAMPLE.numbered(1, record))
        .variable(q::BASE_FREQUENCY.over(&over[..1], hertz));
    let set = self::passes(set, passes).variable(q::Z.over(&over, heights));
    let places = passes.len() * values.len() * record;
    let table = |set: Dataset, (panel, tag): (usize, &str)| {
        let own = (0..places * panels.len()).map(|place| place / places == panel);
        set.table(
            Table::new(format!("fig2{tag}"), &over)
                .columns(&["direction"])
                .titled("damping_ratio", over[2])
                .titled("z_eta", "z")
                .only_where("z")
                .only_rows(own.collect())
                .in_files(),
        )
    };
    TAGS.into_iter()
        .take(panels.len())
        .enumerate()
        .fold(set, table)
}

/// The damping ratio of the person as a coordinate.
fn damping(values: &[f64]) -> Variable {
    match Parameter::parse("jumper.damping_ratio") {
        Ok(parameter) => coordinate(&parameter, values),
        // the key is one of every study
        Err(_) => Variable::coordinate("jumper_damping_ratio", values.to_vec()),
    }
}

/// Initial condition of each way through the values.
fn passes(set: Dataset, passes: &[Pass]) -> Dataset {
    let over = ["direction"];
    let start = |part: fn((f64, f64)) -> f64| -> Vec<f64> {
        let of = |pass: &Pass| match *pass {
            Pass::Start((z, v)) => part((z, v)),
            Pass::Up | Pass::Down => f64::NAN,
        };
        passes.iter().map(of).collect()
    };
    set.variable(q::START_Z.over(&over, start(|s| s.0)))
        .variable(q::START_V.over(&over, start(|s| s.1)))
}

/// Ranges in which cycles are stable, under every law and both readings.
fn regimes(set: Dataset, results: &Results) -> Dataset {
    let regimes = Report::new(results).regimes;
    Listed::new(set, "regimes", "regime", &regimes)
        .column("law", q::REGIME_LAW, |r| r.law.to_owned())
        .column("reference", q::REGIME_REFERENCE, |r| r.reference.to_owned())
        .column("frequency_ratio", q::REGIME_RATIO, |r| r.frequency_ratio)
        .column("base_hz", q::REGIME_BASE, |r| r.base_hz)
        .whole("period", q::REGIME_PERIOD, 0, |r| Some(r.period))
        .column("from", q::REGIME_FROM, |r| r.from)
        .column("from_is", q::REGIME_FROM_IS, |r| r.from_is.clone())
        .column("to", q::REGIME_TO, |r| r.to)
        .column("to_is", q::REGIME_TO_IS, |r| r.to_is.clone())
        .end()
}

/// Motions of Fig. 2 beside the stable cycles: on one, on a slow way to one, or neither.
fn sweeps(set: Dataset, results: &Results) -> Dataset {
    struct Row {
        ratio: f64,
        direction: String,
        value: f64,
        met: Met,
    }
    let rows = panels(results).flat_map(|(diagram, panel)| {
        diagram.rows.iter().map(|row| Row {
            ratio: diagram.ratio,
            direction: direction(&diagram.passes[row.pass]),
            value: row.value,
            met: Diagram::met(row, &panel.stretches),
        })
    });
    let rows: Vec<Row> = rows.collect();
    Listed::new(set, "sweeps", "sweep_row", &rows)
        .column("frequency_ratio", q::SWEEP_RATIO, |r| r.ratio)
        .column("direction", q::SWEEP_DIRECTION, |r| r.direction.clone())
        .column("damping_ratio", q::SWEEP_DAMPING, |r| r.value)
        .whole("cycle", q::SWEEP_CYCLE, 0, |r| match r.met {
            Met::Cycle(period) => Some(period),
            _ => None,
        })
        .whole("slow", q::SWEEP_SLOW, 0, |r| match r.met {
            Met::Slow(period) => Some(period),
            _ => None,
        })
        .end()
}

fn transitions(set: Dataset, results: &Results) -> Dataset {
    let all = details(results).flat_map(|(ratio, detail)| {
        let transitions = detail.transitions.iter();
        transitions.map(move |transition| (ratio, transition))
    });
    let all: Vec<_> = all.collect();
    Listed::new(set, "transitions", "transition", &all)
        .column("frequency_ratio", q::TRANSITION_RATIO, |(ratio, _)| *ratio)
        .column("label", q::TRANSITION_LABEL, |(_, t)| t.label.clone())
        .column("kind", q::TRANSITION_KIND, |(_, t)| {
            kinds::name(&t.kind).to_owned()
        })
        .whole("period", q::TRANSITION_PERIOD, 0, |(_, t)| Some(t.period))
        .column("damping_ratio", q::TRANSITION_DAMPING, |(_, t)| {
            t.damping_ratio
        })
        .column("second", q::TRANSITION_SECOND, |(_, t)| {
            t.second.unwrap_or(f64::NAN)
        })
        .word("seen", q::TRANSITION_SEEN, |(_, t)| yes(t.seen))
        .column("switches", q::TRANSITION_SWITCHES, |(_, t)| {
            t.sequence.clone()
        })
        .end()
}

fn yes(yes: bool) -> &'static str {
    if yes { "yes" } else { "no" }
}

/// Every place of every orbit of the branches.
fn branches(set: Dataset, results: &Results) -> Dataset {
    struct Row<'a> {
        ratio: f64,
        branch: usize,
        origin: &'a str,
        point: usize,
        damping: f64,
        stable: bool,
        place: usize,
        height: f64,
    }
    let mut rows = Vec::new();
    for (ratio, detail) in details(results) {
        for (branch, limb) in detail.limbs.iter().enumerate() {
            for point in 0..limb.damping_ratio.len() {
                rows.extend(limb.heights.iter().enumerate().map(|(place, heights)| Row {
                    ratio,
                    branch,
                    origin: limb.origin.as_deref().unwrap_or_default(),
                    point,
                    damping: limb.damping_ratio[point],
                    stable: limb.stable[point],
                    place,
                    height: heights[point],
                }));
            }
        }
    }
    Listed::new(set, "branches", "branch_point", &rows)
        .column("frequency_ratio", q::BRANCH_RATIO, |r| r.ratio)
        .whole("branch", q::BRANCH, -1, |r| Some(r.branch))
        .column("origin", q::BRANCH_ORIGIN, |r| r.origin.to_owned())
        .whole("point", q::PAPER_BRANCH_POINT, -1, |r| Some(r.point))
        .column("damping_ratio", q::BRANCH_DAMPING, |r| r.damping)
        .word("stable", q::BRANCH_STABLE, |r| yes(r.stable))
        .whole("place", q::BRANCH_PLACE, -1, |r| Some(r.place))
        .column("z_eta", q::BRANCH_Z, |r| r.height)
        .end()
}

fn exponents(set: Dataset, results: &Results) -> Dataset {
    let all = results.exponents.iter().flat_map(|panel| {
        let values = panel.values.iter();
        values.map(|(zeta, exponent)| (panel.ratio, *zeta, exponent))
    });
    let all: Vec<_> = all.collect();
    let periods = results.effort.panel_exponent_periods;
    let set = set.variable(q::EXPONENT_PERIODS.is(periods as i64));
    Listed::new(set, "exponents", "exponent_row", &all)
        .column("frequency_ratio", q::EXPONENT_RATIO, |r| r.0)
        .column("damping_ratio", q::EXPONENT_DAMPING, |r| r.1)
        .column("exponent_per_period", q::EXPONENT, |r| r.2.per_iterate)
        .column("standard_error", q::EXPONENT_ERROR, |r| r.2.standard_error)
        .end()
}

/// The points of Fig. 3 at cos(Omega t) = 1.
fn fig3(set: Dataset, results: &Results) -> Dataset {
    let points = results.cases.iter().flat_map(|result| {
        let section = result.trajectory.section.iter();
        section.map(move |point| (result.case, point))
    });
    let points: Vec<_> = points.collect();
    Listed::new(set, "fig3", "fig3_point", &points)
        .column("panel", q::FIG3_PANEL, |(case, _)| case.tag.to_string())
        .column("frequency_ratio", q::FIG3_RATIO, |(case, _)| case.ratio)
        .column("damping_ratio", q::FIG3_DAMPING, |(case, _)| {
            case.damping_ratio
        })
        .column("z_eta", q::FIG3_Z, |(_, point)| point.z[0])
        .column("v", q::FIG3_V, |(_, point)| point.v[0])
        .end()
}

/// Full against condensed, motion by motion.
fn inertia(set: Dataset, results: &Results) -> Dataset {
    Listed::new(set, "full-condensed", "inertia_row", &results.inertia.rows)
        .column("frequency_ratio", q::INERTIA_RATIO, |r| r.ratio)
        .column("damping_ratio", q::INERTIA_DAMPING, |r| r.damping_ratio)
        .column("difference_eta", q::INERTIA_DIFFERENCE, |r| {
            r.difference.unwrap_or(f64::NAN)
        })
        .column("contact_ratio_full", q::INERTIA_FULL, |r| r.contact_ratio.0)
        .column("contact_ratio_condensed", q::INERTIA_CONDENSED, |r| {
            r.contact_ratio.1
        })
        .end()
}

/// The same, counted.
pub(super) fn came_to(results: &Results) -> String {
    let met = panels(results).flat_map(|(diagram, panel)| {
        let met = |row| Diagram::met(row, &panel.stretches);
        diagram.rows.iter().map(met)
    });
    let (mut all, mut on, mut slow) = (0, 0, 0);
    for met in met {
        all += 1;
        on += u32::from(matches!(met, Met::Cycle(_)));
        slow += u32::from(matches!(met, Met::Slow(_)));
    }
    format!(
        "of {all} motions {on} are on a stable cycle and {slow} on a slow way to one (they repeat, but no such cycle is \
         stable there), as they are beside a bifurcation"
    )
}
