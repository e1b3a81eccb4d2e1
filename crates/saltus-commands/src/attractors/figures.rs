//! The figure of attractors: sections in one colour for each, and below it the shares of their basins.

use super::data::share;
use super::{Found, name};
use crate::colours;
use crate::per_jumper::{PANELS, page, panel_title};
use crate::words::{self, SECTION_HEIGHT, SECTION_VELOCITY, base_in_title};
use saltus::study::{BasinFraction, Bodies, CountedAttractor};
use saltus_config::Parameter;
use saltus_results::{Axis, Cloud, Colour, Curves, Figure, Panel};
use std::cmp::Reverse;

pub(super) fn attractors(found: &Found) -> Figure {
    let shown = found.jumpers().min(PANELS);
    let series = Series::all(found);
    let panels: Vec<Panel> = match &found.parameter {
        Some(parameter) => {
            let clouds = (0..shown).map(|i| cloud(found, parameter, &series, i).into());
            clouds
                .chain([shares(found, parameter, &series).into()])
                .collect()
        }
        None => (0..shown)
            .map(|i| plane(found, &series, i).into())
            .collect(),
    };
    let base = base_in_title(&found.study, found.parameter.as_ref());
    let each = found.parameter.as_ref().map_or("", |_| " per value");
    let starts = found.study.attractors.starts;
    let title = format!("Attractors: {base}{starts} quasi-random initial conditions{each}");
    match <[Panel; 1]>::try_from(panels) {
        Ok([only]) => Figure::new(only).title(title),
        Err(panels) => page(1, panels).title(title),
    }
}

/// A set of motions in one colour: those of an attractor, or of all that there is no colour for.
struct Series<'a> {
    label: String,
    colour: Colour,
    /// With the places of their values.
    points: Vec<(usize, &'a CountedAttractor)>,
}

impl<'a> Series<'a> {
    /// Those that most initial conditions led to have colours of their own.
    fn all(found: &'a Found) -> Vec<Self> {
        let count = found.all.identities.len();
        let mut its: Vec<Vec<(usize, &CountedAttractor)>> = vec![Vec::new(); count];
        for (place, row) in found.all.rows.iter().enumerate() {
            for one in row.attractors() {
                its[one.identity].push((place, one));
            }
        }
        let starts = |identity: &usize| its[*identity].iter().map(|(_, one)| one.fraction.count);
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by_key(|identity| Reverse(starts(identity).sum::<u64>()));
        let (own, rest) = order.split_at(count.min(Colour::ATTRACTORS.len()));
        let mut own = own.to_vec();
        own.sort_unstable();
        let series = |(&identity, colour): (&usize, Colour)| Series {
            label: label(found, identity, &its[identity]),
            colour,
            points: its[identity].clone(),
        };
        let colours: Vec<Colour> = match found.parameter {
            // along a parameter one attractor has many periods
            Some(_) => Colour::ATTRACTORS.to_vec(),
            None => {
                let first = own.iter().filter_map(|&identity| its[identity].first());
                let kinds = first.map(|(_, one)| one.entry.attractor.kind);
                colours::of(kinds).into_iter().flatten().collect()
            }
        };
        let mut all: Vec<Self> = own.iter().zip(colours).map(series).collect();
        all.extend(rest.first().map(|_| Series {
            label: "Other attractors".to_owned(),
            colour: Colour::GREY,
            points: rest.iter().flat_map(|&other| its[other].clone()).collect(),
        }));
        all
    }

    /// Value, low and high of its share at each of `values` values, of so many starts; not finite where it is not.
    fn shares(&self, values: usize, of: u64) -> Vec<[f64; 3]> {
        let mut counts = vec![None; values];
        for &(place, one) in &self.points {
            *counts[place].get_or_insert(0) += one.fraction.count;
        }
        let share = |count: Option<u64>| {
            count.map_or([f64::NAN; 3], |count| share(BasinFraction { count, of }))
        };
        counts.into_iter().map(share).collect()
    }

    /// All samples of a jumper with the places of their values.
    fn samples(&self, jumper: usize) -> impl Iterator<Item = (usize, [f64; 2])> {
        self.points.iter().flat_map(move |(place, one)| {
            let [z, v] = [one.arrival.z(), one.arrival.v()].map(|all| all.get(jumper));
            let samples = z.into_iter().flatten().zip(v.into_iter().flatten());
            samples.map(|(&z, &v)| (*place, [z, v]))
        })
    }
}

