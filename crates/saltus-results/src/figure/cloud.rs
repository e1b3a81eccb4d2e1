//! Bifurcation diagrams: clouds of points, drawn so that none hides another.

use super::axis::{Axis, Extent};
use super::colour::Colour;
use super::panel::{Layer, Panel, Swatch};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

/// Several clouds of points over a common parameter.
///
/// The more points on a place, the darker it is. The first series is black. Of each later one only the values of the
/// parameter are drawn at which its points differ from those of all series before: so two sweeps show where there is
/// hysteresis, and one cloud elsewhere. Series that cannot coincide, such as attractors, are better drawn
/// [`apart`](Self::apart).
#[derive(Clone, Debug)]
pub struct Cloud {
    title: String,
    x: Axis,
    y: Axis,
    series: Vec<Series>,
    /// Diameter (px) of the dots of series that are apart.
    apart: Option<f64>,
    flags: Vec<(f64, String)>,
}

#[derive(Clone, Debug)]
struct Series {
    label: String,
    colour: Option<Colour>,
    x: Vec<f64>,
    y: Vec<f64>,
}

impl Cloud {
    /// An empty diagram.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self {
            title: title.into(),
            x,
            y,
            series: Vec::new(),
            apart: None,
            flags: Vec::new(),
        }
    }

    /// Adds points on top of those present, in the next colour of the fixed order. The shorter of
    /// `x` and `y` counts; points that are not finite are skipped.
    #[must_use]
    pub fn series(
        mut self,
        label: impl Into<String>,
        x: impl Into<Vec<f64>>,
        y: impl Into<Vec<f64>>,
    ) -> Self {
        self.series.push(Series {
            label: label.into(),
            colour: None,
            x: x.into(),
            y: y.into(),
        });
        self
    }

    /// Gives the series added last a colour of its own.
    #[must_use]
    pub fn colour(mut self, colour: Colour) -> Self {
        if let Some(series) = self.series.last_mut() {
            series.colour = Some(colour);
        }
        self
    }

    /// Draws series that have no points in common: dots of one size in the order of [`Colour::ATTRACTORS`], the
    /// series with the fewest points on top, so that a cycle shows before chaos.
    #[must_use]
    pub fn apart(mut self) -> Self {
        self.apart = Some(FINE);
        self
    }

    /// As [`apart`](Self::apart), for series over `count` different x spread over the width of a
    /// [`Figure`](super::Figure) of one column: the fewer, the wider the dots, within what is still a dot.
    #[must_use]
    pub fn apart_over(mut self, count: usize) -> Self {
        self.apart = Some((0.3 * 760.0 / count.max(1) as f64).clamp(FINE, 5.0));
        self
    }

    /// A vertical line at `x` with a label above the frame.
    #[must_use]
    pub fn flag(mut self, x: f64, label: impl Into<String>) -> Self {
        self.flags.push((x, label.into()));
        self
    }
}

/// Diameter (px) of dots that are apart and many.
const FINE: f64 = 2.2;

/// Diameter (px) of a point of a cloud over many values of its parameter, and over few.
const POINT: (f64, f64) = (1.7, 3.4);

/// Diameter (px) of the points of a cloud over so many values.
fn point(values: usize) -> f64 {
    (0.3 * 760.0 / values.max(1) as f64).clamp(POINT.0, POINT.1)
}

/// Distance of points that look the same, as a share of the extent of all, and the share of the points of two clouds
/// that have such a neighbour in the other if both are the same.
const NEAR: f64 = 0.025;
const MOST: f64 = 0.85;

/// The points of `series` at values at which they differ from those of each series `before`; `extent` is that of all
/// points in y.
fn different(series: &Series, before: &[Rows], extent: f64) -> (Vec<f64>, Vec<f64>) {
    let rows = rows(series);
    let known = |value: &u64, points: &Vec<f64>| {
        before.iter().any(|earlier| {
            let there = earlier.get(value);
            there.is_some_and(|there| alike(points, there, NEAR * extent))
        })
    };
    let new = rows.iter().filter(|(value, points)| !known(value, points));
    new.flat_map(|(&value, points)| points.iter().map(move |&y| (f64::from_bits(value), y)))
        .unzip()
}

