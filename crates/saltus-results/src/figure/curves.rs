//! Ordinary line plots: errors over steps, backbones, spectra.

use super::axis::Axis;
use super::colour::Colour;
use super::panel::{Layer, Panel, Swatch};

/// Labelled curves, optionally with a dot at each point.
#[derive(Clone, Debug)]
pub struct Curves {
    panel: Panel,
    curves: usize,
}

impl Curves {
    /// An empty plot.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self {
            panel: Panel::new(title.into(), x, y, (0.03, 0.06)),
            curves: 0,
        }
    }

    /// Adds a line in the next colour of the fixed order.
    #[must_use]
    pub fn line(
        self,
        label: impl Into<String>,
        x: impl Into<Vec<f64>>,
        y: impl Into<Vec<f64>>,
    ) -> Self {
        self.add(label.into(), x.into(), y.into(), Style::Line)
    }

    /// Adds a line with a dot at each point.
    #[must_use]
    pub fn dotted_line(
        self,
        label: impl Into<String>,
        x: impl Into<Vec<f64>>,
        y: impl Into<Vec<f64>>,
    ) -> Self {
        self.add(label.into(), x.into(), y.into(), Style::Both)
    }

    /// Adds dots without a line.
    #[must_use]
    pub fn dots(
        self,
        label: impl Into<String>,
        x: impl Into<Vec<f64>>,
        y: impl Into<Vec<f64>>,
    ) -> Self {
        self.add(label.into(), x.into(), y.into(), Style::Dots)
    }

    /// A dashed horizontal reference line.
    #[must_use]
    pub fn level(mut self, label: impl Into<String>, y: f64) -> Self {
        self.panel.key(label.into(), Swatch::Dashes);
        self.panel.layers.push(Layer::Level { y });
        self
    }

    /// A vertical line at `x` with a label above the frame.
    #[must_use]
    pub fn flag(mut self, x: f64, label: impl Into<String>) -> Self {
        self.panel.flags.push((x, label.into()));
        self
    }

    fn add(mut self, label: String, x: Vec<f64>, y: Vec<f64>, style: Style) -> Self {
        let colour = Colour::of(&Colour::CURVES, self.curves);
        self.curves += 1;
        let swatch = match style {
            Style::Dots => Swatch::Dot {
                radius: 4.0,
                colour,
            },
            _ => Swatch::Line {
                width: 2.2,
                colour,
                dotted: style == Style::Both,
            },
        };
        self.panel.key(label, swatch);
        if style != Style::Dots {
            self.panel.layers.push(Layer::Line {
                x: x.clone(),
                y: y.clone(),
                width: 1.8,
                colour,
            });
        }
        if style != Style::Line {
            self.panel.layers.push(Layer::Dots {
                x,
                y,
                radius: 3.6,
                colour,
            });
        }
        self
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Style {
    Line,
    Both,
    Dots,
}

impl From<Curves> for Panel {
    fn from(curves: Curves) -> Self {
        curves.panel
    }
}
