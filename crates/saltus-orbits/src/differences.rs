//! Derivatives of an image by a parameter: differences, which look closer where the map has a corner.
//!
//! A map with a grazing changes there from one piece to another, and to the side with an impact it is a square root.
//! Differences that reach across a corner are worth nothing. Those that stay on the piece of the image, and no
//! longer change when they reach less far, are its slope.

use crate::events::switches;
use crate::linear::{minus, norm, plus, scaled, size};
use crate::map::{Image, MapRequest, NoImage, ParametricMap};

/// Differences over this part of a parameter's unit: the cube root of rounding, where the error of central
/// differences is smallest.
pub(crate) const DIFFERENCE: f64 = 6e-6;

/// Slopes that differ by more than this part, or by this where they are small, point to a corner:
/// in a smooth map they differ by some 1e-5, and less than this does not hinder Newton's method.
const CORNER: f64 = 1e-2;

/// Factor between the reaches of a look and the next closer one, and the number of looks. The last is at 6e-12,
/// for slopes of 1e5, of which rounding leaves four digits.
const CLOSER: f64 = 1.0 / 32.0;
const LOOKS: i32 = 5;

/// A parameter that may change.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Free {
    /// Its place among the parameters.
    pub(crate) index: usize,
    /// The unit it is measured in where it stands beside states.
    pub(crate) unit: f64,
}

/// `parameters` with one of them moved by a part of its unit.
pub(crate) fn moved(parameters: &[f64], free: &Free, part: f64) -> Vec<f64> {
    let mut moved = parameters.to_vec();
    moved[free.index] += part * free.unit;
    moved
}

/// dP per unit of a parameter, from the image of a shot and those of the shots below and above.
pub(crate) fn slope<F: ParametricMap + ?Sized>(
    family: &F,
    shot: &MapRequest<'_>,
    image: &Image,
    free: &Free,
    both: &[Result<Image, NoImage>; 2],
) -> Result<Vec<f64>, NoImage> {
    let plain = difference(image, both)?;
    let sides = both.each_ref().map(|side| side.as_ref().ok());
    let corner = match sides {
        [Some(below), Some(above)] => {
            let from = |side: &Image| minus(&side.place.x, &image.place.x);
            let slopes = [(below, -DIFFERENCE), (above, DIFFERENCE)];
            let [left, right] = slopes.map(|(side, part)| scaled(&from(side), 1.0 / part));
            !agree(&left, &right)
        }
        _ => false,
    };
    let closer = corner.then(|| beside_corner(family, shot, image, free));
    Ok(closer.flatten().unwrap_or(plain))
}

/// The slope on the piece of the map that an image lies on, if differences show it.
fn beside_corner<F: ParametricMap + ?Sized>(
    family: &F,
    shot: &MapRequest<'_>,
    image: &Image,
    free: &Free,
) -> Option<Vec<f64>> {
    let parts = (0..LOOKS).map(|look| DIFFERENCE * CLOSER.powi(look));
    let beside: Vec<Vec<f64>> = parts
        .flat_map(|part| [-part, part])
        .map(|part| moved(shot.parameters, free, part))
        .collect();
    // Only shots with a derivative tell their switches.
    let shots = beside.iter().map(|parameters| MapRequest {
        parameters,
        derivative: true,
        ..*shot
    });
    let images = family.images(&shots.collect::<Vec<_>>());
    let here = switches(&image.crossings);
    let slope = |(side, parameters): (&Result<Image, NoImage>, &Vec<f64>)| {
        let side = side.as_ref().ok()?;
        // The rest of a small part after rounding.
        let part = (parameters[free.index] - shot.parameters[free.index]) / free.unit;
        let slope = scaled(&minus(&side.place.x, &image.place.x), 1.0 / part);
        (switches(&side.crossings) == here && norm(&slope).is_finite()).then_some(slope)
    };
    let slopes: Vec<Option<Vec<f64>>> = images.iter().zip(&beside).map(slope).collect();
    let looks: Vec<&[Option<Vec<f64>>]> = slopes.chunks_exact(2).collect();
    let steady = |pair: &[&[Option<Vec<f64>>]]| {
        if let [Some(below), Some(above)] = pair[0]
            && agree(below, above)
        {
            return Some(scaled(&plus(below, 1.0, above), 0.5));
        }
        let mut sides = pair[0].iter().zip(pair[1]);
        sides.find_map(|sides| match sides {
            (Some(far), Some(near)) if agree(far, near) => Some(near.clone()),
            _ => None,
        })
    };
    looks.windows(2).find_map(steady)
}

fn agree(a: &[f64], b: &[f64]) -> bool {
    size(&minus(a, b)) <= CORNER * size(a).min(size(b)).max(1.0)
}

/// Central, or to one side where the map ends.
fn difference(image: &Image, both: &[Result<Image, NoImage>; 2]) -> Result<Vec<f64>, NoImage> {
    let (below, above, width) = match both {
        [Err(NoImage::Interrupted), _] | [_, Err(NoImage::Interrupted)] => {
            return Err(NoImage::Interrupted);
        }
        [Ok(below), Ok(above)] => (below, above, 2.0),
        [Ok(below), Err(_)] => (below, image, 1.0),
        [Err(_), Ok(above)] => (image, above, 1.0),
        [Err(reason), Err(_)] => return Err(reason.clone()),
    };
    let change = minus(&above.place.x, &below.place.x);
    if !norm(&change).is_finite() {
        return Err(NoImage::Ended("the image is not finite".into()));
    }
    Ok(scaled(&change, 1.0 / (width * DIFFERENCE)))
}
