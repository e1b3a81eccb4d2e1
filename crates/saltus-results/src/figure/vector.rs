//! The SVG backend: kuva's for axes and type, with our marks as few and short paths.

use super::colour::Colour;
use super::ink::{Drawing, Ink, Step};
use super::mosaic::Mosaic;
use super::style::{HALO, RIM, TICK};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use kuva::backend::svg::SvgBackend;
use kuva::render::color::Color;
use kuva::render::render::{PathData, Primitive, TextAnchor};
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
    let mut images = Vec::new();
    for mark in &ink {
        match mark {
            Ink::Mosaic(mosaic) => {
                scene.elements.extend(place_of_image(images.len()));
                images.push(image(mosaic));
            }
            Ink::Word {
                left,
                baseline,
                content,
            } => scene.elements.extend(word(*left, *baseline, content)),
            _ => scene.elements.extend(primitive(mark)),
        }
    }
    scene.add(Primitive::GroupEnd);
    let view = format!(
        "<svg viewBox=\"0 0 {} {}\" role=\"img\" ",
        scene.width, scene.height
    );
    // kuva writes a size but no view box, without which a viewer cuts instead of scaling.
    let mut svg = SvgBackend::new()
        .render_scene(&scene)
        .replacen("<svg ", &view, 1);
    for (number, image) in images.iter().enumerate() {
        let place = format!("<g {}>", image_mark(number));
        svg = svg.replacen(&place, &format!("<g>{image}"), 1);
    }
    svg
}

/// kuva knows no images: an empty group keeps the place of one.
fn place_of_image(number: usize) -> [Primitive; 2] {
    let start = Primitive::GroupStart {
        transform: None,
        title: None,
        extra_attrs: Some(image_mark(number)),
    };
    [start, Primitive::GroupEnd]
}

fn image_mark(number: usize) -> String {
    format!("data-cells=\"{number}\"")
}

/// The cells as an image that a viewer stretches without smoothing.
fn image(mosaic: &Mosaic) -> String {
    let raster = mosaic.blocks();
    // Writing to memory does not fail; an image without content shows nothing.
    let png = indexed(raster.size, &mosaic.colours, &mosaic.sample(raster)).unwrap_or_default();
    let [left, top, right, bottom] = mosaic.shown;
    format!(
        "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" \
         image-rendering=\"optimizeSpeed\" style=\"image-rendering:pixelated\" \
         href=\"data:image/png;base64,{}\"/>",
        Short(left),
        Short(top),
        Short(right - left),
        Short(bottom - top),
        STANDARD.encode(png)
    )
}

/// Type with a white rim, which parts it from what lies below.
fn word(x: f64, y: f64, content: &str) -> [Primitive; 3] {
    let rim = format!("stroke=\"#ffffff\" stroke-width=\"{HALO}\" paint-order=\"stroke\"");
    let start = Primitive::GroupStart {
        transform: None,
        title: None,
        extra_attrs: Some(rim),
    };
    let text = Primitive::Text {
        x,
        y,
        content: content.to_owned(),
        size: TICK,
        anchor: TextAnchor::Start,
        rotate: None,
        bold: false,
        color: Some(Colour::BLACK.into()),
    };
    [start, text, Primitive::GroupEnd]
}

/// A PNG of one byte for each pixel, the index of its colour.
fn indexed(
    size: (usize, usize),
    colours: &[Colour],
    codes: &[u8],
) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size.0 as u32, size.1 as u32);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    let palette: Vec<u8> = colours.iter().flat_map(|c| [c.0, c.1, c.2]).collect();
    encoder.set_palette(palette);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(codes)?;
    writer.finish()?;
    Ok(bytes)
}

fn primitive(ink: &Ink) -> Option<Primitive> {
    Some(match ink {
        Ink::Mosaic(_) | Ink::Word { .. } => return None,
        Ink::Area {
            corners,
            colour,
            opacity,
        } => {
            let step = |(number, &(x, y)): (usize, &(f64, f64))| match number {
                0 => Step::Move(x, y),
                _ => Step::Line(x, y),
            };
            let steps: Vec<Step> = corners.iter().enumerate().map(step).collect();
            Primitive::Path(Box::new(PathData {
                d: path(&steps),
                fill: Some((*colour).into()),
                stroke: (*colour).into(),
                stroke_width: 0.0,
                opacity: (*opacity < 1.0).then_some(*opacity),
                stroke_dasharray: None,
            }))
        }
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
    })
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
