//! Marks in pixels, as both backends draw them, and makers of the simplest ones.

use super::colour::Colour;
use super::mosaic::Mosaic;
use kuva::render::render::Scene;

/// A figure in pixels of the SVG: axes and type as kuva draws them, and the marks above both.
pub(crate) struct Drawing {
    pub(crate) scene: Scene,
    pub(crate) ink: Vec<Ink>,
}

/// A mark in pixels of the SVG, ready for either backend.
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
    /// Type of the size of ticks with a white rim.
    Word {
        left: f64,
        baseline: f64,
        content: String,
    },
    /// The cells of a map.
    Mosaic(Mosaic),
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
