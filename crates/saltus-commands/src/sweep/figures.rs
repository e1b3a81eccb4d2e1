//! The bifurcation diagram, and the exponents along it.

use super::Run;
use super::report::{LABELS, Rate, Report, Row};
use crate::per_jumper::{PANELS, panel_title};
use crate::words::{base_in_title, capitalized};
use saltus::study::Pass;
use saltus_results::{Axis, Cloud, Curves, Figure, Panel};

pub(super) fn bifurcation(run: &Run) -> Figure {
    let title = format!("Bifurcation diagram: {}", setting(run));
    let shown = run.jumpers().min(PANELS);
    if shown == 1 {
        return Figure::new(cloud(run, 0, &title));
    }
    let panels = (0..shown).map(|i| cloud(run, i, &panel_title(i, run.jumpers())).into());
    Figure::grid(1, panels).title(title)
}

fn setting(run: &Run) -> String {
    let sweep = &run.sweep;
    format!(
        "{}{} forcing periods per value after {}",
        base_in_title(&run.study, Some(&run.parameter)),
        sweep.record,
        sweep.transient
    )
}

fn cloud(run: &Run, jumper: usize, title: &str) -> Cloud {
    let cloud = Cloud::new(
        title,
        Axis::new(capitalized(&run.parameter.label())),
        Axis::new("Height z/η at cos Ωt = 1 (-)"),
    );
    let passes = run.sweep.passes.iter().enumerate();
    passes.fold(cloud, |cloud, (index, pass)| {
        let rows = run.rows.iter().filter(|row| row.pass == index);
        let points = rows.flat_map(|row| {
            let heights = row.z.get(jumper).map_or(&[][..], Vec::as_slice);
            heights.iter().map(|&z| (row.value, z))
        });
        let (values, heights): (Vec<f64>, Vec<f64>) = points.unzip();
        cloud.series(label(run, pass), values, heights)
    })
}

/// Exponents drawn at most: there are no more colours for curves.
const CURVES: usize = 7;

/// One panel per pass: the exponents over the parameter, and behind them what the motion is.
pub(super) fn exponents(run: &Run, report: &Report) -> Figure {
    let count = run.table.exponents as usize;
    let which = match count {
        _ if count > CURVES => format!(" (the largest {CURVES} of {count})"),
        _ => String::new(),
    };
    let title = format!(
        "Lyapunov exponents{which}: {}{} forcing periods per value",
        base_in_title(&run.study, Some(&run.parameter)),
        run.table.exponent_periods
    );
    let passes = run.sweep.passes.iter().enumerate().take(PANELS);
    let panels = passes.map(|(index, pass)| {
        let rows: Vec<&Row> = report.rows.iter().filter(|row| row.pass == index).collect();
        Panel::from(spectrum(run, &label(run, pass), &rows))
    });
    Figure::grid(1, panels).title(title)
}

fn spectrum(run: &Run, title: &str, rows: &[&Row]) -> Curves {
    let values: Vec<f64> = rows.iter().map(|row| row.value).collect();
    let plot = Curves::new(
        title,
        Axis::new(capitalized(&run.parameter.label())),
        Axis::new("Mean growth per forcing period (-)"),
    );
    let count = (run.table.exponents as usize).min(CURVES);
    let plot = (0..count).fold(plot, |plot, k| {
        let of = |value: fn(&Rate) -> f64| -> Vec<f64> {
            let rates = rows.iter().map(|row| row.exponents.get(k));
            rates.map(|rate| rate.map_or(f64::NAN, value)).collect()
        };
        plot.line(
            format!("λ_{}", k + 1),
            &values[..],
            of(|rate| rate.per_period),
        )
        .band(
            "± one standard error",
            of(|rate| rate.per_period - rate.standard_error),
            of(|rate| rate.per_period + rate.standard_error),
        )
    });
    // all of them, so that a colour means the same in every figure
    LABELS.iter().fold(plot.level("Zero", 0.0), |plot, name| {
        let its = rows.iter().enumerate();
        let its = its.filter(|(_, row)| row.label == Some(name));
        let intervals: Vec<_> = its.map(|(i, _)| around(&values, i)).collect();
        plot.shade(capitalized(name), &intervals)
    })
}

/// From halfway to the value before to halfway to the value after.
fn around(values: &[f64], i: usize) -> (f64, f64) {
    let halfway = |j: usize| {
        let other = values.get(j).unwrap_or(&values[i]);
        f64::midpoint(values[i], *other)
    };
    let (a, b) = (halfway(i.wrapping_sub(1)), halfway(i + 1));
    (a.min(b), a.max(b))
}

/// Entry of the legend.
fn label(run: &Run, pass: &Pass) -> String {
    let symbol = run.parameter.symbol();
    match *pass {
        Pass::Up | Pass::Down => {
            let values = &run.sweep.values;
            let rising = values.first() < values.last();
            let onwards = matches!(pass, Pass::Up);
            let way = if rising == onwards {
                "rising"
            } else {
                "falling"
            };
            format!("{symbol} {way}, state carried on")
        }
        Pass::Start { z, v } => format!("Anew from z/η = {z}, ż/(η ω_h) = {v}"),
    }
}
