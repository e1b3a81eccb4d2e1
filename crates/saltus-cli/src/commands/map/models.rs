//! The model at each pixel.

use super::Plane;
use saltus::hybrid::Options;
use saltus::model::{Model, ModelError, PreparedPlate};
use saltus::physics::PhysicsError;
use saltus_config::{Parameter, Study};
use std::sync::{Arc, Mutex, PoisonError};

/// Makes models; the plate's coefficients are computed once if no parameter changes them.
pub(super) struct Models<'a> {
    study: &'a Study,
    plane: &'a Plane,
    options: Options,
    plate: Option<Arc<PreparedPlate>>,
    /// The study of the row last asked for: neighbours ask for the same.
    row: Mutex<Option<(u64, Arc<Study>)>>,
}

impl<'a> Models<'a> {
    pub(super) fn new(study: &'a Study, plane: &'a Plane, options: Options) -> Self {
        Self {
            study,
            plane,
            options,
            // one that cannot be prepared is told of by the pixels that need it
            plate: PreparedPlate::new(&study.plate()).ok(),
            row: Mutex::default(),
        }
    }

    /// The equations of motion, with a step that the solver can take.
    pub(super) fn at(&self, x: f64, y: f64) -> Result<Model, ModelError> {
        let parameter = &self.plane.x.parameter;
        let setup = parameter
            .apply(&*self.row(y)?, x)
            .map_err(|_| impossible(parameter, x))?
            .setup();
        let prepared = self.plate.as_ref().filter(|p| p.plate == setup.plate);
        let model = prepared.map_or_else(|| setup.model(), |plate| setup.model_on(plate))?;
        model.check_step(&self.options)?;
        Ok(model)
    }

    fn row(&self, y: f64) -> Result<Arc<Study>, ModelError> {
        let mut kept = self.row.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((bits, study)) = &*kept
            && *bits == y.to_bits()
        {
            return Ok(Arc::clone(study));
        }
        let parameter = &self.plane.y.parameter;
        let row = parameter.apply(self.study, y);
        let row = Arc::new(row.map_err(|_| impossible(parameter, y))?);
        *kept = Some((y.to_bits(), Arc::clone(&row)));
        Ok(row)
    }
}

fn impossible(parameter: &Parameter, value: f64) -> ModelError {
    PhysicsError::OutOfRange {
        field: parameter.key(),
        value,
        expected: "a value that the study file allows is needed",
    }
    .into()
}
