//! The figures of the paper, and those it does not have.

use saltus::model::Observation;
use saltus::physics::{ContactLaw, FrequencyReference};
use saltus::study::{Bodies, Pass};
use saltus_paper::{CaseResult, Diagram, InertiaRow, RATIOS};
use saltus_results::{Axis, Cloud, Figure, History, Panel, Portrait};

use super::Results;
use crate::words::{HEIGHT, VELOCITY};

pub(super) const DAMPING: &str = "Damping ratio $ζ_h$";

/// Fig. 2 under one reading of omega_h: all passes of the paper's law.
pub(super) fn fig2(results: &Results, reference: FrequencyReference) -> Figure {
    let panels = RATIOS.into_iter().filter_map(|ratio| {
        let law = ContactLaw::ReactionForce;
        let diagram = find(results, law, reference, ratio)?;
        Some(Panel::from(passes(diagram)))
    });
    Figure::grid(1, panels)
        .title(format!(
            "Fig. 2 with $ω_h$ the {} frequency of the body",
            reference.name()
        ))
        .plot_size(900.0, 300.0)
}

fn find(
    results: &Results,
    law: ContactLaw,
    reference: FrequencyReference,
    ratio: f64,
) -> Option<&Diagram> {
    let wanted = |d: &&Diagram| d.law == law && d.reference == reference && d.ratio == ratio;
    results.diagrams.iter().find(wanted)
}

fn panel(ratio: f64, hertz: f64) -> Cloud {
    let title = format!("$Ω$ = {ratio:.1} $ω_h$ ({hertz:.4} Hz)");
    Cloud::new(title, Axis::new(DAMPING), Axis::new(HEIGHT))
}

fn passes(diagram: &Diagram) -> Cloud {
    let cloud = panel(diagram.ratio, diagram.hertz);
    diagram
        .passes
        .iter()
        .enumerate()
        .fold(cloud, |cloud, (index, pass)| {
            let (x, y) = points(diagram, index);
            cloud.series(pass_name(pass), x, y)
        })
}

/// Entry of the legend.
fn pass_name(pass: &Pass) -> String {
    match pass {
        Pass::Up => "$ζ_h$ rising".into(),
        Pass::Down => "$ζ_h$ falling, where it differs".into(),
        Pass::Start((z, v)) => format!("from $z/η$ = {z}, $ż/(η ω_h)$ = {v}, where it differs"),
    }
}

/// All samples of one pass.
pub(super) fn points(diagram: &Diagram, pass: usize) -> (Vec<f64>, Vec<f64>) {
    let rows = diagram.pass(pass);
    let samples = rows.flat_map(|row| {
        let z = row.z().first().map_or(&[][..], Vec::as_slice);
        z.iter().map(|&z| (row.value, z))
    });
    samples.unzip()
}

/// Fig. 2 under the three contact laws: up- and down-sweep together in one colour for each law.
pub(super) fn laws(results: &Results) -> Figure {
    let panels = RATIOS.into_iter().filter_map(|ratio| {
        let reference = FrequencyReference::Occupied;
        let hertz = find(results, ContactLaw::ReactionForce, reference, ratio)?.hertz;
        let mut cloud = panel(ratio, hertz);
        for law in ContactLaw::ALL {
            let diagram = find(results, law, reference, ratio)?;
            let (mut x, mut y) = points(diagram, 0);
            let (more_x, more_y) = points(diagram, 1);
            x.extend(more_x);
            y.extend(more_y);
            let label = match law {
                ContactLaw::ReactionForce => law.name().to_owned(),
                other => format!("{}, where it differs", other.name()),
            };
            cloud = cloud.series(label, x, y);
        }
        Some(Panel::from(cloud))
    });
    Figure::grid(1, panels)
        .title("Fig. 2 under three contact laws (up- and down-sweep)")
        .plot_size(900.0, 300.0)
}

/// Full and condensed model at the same damping ratios.
pub(super) fn inertia(results: &Results) -> Figure {
    let panels = RATIOS.into_iter().map(|ratio| {
        let rows: Vec<&InertiaRow> = results
            .inertia
            .rows
            .iter()
            .filter(|row| row.ratio == ratio)
            .collect();
        let collect = |pick: fn(&InertiaRow) -> &[f64]| -> (Vec<f64>, Vec<f64>) {
            let all = rows
                .iter()
                .flat_map(|row| pick(row).iter().map(|&z| (row.damping_ratio, z)));
            all.unzip()
        };
        let (fx, fy) = collect(|row| &row.full.0);
        let (cx, cy) = collect(|row| &row.condensed.0);
        let cloud = Cloud::new(
            format!("$Ω$ = {ratio:.1} $ω_h$"),
            Axis::new(DAMPING),
            Axis::new(HEIGHT),
        )
        .series("full, 17 degrees of freedom", fx, fy)
        .series("condensed, 5 degrees of freedom, where it differs", cx, cy);
        Panel::from(cloud)
    });
    Figure::grid(3, panels)
        .title("In-plane inertia kept and condensed, from the same start")
        .plot_size(420.0, 320.0)
}

