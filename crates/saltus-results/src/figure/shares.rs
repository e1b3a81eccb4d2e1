//! Shares of a whole over a parameter, such as the basins of coexisting attractors, as stacked areas.

use super::axis::Axis;
use super::colour::Colour;
use super::panel::{Layer, Panel, Swatch};

/// Stacked areas over a parameter, the first at the bottom.
///
/// With the labels and colours of a [`Cloud`](super::Cloud) above it in a
/// [`Figure::grid`](super::Figure::grid) of one column, both need one legend only.
#[derive(Clone, Debug)]
pub struct Shares {
    title: String,
    x: Axis,
    y: Axis,
    at: Vec<f64>,
    shares: Vec<(String, Option<Colour>, Vec<f64>)>,
}

impl Shares {
    /// An empty diagram over the parameter values `at`. Limits of `y` follow the sum unless it has a range.
    pub fn new(title: impl Into<String>, x: Axis, at: impl Into<Vec<f64>>, y: Axis) -> Self {
        Self {
            title: title.into(),
            x,
            y,
            at: at.into(),
            shares: Vec::new(),
        }
    }

    /// Adds a share on top of those present, one value for each parameter value, in the next colour of the
    /// fixed order. Where one share is missing or not finite the sum is not known, and this share and those
    /// above it have a gap.
    #[must_use]
    pub fn share(mut self, label: impl Into<String>, values: impl Into<Vec<f64>>) -> Self {
        self.shares.push((label.into(), None, values.into()));
        self
    }

    /// Gives the share added last a colour of its own.
    #[must_use]
    pub fn colour(mut self, colour: Colour) -> Self {
        if let Some(share) = self.shares.last_mut() {
            share.1 = Some(colour);
        }
        self
    }
}

impl From<Shares> for Panel {
    fn from(stack: Shares) -> Self {
        let mut panel = Self::new(stack.title, stack.x, stack.y, (0.012, 0.0));
        let mut sum = vec![0.0; stack.at.len()];
        let mut areas = Vec::new();
        for (index, (label, colour, values)) in stack.shares.into_iter().enumerate() {
            let colour = colour.unwrap_or(Colour::of(&Colour::ATTRACTORS, index));
            panel.key(label, Swatch::Patch { colour });
            for (number, sum) in sum.iter_mut().enumerate() {
                *sum += values.get(number).copied().unwrap_or(f64::NAN);
            }
            areas.push(Layer::Area {
                x: stack.at.clone(),
                low: vec![0.0; sum.len()],
                high: sum.clone(),
                colour,
                opacity: 1.0,
            });
        }
        // Each area goes down to zero and hides part of the one before: areas side by side would show seams.
        panel.layers.extend(areas.into_iter().rev());
        panel.layers.push(Layer::Frame);
        panel
    }
}
