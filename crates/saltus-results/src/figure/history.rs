//! Time histories with shaded intervals, such as the flights of a jumper.

use super::axis::Axis;
use super::colour::Colour;
use super::panel::{Layer, Panel, Swatch};

/// Curves over time, with intervals shaded behind them and reference levels.
#[derive(Clone, Debug)]
pub struct History {
    panel: Panel,
    curves: usize,
}

impl History {
    /// An empty history.
    pub fn new(title: impl Into<String>, time: Axis, y: Axis) -> Self {
        Self {
            panel: Panel::new(title.into(), time, y, (0.0, 0.07)),
            curves: 0,
        }
    }

    /// Adds a curve in the next colour of the fixed order.
    #[must_use]
    pub fn curve(
        mut self,
        label: impl Into<String>,
        time: impl Into<Vec<f64>>,
        y: impl Into<Vec<f64>>,
    ) -> Self {
        let colour = Colour::of(&Colour::CURVES, self.curves);
        self.curves += 1;
        self.panel.key(
            label.into(),
            Swatch::Line {
                width: 2.0,
                colour,
                dotted: false,
            },
        );
        self.panel.layers.push(Layer::Line {
            x: time.into(),
            y: y.into(),
            width: 1.6,
            colour,
            dashed: false,
        });
        self
    }

    /// Shades intervals of time; overlapping ones are joined.
    #[must_use]
    pub fn shade(mut self, label: impl Into<String>, intervals: &[(f64, f64)]) -> Self {
        self.panel.shade(label.into(), intervals, Colour::SKY);
        self
    }

    /// A dashed horizontal line, such as the body weight.
    #[must_use]
    pub fn level(mut self, label: impl Into<String>, y: f64) -> Self {
        self.panel.level(label.into(), y);
        self
    }
}

impl From<History> for Panel {
    fn from(history: History) -> Self {
        history.panel
    }
}
