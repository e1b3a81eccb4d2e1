//! The four dense linear-algebra steps the physics needs, on row-major slices. All inputs are
//! checked to be finite first: the solvers promise nothing otherwise.

use super::PhysicsError;
use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Mat, Side};

fn matrix(
    what: &'static str,
    rows: usize,
    cols: usize,
    data: &[f64],
) -> Result<Mat<f64>, PhysicsError> {
    debug_assert_eq!(data.len(), rows * cols);
    match data.iter().find(|value| !value.is_finite()) {
        Some(value) => Err(PhysicsError::Algebra {
            what,
            reason: format!("an entry is {value}; are the inputs in SI units?"),
        }),
        None => Ok(Mat::from_fn(rows, cols, |row, col| data[row * cols + col])),
    }
}

/// Eigenvalues of the symmetric `size` x `size` matrix `a`, ascending.
pub(super) fn eigenvalues(
    what: &'static str,
    size: usize,
    a: &[f64],
) -> Result<Vec<f64>, PhysicsError> {
    if size == 0 {
        return Ok(Vec::new());
    }
    matrix(what, size, size, a)?
        .self_adjoint_eigenvalues(Side::Lower)
        .map_err(|error| PhysicsError::Algebra {
            what,
            reason: format!("{error:?}"),
        })
}

/// Eigenvalues of the symmetric `size` x `size` matrix `a`, ascending, each with its unit vector.
pub(super) fn eigenpairs(
    what: &'static str,
    size: usize,
    a: &[f64],
) -> Result<Vec<(f64, Vec<f64>)>, PhysicsError> {
    if size == 0 {
        return Ok(Vec::new());
    }
    let eigen = matrix(what, size, size, a)?
        .self_adjoint_eigen(Side::Lower)
        .map_err(|error| PhysicsError::Algebra {
            what,
            reason: format!("{error:?}"),
        })?;
    let (values, vectors) = (eigen.S().column_vector(), eigen.U());
    Ok((0..size)
        .map(|col| {
            (
                values[col],
                (0..size).map(|row| vectors[(row, col)]).collect(),
            )
        })
        .collect())
}

/// The lower L with L L^T = A, for symmetric positive definite A (`size` x `size`), row-major.
pub(super) fn cholesky(
    what: &'static str,
    size: usize,
    a: &[f64],
) -> Result<Vec<f64>, PhysicsError> {
    let factor = matrix(what, size, size, a)?
        .llt(Side::Lower)
        .map_err(|error| PhysicsError::Algebra {
            what,
            reason: format!("the stiffness matrix is not positive definite ({error:?})"),
        })?;
    let lower = factor.L();
    Ok((0..size)
        .flat_map(|row| (0..size).map(move |col| (row, col)))
        .map(|(row, col)| if col <= row { lower[(row, col)] } else { 0.0 })
        .collect())
}

/// x = A^-1 b for a general A (`size` x `size`), row-major. A singular A gives values that are not
/// finite.
pub(super) fn solve(
    what: &'static str,
    size: usize,
    a: &[f64],
    b: &[f64],
) -> Result<Vec<f64>, PhysicsError> {
    let (a, b) = (matrix(what, size, size, a)?, matrix(what, size, 1, b)?);
    let x = PartialPivLu::new(a.as_ref()).solve(&b);
    Ok((0..size).map(|row| x[(row, 0)]).collect())
}

/// A^T B for A and B with `rows` rows, row-major.
pub(super) fn transpose_times(
    what: &'static str,
    rows: usize,
    cols: usize,
    a: &[f64],
    b: &[f64],
) -> Result<Vec<f64>, PhysicsError> {
    let product = matrix(what, rows, cols, a)?.transpose() * matrix(what, rows, cols, b)?;
    Ok((0..cols)
        .flat_map(|row| (0..cols).map(move |col| (row, col)))
        .map(|at| product[at])
        .collect())
}
