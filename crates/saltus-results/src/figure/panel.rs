//! One panel: two axes and the layers between them. The kinds of figure only fill one in.

use super::axis::{Axis, Extent};
use super::bar::Bar;
use super::colour::Colour;
use super::mosaic::Cells;

/// One panel of a figure. Made from a [`Cloud`](super::Cloud), [`Portrait`](super::Portrait),
/// [`History`](super::History), [`Curves`](super::Curves), [`ClassMap`](super::ClassMap) or
/// [`ValueMap`](super::ValueMap) by `into()`.
#[derive(Clone, Debug)]
pub struct Panel {
    pub(crate) title: String,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    /// Empty space around the data as a fraction of its extent, in x and y.
    pub(crate) pad: (f64, f64),
    pub(crate) layers: Vec<Layer>,
    /// Vertical lines at `x`, labelled above the frame.
    pub(crate) flags: Vec<(f64, String)>,
    pub(crate) keys: Vec<Key>,
    /// The scale of the colours, at the right of the frame.
    pub(crate) bar: Option<Bar>,
}

/// What is drawn between the axes, from back to front.
#[derive(Clone, Debug)]
pub(crate) enum Layer {
    /// Intervals of x shaded over the full height.
    Bands {
        intervals: Vec<(f64, f64)>,
        colour: Colour,
    },
    /// A horizontal line over the full width.
    Level { y: f64 },
    /// A line through the points, broken where one is not finite.
    Line {
        x: Vec<f64>,
        y: Vec<f64>,
        width: f64,
        colour: Colour,
    },
    /// Dots so small and many that they are thinned to the pixel grid. Neighbours in the list of
    /// layers share one budget.
    Dust {
        x: Vec<f64>,
        y: Vec<f64>,
        pen: f64,
        colour: Colour,
    },
    /// Dots to be counted, with a white rim.
    Dots {
        x: Vec<f64>,
        y: Vec<f64>,
        radius: f64,
        colour: Colour,
    },
    /// The cells of a map, which hide the lines of the grid.
    Cells(Cells),
}

/// An entry of the legend.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Key {
    pub(crate) label: String,
    pub(crate) swatch: Swatch,
    /// How often it occurs, if that matters; what does not occur is not shown.
    pub(crate) tally: Option<Tally>,
}

/// Cells of a class among all cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tally {
    pub(crate) cells: usize,
    pub(crate) total: usize,
    /// Whether the legend says it.
    pub(crate) share: bool,
}

/// How a legend entry shows its layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Swatch {
    Dot {
        radius: f64,
        colour: Colour,
    },
    Line {
        width: f64,
        colour: Colour,
        dotted: bool,
    },
    Dashes,
    Shade {
        colour: Colour,
    },
    Patch {
        colour: Colour,
    },
}

impl Panel {
    pub(crate) fn new(title: String, x: Axis, y: Axis, pad: (f64, f64)) -> Self {
        Self {
            title,
            x,
            y,
            pad,
            layers: Vec::new(),
            flags: Vec::new(),
            keys: Vec::new(),
            bar: None,
        }
    }

    /// Adds a legend entry; an empty label adds none.
    pub(crate) fn key(&mut self, label: String, swatch: Swatch) {
        if !label.is_empty() {
            let tally = None;
            self.keys.push(Key {
                label,
                swatch,
                tally,
            });
        }
    }

    /// Finite extents of everything drawn.
    pub(crate) fn extents(&self) -> (Extent, Extent) {
        let (mut across, mut up) = (Extent::EMPTY, Extent::EMPTY);
        for layer in &self.layers {
            layer.extend(self, &mut across, &mut up);
        }
        (across, up)
    }
}

impl Layer {
    fn extend(&self, panel: &Panel, across: &mut Extent, up: &mut Extent) {
        match self {
            // Shades lie behind the data and must not stretch the axis beyond it.
            Self::Bands { .. } => {}
            Self::Cells(cells) => {
                cells.x.iter().for_each(|&x| across.include(&panel.x, x));
                cells.y.iter().for_each(|&y| up.include(&panel.y, y));
            }
            Self::Level { y } => up.include(&panel.y, *y),
            Self::Line { x, y, .. } | Self::Dust { x, y, .. } | Self::Dots { x, y, .. } => {
                for (&x, &y) in x.iter().zip(y) {
                    if panel.x.admits(x) && panel.y.admits(y) {
                        across.include(&panel.x, x);
                        up.include(&panel.y, y);
                    }
                }
            }
        }
    }
}
