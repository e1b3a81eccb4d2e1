//! The model at values of some parameters.

use saltus::hybrid::Options;
use saltus::model::{Model, ModelError, PreparedPlate};
use saltus::physics::PhysicsError;
use saltus_config::{Parameter, Study};
use std::sync::{Arc, Mutex, PoisonError};

/// Makes models; the plate's coefficients are computed once if no parameter changes them.
pub(super) struct Models<'a> {
    study: &'a Study,
    parameters: Vec<Parameter>,
    options: Options,
    plate: Option<Arc<PreparedPlate>>,
    /// The study at all values but the last: neighbours ask for the same.
    row: Mutex<Option<(Vec<f64>, Arc<Study>)>>,
}

impl<'a> Models<'a> {
    /// Of a study with these parameters; the last is the one that changes most often.
    pub(super) fn new(study: &'a Study, parameters: &[&Parameter], options: Options) -> Self {
        Self {
            study,
            parameters: parameters.iter().copied().cloned().collect(),
            options,
            // values that need one report why it cannot be prepared
            plate: PreparedPlate::new(&study.plate()).ok(),
            row: Mutex::default(),
        }
    }

    /// The study that they are of.
    pub(super) fn study(&self) -> &'a Study {
        self.study
    }

    /// The equations of motion, with a step that the solver can take; one value for each parameter.
    pub(super) fn at(&self, values: &[f64]) -> Result<Model, ModelError> {
        let setup = self.study_at(values)?.setup();
        let prepared = self.plate.as_ref().filter(|p| p.plate == setup.plate);
        let model = prepared.map_or_else(|| setup.model(), |plate| setup.model_on(plate))?;
        model.check_step(&self.options)?;
        Ok(model)
    }

    fn study_at(&self, values: &[f64]) -> Result<Arc<Study>, ModelError> {
        let (Some((parameter, _)), Some((&value, others))) =
            (self.parameters.split_last(), values.split_last())
        else {
            return Ok(Arc::new(self.study.clone()));
        };
        let row = self.row(others)?;
        applied(parameter, &row, value).map(Arc::new)
    }

    fn row(&self, values: &[f64]) -> Result<Arc<Study>, ModelError> {
        let mut kept = self.row.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((known, study)) = &*kept
            && known == values
        {
            return Ok(Arc::clone(study));
        }
        let mut study = self.study.clone();
        for (parameter, &value) in self.parameters.iter().zip(values) {
            study = applied(parameter, &study, value)?;
        }
        let study = Arc::new(study);
        *kept = Some((values.to_vec(), Arc::clone(&study)));
        Ok(study)
    }
}

fn applied(parameter: &Parameter, study: &Study, value: f64) -> Result<Study, ModelError> {
    let impossible = |_| PhysicsError::OutOfRange {
        field: parameter.key(),
        value,
        expected: "a value that the study file allows is needed",
    };
    Ok(parameter.apply(study, value).map_err(impossible)?)
}
