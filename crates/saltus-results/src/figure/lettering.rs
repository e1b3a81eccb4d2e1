//! Type in PNG that kuva's rasteriser cannot place: turned by a quarter, or above the marks.
//!
//! kuva draws each label upright on a white slip of its own, which is then copied onto the sheet.

use super::colour::Colour;
use super::raster::pixmap;
use super::text;
use crate::ResultsError;
use kuva::render::render::{Primitive, Scene, TextAnchor};
use tiny_skia::Pixmap;

/// A label to be read from below to above, by its anchor on the sheet.
pub(crate) struct Turned {
    x: f64,
    y: f64,
    content: String,
    size: u32,
}

/// Takes the rotated labels out of the scene, following the groups that move them.
pub(crate) fn take_turned(scene: &mut Scene) -> Vec<Turned> {
    let mut turned = Vec::new();
    let mut shift = (0.0, 0.0);
    scene.elements.retain(|element| match element {
        // Panels are one group deep.
        Primitive::GroupStart { transform, .. } => {
            shift = transform
                .as_deref()
                .and_then(translation)
                .unwrap_or((0.0, 0.0));
            true
        }
        Primitive::GroupEnd => {
            shift = (0.0, 0.0);
            true
        }
        Primitive::Text {
            x,
            y,
            content,
            size,
            rotate: Some(_),
            ..
        } => {
            turned.push(Turned {
                x: x + shift.0,
                y: y + shift.1,
                content: content.clone(),
                size: *size,
            });
            false
        }
        _ => true,
    });
    turned
}

fn translation(transform: &str) -> Option<(f64, f64)> {
    let (x, y) = transform
        .strip_prefix("translate(")?
        .strip_suffix(')')?
        .split_once(',')?;
    Some((x.parse().ok()?, y.parse().ok()?))
}

impl Turned {
    /// Draws the label upright on a slip of its own and copies that a quarter turn to the left.
    pub(crate) fn blit(&self, image: &mut Pixmap, scale: f32) -> Result<(), ResultsError> {
        let slip = slip(&self.content, self.size, scale)?;
        let anchor = |v: f64| (v * f64::from(scale)).round() as i64;
        let (middle, baseline) = (i64::from(slip.width()) / 2, i64::from(slip.height()) / 2);
        for row in 0..slip.height() {
            for column in 0..slip.width() {
                let x = anchor(self.x) + i64::from(row) - baseline;
                let y = anchor(self.y) - (i64::from(column) - middle);
                copy_darker(&slip, (column, row), image, (x, y));
            }
        }
        Ok(())
    }
}

/// Space at both sides of the text on a slip (px).
const MARGIN: f64 = 5.0;

/// Black type on white, its middle and its baseline at the middle of the slip.
fn slip(content: &str, size: u32, scale: f32) -> Result<Pixmap, ResultsError> {
    let height = f64::from(size) * 2.0;
    let mut slip = Scene::new(text::width(content, size) + 2.0 * MARGIN, height);
    slip.add(Primitive::Text {
        x: slip.width / 2.0,
        y: height / 2.0,
        content: content.to_owned(),
        size,
        anchor: TextAnchor::Middle,
        rotate: None,
        bold: false,
        color: Some(Colour::BLACK.into()),
    });
    pixmap(&slip, scale)
}

/// Copies a pixel where it is darker than what is there, so that white slips cover nothing.
fn copy_darker(from: &Pixmap, (column, row): (u32, u32), to: &mut Pixmap, at: (i64, i64)) {
    let Some(target) = index(to, at) else { return };
    let source = 4 * (row as usize * from.width() as usize + column as usize);
    for channel in 0..3 {
        let value = from.data()[source + channel];
        let there = &mut to.data_mut()[target + channel];
        *there = value.min(*there);
    }
}

/// First byte of a pixel, if the image has it.
fn index(image: &Pixmap, (x, y): (i64, i64)) -> Option<usize> {
    let inside =
        (0..i64::from(image.width())).contains(&x) && (0..i64::from(image.height())).contains(&y);
    inside.then(|| 4 * (y as usize * image.width() as usize + x as usize))
}

/// Draws upright type with a white rim of half the width `halo` (px) over what is there.
pub(crate) fn word(
    content: &str,
    size: u32,
    (left, baseline): (f64, f64),
    halo: f64,
    image: &mut Pixmap,
    scale: f32,
) -> Result<(), ResultsError> {
    let slip = slip(content, size, scale)?;
    let scale = f64::from(scale);
    let corner = (
        ((left - MARGIN) * scale).round() as i64,
        (baseline * scale).round() as i64 - i64::from(slip.height()) / 2,
    );
    let reach = 0.5 * halo * scale;
    let disc = disc(reach);
    for row in 0..i64::from(slip.height()) {
        for column in 0..i64::from(slip.width()) {
            let near = disc.iter().map(|(x, y)| dark(&slip, (column + x, row + y)));
            let cover = u32::from(near.max().unwrap_or(0));
            if let Some(target) = index(image, (corner.0 + column, corner.1 + row)) {
                for there in &mut image.data_mut()[target..target + 3] {
                    *there += (u32::from(255 - *there) * cover / 255) as u8;
                }
            }
        }
    }
    for row in 0..slip.height() {
        for column in 0..slip.width() {
            let at = (corner.0 + i64::from(column), corner.1 + i64::from(row));
            copy_darker(&slip, (column, row), image, at);
        }
    }
    Ok(())
}

/// Steps from a pixel to those within `reach`.
fn disc(reach: f64) -> Vec<(i64, i64)> {
    let most = reach.ceil() as i64;
    let square = (-most..=most).flat_map(|x| (-most..=most).map(move |y| (x, y)));
    square
        .filter(|&(x, y)| (x as f64).hypot(y as f64) <= reach)
        .collect()
}

/// Darkness of a pixel, from 0 to 255.
fn dark(image: &Pixmap, at: (i64, i64)) -> u8 {
    index(image, at).map_or(0, |start| 255 - image.data()[start])
}
