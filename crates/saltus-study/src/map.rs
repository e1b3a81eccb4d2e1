//! Maps: the attractor at each pixel of a plane of two parameters, or of two numbers of the start.

use saltus_hybrid::Point;

use crate::attractor::Found;
use crate::pursuit::attractors;
use crate::search::Search;
use crate::subject::Subject;
use crate::{Control, StudyError};

/// A regular plane of pixels, numbered row by row: pixel (column, row) is `row * columns + column`.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Values along x, one per column.
    pub x: Vec<f64>,
    /// Values along y, one per row.
    pub y: Vec<f64>,
}

impl Grid {
    /// Number of pixels.
    pub fn len(&self) -> usize {
        self.x.len() * self.y.len()
    }

    /// Whether there are no pixels.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Values (x, y) of a pixel.
    ///
    /// # Panics
    /// If there is no such pixel.
    pub fn at(&self, pixel: usize) -> (f64, f64) {
        let columns = self.x.len();
        (self.x[pixel % columns], self.y[pixel / columns])
    }
}

/// The attractor at each of `pixels`, into `sink`, in no particular order: `model_at` makes model and
/// start at values (x, y) when the pixel's turn comes. Pixels do not depend on each other, to the bit.
///
/// # Errors
/// As [`attractors`].
pub fn map<S, F, E>(
    grid: &Grid,
    pixels: impl IntoIterator<Item = usize, IntoIter: Send>,
    model_at: F,
    search: &Search,
    control: &Control,
    sink: impl FnMut(usize, Found<S::NoModel>) -> Result<(), E> + Send,
) -> Result<(), E>
where
    F: Fn(f64, f64) -> Result<(S, Point), S::NoModel> + Sync,
    E: From<StudyError<S::NoModel>> + Send,
    S: Subject,
{
    let start_at = |pixel| {
        let (x, y) = grid.at(pixel);
        model_at(x, y)
    };
    attractors(pixels, start_at, search, control, sink)
}
