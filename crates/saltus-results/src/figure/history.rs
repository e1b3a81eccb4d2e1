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
        });
        self
    }

    /// Shades intervals of time; overlapping ones are joined.
    #[must_use]
    pub fn shade(mut self, label: impl Into<String>, intervals: &[(f64, f64)]) -> Self {
        let colour = Colour::SKY;
        self.panel.key(label.into(), Swatch::Shade { colour });
        self.panel.layers.insert(
            0,
            Layer::Bands {
                intervals: joined(intervals),
                colour,
            },
        );
        self
    }

    /// A dashed horizontal line, such as the body weight.
    #[must_use]
    pub fn level(mut self, label: impl Into<String>, y: f64) -> Self {
        self.panel.key(label.into(), Swatch::Dashes);
        self.panel.layers.push(Layer::Level { y });
        self
    }
}

impl From<History> for Panel {
    fn from(history: History) -> Self {
        history.panel
    }
}

/// Intervals in order and disjoint, so that no part is shaded twice.
fn joined(intervals: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut sorted: Vec<_> = intervals
        .iter()
        .copied()
        .filter(|(a, b)| a.is_finite() && b > a)
        .collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut joined: Vec<(f64, f64)> = Vec::new();
    for (start, end) in sorted {
        match joined.last_mut() {
            Some(last) if start <= last.1 => last.1 = last.1.max(end),
            _ => joined.push((start, end)),
        }
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overlapping_shades_are_joined() {
        let intervals = [
            (3.0, 4.0),
            (0.0, 1.0),
            (0.5, 2.0),
            (f64::NAN, 1.0),
            (9.0, 8.0),
        ];
        assert_eq!(joined(&intervals), [(0.0, 2.0), (3.0, 4.0)]);
    }
}
