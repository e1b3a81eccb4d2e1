//! A plate with its coefficients.

use std::sync::Arc;

use super::elastic::Stretching;
use crate::physics::{Elasticity, PhysicsError, Plate};

/// A plate with its coefficients, computed once and shared by all models on it.
#[derive(Clone, Debug)]
pub struct PreparedPlate {
    /// The plate.
    pub plate: Plate,
    /// Its coefficients.
    pub elasticity: Elasticity,
    /// Contribution of its stretching to the equations.
    pub(super) stretching: Stretching,
}

impl PreparedPlate {
    /// Computes all coefficients.
    ///
    /// # Errors
    /// As [`Plate::elasticity`].
    pub fn new(plate: &Plate) -> Result<Arc<Self>, PhysicsError> {
        let elasticity = plate.elasticity()?;
        let stretching = Stretching::new(&elasticity)?;
        Ok(Arc::new(Self {
            plate: plate.clone(),
            elasticity,
            stretching,
        }))
    }
}
