//! Why the transitions of Fig. 2 are where they are: branches, special points, exponents.

use saltus_paper::{Detail, Diagram, PanelExponents, Transition};
use saltus_results::{Axis, Branches, Colour, Curves, Figure, Panel};

use super::Results;
use super::album::Album;
use super::data::{details, panels};
use super::figures::{DAMPING, points};
use crate::failure::CommandError;
use crate::kinds;
use crate::words::HEIGHT;

pub(super) fn write(album: &mut Album<'_>, results: &Results) -> Result<(), CommandError> {
    album.section("Why the transitions are where they are");
    album.say(&[
        "Sweeps see stable motions only. Here the periodic orbits themselves are followed, stable or not, with every \
         point at which one is born, dies or changes its stability or the order of its switches. Each such point was \
         found twice: by continuation with the tangent flow, and from orbits at given damping ratios with derivatives \
         by differences.",
    ]);
    let caption = "Periodic orbits behind Fig. 2 over the damping ratio: solid where stable, dashed where not; grey, \
                   what the sweeps show.";
    let data = [
        ("branches", "branches.csv"),
        ("special points", "transitions.csv"),
    ];
    album.show("fig2-branches", &figure(results), caption, &data)?;
    let rows: Vec<Vec<String>> = details(results).flat_map(rows).collect();
    let columns = [
        "Ω/ω_h",
        "",
        "What",
        "Period",
        "ζ_h",
        "Second method",
        "Switches",
    ];
    album.with(|page| {
        let title = format!(
            "The {} bifurcations and grazings that sweeps meet: on one side at least the orbit is stable",
            rows.len()
        );
        page.details(&title, |page| page.table(&columns, rows))
    });
    let others = details(results).flat_map(|(_, detail)| &detail.transitions);
    let others = others.filter(|transition| !transition.seen).count();
    album.say(&[
        &format!(
            "T: take-off, L: landing; a bar separates forcing periods. {others} more special points lie on parts \
             that are unstable on both sides; they are in transitions.csv."
        ),
        &agreement(results),
    ]);
    let caption = "Largest Lyapunov exponent of the motions of the rising sweeps, with its standard error: positive in \
                   chaos, zero at each bifurcation of a cycle, negative on stable cycles.";
    album.show(
        "fig2-exponents",
        &exponents(results),
        caption,
        &[("data", "exponents.csv")],
    )
}

/// How far the two methods are apart, measured on the table itself.
fn agreement(results: &Results) -> String {
    let all = details(results).flat_map(|(ratio, detail)| {
        let points = detail.transitions.iter();
        points.filter_map(move |point| {
            let apart = (point.second? - point.damping_ratio).abs();
            Some((apart, ratio, &point.label))
        })
    });
    let points: Vec<_> = all.collect();
    let largest = points.iter().max_by(|a, b| a.0.total_cmp(&b.0));
    let Some((apart, ratio, label)) = largest else {
        return String::new();
    };
    format!(
        "The two methods are at most {apart:.1e} apart in ζ_h, at {label} of Ω = {ratio:.1} ω_h; that is the largest of \
         {} differences in transitions.csv.",
        points.len()
    )
}

fn rows((ratio, detail): (f64, &Detail)) -> Vec<Vec<String>> {
    let seen = detail
        .transitions
        .iter()
        .filter(|transition| transition.seen);
    let row = |transition: &Transition| {
        let second = transition
            .second
            .map_or("none near".into(), |zeta| format!("{zeta:.10}"));
        vec![
            format!("{ratio:.1}"),
            transition.label.clone(),
            kinds::name(&transition.kind).into(),
            format!("{}T", transition.period),
            format!("{:.10}", transition.damping_ratio),
            second,
            transition.sequence.clone(),
        ]
    };
    seen.map(row).collect()
}

fn figure(results: &Results) -> Figure {
    let all = panels(results).filter_map(|(cloud, panel)| {
        let detail = panel.detail.as_ref()?;
        Some(Panel::from(diagram(cloud, detail)))
    });
    Figure::grid(1, all)
        .title("Periodic orbits behind Fig. 2")
        .plot_size(900.0, 330.0)
}

fn diagram(cloud: &Diagram, panel: &Detail) -> Branches {
    let title = format!("$Ω$ = {:.1} $ω_h$", cloud.ratio);
    let (mut x, mut y) = points(cloud, 0);
    let (more_x, more_y) = points(cloud, 1);
    x.extend(more_x);
    y.extend(more_y);
    let mut diagram = Branches::new(title, Axis::new(DAMPING), Axis::new(HEIGHT));
    diagram = diagram.cloud("Sweeps both ways", x, y);
    for limb in &panel.limbs {
        let label = format!("Period {}", limb.period);
        let (x, curves) = (limb.damping_ratio.clone(), limb.heights.clone());
        diagram = diagram
            .branch(label, x, &limb.stable, curves)
            .colour(Colour::of_period(limb.period as u32));
    }
    let seen = panel
        .transitions
        .iter()
        .filter(|transition| transition.seen);
    seen.fold(diagram, |diagram, transition| {
        let symbol = kinds::symbol(&transition.kind);
        let (zeta, heights) = (transition.damping_ratio, transition.heights.clone());
        diagram.special(symbol, &transition.label, zeta, heights)
    })
}

fn exponents(results: &Results) -> Figure {
    let panel = |panel: &PanelExponents| {
        let title = format!("$Ω$ = {:.1} $ω_h$", panel.ratio);
        let axis = Axis::new("Exponent $λ$ (1/period)");
        let zeta: Vec<f64> = panel.values.iter().map(|(zeta, _)| *zeta).collect();
        let value = |side: f64| -> Vec<f64> {
            let at = panel.values.iter();
            at.map(|(_, e)| e.per_iterate + side * e.standard_error)
                .collect()
        };
        let curves = Curves::new(title, Axis::new(DAMPING), axis)
            .line("$λ$ of the rising sweep", zeta, value(0.0))
            .band("± standard error", value(-1.0), value(1.0))
            .level("Zero", 0.0);
        Panel::from(curves)
    };
    Figure::grid(1, results.exponents.iter().map(panel))
        .title("Lyapunov exponents along Fig. 2")
        .plot_size(900.0, 240.0)
}
