//! The trajectories that Python asks for: parameters, initial conditions and modes, checked against the system.

use numpy::PyReadonlyArray2;
use pyo3::prelude::*;

use super::blueprint::Blueprint;
use crate::error::of_definition;

/// Trajectories to begin: parameters, states and modes, one row for each.
pub(crate) struct Members {
    pub(crate) count: usize,
    pub(crate) parameters: Rows<f64>,
    pub(crate) starts: Rows<f64>,
    pub(crate) modes: Rows<usize>,
}

/// A matrix, row by row; rows may be empty.
pub(crate) struct Rows<T> {
    width: usize,
    values: Vec<T>,
}

impl<T: Copy> Rows<T> {
    pub(crate) fn row(&self, index: usize) -> &[T] {
        &self.values[index * self.width..(index + 1) * self.width]
    }
}

/// A copy, since Python may change the array while we compute.
fn rows<T: Copy + numpy::Element>(array: &PyReadonlyArray2<'_, T>) -> Rows<T> {
    let array = array.as_array();
    Rows {
        width: array.ncols(),
        values: array.iter().copied().collect(),
    }
}

impl Members {
    /// Copies of the arrays, if they are of the sizes of `blueprint` with this number of parameters, their modes
    /// are there, and every system of these parameters can be built.
    pub(crate) fn new(
        blueprint: &Blueprint,
        expected_parameters: usize,
        parameters: &PyReadonlyArray2<'_, f64>,
        starts: &PyReadonlyArray2<'_, f64>,
        modes: &PyReadonlyArray2<'_, u8>,
    ) -> PyResult<Self> {
        let modes = rows(modes);
        let members = Self {
            count: starts.as_array().nrows(),
            parameters: rows(parameters),
            starts: rows(starts),
            modes: Rows {
                width: modes.width,
                values: modes.values.iter().map(|&mode| usize::from(mode)).collect(),
            },
        };
        members.sizes(blueprint, expected_parameters)?;
        members.possible(blueprint)?;
        Ok(members)
    }

    /// One row for each member in every array, as long as the system says.
    fn sizes(&self, blueprint: &Blueprint, parameters: usize) -> PyResult<()> {
        let count = self.count;
        let widths = (self.parameters.width, self.starts.width, self.modes.width);
        let expected = (parameters, blueprint.states(), blueprint.units.len());
        let long = |rows: usize, width: usize| rows == count * width;
        let full =
            long(self.parameters.values.len(), widths.0) && long(self.modes.values.len(), widths.2);
        if widths != expected || !full {
            return Err(of_definition(format!(
                "{count} members with {widths:?} parameters, states and units; {expected:?} are needed"
            )));
        }
        Ok(())
    }

    /// Modes that their units have, and parameters of which a system can be made.
    fn possible(&self, blueprint: &Blueprint) -> PyResult<()> {
        for member in 0..self.count {
            let modes = self.modes.row(member).iter().zip(&blueprint.units);
            if modes.into_iter().any(|(&mode, unit)| mode >= unit.len()) {
                return Err(of_definition(format!(
                    "member {member}: a mode that its unit does not have"
                )));
            }
            let row = self.parameters.row(member);
            let fits = match member {
                0 => blueprint.system(row).map(drop),
                _ => blueprint.check(row),
            };
            if let Err(reason) = fits {
                return Err(of_definition(format!("member {member}: {reason}")));
            }
        }
        Ok(())
    }
}