/// With its share where it has but one.
fn label(found: &Found, identity: usize, its: &[(usize, &CountedAttractor)]) -> String {
    match (its, &found.parameter) {
        ([(_, one)], None) => {
            let [share, low, high] = share(one.fraction).map(|share| 100.0 * share);
            let kind = name(one);
            format!(
                "{}: {kind}, {share:.1} % ({low:.1} to {high:.1} %)",
                identity + 1
            )
        }
        _ => format!("{}: {}", identity + 1, found.kinds(identity)),
    }
}

/// The axis of the parameter, the same for all panels.
fn axis(found: &Found, parameter: &Parameter) -> Axis {
    let values = found.values().into_iter();
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    let margin = 0.015 * (high - low);
    words::axis(parameter).range(low - margin, high + margin)
}

fn cloud(found: &Found, parameter: &Parameter, series: &[Series], jumper: usize) -> Cloud {
    let cloud = Cloud::new(
        panel_title(jumper, found.jumpers()),
        axis(found, parameter),
        Axis::new(SECTION_HEIGHT),
    );
    series
        .iter()
        .fold(cloud.apart_over(found.all.rows.len()), |cloud, one| {
            let points = one
                .samples(jumper)
                .map(|(place, [z, _])| (found.all.rows[place].value, z));
            let (values, heights): (Vec<f64>, Vec<f64>) = points.unzip();
            cloud.series(&one.label, values, heights).colour(one.colour)
        })
}

/// Values whose dots and bars have room beside each other.
const ROOMY: usize = 120;

fn shares(found: &Found, parameter: &Parameter, series: &[Series]) -> Curves {
    let plot = Curves::new(
        "",
        axis(found, parameter),
        Axis::new("Part of the initial conditions").range(-0.02, 1.02),
    );
    let values = found.values();
    let plot = series.iter().fold(plot, |plot, one| {
        let parts = one.shares(values.len(), found.study.attractors.starts.into());
        let part = |part: usize| parts.iter().map(|share| share[part]).collect::<Vec<f64>>();
        let interval = "95 % confidence interval";
        match values.len() > ROOMY {
            true => plot
                .line(&one.label, &values[..], part(0))
                .colour(one.colour)
                .band(interval, part(1), part(2)),
            false => plot
                .dots(&one.label, &values[..], part(0))
                .colour(one.colour)
                .bars(interval, part(1), part(2)),
        }
    });
    hysteresis(found, without_attractor(found, plot))
}

/// Part of the initial conditions that led to no attractor.
fn without_attractor(found: &Found, plot: Curves) -> Curves {
    let none = found.all.rows.iter().filter_map(|row| {
        let census = row.census.as_ref().ok()?;
        let share = census.undecided.value() + census.lost.value();
        Some((found.value(row)?, share)).filter(|_| share > 0.0)
    });
    let (values, none): (Vec<f64>, Vec<f64>) = none.unzip();
    if none.is_empty() {
        return plot;
    }
    plot.dots("Undecided or lost", values, none)
        .colour(Colour::UNDECIDED)
}

fn hysteresis(found: &Found, plot: Curves) -> Curves {
    if found.all.loops.is_empty() {
        return plot;
    }
    let middle = |jump: Option<[f64; 2]>| jump.map(|[low, high]| 0.5 * (low + high));
    let loops = found.all.loops.iter().map(|one| {
        let from = middle(one.jump_down).unwrap_or(one.from);
        (from, middle(one.jump_up).unwrap_or(one.to))
    });
    plot.shade("Hysteresis", &loops.collect::<Vec<_>>())
}

/// Sections in the plane of height and velocity, cycles on top of what is not periodic.
fn plane(found: &Found, series: &[Series], jumper: usize) -> Curves {
    let plot = Curves::new(
        panel_title(jumper, found.jumpers()),
        Axis::new(SECTION_HEIGHT),
        Axis::new(SECTION_VELOCITY),
    );
    let mut order: Vec<&Series> = series.iter().collect();
    order.sort_by_key(|one| Reverse(one.samples(jumper).count()));
    order.into_iter().fold(plot, |plot, one| {
        let (z, v): (Vec<f64>, Vec<f64>) = one.samples(jumper).map(|(_, [z, v])| (z, v)).unzip();
        plot.dots(&one.label, z, v).colour(one.colour)
    })
}
