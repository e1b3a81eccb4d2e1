//! Phase portraits: a trajectory with its stroboscopic points.

use super::axis::Axis;
use super::colour::Colour;
use super::panel::{Layer, Panel, Swatch};
use super::parts::only;
use super::thin::{CELL, strokes};

/// Velocity over position with the points of a stroboscopic map on top.
#[derive(Clone, Debug)]
pub struct Portrait {
    panel: Panel,
    points: usize,
}

impl Portrait {
    /// An empty portrait.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self {
            panel: Panel::new(title.into(), x, y, (0.06, 0.07)),
            points: 0,
        }
    }

    /// Adds a trajectory as a thin grey line under the points.
    #[must_use]
    pub fn path(
        mut self,
        label: impl Into<String>,
        x: impl Into<Vec<f64>>,
        y: impl Into<Vec<f64>>,
    ) -> Self {
        let layer = Layer::Line {
            x: x.into(),
            y: y.into(),
            width: LINE,
            colour: Colour::GREY,
            dashed: false,
        };
        self.panel.key(label.into(), swatch(Colour::GREY));
        self.panel.layers.push(layer);
        self
    }

    /// Adds a trajectory of which a part is marked by a second colour, such as the flight between
    /// two contacts: the step from sample `i` to `i + 1` is marked where `marked[i]` is true.
    #[must_use]
    pub fn marked_path(
        mut self,
        labels: (&str, &str),
        x: impl Into<Vec<f64>>,
        y: impl Into<Vec<f64>>,
        marked: &[bool],
    ) -> Self {
        let (x, y) = (x.into(), y.into());
        for (wanted, label, colour) in [
            (false, labels.0, Colour::GREY),
            (true, labels.1, Colour::SKY),
        ] {
            let (x, y) = only(&x, &y, marked, wanted);
            self.panel.key(label.to_owned(), swatch(colour));
            self.panel.layers.push(Layer::Line {
                x,
                y,
                width: LINE,
                colour,
                dashed: false,
            });
        }
        self
    }

    /// Adds points of little weight, such as those of a transient, in light grey.
    #[must_use]
    pub fn faint(
        mut self,
        label: impl Into<String>,
        x: impl Into<Vec<f64>>,
        y: impl Into<Vec<f64>>,
    ) -> Self {
        let (radius, colour) = (2.0, Colour(176, 176, 176));
        self.panel.key(label.into(), Swatch::Dot { radius, colour });
        let (x, y) = (x.into(), y.into());
        self.panel.layers.push(Layer::Dots {
            x,
            y,
            radius,
            colour,
        });
        self
    }

    /// Adds stroboscopic points: large dots while they can be counted, fine ones for a chaotic set.
    #[must_use]
    pub fn points(
        mut self,
        label: impl Into<String>,
        x: impl Into<Vec<f64>>,
        y: impl Into<Vec<f64>>,
    ) -> Self {
        let (x, y) = (x.into(), y.into());
        let colour = Colour::of(&Colour::POINTS, self.points);
        self.points += 1;
        let layer = match distinct(&x, &y) {
            0..=40 => Layer::Dots {
                x,
                y,
                radius: 4.5,
                colour,
            },
            41..=250 => Layer::Dots {
                x,
                y,
                radius: 2.6,
                colour,
            },
            _ => Layer::Dust {
                x,
                y,
                pen: 2.0,
                colour,
                shaded: false,
            },
        };
        self.panel.key(
            label.into(),
            Swatch::Dot {
                radius: 4.0,
                colour,
            },
        );
        self.panel.layers.push(layer);
        self
    }
}

impl From<Portrait> for Panel {
    fn from(portrait: Portrait) -> Self {
        let mut panel = portrait.panel;
        // Points belong on top, whatever the order of the calls; the sort is stable.
        panel
            .layers
            .sort_by_key(|layer| !matches!(layer, Layer::Line { .. }));
        panel
            .keys
            .sort_by_key(|key| !matches!(key.swatch, Swatch::Line { .. }));
        panel
    }
}

/// Width of a trajectory (px).
const LINE: f64 = 1.4;

fn swatch(colour: Colour) -> Swatch {
    Swatch::Line {
        width: 2.0,
        colour,
        dotted: false,
    }
}

/// Number of points that look different, roughly: on a grid of some hundred cells a side.
fn distinct(x: &[f64], y: &[f64]) -> usize {
    let unit = |values: &[f64]| {
        let finite = values.iter().copied().filter(|v| v.is_finite());
        let (low, high) = finite.fold((f64::MAX, f64::MIN), |(a, b), v| (a.min(v), b.max(v)));
        (
            low,
            if high > low {
                200.0 * CELL / (high - low)
            } else {
                0.0
            },
        )
    };
    let ((x0, sx), (y0, sy)) = (unit(x), unit(y));
    let grid: Vec<_> = x
        .iter()
        .zip(y)
        .filter(|(x, y)| x.is_finite() && y.is_finite())
        .map(|(x, y)| ((x - x0) * sx, (y - y0) * sy))
        .collect();
    strokes(&grid, CELL, CELL).len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_periodic_orbit_counts_few_points_and_a_chaotic_one_many() {
        let periodic: Vec<f64> = (0..300).map(|i| f64::from(i % 3)).collect();
        assert_eq!(distinct(&periodic, &periodic), 3);
        let spread: Vec<f64> = (0..3000).map(|i| (f64::from(i) * 0.618).fract()).collect();
        let other: Vec<f64> = (0..3000).map(|i| (f64::from(i) * 0.755).fract()).collect();
        assert!(distinct(&spread, &other) > 250);
        assert_eq!(distinct(&[f64::NAN], &[1.0]), 0);
    }
}
