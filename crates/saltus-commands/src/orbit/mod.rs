//! `saltus orbit`: the periodic orbit near the long-term motion.

mod data;
mod figures;
mod summary;

use crate::answer::{Answer, Take};
use crate::context::RunContext;
use crate::failure::CommandError;
use saltus::model::Model;
use saltus::orbits::Orbit;
use saltus::study::{Control, OrbitSearch, Portrait, orbit, portrait};
use saltus_config::{OrbitTable, Study};
use saltus_results::Dataset;

/// An orbit with what it is an orbit of.
struct Found {
    study: Study,
    model: Model,
    orbit: Orbit,
    portrait: Portrait,
}

pub(crate) fn ask(study: &Study, context: &RunContext) -> Result<Box<dyn Answer>, CommandError> {
    let control = context.control(study);
    let found = context.count("searching", &control.done, || find(study, &control))?;
    context.check()?;
    Ok(Box::new(found))
}

fn find(study: &Study, control: &Control) -> Result<Found, CommandError> {
    let model = study.setup().model()?;
    model.check_step(&control.options)?;
    let start = model.start(study.start.z, study.start.v);
    let orbit = orbit(&model, &start, &search(&study.orbit), control).map_err(|error| {
        CommandError::from(error)
            .advise("[start], orbit.transient and orbit.period say where the search begins")
    })?;
    Ok(Found {
        study: study.clone(),
        portrait: portrait(&model, &orbit, control)?,
        orbit,
        model,
    })
}

fn search(table: &OrbitTable) -> OrbitSearch {
    let given = |number: u32| (number > 0).then_some(number as usize);
    OrbitSearch {
        period: given(table.period),
        transient: table.transient.into(),
        segments: given(table.segments),
    }
}

impl Answer for Found {
    fn study(&self) -> &Study {
        &self.study
    }

    fn data(&self) -> Dataset {
        data::data(self)
    }

    fn summary(&self) -> String {
        summary::text(self)
    }

    fn draw(&self, take: Take) -> Result<(), CommandError> {
        figures::draw(self, take)
    }
}
