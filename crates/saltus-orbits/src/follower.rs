//! Exponents of any family that gives its derivative, one iterate after another.

use crate::{ExponentError, Image, MapPoint, MapRequest, ParametricMap, Spectrum};

/// A trajectory with its tangent columns and their record.
///
/// One image is asked for at a time. An integrator of a flow may move the columns along instead of asking
/// for the whole derivative, and feed a [`Spectrum`] itself.
pub struct Follower<'a> {
    family: &'a dyn ParametricMap,
    parameters: &'a [f64],
    place: MapPoint,
    columns: Vec<f64>,
    /// Iterates made, transient included.
    made: usize,
    spectrum: Spectrum,
}

impl<'a> Follower<'a> {
    /// Begins at `start`, for the `columns` largest exponents.
    ///
    /// # Errors
    /// [`ExponentError::Columns`] unless there are 1 to n columns, [`ExponentError::Length`] if the state is not
    /// of length n.
    pub fn new(
        family: &'a dyn ParametricMap,
        parameters: &'a [f64],
        start: MapPoint,
        columns: usize,
    ) -> Result<Self, ExponentError> {
        let spectrum = Spectrum::new(family.dimension(), columns)?;
        let (got, want) = (start.x.len(), family.dimension());
        if got != want {
            return Err(ExponentError::Length { got, want });
        }
        Ok(Self {
            family,
            parameters,
            place: start,
            columns: spectrum.start_columns(),
            made: 0,
            spectrum,
        })
    }

    /// Makes `iterates` more iterates, and records them.
    ///
    /// # Errors
    /// [`ExponentError::NoImage`] where the trajectory ends, [`ExponentError::NoDerivative`] if the family gives none,
    /// [`ExponentError::NotFinite`]. The record until then stays.
    pub fn advance(&mut self, iterates: usize) -> Result<(), ExponentError> {
        for _ in 0..iterates {
            let image = self.image()?;
            self.turn(&image)?;
            self.spectrum.feed(&mut self.columns)?;
            self.place = image.place;
            self.made += 1;
        }
        Ok(())
    }

    /// Forgets the record, not the place or the columns: call it after the transient.
    pub fn forget(&mut self) {
        self.spectrum.forget();
    }

    /// The last place of the trajectory.
    pub fn place(&self) -> &MapPoint {
        &self.place
    }

    /// The record.
    pub fn spectrum(&self) -> &Spectrum {
        &self.spectrum
    }

    fn image(&self) -> Result<Image, ExponentError> {
        let shot = MapRequest {
            parameters: self.parameters,
            start: &self.place,
            derivative: true,
        };
        let iterate = self.made;
        let answer = self.family.images(&[shot]).pop();
        let answer = answer.ok_or(self.no_derivative())?;
        answer.map_err(|lost| ExponentError::NoImage { iterate, lost })
    }

    /// Every column times the derivative.
    fn turn(&mut self, image: &Image) -> Result<(), ExponentError> {
        let n = self.place.x.len();
        let derivative = image.derivative.as_ref();
        let square = derivative.filter(|d| (d.nrows(), d.ncols()) == (n, n));
        let d = square.ok_or(self.no_derivative())?;
        for column in self.columns.chunks_exact_mut(n) {
            let row = |i| (0..n).map(|j| d[(i, j)] * column[j]).sum();
            let turned: Vec<f64> = (0..n).map(row).collect();
            column.copy_from_slice(&turned);
        }
        Ok(())
    }

    fn no_derivative(&self) -> ExponentError {
        let dimension = self.place.x.len();
        ExponentError::NoDerivative { dimension }
    }
}

/// The record of the `columns` largest exponents along `iterates` iterates, after `transient` others.
///
/// # Errors
/// Those of [`Follower::new`] and [`Follower::advance`].
pub fn spectrum_of(
    family: &dyn ParametricMap,
    parameters: &[f64],
    start: MapPoint,
    transient: usize,
    iterates: usize,
    columns: usize,
) -> Result<Spectrum, ExponentError> {
    let mut follower = Follower::new(family, parameters, start, columns)?;
    follower.advance(transient)?;
    follower.forget();
    follower.advance(iterates)?;
    Ok(follower.spectrum)
}
