//! Ordinary line plots: errors over steps, backbones, exponents over a parameter or over iterates.

use super::axis::Axis;
use super::colour::Colour;
use super::panel::{Layer, Panel, Swatch};
use super::style::BAND;

/// Labelled curves, optionally with a dot at each point and with their uncertainty.
#[derive(Clone, Debug)]
pub struct Curves {
    panel: Panel,
    curves: Vec<Curve>,
    shades: usize,
}

#[derive(Clone, Debug)]
struct Curve {
    label: String,
    colour: Colour,
    x: Vec<f64>,
    y: Vec<f64>,
    style: Style,
    spreads: Vec<Spread>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Style {
    Line,
    Both,
    Dots,
}

/// Uncertainty of a curve.
#[derive(Clone, Debug)]
struct Spread {
    label: String,
    low: Vec<f64>,
    high: Vec<f64>,
    bars: bool,
}

impl Curves {
    /// An empty plot.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self {
            panel: Panel::new(title.into(), x, y, (0.03, 0.06)),
            curves: Vec::new(),
            shades: 0,
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

    /// Gives the curve added last, with its band and bars, a colour of its own.
    #[must_use]
    pub fn colour(mut self, colour: Colour) -> Self {
        if let Some(curve) = self.curves.last_mut() {
            curve.colour = colour;
        }
        self
    }

    /// Shades the area between `low` and `high` (values, not distances) around the curve added last. The
    /// label says what the band is, such as "± one standard error"; equal labels are shown once.
    #[must_use]
    pub fn band(
        self,
        label: impl Into<String>,
        low: impl Into<Vec<f64>>,
        high: impl Into<Vec<f64>>,
    ) -> Self {
        self.spread(label.into(), low.into(), high.into(), false)
    }

    /// Draws a bar from `low` to `high` (values, not distances) at each point of the curve added last. The
    /// label says what the bars are, such as "95 % confidence interval"; equal labels are shown once.
    #[must_use]
    pub fn bars(
        self,
        label: impl Into<String>,
        low: impl Into<Vec<f64>>,
        high: impl Into<Vec<f64>>,
    ) -> Self {
        self.spread(label.into(), low.into(), high.into(), true)
    }

    /// Shades intervals of x behind all curves, such as those of chaotic motion, in the next light colour;
    /// overlapping intervals are joined.
    #[must_use]
    pub fn shade(mut self, label: impl Into<String>, intervals: &[(f64, f64)]) -> Self {
        let colour = Colour::of(&Colour::SHADES, self.shades);
        self.shades += 1;
        // the colour is taken all the same, so that it means the same in every figure
        if !intervals.is_empty() {
            self.panel.shade(label.into(), intervals, colour);
        }
        self
    }

    /// A dashed horizontal reference line.
    #[must_use]
    pub fn level(mut self, label: impl Into<String>, y: f64) -> Self {
        self.panel.level(label.into(), y);
        self
    }

    /// A vertical line at `x` with a label above the frame.
    #[must_use]
    pub fn flag(mut self, x: f64, label: impl Into<String>) -> Self {
        self.panel.flags.push((x, label.into()));
        self
    }

    fn add(mut self, label: String, x: Vec<f64>, y: Vec<f64>, style: Style) -> Self {
        let colour = Colour::of(&Colour::CURVES, self.curves.len());
        self.curves.push(Curve {
            label,
            colour,
            x,
            y,
            style,
            spreads: Vec::new(),
        });
        self
    }

    fn spread(mut self, label: String, low: Vec<f64>, high: Vec<f64>, bars: bool) -> Self {
        if let Some(curve) = self.curves.last_mut() {
            curve.spreads.push(Spread {
                label,
                low,
                high,
                bars,
            });
        }
        self
    }
}

impl From<Curves> for Panel {
    fn from(plot: Curves) -> Self {
        let mut panel = plot.panel;
        // Curves come first in the legend, reference lines and shades after them.
        let references = std::mem::take(&mut panel.keys);
        for curve in &plot.curves {
            panel.key(curve.label.clone(), curve.swatch());
        }
        let (bars, bands) = plot
            .curves
            .iter()
            .flat_map(|curve| curve.spreads.iter().map(move |spread| (curve, spread)))
            .partition::<Vec<_>, _>(|(_, spread)| spread.bars);
        for (curve, spread) in bands.into_iter().chain(bars) {
            panel.key(spread.label.clone(), spread.swatch());
            panel.layers.push(spread.layer(curve));
        }
        panel.keys.extend(references);
        panel
            .layers
            .extend(plot.curves.into_iter().flat_map(Curve::layers));
        panel
    }
}

impl Curve {
    fn swatch(&self) -> Swatch {
        let colour = self.colour;
        match self.style {
            Style::Dots => Swatch::Dot {
                radius: 4.0,
                colour,
            },
            _ => Swatch::Line {
                width: 2.2,
                colour,
                dotted: self.style == Style::Both,
            },
        }
    }

    fn layers(self) -> Vec<Layer> {
        let Self {
            x,
            y,
            colour,
            style,
            ..
        } = self;
        let mut layers = Vec::new();
        if style != Style::Dots {
            layers.push(Layer::Line {
                x: x.clone(),
                y: y.clone(),
                width: 1.8,
                colour,
                dashed: false,
            });
        }
        if style != Style::Line {
            layers.push(Layer::Dots {
                x,
                y,
                radius: 3.6,
                colour,
            });
        }
        layers
    }
}

impl Spread {
    fn swatch(&self) -> Swatch {
        match self.bars {
            true => Swatch::Bar,
            false => Swatch::Band,
        }
    }

    fn layer(&self, curve: &Curve) -> Layer {
        let (x, low, high) = (curve.x.clone(), self.low.clone(), self.high.clone());
        let colour = curve.colour;
        match self.bars {
            true => Layer::Bars {
                x,
                low,
                high,
                colour,
            },
            false => Layer::Area {
                x,
                low,
                high,
                colour,
                opacity: BAND,
            },
        }
    }
}
