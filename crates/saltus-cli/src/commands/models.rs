//! The model at each value of the parameter.

use saltus::hybrid::Options;
use saltus::model::{Model, ModelError, PreparedPlate};
use saltus::physics::PhysicsError;
use saltus_config::{Parameter, Study};
use std::sync::Arc;

/// Makes models; the plate's coefficients are computed once if the parameter does not change them.
pub(super) struct Models<'a> {
    study: &'a Study,
    parameter: &'a Parameter,
    options: Options,
    plate: Option<Arc<PreparedPlate>>,
}

impl<'a> Models<'a> {
    pub(super) fn new(study: &'a Study, parameter: &'a Parameter, options: Options) -> Self {
        Self {
            study,
            parameter,
            options,
            // one that cannot be prepared is told of by the values that need it
            plate: PreparedPlate::new(&study.plate()).ok(),
        }
    }

    /// The equations of motion, with a step that the solver can take.
    pub(super) fn at(&self, value: f64) -> Result<Model, ModelError> {
        let setup = self
            .parameter
            .apply(self.study, value)
            .map_err(|_| self.impossible(value))?
            .setup();
        let prepared = self.plate.as_ref().filter(|p| p.plate == setup.plate);
        let model = prepared.map_or_else(|| setup.model(), |plate| setup.model_on(plate))?;
        model.check_step(&self.options)?;
        Ok(model)
    }

    fn impossible(&self, value: f64) -> ModelError {
        let field = self.parameter.key();
        let expected = "a value that the study file allows is needed";
        PhysicsError::OutOfRange {
            field,
            value,
            expected,
        }
        .into()
    }
}
