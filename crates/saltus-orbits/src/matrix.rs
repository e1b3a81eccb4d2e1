//! Dense matrices, such as derivatives of a map.

use std::ops::{Index, IndexMut};

/// A dense matrix, read and written by (row, column).
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    nrows: usize,
    ncols: usize,
    /// Column by column.
    values: Vec<f64>,
}

impl Matrix {
    /// The matrix with `entry(row, column)` at each place.
    pub fn from_fn(nrows: usize, ncols: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let places = (0..ncols).flat_map(|col| (0..nrows).map(move |row| (row, col)));
        Self {
            nrows,
            ncols,
            values: places.map(|(row, col)| entry(row, col)).collect(),
        }
    }

    /// A matrix of zeros.
    pub fn zeros(nrows: usize, ncols: usize) -> Self {
        Self::from_fn(nrows, ncols, |_, _| 0.0)
    }

    /// The identity of n rows.
    pub fn identity(n: usize) -> Self {
        Self::from_fn(n, n, |row, col| if row == col { 1.0 } else { 0.0 })
    }

    /// Number of rows.
    pub fn nrows(&self) -> usize {
        self.nrows
    }

    /// Number of columns.
    pub fn ncols(&self) -> usize {
        self.ncols
    }

    /// The matrix with rows and columns exchanged.
    #[must_use]
    pub(crate) fn transposed(&self) -> Self {
        Self::from_fn(self.ncols, self.nrows, |row, col| self[(col, row)])
    }

    fn place(&self, (row, col): (usize, usize)) -> usize {
        assert!(row < self.nrows && col < self.ncols, "outside the matrix");
        col * self.nrows + row
    }
}

impl Index<(usize, usize)> for Matrix {
    type Output = f64;

    fn index(&self, place: (usize, usize)) -> &f64 {
        &self.values[self.place(place)]
    }
}

impl IndexMut<(usize, usize)> for Matrix {
    fn index_mut(&mut self, place: (usize, usize)) -> &mut f64 {
        let place = self.place(place);
        &mut self.values[place]
    }
}
