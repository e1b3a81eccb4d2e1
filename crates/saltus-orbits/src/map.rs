//! A map that depends on parameters: the hinge between a motion and the questions asked of it.

use crate::matrix::Matrix;

/// A point of a trajectory at the section: modes and state together; neither means anything alone.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MapPoint {
    /// Mode of each unit that switches; empty for a map without any.
    pub modes: Vec<usize>,
    /// State, of length [`ParametricMap::dimension`].
    pub x: Vec<f64>,
}

/// One application of the map that is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapRequest<'a> {
    /// Value of each parameter.
    pub parameters: &'a [f64],
    /// First state.
    pub start: &'a MapPoint,
    /// Whether the derivative and what happens on the way are wanted too.
    pub derivative: bool,
}

/// The image of a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// The place it leads to.
    pub place: MapPoint,
    /// d(image)/d(start), n x n, if it was asked for.
    pub derivative: Option<Matrix>,
    /// Switches on the way, in time order, if the derivative was asked for.
    pub crossings: Vec<Crossing>,
    /// Extrema of guards without a switch, if the derivative was asked for.
    pub touches: Vec<Touch>,
}

/// A switch on the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Unit that switches.
    pub unit: usize,
    /// The mode left.
    pub from: usize,
    /// The mode entered.
    pub to: usize,
    /// Time, as a part of the way from start to image, in (0, 1].
    pub at: f64,
}

/// An extremum of a guard that stayed on its side: at grazing its value is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Unit whose guard it is.
    pub unit: usize,
    /// The mode it was in.
    pub mode: usize,
    /// Number of the guard within that mode.
    pub guard: usize,
    /// Value of the guard there; positive, since the mode lasts.
    pub value: f64,
    /// Time, as a part of the way from start to image.
    pub at: f64,
}

/// Reason why there is no image.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NoImage {
    /// No map at these parameters, with the reason.
    #[error("{0}")]
    NoMap(String),
    /// The way ended before the image, with the reason.
    #[error("{0}")]
    Ended(String),
    /// Stopped from outside.
    #[error("interrupted")]
    Interrupted,
}

/// A map R^n -> R^n that depends on parameters, such as a forced flow over one period.
pub trait ParametricMap: Sync {
    /// n.
    fn dimension(&self) -> usize;

    /// The image of each shot, in their order. Many at once cost less than one by one.
    fn images(&self, shots: &[MapRequest<'_>]) -> Vec<Result<Image, NoImage>>;
}
