//! The bifurcation diagram, and the exponents along it.

use super::data::labels;
use super::{Found, Row};
use crate::per_jumper::{PANELS, page, panel_title};
use crate::words::{SECTION_HEIGHT, axis, base_in_title, capitalized};
use saltus::orbits::Exponent;
use saltus::study::{Bodies, Pass};
use saltus_results::{Axis, Cloud, Curves, Figure, Panel};

pub(super) fn bifurcation(found: &Found) -> Figure {
    let title = format!("Bifurcation diagram: {}", setting(found));
    let shown = found.jumpers().min(PANELS);
    if shown == 1 {
        return Figure::new(cloud(found, 0, &title));
    }
    let panels = (0..shown).map(|i| cloud(found, i, &panel_title(i, found.jumpers())).into());
    page(1, panels.collect()).title(title)
}

fn setting(found: &Found) -> String {
    let sweep = &found.sweep;
    format!(
        "{}{} forcing periods per value after {}",
        base_in_title(&found.study, Some(&found.parameter)),
        sweep.record,
        sweep.transient
    )
}

fn cloud(found: &Found, jumper: usize, title: &str) -> Cloud {
    let cloud = Cloud::new(title, axis(&found.parameter), Axis::new(SECTION_HEIGHT));
    let passes = found.sweep.passes.iter().enumerate();
    passes.fold(cloud, |cloud, (index, pass)| {
        let points = found.rows_of(index).flat_map(|row| {
            let heights = row.run.z().get(jumper).map_or(&[][..], Vec::as_slice);
            heights.iter().map(|&z| (row.run.value, z))
        });
        let (values, heights): (Vec<f64>, Vec<f64>) = points.unzip();
        let differs = match index {
            0 => "",
            _ => ", where it differs",
        };
        cloud.series(format!("{}{differs}", label(found, pass)), values, heights)
    })
}

/// Exponents drawn at most: there are no more colours for curves.
const CURVES: usize = 7;

/// One panel per pass: the exponents over the parameter, and behind them what the motion is.
pub(super) fn exponents(found: &Found) -> Figure {
    let count = found.table.exponents as usize;
    let which = match count {
        _ if count > CURVES => format!(" (the largest {CURVES} of {count})"),
        _ => String::new(),
    };
    let title = format!(
        "Lyapunov exponents{which}: {}{} forcing periods per value",
        base_in_title(&found.study, Some(&found.parameter)),
        found.table.exponent_periods
    );
    let passes = found.sweep.passes.iter().enumerate().take(PANELS);
    let panels = passes.map(|(index, pass)| {
        let rows: Vec<&Row> = found.rows_of(index).collect();
        Panel::from(spectrum(found, &label(found, pass), &rows))
    });
    Figure::grid(1, panels).title(title)
}

fn spectrum(found: &Found, title: &str, rows: &[&Row]) -> Curves {
    let values: Vec<f64> = rows.iter().map(|row| row.run.value).collect();
    let plot = Curves::new(
        title,
        axis(&found.parameter),
        Axis::new("Lyapunov exponent $λ$ per forcing period"),
    );
    let count = (found.table.exponents as usize).min(CURVES);
    let plot = (0..count).fold(plot, |plot, k| {
        let of = |value: fn(&Exponent) -> f64| -> Vec<f64> {
            let rates = rows.iter().map(|row| row.exponents.get(k));
            rates.map(|rate| rate.map_or(f64::NAN, value)).collect()
        };
        plot.line(
            format!("$λ_{{{}}}$", k + 1),
            &values[..],
            of(|e| e.per_iterate),
        )
        .band(
            "± one standard error",
            of(|e| e.per_iterate - e.standard_error),
            of(|e| e.per_iterate + e.standard_error),
        )
    });
    // all of them, so that a colour means the same in every figure
    labels().iter().fold(plot.level("Zero", 0.0), |plot, name| {
        let its = rows.iter().enumerate();
        let its = its.filter(|(_, row)| row.label() == *name);
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
fn label(found: &Found, pass: &Pass) -> String {
    let symbol = found.parameter.symbol();
    match *pass {
        Pass::Up | Pass::Down => {
            let values = &found.sweep.values;
            let rising = values.first() < values.last();
            let onwards = matches!(pass, Pass::Up);
            let way = if rising == onwards {
                "rising"
            } else {
                "falling"
            };
            format!("${symbol}$ {way}")
        }
        Pass::Start((z, v)) => format!("From $z/η$ = {z}, $ż/(η ω_h)$ = {v}"),
    }
}
