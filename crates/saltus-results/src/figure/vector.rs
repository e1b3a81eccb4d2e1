//! The SVG backend: kuva's for axes and type, with our marks as few and short paths.

use super::compose::Drawing;
use super::marks::{Ink, RIM, SHADE, Step};
use kuva::backend::svg::SvgBackend;
use kuva::render::color::Color;
use kuva::render::render::{PathData, Primitive};
use std::fmt::Write;

/// The drawing as SVG text.
pub(crate) fn svg(drawing: Drawing) -> String {
    let Drawing { mut scene, ink } = drawing;
    let attributes = r#"fill="none" stroke-linecap="round" stroke-linejoin="round""#.to_owned();
    scene.add(Primitive::GroupStart {
        transform: None,
        title: None,
        extra_attrs: Some(attributes),
    });
    scene.elements.extend(ink.iter().map(primitive));
    scene.add(Primitive::GroupEnd);
    let view = format!(
        "<svg viewBox=\"0 0 {} {}\" role=\"img\" ",
        scene.width, scene.height
    );
    // kuva writes a size but no view box, without which a viewer cuts instead of scaling.
    SvgBackend::new()
        .render_scene(&scene)
        .replacen("<svg ", &view, 1)
}

fn primitive(ink: &Ink) -> Primitive {
    match ink {
        Ink::Trail {
            steps,
            width,
            colour,
        } => Primitive::Path(Box::new(PathData {
            d: path(steps),
            fill: None,
            stroke: (*colour).into(),
            stroke_width: *width,
            opacity: None,
            stroke_dasharray: None,
        })),
        Ink::Dot {
            centre,
            radius,
            colour,
        } => Primitive::Circle {
            cx: centre.0,
            cy: centre.1,
            r: *radius,
            fill: (*colour).into(),
            fill_opacity: None,
            stroke: Some(Color::Rgb(255, 255, 255)),
            stroke_width: Some(RIM),
        },
        Ink::Shade {
            corner,
            size,
            colour,
        } => Primitive::Rect {
            x: corner.0,
            y: corner.1,
            width: size.0,
            height: size.1,
            fill: (*colour).into(),
            stroke: None,
            stroke_width: None,
            opacity: Some(SHADE),
        },
    }
}

/// Path data to a hundredth of a pixel; a vertical stroke, of which clouds have many, is a short `v`.
fn path(steps: &[Step]) -> String {
    let mut d = String::with_capacity(steps.len() * 12);
    let mut pen = (f64::NAN, f64::NAN);
    for &step in steps {
        // Writing to a string cannot fail.
        let _ = match step {
            Step::Move(x, y) => write!(d, "M{} {}", Short(x), Short(y)),
            Step::Line(x, y) if x == pen.0 => write!(d, "v{}", Short(y - pen.1)),
            Step::Line(x, y) => write!(d, "L{} {}", Short(x), Short(y)),
        };
        let (Step::Move(x, y) | Step::Line(x, y)) = step;
        pen = (x, y);
    }
    d
}

/// A coordinate with at most two decimals and no trailing zeros.
struct Short(f64);

impl std::fmt::Display for Short {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let hundredths = (self.0 * 100.0).round() as i64;
        let sign = if hundredths < 0 { "-" } else { "" };
        let (whole, rest) = (hundredths.abs() / 100, hundredths.abs() % 100);
        match (rest, rest % 10) {
            (0, _) => write!(f, "{sign}{whole}"),
            (_, 0) => write!(f, "{sign}{whole}.{}", rest / 10),
            _ => write!(f, "{sign}{whole}.{rest:02}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_short_and_right() {
        let written = |x: f64| Short(x).to_string();
        assert_eq!(written(12.0), "12");
        assert_eq!(written(-0.004), "0");
        assert_eq!(written(-3.456), "-3.46");
        assert_eq!(written(7.1), "7.1");
        assert_eq!(written(7.01), "7.01");
    }
}
