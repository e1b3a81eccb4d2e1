//! The figure of attractors: sections in one colour for each, and below it the shares of their basins.

use super::Run;
use super::report::{Attractor, Report, name};
use crate::commands::capitalized;
use crate::per_jumper::{PANELS, panel_title};
use saltus_config::Parameter;
use saltus_results::{Axis, Cloud, Colour, Curves, Figure, Panel};
use std::cmp::Reverse;

pub(super) fn attractors(run: &Run, report: &Report) -> Figure {
    let shown = run.study.jumper.len().min(PANELS);
    let series = Series::all(run, report);
    let panels: Vec<Panel> = match &run.parameter {
        Some(parameter) => {
            let clouds = (0..shown).map(|i| cloud(run, parameter, &series, i).into());
            clouds
                .chain([shares(run, parameter, &series).into()])
                .collect()
        }
        None => (0..shown).map(|i| plane(run, &series, i).into()).collect(),
    };
    let title = format!("Attractors: {} quasi-random first states", report.starts);
    match <[Panel; 1]>::try_from(panels) {
        Ok([only]) => Figure::new(only).title(title),
        Err(panels) => Figure::grid(1, panels).title(title),
    }
}

/// What is drawn in one colour: an attractor, or all that there is no colour for.
struct Series<'a> {
    label: String,
    colour: Colour,
    /// With the value of the parameter.
    points: Vec<(f64, &'a Attractor)>,
}

impl<'a> Series<'a> {
    /// Those that most first states led to have colours of their own.
    fn all(run: &Run, report: &'a Report) -> Vec<Self> {
        let count = report.attractors.len();
        let mut its: Vec<Vec<(f64, &Attractor)>> = vec![Vec::new(); count];
        for (row, found) in report.rows.iter().zip(&run.found.rows) {
            for one in &row.attractors {
                its[one.number - 1].push((found.value, one));
            }
        }
        let starts = |identity: &usize| its[*identity].iter().map(|(_, one)| one.drawn.starts);
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by_key(|identity| Reverse(starts(identity).sum::<u64>()));
        let (own, rest) = order.split_at(count.min(Colour::ATTRACTORS.len()));
        let mut own = own.to_vec();
        own.sort_unstable();
        let series = |(&identity, colour): (&usize, Colour)| Series {
            label: label(run, identity, &its[identity]),
            colour,
            points: its[identity].clone(),
        };
        let mut all: Vec<Self> = own.iter().zip(Colour::ATTRACTORS).map(series).collect();
        all.extend(rest.first().map(|_| Series {
            label: "Other attractors".to_owned(),
            colour: Colour::GREY,
            points: rest.iter().flat_map(|&other| its[other].clone()).collect(),
        }));
        all
    }

    /// All samples of a jumper with the values at which they are.
    fn samples(&self, jumper: usize) -> impl Iterator<Item = (f64, [f64; 2])> {
        self.points.iter().flat_map(move |(value, one)| {
            let (z, v) = (one.z.as_slice().get(jumper), one.v.as_slice().get(jumper));
            let samples = z.into_iter().flatten().zip(v.into_iter().flatten());
            samples.map(|(&z, &v)| (*value, [z, v]))
        })
    }
}

/// With its share where it has but one.
fn label(run: &Run, identity: usize, its: &[(f64, &Attractor)]) -> String {
    match (its, &run.parameter) {
        ([(_, one)], None) => {
            let [share, low, high] = one.drawn.share.map(|share| 100.0 * share);
            let kind = name(one.period);
            format!(
                "{}: {kind}, {share:.1} % ({low:.1} to {high:.1} %)",
                identity + 1
            )
        }
        _ => format!("{}: {}", identity + 1, run.kinds(identity)),
    }
}

/// The axis of the parameter, the same for all panels.
fn axis(run: &Run, parameter: &Parameter) -> Axis {
    let values = run.found.rows.iter().map(|row| row.value);
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    let margin = 0.015 * (high - low);
    Axis::new(capitalized(&parameter.label())).range(low - margin, high + margin)
}

fn cloud(run: &Run, parameter: &Parameter, series: &[Series], jumper: usize) -> Cloud {
    let cloud = Cloud::new(
        panel_title(jumper, run.study.jumper.len()),
        axis(run, parameter),
        Axis::new("Height z/η at cos Ωt = 1 (-)"),
    );
    series.iter().fold(cloud.apart(), |cloud, one| {
        let points = one.samples(jumper).map(|(value, [z, _])| (value, z));
        let (values, heights): (Vec<f64>, Vec<f64>) = points.unzip();
        cloud.series(&one.label, values, heights).colour(one.colour)
    })
}

fn shares(run: &Run, parameter: &Parameter, series: &[Series]) -> Curves {
    let plot = Curves::new(
        "",
        axis(run, parameter),
        Axis::new("Part of the first states (-)").range(-0.02, 1.02),
    );
    let plot = series.iter().fold(plot, |plot, one| {
        let values: Vec<f64> = one.points.iter().map(|(value, _)| *value).collect();
        let part = |part: usize| -> Vec<f64> {
            let shares = one.points.iter().map(|(_, one)| one.drawn.share);
            shares.map(|share| share[part]).collect()
        };
        plot.dots(&one.label, values, part(0))
            .colour(one.colour)
            .bars("95 % confidence interval", part(1), part(2))
    });
    if run.found.loops.is_empty() {
        return plot;
    }
    let middle = |jump: Option<[f64; 2]>| jump.map(|[low, high]| 0.5 * (low + high));
    let loops = run.found.loops.iter().map(|one| {
        let from = middle(one.jump_down).unwrap_or(one.from);
        (from, middle(one.jump_up).unwrap_or(one.to))
    });
    plot.shade("Hysteresis", &loops.collect::<Vec<_>>())
}

/// Sections in the plane of height and velocity, cycles on top of what is not periodic.
fn plane(run: &Run, series: &[Series], jumper: usize) -> Curves {
    let plot = Curves::new(
        panel_title(jumper, run.study.jumper.len()),
        Axis::new("Height z/η at cos Ωt = 1 (-)"),
        Axis::new("Velocity ż/(η ω_h) at cos Ωt = 1 (-)"),
    );
    let mut order: Vec<&Series> = series.iter().collect();
    order.sort_by_key(|one| Reverse(one.samples(jumper).count()));
    order.into_iter().fold(plot, |plot, one| {
        let (z, v): (Vec<f64>, Vec<f64>) = one.samples(jumper).map(|(_, [z, v])| (z, v)).unzip();
        plot.dots(&one.label, z, v).colour(one.colour)
    })
}
