//! Bifurcation diagrams: clouds of points, drawn so that none hides another.

use super::axis::Axis;
use super::colour::Colour;
use super::panel::{Layer, Panel, Swatch};
use std::cmp::Reverse;

/// Several clouds of points over a common parameter.
///
/// The first series is drawn at the bottom with the largest and lightest dots, each later one
/// smaller and on top. Where two series coincide the later shows its dot with a rim of the earlier;
/// where only one is present its bare dot shows. Nothing is transparent, so a colour means one thing.
/// Series that cannot coincide, such as attractors, are better drawn [`apart`](Self::apart).
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

/// Diameter (px) of the dots of series `index` of `count`: from wide below to fine on top.
fn pen(index: usize, count: usize) -> f64 {
    const FINE: f64 = 1.4;
    let wide = match count {
        0 | 1 => return 1.7,
        2 => 3.2,
        _ => 4.0,
    };
    let depth = (count - 1 - index) as f64 / (count - 1) as f64;
    FINE + (wide - FINE) * depth
}

impl From<Cloud> for Panel {
    fn from(cloud: Cloud) -> Self {
        let mut panel = Self::new(cloud.title, cloud.x, cloud.y, (0.012, 0.05));
        panel.flags = cloud.flags;
        let count = cloud.series.len();
        let order: &[Colour] = match cloud.apart {
            Some(_) => &Colour::ATTRACTORS,
            None => &Colour::NESTED,
        };
        for (index, series) in cloud.series.into_iter().enumerate() {
            let colour = series.colour.unwrap_or(Colour::of(order, index));
            let pen = cloud.apart.unwrap_or(pen(index, count));
            panel.key(
                series.label,
                Swatch::Dot {
                    radius: 1.4 + 0.9 * pen.min(4.0),
                    colour,
                },
            );
            panel.layers.push(Layer::Dust {
                x: series.x,
                y: series.y,
                pen,
                colour,
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
