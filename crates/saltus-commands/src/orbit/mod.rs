//! `saltus orbit`: the periodic orbit near the long-term motion.

mod dataset;
mod figures;
mod report;
mod summary;
mod tables;

use crate::context::Context;
use crate::failure::Failure;
use crate::request::Answer;
use crate::store::{self, Store};
use report::Report;
use saltus::model::Model;
use saltus::orbits::Orbit;
use saltus::study::{Control, OrbitSearch, Portrait, orbit, portrait};
use saltus_config::{OrbitTable, Study};
use std::io::{self, Write};

/// An orbit with what it is an orbit of.
struct Run {
    study: Study,
    model: Model,
    orbit: Orbit,
    portrait: Portrait,
}

pub(crate) fn ask(study: &Study, context: &Context) -> Result<Box<dyn Answer>, Failure> {
    let control = context.control(study);
    let run = context.count("searching", &control.done, || find(study, &control))?;
    context.check()?;
    Ok(Box::new(run))
}

fn find(study: &Study, control: &Control) -> Result<Run, Failure> {
    let model = study.setup().model()?;
    model.check_step(&control.options)?;
    let start = model.start(study.start.z, study.start.v);
    let orbit = orbit(&model, &start, &search(&study.orbit), control).map_err(|error| {
        Failure::from(error)
            .advise("[start], orbit.transient and orbit.period say where the search begins")
    })?;
    Ok(Run {
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

impl Answer for Run {
    fn summary(&self) -> String {
        summary::text(self, &Report::new(self))
    }

    fn document(&self, to: &mut dyn Write) -> io::Result<()> {
        store::stream_json(to, &Report::new(self))
    }

    fn fill(&self, store: &mut dyn Store) -> Result<(), Failure> {
        let report = Report::new(self);
        tables::write(store, self, &report)?;
        store.dataset("orbit.nc", dataset::dataset(self, &report))?;
        figures::write(store, self)
    }
}
