//! The PNG backend.

use super::colour::Colour;
use super::ink::{Density, Drawing, Ink, Step, Type};
use super::mosaic::{Mosaic, Raster};
use super::style::{HALO, RIM};
use super::typeface::Curve;
use crate::ResultsError;
use tiny_skia::{
    FillRule, FilterQuality, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, PixmapPaint,
    PremultipliedColorU8, Stroke, Transform,
};

/// Pixels of a PNG per inch where the figure has a size in print, and the most in all: a poster has fewer to an inch.
const INCH: f64 = 600.0;
const MOST: f64 = 2e8;

/// The drawing as PNG bytes with `scale` pixels per unit; a figure with a size in print has 600 to an inch instead.
pub(crate) fn png(drawing: &Drawing, scale: f32) -> Result<Vec<u8>, ResultsError> {
    let Drawing { width, height, .. } = *drawing;
    let scale = match drawing.point {
        Some(point) => {
            let fits = (0.99 * MOST / (width * height)).sqrt();
            (INCH / 72.0 * point).min(fits) as f32
        }
        None => scale,
    };
    let pixels = width * height * f64::from(scale).powi(2);
    if !(0.3..=32.0).contains(&scale) || pixels > MOST {
        return Err(ResultsError::PngScale {
            width,
            height,
            scale,
        });
    }
    let size = |length: f64| (length * f64::from(scale)).round() as u32;
    let mut image =
        Pixmap::new(size(width), size(height)).ok_or_else(|| refused(&"it is empty"))?;
    image.fill(tiny_skia::Color::WHITE);
    for mark in &drawing.ink {
        draw(mark, &mut image, Transform::from_scale(scale, scale));
    }
    let metre = drawing
        .point
        .map(|point| f64::from(scale) / point * 72.0 / 0.0254);
    encode(&image, metre)
}

fn refused(reason: &impl ToString) -> ResultsError {
    ResultsError::Png {
        reason: reason.to_string(),
    }
}

fn draw(mark: &Ink, image: &mut Pixmap, transform: Transform) {
    match mark {
        Ink::Trail {
            steps,
            width,
            colour,
        } => trail(steps, *width, *colour, image, transform),
        Ink::Dot {
            centre,
            radius,
            colour,
        } => dot(*centre, *radius, *colour, image, transform),
        Ink::Mosaic(mosaic) => tile(mosaic, image, f64::from(transform.sx)),
        Ink::Density(density) => shade(density, image, transform),
        Ink::Area {
            corners,
            colour,
            opacity,
        } => area(corners, &paint(*colour, *opacity), image, transform),
        Ink::Type(letters) => text(letters, image, transform),
    }
}

/// Type as the outlines of its letters, over a white rim if it has one.
fn text(letters: &Type, image: &mut Pixmap, transform: Transform) {
    let mut builder = PathBuilder::new();
    let f = |v: f64| v as f32;
    for curve in letters.outlines() {
        match curve {
            Curve::Move((x, y)) => builder.move_to(f(x), f(y)),
            Curve::Line((x, y)) => builder.line_to(f(x), f(y)),
            Curve::Cubic(a, b, c) => {
                builder.cubic_to(f(a.0), f(a.1), f(b.0), f(b.1), f(c.0), f(c.1));
            }
            Curve::Close => builder.close(),
        }
    }
    let Some(path) = builder.finish() else { return };
    if letters.rim {
        let white = paint(Colour(255, 255, 255), 1.0);
        image.stroke_path(&path, &white, &pen(HALO), transform, None);
    }
    let ink = paint(letters.colour, 1.0);
    image.fill_path(&path, &ink, FillRule::Winding, transform, None);
}

/// Shades over what is there.
fn shade(density: &Density, image: &mut Pixmap, transform: Transform) {
    let size = (density.size.0 as u32, density.size.1 as u32);
    let Some(mut cells) = Pixmap::new(size.0, size.1) else {
        return;
    };
    let Colour(red, green, blue) = density.colour;
    let part = |channel: u8, shade: u8| (u16::from(channel) * u16::from(shade) / 255) as u8;
    for (cell, &shade) in cells.pixels_mut().iter_mut().zip(&density.shades) {
        let [r, g, b] = [red, green, blue].map(|channel| part(channel, shade));
        // No channel exceeds the opacity, so there is such a colour.
        if let Some(colour) = PremultipliedColorU8::from_rgba(r, g, b, shade) {
            *cell = colour;
        }
    }
    let [left, top, right, bottom] = density.sides.map(|side| side as f32);
    let stretch = (
        (right - left) / size.0 as f32,
        (bottom - top) / size.1 as f32,
    );
    let place = transform
        .pre_translate(left, top)
        .pre_scale(stretch.0, stretch.1);
    let smooth = PixmapPaint {
        quality: FilterQuality::Bilinear,
        ..PixmapPaint::default()
    };
    image.draw_pixmap(0, 0, cells.as_ref(), &smooth, place, None);
}

