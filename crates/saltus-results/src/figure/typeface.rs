//! The typeface of all figures, DejaVu Sans: widths and outlines of its letters, in ems.

use std::sync::OnceLock;
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// A style of the typeface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Style {
    Regular,
    Bold,
    /// For letters that stand for quantities.
    Oblique,
}

impl Style {
    fn face(self) -> Option<&'static Face<'static>> {
        static FACES: [OnceLock<Option<Face<'static>>>; 3] = [const { OnceLock::new() }; 3];
        let bytes = match self {
            Self::Regular => dejavu::sans::regular,
            Self::Bold => dejavu::sans::bold,
            Self::Oblique => dejavu::sans::oblique,
        };
        let parsed = FACES[self as usize].get_or_init(|| Face::parse(bytes(), 0).ok());
        parsed.as_ref()
    }

    /// Width of a letter (em).
    pub(crate) fn advance(self, letter: char) -> f64 {
        let width = self.face().and_then(|face| {
            let width = face.glyph_hor_advance(glyph(face, letter))?;
            Some(f64::from(width) / f64::from(face.units_per_em()))
        });
        width.unwrap_or(0.6)
    }

    /// Outline of a letter whose baseline begins at (0, 0), y up (em).
    pub(crate) fn outline(self, letter: char) -> Vec<Curve> {
        let Some(face) = self.face() else {
            return Vec::new();
        };
        let mut pen = Pen {
            em: f64::from(face.units_per_em()),
            curves: Vec::new(),
        };
        // A letter without an outline, such as a space, leaves none.
        let _ = face.outline_glyph(glyph(face, letter), &mut pen);
        pen.curves
    }
}

/// The glyph of a letter; one that the typeface lacks shows as its empty box.
fn glyph(face: &Face, letter: char) -> GlyphId {
    face.glyph_index(letter).unwrap_or(GlyphId(0))
}

/// A piece of an outline.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Curve {
    Move((f64, f64)),
    Line((f64, f64)),
    /// A Bézier curve by its two control points and its end.
    Cubic((f64, f64), (f64, f64), (f64, f64)),
    Close,
}

impl Curve {
    /// The same piece with each point moved.
    pub(crate) fn map(self, to: impl Fn((f64, f64)) -> (f64, f64)) -> Self {
        match self {
            Self::Move(a) => Self::Move(to(a)),
            Self::Line(a) => Self::Line(to(a)),
            Self::Cubic(a, b, c) => Self::Cubic(to(a), to(b), to(c)),
            Self::Close => Self::Close,
        }
    }
}

/// Collects an outline.
struct Pen {
    em: f64,
    curves: Vec<Curve>,
}

impl Pen {
    fn at(&self, x: f32, y: f32) -> (f64, f64) {
        (f64::from(x) / self.em, f64::from(y) / self.em)
    }

    fn end(&self) -> (f64, f64) {
        match self.curves.last() {
            Some(Curve::Move(p) | Curve::Line(p) | Curve::Cubic(_, _, p)) => *p,
            _ => (0.0, 0.0),
        }
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.curves.push(Curve::Move(self.at(x, y)));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.curves.push(Curve::Line(self.at(x, y)));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        // A parabola is the cubic whose control points lie two thirds of the way to its own.
        let (from, control, to) = (self.end(), self.at(x1, y1), self.at(x, y));
        let towards = |end: (f64, f64)| {
            let step = |a: f64, b: f64| a + 2.0 / 3.0 * (b - a);
            (step(end.0, control.0), step(end.1, control.1))
        };
        self.curves
            .push(Curve::Cubic(towards(from), towards(to), to));
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let (a, b, c) = (self.at(x1, y1), self.at(x2, y2), self.at(x, y));
        self.curves.push(Curve::Cubic(a, b, c));
    }

    fn close(&mut self) {
        self.curves.push(Curve::Close);
    }
}
