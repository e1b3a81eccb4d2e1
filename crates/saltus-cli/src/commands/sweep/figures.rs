//! The bifurcation diagram.

use super::Run;
use crate::commands::{base_in_title, capitalized};
use crate::per_jumper::{PANELS, panel_title};
use saltus::study::Pass;
use saltus_results::{Axis, Cloud, Figure};

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
        base_in_title(run.study, Some(&run.parameter)),
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