fn trail(steps: &[Step], width: f64, colour: Colour, image: &mut Pixmap, transform: Transform) {
    // A path of many strokes is slow to sort: a few thousand at a time are faster.
    for part in steps
        .chunk_by(|_, next| !matches!(next, Step::Move(..)))
        .collect::<Vec<_>>()
        .chunks(500)
    {
        if let Some(path) = path(part.iter().copied().flatten().copied()) {
            image.stroke_path(&path, &paint(colour, 1.0), &pen(width), transform, None);
        }
    }
}

/// A disc of the colour, and its white rim.
fn dot(centre: (f64, f64), radius: f64, colour: Colour, image: &mut Pixmap, transform: Transform) {
    let circle = PathBuilder::from_circle(centre.0 as f32, centre.1 as f32, radius as f32);
    let Some(circle) = circle else { return };
    let (inside, rim) = (paint(colour, 1.0), paint(Colour(255, 255, 255), 1.0));
    image.fill_path(&circle, &inside, FillRule::Winding, transform, None);
    image.stroke_path(&circle, &rim, &pen(RIM), transform, None);
}

fn area(corners: &[(f64, f64)], paint: &Paint<'_>, image: &mut Pixmap, transform: Transform) {
    let mut builder = PathBuilder::new();
    for (number, &(x, y)) in corners.iter().enumerate() {
        match number {
            0 => builder.move_to(x as f32, y as f32),
            _ => builder.line_to(x as f32, y as f32),
        }
    }
    builder.close();
    if let Some(path) = builder.finish() {
        image.fill_path(&path, paint, FillRule::Winding, transform, None);
    }
}

/// Gives each pixel of the image that a cell covers the colour of the cell.
fn tile(mosaic: &Mosaic, image: &mut Pixmap, scale: f64) {
    let [left, top, right, bottom] = mosaic.shown.map(|side| (side * scale).round() as usize);
    let (right, bottom) = (
        right.min(image.width() as usize),
        bottom.min(image.height() as usize),
    );
    let size = (right.saturating_sub(left), bottom.saturating_sub(top));
    if size.0 == 0 || size.1 == 0 {
        return;
    }
    let step = 1.0 / scale;
    let codes = mosaic.sample(Raster {
        x: left as f64 * step,
        y: top as f64 * step,
        step: (step, step),
        size,
    });
    let width = image.width() as usize;
    for (row, codes) in codes.chunks(size.0).enumerate() {
        let start = 4 * ((top + row) * width + left);
        let pixels = &mut image.data_mut()[start..start + 4 * size.0];
        for (pixel, &code) in pixels.chunks_exact_mut(4).zip(codes) {
            let Colour(red, green, blue) = mosaic.colours[usize::from(code)];
            pixel.copy_from_slice(&[red, green, blue, 255]);
        }
    }
}

fn path(steps: impl Iterator<Item = Step>) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for step in steps {
        match step {
            Step::Move(x, y) => builder.move_to(x as f32, y as f32),
            Step::Line(x, y) => builder.line_to(x as f32, y as f32),
        }
    }
    builder.finish()
}

fn pen(width: f64) -> Stroke {
    Stroke {
        width: width as f32,
        line_cap: LineCap::Round,
        line_join: LineJoin::Round,
        ..Stroke::default()
    }
}

fn paint(colour: Colour, opacity: f64) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(
        colour.0,
        colour.1,
        colour.2,
        (opacity * 255.0).round() as u8,
    );
    paint
}

/// Three channels suffice on a white ground; `metre` is the number of pixels of one in print.
fn encode(image: &Pixmap, metre: Option<f64>) -> Result<Vec<u8>, ResultsError> {
    let rgb: Vec<u8> = image
        .data()
        .chunks_exact(4)
        .flat_map(|pixel| [pixel[0], pixel[1], pixel[2]])
        .collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, image.width(), image.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    if let Some(metre) = metre {
        let metre = metre.round() as u32;
        encoder.set_pixel_dims(Some(png::PixelDimensions {
            xppu: metre,
            yppu: metre,
            unit: png::Unit::Meter,
        }));
    }
    let mut writer = encoder.write_header().map_err(|error| refused(&error))?;
    writer
        .write_image_data(&rgb)
        .map_err(|error| refused(&error))?;
    writer.finish().map_err(|error| refused(&error))?;
    Ok(bytes)
}
