//! Branches over their parameter, and curves of special points over two.

use super::Found;
use super::diagram::track;
use crate::answer::Take;
use crate::failure::CommandError;
use crate::kinds;
use crate::per_jumper::{PANELS, page, panel_title};
use crate::words::{self, SECTION_HEIGHT, base_in_title};
use saltus::study::{Bodies, SweepRow};
use saltus_config::Parameter;
use saltus_results::{Axis, BifurcationSet, Branches, Colour, Figure};

pub(super) fn draw(found: &Found, take: Take) -> Result<(), CommandError> {
    take("branches", &diagram(found))?;
    if found.curves.iter().any(|curve| curve.outcome.is_ok()) {
        take("curves", &curves(found))?;
    }
    Ok(())
}

fn diagram(found: &Found) -> Figure {
    let base = base_in_title(&found.study, Some(&found.question.parameter));
    let inertia = found.model.setup().inertia.name();
    let title = format!("Branches of periodic orbits: {base}in-plane inertia {inertia}");
    let jumpers = found.study.jumper.len();
    let shown = jumpers.min(PANELS);
    if shown == 1 {
        return Figure::new(branches(found, 0, &title));
    }
    let panels = (0..shown).map(|i| branches(found, i, &panel_title(i, jumpers)).into());
    page(1, panels.collect()).title(title)
}

fn axis(parameter: &Parameter, from: f64, to: f64) -> Axis {
    words::axis(parameter).range(from, to)
}

fn branches(found: &Found, jumper: usize, title: &str) -> Branches {
    let table = &found.question.table;
    let mut diagram = Branches::new(
        title,
        axis(&found.question.parameter, table.from, table.to),
        Axis::new(SECTION_HEIGHT),
    );
    if !found.cloud.is_empty() {
        let points = found.cloud.iter().flat_map(|row: &SweepRow| {
            let heights = row.z().get(jumper).map_or(&[][..], Vec::as_slice);
            heights.iter().map(|&z| (row.value, z))
        });
        let (values, heights): (Vec<f64>, Vec<f64>) = points.unzip();
        diagram = diagram.cloud("Long-term motion, both ways", values, heights);
    }
    for (limb, view) in found.limbs.iter().zip(&found.views) {
        let track = track(limb, view, jumper);
        let label = format!("Period {}", track.heights.len());
        let colour = Colour::of_period(track.heights.len() as u32);
        diagram = diagram
            .branch(label, track.values, &track.stable, track.heights)
            .colour(colour);
        for (special, seen) in limb.branch.specials.iter().zip(&view.specials) {
            let heights: Vec<f64> = seen.section.iter().map(|point| point.z[jumper]).collect();
            let symbol = kinds::symbol(&special.kind);
            diagram = diagram.special(symbol, &special.label, special.parameter, heights);
        }
    }
    diagram
}

fn curves(found: &Found) -> Figure {
    let table = &found.question.table;
    let first = axis(&found.question.parameter, table.from, table.to);
    let second = found.question.second.as_ref();
    let second = second.map_or(Axis::new(""), |(t, p)| axis(p, t.from, t.to));
    let mut set = match &found.over {
        Some(map) => BifurcationSet::over(map.clone()),
        None => BifurcationSet::new("Bifurcations of periodic orbits", first, second),
    };
    for followed in &found.curves {
        if let (Some(special), Ok(curve)) = (&followed.special, &followed.outcome) {
            let points = curve.points.iter().map(|point| point.parameters.into());
            let (x, y): (Vec<f64>, Vec<f64>) = points.unzip();
            set = set.curve(kinds::symbol(&special.kind), &followed.label, x, y);
        }
    }
    Figure::new(set)
}
