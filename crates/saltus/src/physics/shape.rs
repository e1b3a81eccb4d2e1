//! Products X(x) Y(y) of half-waves on the plate, their slopes, and exact integrals of such
//! functions' products.

use super::trig::{Trig, integral as integral_1d};

/// scale X(x/a) Y(y/b) on a rectangle a x b.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    scale: f64,
    x: Trig,
    y: Trig,
}

/// The rectangle, which turns wave numbers into slopes and unit integrals into areas.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rectangle {
    /// Length a (m).
    pub(super) length: f64,
    /// Width b (m).
    pub(super) width: f64,
}

impl Shape {
    /// The shape that is zero everywhere.
    pub(super) const ZERO: Self = Self {
        scale: 0.0,
        x: Trig::Sin(0),
        y: Trig::Sin(0),
    };

    /// X(x/a) Y(y/b).
    pub(super) fn new(x: Trig, y: Trig) -> Self {
        Self { scale: 1.0, x, y }
    }
}

impl Rectangle {
    /// Derivative along x.
    pub(super) fn d_dx(self, shape: Shape) -> Shape {
        let (factor, x) = shape.x.derivative();
        Shape {
            scale: shape.scale * factor / self.length,
            x,
            ..shape
        }
    }

    /// Derivative along y.
    pub(super) fn d_dy(self, shape: Shape) -> Shape {
        let (factor, y) = shape.y.derivative();
        Shape {
            scale: shape.scale * factor / self.width,
            y,
            ..shape
        }
    }

    /// ∫∫ of the product of `N` shapes over the rectangle.
    pub(super) fn integral<const N: usize>(self, shapes: [Shape; N]) -> f64 {
        let scale: f64 = shapes.iter().map(|s| s.scale).product();
        if scale == 0.0 {
            return 0.0;
        }
        let along_x = integral_1d(&shapes.map(|s| s.x));
        if along_x == 0.0 {
            return 0.0;
        }
        self.length * self.width * scale * along_x * integral_1d(&shapes.map(|s| s.y))
    }
}
