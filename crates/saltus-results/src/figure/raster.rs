//! The PNG backend: kuva's rasteriser for axes and upright type, ours for the rest.
//!
//! kuva 0.6 frays slanted lines (no coverage in the vertical direction) and darkens rotated type (it
//! blends onto a transparent ground as if it were opaque). So the marks are drawn by tiny-skia, and
//! the labels of the vertical axes are drawn upright and turned by exact quarter turns (`lettering.rs`).

use super::colour::Colour;
use super::ink::{Drawing, Ink, Step};
use super::lettering::{self, take_turned};
use super::mosaic::{Mosaic, Raster};
use super::style::{HALO, RIM, TICK};
use crate::ResultsError;
use kuva::RasterBackend;
use kuva::render::render::Scene;
use tiny_skia::{
    FillRule, IntSize, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, Transform,
};

/// The drawing as PNG bytes with `scale` pixels per unit.
pub(crate) fn png(drawing: Drawing, scale: f32) -> Result<Vec<u8>, ResultsError> {
    let Drawing { mut scene, ink } = drawing;
    let (width, height) = (scene.width, scene.height);
    let pixels = width * height * f64::from(scale).powi(2);
    if !(0.5..=8.0).contains(&scale) || pixels > 2e8 {
        return Err(ResultsError::PngScale {
            width,
            height,
            scale,
        });
    }
    let turned = take_turned(&mut scene);
    let mut image = pixmap(&scene, scale)?;
    for label in &turned {
        label.blit(&mut image, scale)?;
    }
    for mark in &ink {
        draw(mark, &mut image, Transform::from_scale(scale, scale))?;
    }
    encode(&image)
}

fn refused(reason: &impl ToString) -> ResultsError {
    ResultsError::Png {
        reason: reason.to_string(),
    }
}

/// The scene as pixels, by kuva.
pub(crate) fn pixmap(scene: &Scene, scale: f32) -> Result<Pixmap, ResultsError> {
    let bytes = RasterBackend::new()
        .with_scale(scale)
        .render_scene(scene)
        .map_err(|error| refused(&error))?;
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes))
        .read_info()
        .map_err(|error| refused(&error))?;
    let size = reader
        .output_buffer_size()
        .ok_or_else(|| refused(&"the image is too large"))?;
    let mut pixels = vec![0; size];
    let info = reader
        .next_frame(&mut pixels)
        .map_err(|error| refused(&error))?;
    let size =
        IntSize::from_wh(info.width, info.height).ok_or_else(|| refused(&"the image is empty"))?;
    // kuva writes four channels on an opaque ground, which is tiny-skia's own format.
    Pixmap::from_vec(pixels, size).ok_or_else(|| refused(&"the image is not of four channels"))
}

fn draw(mark: &Ink, image: &mut Pixmap, transform: Transform) -> Result<(), ResultsError> {
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
        Ink::Area {
            corners,
            colour,
            opacity,
        } => area(corners, &paint(*colour, *opacity), image, transform),
        Ink::Word {
            left,
            baseline,
            content,
        } => lettering::word(content, TICK, (*left, *baseline), HALO, image, transform.sx)?,
    }
    Ok(())
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

/// Three channels suffice on a white ground.
fn encode(image: &Pixmap) -> Result<Vec<u8>, ResultsError> {
    let rgb: Vec<u8> = image
        .data()
        .chunks_exact(4)
        .flat_map(|pixel| [pixel[0], pixel[1], pixel[2]])
        .collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, image.width(), image.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().map_err(|error| refused(&error))?;
    writer
        .write_image_data(&rgb)
        .map_err(|error| refused(&error))?;
    writer.finish().map_err(|error| refused(&error))?;
    Ok(bytes)
}
