//! One panel as data: two axes and the layers between them. The kinds of figure only fill one in.

use super::axis::{Axis, Extent};
use super::bar::Bar;
use super::bifurcation::Bifurcation;
use super::colour::Colour;
use super::mosaic::Cells;
use super::style::REFERENCE;

/// One panel of a figure. Made by `into()` from a [`Cloud`](super::Cloud), [`Branches`](super::Branches),
/// [`BifurcationSet`](super::BifurcationSet), [`Shares`](super::Shares), [`Portrait`](super::Portrait),
/// [`History`](super::History), [`Curves`](super::Curves), [`ClassMap`](super::ClassMap) or
/// [`ValueMap`](super::ValueMap).
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

/// A layer between the axes; a panel draws its layers from back to front.
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
        dashed: bool,
    },
    /// The area between two curves over x, with a gap where one is not finite.
    Area {
        x: Vec<f64>,
        low: Vec<f64>,
        high: Vec<f64>,
        colour: Colour,
        opacity: f64,
    },
    /// Vertical bars with caps.
    Bars {
        x: Vec<f64>,
        low: Vec<f64>,
        high: Vec<f64>,
        colour: Colour,
    },
    /// Dots so small and many that they are thinned to the pixel grid, or shown as shades by their number. Neighbours in
    /// the list of layers share one budget.
    Dust {
        x: Vec<f64>,
        y: Vec<f64>,
        pen: f64,
        colour: Colour,
        shaded: bool,
    },
    /// Dots to be counted, with a white rim.
    Dots {
        x: Vec<f64>,
        y: Vec<f64>,
        radius: f64,
        colour: Colour,
    },
    /// The symbol of a bifurcation at each point.
    Symbols {
        kind: Bifurcation,
        x: Vec<f64>,
        y: Vec<f64>,
    },
    /// Short labels beside points, placed so that they do not overlap.
    Notes(Vec<Note>),
    /// The cells of a map, which hide the lines of the grid.
    Cells(Cells),
    /// The frame once more, where layers before have covered the inner half of its line.
    Frame,
}

/// A label and the points or the curve that it belongs to.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Note {
    pub(crate) text: String,
    pub(crate) place: Place,
}

/// Places beside which a label may stand, in data.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Place {
    /// Any one of the first points that show, such as those of a cycle; the first are liked best.
    At(Vec<(f64, f64)>),
    /// Any part of a curve; its middle is liked best.
    Along(Vec<f64>, Vec<f64>),
}

/// An entry of the legend.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Key {
    pub(crate) label: String,
    pub(crate) swatch: Swatch,
    /// Number of its cells, if that matters; an entry without cells is not shown.
    pub(crate) tally: Option<Tally>,
}

/// Cells of a class among all cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tally {
    pub(crate) cells: usize,
    pub(crate) total: usize,
    /// Whether the legend shows the share.
    pub(crate) share: bool,
}

/// Sample of a layer in the legend.
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
    Dashed {
        width: f64,
        colour: Colour,
    },
    Band,
    Bar,
    Symbol(Bifurcation),
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

    /// A dashed horizontal line over the full width.
    pub(crate) fn level(&mut self, label: String, y: f64) {
        let (width, colour) = REFERENCE;
        self.key(label, Swatch::Dashed { width, colour });
        self.layers.push(Layer::Level { y });
    }

    /// Shades intervals of x behind all that is there; overlapping ones are joined.
    pub(crate) fn shade(&mut self, label: String, intervals: &[(f64, f64)], colour: Colour) {
        self.key(label, Swatch::Shade { colour });
        let intervals = joined(intervals);
        self.layers.insert(0, Layer::Bands { intervals, colour });
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
            Self::Bands { .. } | Self::Notes(_) | Self::Frame => {}
            Self::Cells(cells) => {
                cells.x.iter().for_each(|&x| across.include(&panel.x, x));
                cells.y.iter().for_each(|&y| up.include(&panel.y, y));
            }
            Self::Level { y } => up.include(&panel.y, *y),
            Self::Line { x, y, .. }
            | Self::Dust { x, y, .. }
            | Self::Dots { x, y, .. }
            | Self::Symbols { x, y, .. } => include(panel, (x, y), across, up),
            Self::Area { x, low, high, .. } | Self::Bars { x, low, high, .. } => {
                include(panel, (x, low), across, up);
                include(panel, (x, high), across, up);
            }
        }
    }
}

/// Includes the points that both axes have a place for.
fn include(panel: &Panel, (x, y): (&[f64], &[f64]), across: &mut Extent, up: &mut Extent) {
    for (&x, &y) in x.iter().zip(y) {
        if panel.x.admits(x) && panel.y.admits(y) {
            across.include(&panel.x, x);
            up.include(&panel.y, y);
        }
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
