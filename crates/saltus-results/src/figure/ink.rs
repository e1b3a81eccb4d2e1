//! Marks and type in pixels, as all backends draw them, and makers of the simplest ones.

use super::colour::Colour;
use super::lettering::{Line, printable};
use super::mosaic::Mosaic;
use super::typeface::Curve;

/// A figure in pixels of the SVG.
pub(crate) struct Drawing {
    pub(crate) width: f64,
    pub(crate) height: f64,
    /// Points (1/72 inch) of a pixel, if the figure has a size in print.
    pub(crate) point: Option<f64>,
    pub(crate) title: String,
    /// A sentence for those who do not see it.
    pub(crate) description: String,
    /// From back to front.
    pub(crate) ink: Vec<Ink>,
}

/// A mark in pixels of the SVG, ready for any backend.
#[derive(Clone, Debug)]
pub(crate) enum Ink {
    /// Lines drawn with a round pen.
    Trail {
        steps: Vec<Step>,
        width: f64,
        colour: Colour,
    },
    /// A dot with a white rim, so that neighbours stay apart.
    Dot {
        centre: (f64, f64),
        radius: f64,
        colour: Colour,
    },
    /// A filled polygon; the grid stays visible through one that is translucent.
    Area {
        corners: Vec<(f64, f64)>,
        colour: Colour,
        opacity: f64,
    },
    /// Type.
    Type(Type),
    /// The cells of a map.
    Mosaic(Mosaic),
    /// A cloud of points as shades of one colour.
    Density(Density),
}

/// One line of type.
#[derive(Clone, Debug)]
pub(crate) struct Type {
    pub(crate) line: Line,
    /// The anchor on the baseline.
    pub(crate) at: (f64, f64),
    pub(crate) anchor: Anchor,
    /// Whether it is read from below to above.
    pub(crate) turned: bool,
    pub(crate) size: f64,
    pub(crate) colour: Colour,
    /// Whether a white rim parts it from what lies below.
    pub(crate) rim: bool,
}

/// Part of a line of type that stands at its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

impl Type {
    /// Black type of `size` at `at`.
    pub(crate) fn new(content: &str, size: f64, at: (f64, f64), anchor: Anchor) -> Self {
        Self {
            line: Line::set(&printable(content), false),
            at,
            anchor,
            turned: false,
            size,
            colour: Colour::BLACK,
            rim: false,
        }
    }

    /// The same type with its middle at the height of `at`.
    pub(crate) fn centred(mut self) -> Self {
        self.at.1 += 0.36 * self.size;
        self
    }

    /// Outlines of the letters on the sheet (px).
    pub(crate) fn outlines(&self) -> impl Iterator<Item = Curve> {
        let (size, turned, (x, y)) = (self.size, self.turned, self.at);
        let start = match self.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => -0.5 * self.line.width,
            Anchor::End => -self.line.width,
        };
        self.line.outlines().map(move |curve| {
            curve.map(|(right, up)| {
                let (right, up) = ((start + right) * size, up * size);
                if turned {
                    (x - up, y - right)
                } else {
                    (x + right, y - up)
                }
            })
        })
    }
}

/// Shades on a raster of equal cells, rows from above.
#[derive(Clone, Debug)]
pub(crate) struct Density {
    /// Left, top, right and bottom (px).
    pub(crate) sides: [f64; 4],
    pub(crate) size: (usize, usize),
    /// Opacity of each cell.
    pub(crate) shades: Vec<u8>,
    pub(crate) colour: Colour,
}

/// One move of a pen (px).
#[derive(Clone, Copy, Debug)]
pub(crate) enum Step {
    Move(f64, f64),
    Line(f64, f64),
}

impl Ink {
    pub(crate) fn trail(steps: Vec<Step>, width: f64, colour: Colour) -> Self {
        Self::Trail {
            steps,
            width,
            colour,
        }
    }

    pub(crate) fn dot(centre: (f64, f64), radius: f64, colour: Colour) -> Self {
        Self::Dot {
            centre,
            radius,
            colour,
        }
    }

    pub(crate) fn area(corners: Vec<(f64, f64)>, colour: Colour, opacity: f64) -> Self {
        Self::Area {
            corners,
            colour,
            opacity,
        }
    }
}

/// A filled rectangle.
pub(crate) fn rectangle((x, y): (f64, f64), size: (f64, f64), colour: Colour, opacity: f64) -> Ink {
    let (right, below) = (x + size.0, y + size.1);
    let corners = vec![(x, y), (x, below), (right, below), (right, y)];
    Ink::area(corners, colour, opacity)
}

/// The sides of a rectangle, drawn with a pen of `width` (px).
pub(crate) fn outline((x, y): (f64, f64), size: (f64, f64), width: f64) -> Ink {
    let steps = vec![
        Step::Move(x, y),
        Step::Line(x, y + size.1),
        Step::Line(x + size.0, y + size.1),
        Step::Line(x + size.0, y),
        Step::Line(x, y),
    ];
    Ink::trail(steps, width, Colour::BLACK)
}
