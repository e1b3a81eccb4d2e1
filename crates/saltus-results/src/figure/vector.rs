//! The SVG backend: type that stays type, marks as few and short paths, cells and shades as images.

use super::colour::Colour;
use super::ink::{Anchor, Density, Drawing, Ink, Step, Type};
use super::mosaic::Mosaic;
use super::style::{HALO, RIM};
use super::typeface::Style;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::fmt::Write;

/// The drawing as SVG text.
pub(crate) fn svg(drawing: &Drawing) -> String {
    let Drawing { width, height, .. } = drawing;
    let size = |length: &f64| match drawing.point {
        Some(point) => format!("{}mm", Short(length * point * 25.4 / 72.0)),
        None => Short(*length).to_string(),
    };
    let mut svg = String::new();
    // Writing to a string cannot fail.
    let _ = write!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{}\" height=\"{}\" \
         role=\"img\" font-family=\"DejaVu Sans, Verdana, Geneva, sans-serif\">\n<title>{}</title>\n<desc>{}</desc>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n\
         <g stroke-linecap=\"round\" stroke-linejoin=\"round\">\n",
        size(width),
        size(height),
        escaped(&drawing.title),
        escaped(&drawing.description)
    );
    drawing.ink.iter().for_each(|mark| draw(mark, &mut svg));
    svg.push_str("</g>\n</svg>\n");
    svg
}

fn draw(mark: &Ink, svg: &mut String) {
    let _ = match mark {
        Ink::Mosaic(mosaic) => {
            svg.push_str(&cells(mosaic));
            Ok(())
        }
        Ink::Density(density) => {
            svg.push_str(&shades(density));
            Ok(())
        }
        Ink::Type(letters) => {
            svg.push_str(&text(letters));
            Ok(())
        }
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
            let opacity = match *opacity {
                opaque if opaque >= 1.0 => String::new(),
                opacity => format!(" fill-opacity=\"{}\"", Short(opacity)),
            };
            writeln!(
                svg,
                "<path d=\"{}z\" fill=\"{}\"{opacity}/>",
                path(&steps),
                colour.hex()
            )
        }
        // An empty path would be an element for nothing.
        Ink::Trail { steps, .. } if steps.is_empty() => Ok(()),
        Ink::Trail {
            steps,
            width,
            colour,
        } => writeln!(
            svg,
            "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"/>",
            path(steps),
            colour.hex(),
            Short(*width)
        ),
        Ink::Dot {
            centre,
            radius,
            colour,
        } => writeln!(
            svg,
            "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\" stroke=\"#ffffff\" stroke-width=\"{RIM}\"/>",
            Short(centre.0),
            Short(centre.1),
            Short(*radius),
            colour.hex()
        ),
    };
}

/// Type, its indices as spans that are lowered and raised.
fn text(letters: &Type) -> String {
    let (x, y) = (Short(letters.at.0), Short(letters.at.1));
    if letters.line.runs.is_empty() {
        return String::new();
    }
    let anchor = match letters.anchor {
        Anchor::Start => "",
        Anchor::Middle => " text-anchor=\"middle\"",
        Anchor::End => " text-anchor=\"end\"",
    };
    let turn = match letters.turned {
        true => format!(" transform=\"rotate(-90 {x} {y})\""),
        false => String::new(),
    };
    let rim = match letters.rim {
        true => format!(" stroke=\"#ffffff\" stroke-width=\"{HALO}\" paint-order=\"stroke\""),
        false => String::new(),
    };
    let mut spans = String::new();
    let mut height = 0.0;
    for run in &letters.line.runs {
        let mut attributes = String::new();
        if run.style == Style::Oblique {
            attributes.push_str(" font-style=\"italic\"");
        }
        if run.style == Style::Bold {
            attributes.push_str(" font-weight=\"bold\"");
        }
        if run.size < 1.0 {
            let _ = write!(
                attributes,
                " font-size=\"{}\"",
                Short(run.size * letters.size)
            );
        }
        let down = (height - run.rise) * letters.size;
        if down != 0.0 {
            let _ = write!(attributes, " dy=\"{}\"", Short(down));
        }
        height = run.rise;
        let words = escaped(&run.text);
        let _ = match attributes.is_empty() {
            true => write!(spans, "{words}"),
            false => write!(spans, "<tspan{attributes}>{words}</tspan>"),
        };
    }
    format!(
        "<text x=\"{x}\" y=\"{y}\" font-size=\"{}\" fill=\"{}\" xml:space=\"preserve\"{anchor}{turn}{rim}>{spans}</text>\n",
        Short(letters.size),
        letters.colour.hex()
    )
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

/// An image that a viewer stretches without smoothing.
fn image([left, top, right, bottom]: [f64; 4], png: &[u8]) -> String {
    format!(
        "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" \
         image-rendering=\"optimizeSpeed\" style=\"image-rendering:pixelated\" \
         href=\"data:image/png;base64,{}\"/>\n",
        Short(left),
        Short(top),
        Short(right - left),
        Short(bottom - top),
        STANDARD.encode(png)
    )
}

fn cells(mosaic: &Mosaic) -> String {
    let raster = mosaic.blocks();
    let palette: Vec<u8> = mosaic
        .colours
        .iter()
        .flat_map(|c| [c.0, c.1, c.2])
        .collect();
    // Writing to memory does not fail; an image without content shows nothing.
    let png = indexed(raster.size, palette, None, &mosaic.sample(raster)).unwrap_or_default();
    image(mosaic.shown, &png)
}

fn shades(density: &Density) -> String {
    let Colour(red, green, blue) = density.colour;
    let palette = [red, green, blue].repeat(256);
    let opacities = (0..=255).collect();
    let png = indexed(density.size, palette, Some(opacities), &density.shades);
    image(density.sides, &png.unwrap_or_default())
}

/// A PNG of one byte for each pixel, the index of its colour.
fn indexed(
    size: (usize, usize),
    palette: Vec<u8>,
    opacities: Option<Vec<u8>>,
    codes: &[u8],
) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size.0 as u32, size.1 as u32);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette);
    if let Some(opacities) = opacities {
        encoder.set_trns(opacities);
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(codes)?;
    writer.finish()?;
    Ok(bytes)
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
