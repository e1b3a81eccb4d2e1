//! Branches over their parameter, and curves of special points over two.

use super::Run;
use super::diagram::track;
use crate::failure::Failure;
use crate::kinds;
use crate::per_jumper::{PANELS, panel_title};
use crate::store::Store;
use crate::words::{base_in_title, capitalized};
use saltus::study::SweepRow;
use saltus_config::Parameter;
use saltus_results::{Axis, BifurcationSet, Branches, Figure};

pub(super) fn write(folder: &mut dyn Store, run: &Run) -> Result<(), Failure> {
    folder.figure("branches", &diagram(run))?;
    if run.curves.iter().any(|curve| curve.outcome.is_ok()) {
        folder.figure("curves", &curves(run))?;
    }
    Ok(())
}

fn diagram(run: &Run) -> Figure {
    let base = base_in_title(&run.study, Some(&run.question.parameter));
    let inertia = run.model.setup().inertia.name();
    let title = format!("Branches of periodic orbits: {base}in-plane inertia {inertia}");
    let jumpers = run.study.jumper.len();
    let shown = jumpers.min(PANELS);
    if shown == 1 {
        return Figure::new(branches(run, 0, &title));
    }
    let panels = (0..shown).map(|i| branches(run, i, &panel_title(i, jumpers)).into());
    Figure::grid(1, panels).title(title)
}

fn axis(parameter: &Parameter, from: f64, to: f64) -> Axis {
    Axis::new(capitalized(&parameter.label())).range(from, to)
}

fn branches(run: &Run, jumper: usize, title: &str) -> Branches {
    let table = &run.question.table;
    let mut diagram = Branches::new(
        title,
        axis(&run.question.parameter, table.from, table.to),
        Axis::new("Height z/η at cos Ωt = 1 (-)"),
    );
    if !run.cloud.is_empty() {
        let points = run.cloud.iter().flat_map(|row: &SweepRow| {
            let heights = row.z.get(jumper).map_or(&[][..], Vec::as_slice);
            heights.iter().map(|&z| (row.value, z))
        });
        let (values, heights): (Vec<f64>, Vec<f64>) = points.unzip();
        diagram = diagram.cloud("Long-term motion, both ways", values, heights);
    }
    for (limb, view) in run.limbs.iter().zip(&run.views) {
        let track = track(limb, view, jumper);
        let label = format!("Period {}", track.heights.len());
        diagram = diagram.branch(label, track.values, &track.stable, track.heights);
        for (special, seen) in limb.branch.specials.iter().zip(&view.specials) {
            let heights: Vec<f64> = seen.section.iter().map(|point| point.z[jumper]).collect();
            let symbol = kinds::symbol(&special.kind);
            diagram = diagram.special(symbol, &special.label, special.parameter, heights);
        }
    }
    diagram
}

fn curves(run: &Run) -> Figure {
    let table = &run.question.table;
    let first = axis(&run.question.parameter, table.from, table.to);
    let second = run.question.second.as_ref();
    let second = second.map_or(Axis::new(""), |(t, p)| axis(p, t.from, t.to));
    let mut set = BifurcationSet::new("Bifurcations of periodic orbits", first, second);
    for followed in &run.curves {
        if let (Some(special), Ok(curve)) = (&followed.special, &followed.outcome) {
            let points = curve.points.iter().map(|point| point.parameters.into());
            let (x, y): (Vec<f64>, Vec<f64>) = points.unzip();
            set = set.curve(kinds::symbol(&special.kind), &followed.label, x, y);
        }
    }
    Figure::new(set)
}