/// Fig. 3: phase portraits with stroboscopic points. Those of one frequency share their scales.
pub(super) fn portraits(results: &Results) -> Figure {
    let panels = results.cases.iter().map(|result| {
        let alike = results.cases.iter();
        let alike = alike.filter(|other| other.case.ratio == result.case.ratio);
        let states = alike.flat_map(|case| &case.trajectory.history.states);
        let range = |of: fn(&Observation) -> f64| {
            let values = states.clone().map(of);
            let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
                (low.min(v), high.max(v))
            });
            let margin = 0.06 * (high - low);
            (low - margin, high + margin)
        };
        let (z, v) = (range(|s| s.z[0]), range(|s| s.v[0]));
        Panel::from(portrait(result, z, v))
    });
    Figure::grid(2, panels)
        .title("Fig. 3: phase portraits and Poincaré points at $cos Ωt = 1$")
        .plot_size(460.0, 330.0)
}

fn heading(result: &CaseResult) -> String {
    let case = result.case;
    let exponent = result.verdict.exponent;
    let (mean, error) = (exponent.per_iterate, exponent.standard_error);
    let ours = match result.recurrence {
        Some(n) => format!("{n}$T$"),
        None => format!("$λ$ = {mean:.3} ± {error:.3} per $T$"),
    };
    format!(
        "$Ω$ = {:.1} $ω_h$, $ζ_h$ = {:.2}: {ours}",
        case.ratio, case.damping_ratio
    )
}

fn portrait(result: &CaseResult, heights: (f64, f64), speeds: (f64, f64)) -> Portrait {
    let history = &result.trajectory.history;
    let z: Vec<f64> = history.states.iter().map(|s| s.z[0]).collect();
    let v: Vec<f64> = history.states.iter().map(|s| s.v[0]).collect();
    let flight: Vec<bool> = history.states.iter().map(|s| s.prf[0] == 0.0).collect();
    // A periodic section repeats itself: its n points once, so that they are drawn as points.
    let kept = result.recurrence.map_or(usize::MAX, |n| n as usize);
    let section = result.trajectory.section.iter().take(kept);
    let points: (Vec<f64>, Vec<f64>) = section.map(|s| (s.z[0], s.v[0])).unzip();
    let x = Axis::new(HEIGHT).range(heights.0, heights.1);
    let y = Axis::new(VELOCITY).range(speeds.0, speeds.1);
    Portrait::new(heading(result), x, y)
        .marked_path(("on the floor", "in flight"), z, v, &flight)
        .points("Poincaré points", points.0, points.1)
}

/// Periods shown of a force history: enough for twice the longest period of the paper's cases.
const SHOWN: f64 = 8.0;

/// The plate reaction force of every case, flights shaded.
pub(super) fn forces(results: &Results) -> Figure {
    let panels = results
        .cases
        .iter()
        .map(|result| Panel::from(force(result)));
    Figure::grid(2, panels)
        .title("Plate reaction force PRF of the cases of Fig. 3")
        .plot_size(460.0, 230.0)
        .same_scales()
}

fn force(result: &CaseResult) -> History {
    let period = result.period_seconds;
    let history = &result.trajectory.history;
    let begin = history
        .time
        .last()
        .map_or(0.0, |last| last - SHOWN * period);
    let in_periods = |t: f64| (t - begin) / period;
    let (t, prf): (Vec<f64>, Vec<f64>) = history
        .time
        .iter()
        .zip(&history.states)
        .filter(|(t, _)| **t >= begin)
        .map(|(t, state)| (in_periods(*t), state.prf[0]))
        .unzip();
    let flights: Vec<(f64, f64)> = result
        .flights()
        .into_iter()
        .filter(|flight| flight.1 > begin)
        .map(|(from, to)| (in_periods(from.max(begin)), in_periods(to)))
        .collect();
    History::new(
        heading(result),
        Axis::new("Time $t/T$"),
        Axis::new("Force $PRF/(m_h g)$"),
    )
    .shade("in flight", &flights)
    .curve("plate reaction force", t, prf)
    .level("body weight", 1.0)
}