/// Points in ascending order by the bits of their parameter.
type Rows = BTreeMap<u64, Vec<f64>>;

fn rows(series: &Series) -> Rows {
    let mut rows = Rows::new();
    for (x, &y) in series
        .x
        .iter()
        .zip(&series.y)
        .filter(|(_, y)| y.is_finite())
    {
        rows.entry(x.to_bits()).or_default().push(y);
    }
    rows.values_mut()
        .for_each(|row| row.sort_by(f64::total_cmp));
    rows
}

/// Points that are apart beyond which a row is no cycle but a cloud, and the part of their extent that two clouds have
/// in common at least if they are samples of one.
const CYCLE: usize = 32;
const COMMON: f64 = 0.6;

/// Whether two sorted rows look the same: two clouds if they extend alike, others if most points of each have a
/// neighbour in the other.
fn alike(one: &[f64], two: &[f64], near: f64) -> bool {
    let cloud = |points: &[f64]| {
        let apart = points
            .windows(2)
            .filter(|pair| pair[1] - pair[0] > 0.02 * near);
        apart.count() > CYCLE
    };
    if let ([a, .., b], [c, .., d]) = (one, two)
        && cloud(one)
        && cloud(two)
    {
        return b.min(*d) - a.max(*c) > COMMON * (b.max(*d) - a.min(*c));
    }
    let covered = |points: &[f64], by: &[f64]| {
        let close = |y: &&f64| {
            let next = by.partition_point(|other| *other < **y - near);
            by.get(next).is_some_and(|other| *other <= **y + near)
        };
        points.iter().filter(close).count() as f64 >= MOST * points.len() as f64
    };
    covered(one, two) && covered(two, one)
}

impl From<Cloud> for Panel {
    fn from(cloud: Cloud) -> Self {
        let mut panel = Self::new(cloud.title, cloud.x, cloud.y, (0.012, 0.05));
        panel.flags = cloud.flags;
        let order: &[Colour] = match cloud.apart {
            Some(_) => &Colour::ATTRACTORS,
            None => &Colour::CLOUDS,
        };
        let mut extent = Extent::EMPTY;
        let heights = cloud.series.iter().flat_map(|series| &series.y);
        heights.for_each(|&y| extent.include(&panel.y, y));
        let extent = extent.limits().map_or(0.0, |(low, high)| high - low);
        let mut before: Vec<Rows> = Vec::new();
        let values = cloud.series.iter().flat_map(|series| &series.x);
        let values: BTreeSet<u64> = values.map(|x| x.to_bits()).collect();
        let pen = cloud.apart.unwrap_or(point(values.len()));
        for (index, series) in cloud.series.into_iter().enumerate() {
            let colour = series.colour.unwrap_or(Colour::of(order, index));
            let (x, y) = match cloud.apart {
                Some(_) => (series.x, series.y),
                None => {
                    let new = different(&series, &before, extent);
                    before.push(rows(&series));
                    new
                }
            };
            if index > 0 && x.is_empty() {
                continue;
            }
            panel.key(
                series.label,
                Swatch::Dot {
                    radius: 1.4 + 0.9 * pen.min(4.0),
                    colour,
                },
            );
            panel.layers.push(Layer::Dust {
                x,
                y,
                pen,
                colour,
                shaded: cloud.apart.is_none(),
            });
        }
        if cloud.apart.is_some() {
            panel.layers.sort_by_key(|layer| match layer {
                Layer::Dust { x, .. } => Reverse(x.len()),
                _ => Reverse(0),
            });
        }
        panel
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_sweep_shows_where_it_differs() {
        let series = |y: &[f64]| Series {
            label: String::new(),
            colour: None,
            x: (0..y.len()).map(|i| (i / 2) as f64).collect(),
            y: y.to_vec(),
        };
        let first = series(&[1.0, 2.0, 1.0, 2.0, 1.0, 1.0, f64::NAN, f64::NAN]);
        let second = series(&[1.001, 2.0, 1.0, 1.0, 1.0, 1.0, 3.0, 3.0]);
        let (x, y) = different(&second, &[rows(&first)], 2.0);
        assert_eq!((x, y), (vec![1.0, 1.0, 3.0, 3.0], vec![1.0, 1.0, 3.0, 3.0]));
    }
}
