//! The few dense steps that orbits need. Every matrix is checked to be finite first: the solvers promise
//! nothing otherwise.

use faer::Mat;
use faer::linalg::solvers::{DenseSolveCore, PartialPivLu, Solve, SolveLstsq};

use crate::matrix::Matrix;

/// A pivot below this part of the largest one (or of 1, the size of the identity in M - I) says that a
/// system has no solution worth the name: rounding alone makes pivots of some 1e-15.
const SINGULAR: f64 = 1e-14;

/// The matrix as the solvers take it.
fn dense(a: &Matrix) -> Mat<f64> {
    Mat::from_fn(a.nrows(), a.ncols(), |row, col| a[(row, col)])
}

/// One column.
fn column(b: &[f64]) -> Mat<f64> {
    Mat::from_fn(b.len(), 1, |row, _| b[row])
}

/// A b.
pub(crate) fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let out = dense(a) * dense(b);
    Matrix::from_fn(out.nrows(), out.ncols(), |row, col| out[(row, col)])
}

/// Root of the sum of all squares (Frobenius norm).
pub(crate) fn whole_norm(a: &Matrix) -> f64 {
    dense(a).norm_l2()
}

pub(crate) fn is_finite(a: &Matrix) -> bool {
    (0..a.ncols()).all(|col| (0..a.nrows()).all(|row| a[(row, col)].is_finite()))
}

/// x = A^-1 b, unless A is singular or something is not finite.
pub(crate) fn solve(a: &Matrix, b: &[f64]) -> Option<Vec<f64>> {
    if !is_finite(a) || b.iter().any(|value| !value.is_finite()) {
        return None;
    }
    let lu = PartialPivLu::new(dense(a).as_ref());
    let pivots = (0..a.nrows()).map(|i| lu.U()[(i, i)].abs());
    let (least, most) = pivots.fold((f64::INFINITY, 1.0_f64), |(least, most), pivot| {
        (least.min(pivot), most.max(pivot))
    });
    if least <= SINGULAR * most {
        return None;
    }
    let x = lu.solve(column(b));
    let x: Vec<f64> = (0..b.len()).map(|row| x[(row, 0)]).collect();
    x.iter().all(|value| value.is_finite()).then_some(x)
}

/// Eigenvalues as (real part, imaginary part, condition), unless A is not finite or the iteration fails. A change of A
/// by d changes an eigenvalue by its condition times |d| at most, to first order.
pub(crate) fn eigenvalues(a: &Matrix) -> Option<Vec<(f64, f64, f64)>> {
    if !is_finite(a) {
        return None;
    }
    let eigen = dense(a).eigen().ok()?;
    let (values, vectors) = (eigen.S().column_vector(), eigen.U());
    let dual = vectors.partial_piv_lu().inverse();
    let condition = |j: usize| {
        let length = vectors.col(j).norm_l2() * dual.row(j).norm_l2();
        // no vectors of its own
        if length.is_finite() {
            length
        } else {
            f64::INFINITY
        }
    };
    let value = |j: usize| (values[j].re, values[j].im, condition(j));
    Some((0..a.nrows()).map(value).collect())
}

/// The x for which A x is nearest to b, for A with more rows than columns, unless something is not finite.
pub(crate) fn least_squares(a: &Matrix, b: &[f64]) -> Option<Vec<f64>> {
    if !is_finite(a) || b.iter().any(|value| !value.is_finite()) {
        return None;
    }
    let x = dense(a).qr().solve_lstsq(column(b));
    let x: Vec<f64> = (0..a.ncols()).map(|row| x[(row, 0)]).collect();
    x.iter().all(|value| value.is_finite()).then_some(x)
}

/// The unit vector that A shortens most, for A with one column more than rows. Where A shortens a whole
/// plane to less than `noise`, that vector of the plane that is nearest to `ahead`.
pub(crate) fn tangent(a: &Matrix, noise: f64, ahead: &[f64]) -> Option<Vec<f64>> {
    let plane = null_space(a, 2.min(a.ncols()))?;
    let (last, others) = plane.split_last()?;
    let known = others.iter().all(|v| size(&times(a, v)) > noise);
    let tangent = if known {
        last.clone()
    } else {
        let onto = |sum: Vec<f64>, v: &Vec<f64>| plus(&sum, dot(v, ahead), v);
        unit(&plane.iter().fold(vec![0.0; ahead.len()], onto))
    };
    let sign = dot(&tangent, ahead).signum();
    let tangent = scaled(&tangent, sign);
    tangent
        .iter()
        .all(|value| value.is_finite())
        .then_some(tangent)
}

/// The `count` orthonormal vectors that A shortens most, for A with at least as many columns as rows: its
/// null space where A has one of that dimension. The most shortened is the last.
pub(crate) fn null_space(a: &Matrix, count: usize) -> Option<Vec<Vec<f64>>> {
    if !is_finite(a) {
        return None;
    }
    let svd = dense(a).svd().ok()?;
    let (v, cols) = (svd.V(), a.ncols());
    let column = |col| (0..cols).map(|row| v[(row, col)]).collect();
    Some((cols - count..cols).map(column).collect())
}

impl Matrix {
    /// The determinant; NaN if an entry is not finite.
    ///
    /// # Panics
    /// If the matrix is not square.
    pub fn determinant(&self) -> f64 {
        if is_finite(self) {
            dense(self).determinant()
        } else {
            f64::NAN
        }
    }
}

/// The vector that A turns into `mu` times itself, of length 1, for an eigenvalue `mu` that is real.
pub(crate) fn eigenvector(a: &Matrix, mu: f64) -> Option<Vec<f64>> {
    let n = a.nrows();
    null_space(&shifted(a, mu), 1)?
        .pop()
        .filter(|v| v.len() == n)
}

/// A - mu I.
pub(crate) fn shifted(a: &Matrix, mu: f64) -> Matrix {
    Matrix::from_fn(a.nrows(), a.ncols(), |row, col| {
        a[(row, col)] - if row == col { mu } else { 0.0 }
    })
}

/// A x.
pub(crate) fn times(a: &Matrix, x: &[f64]) -> Vec<f64> {
    (0..a.nrows())
        .map(|row| (0..a.ncols()).map(|col| a[(row, col)] * x[col]).sum())
        .collect()
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(crate) fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// Largest absolute value.
pub(crate) fn size(a: &[f64]) -> f64 {
    a.iter().fold(0.0, |most, value| value.abs().max(most))
}

/// a - b.
pub(crate) fn minus(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// a + factor b.
pub(crate) fn plus(a: &[f64], factor: f64, b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + factor * b).collect()
}

/// factor a.
pub(crate) fn scaled(a: &[f64], factor: f64) -> Vec<f64> {
    a.iter().map(|value| factor * value).collect()
}

/// a / |a|.
pub(crate) fn unit(a: &[f64]) -> Vec<f64> {
    scaled(a, 1.0 / norm(a))
}
