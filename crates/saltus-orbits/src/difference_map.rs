//! A family whose derivative is taken by differences: for maps that have none of their own, and as a second
//! opinion on those that do.

use crate::{Image, MapPoint, MapRequest, Matrix, NoImage, ParametricMap};

/// Any family with its derivative by central differences of step h.
///
/// An image with derivative costs 2 n images. Crossings and touches on the way are not reported. The error is some
/// h^2 of the third derivative, and the noise of the images over h.
#[derive(Clone, Copy, Debug)]
pub struct Differences<'a, F: ?Sized> {
    family: &'a F,
    step: f64,
}

impl<'a, F: ParametricMap + ?Sized> Differences<'a, F> {
    /// `family` with differences of `step` in each state.
    pub fn new(family: &'a F, step: f64) -> Self {
        Self { family, step }
    }

    /// The start, then each of its states moved up and down.
    fn around(&self, start: &MapPoint) -> Vec<MapPoint> {
        let moved = |i: usize, by: f64| {
            let mut place = start.clone();
            place.x[i] += by;
            place
        };
        let sides = (0..start.x.len()).flat_map(|i| [moved(i, self.step), moved(i, -self.step)]);
        std::iter::once(start.clone()).chain(sides).collect()
    }

    fn assemble(&self, images: Vec<Result<Image, NoImage>>) -> Result<Image, NoImage> {
        let mut images = images.into_iter().collect::<Result<Vec<_>, _>>()?;
        let sides = images.split_off(1);
        let mut image = images.remove(0);
        let n = image.place.x.len();
        image.derivative = Some(Matrix::from_fn(n, n, |row, column| {
            let [ahead, behind] = [0, 1].map(|side| sides[2 * column + side].place.x[row]);
            (ahead - behind) / (2.0 * self.step)
        }));
        Ok(image)
    }
}

impl<F: ParametricMap + ?Sized> ParametricMap for Differences<'_, F> {
    fn dimension(&self) -> usize {
        self.family.dimension()
    }

    fn images(&self, shots: &[MapRequest<'_>]) -> Vec<Result<Image, NoImage>> {
        let starts = shots.iter().map(|shot| match shot.derivative {
            true => self.around(shot.start),
            false => vec![shot.start.clone()],
        });
        let starts: Vec<Vec<MapPoint>> = starts.collect();
        let plain = |(shot, start)| {
            let shot: &MapRequest<'_> = shot;
            MapRequest {
                derivative: false,
                start,
                ..*shot
            }
        };
        let pairs = shots.iter().zip(&starts);
        let all: Vec<MapRequest<'_>> = pairs
            .flat_map(|(shot, starts)| starts.iter().map(move |start| plain((shot, start))))
            .collect();
        let mut images = self.family.images(&all).into_iter();
        let answer = |(shot, starts): (&MapRequest<'_>, &Vec<MapPoint>)| {
            let mut mine: Vec<_> = images.by_ref().take(starts.len()).collect();
            match shot.derivative {
                true => self.assemble(mine),
                false => mine.pop().unwrap_or(Err(NoImage::Interrupted)),
            }
        };
        shots.iter().zip(&starts).map(answer).collect()
    }
}
