//! `saltus simulate`: the motion, once per forcing period.

mod data;
mod figures;
mod flights;
mod summary;

use crate::answer::{Answer, Take};
use crate::context::RunContext;
use crate::estimate::Part;
use crate::failure::CommandError;
use crate::status;
use saltus::hybrid::Status;
use saltus::model::Model;
use saltus::study::{Instants, Trajectory, simulate_at};
use saltus_config::{SimulateTable, Study};
use saltus_results::Dataset;

/// A run with what it ran.
struct Found {
    study: Study,
    model: Model,
    trajectory: Trajectory,
}

pub(crate) fn ask(study: &Study, context: &RunContext) -> Result<Box<dyn Answer>, CommandError> {
    Ok(Box::new(integrate(study, context)?))
}

fn integrate(study: &Study, context: &RunContext) -> Result<Found, CommandError> {
    let control = context.control(study);
    let model = study.setup().model_with_energy()?;
    let start = model.start(study.start.z, study.start.v);
    let periods = study.simulate.periods;
    let instants = instants(&study.simulate, &model)?;
    let work = || simulate_at(&model, &start, periods.into(), instants, &control);
    let trajectory = context.follow(periods.into(), "periods", &control.done, work)?;
    context.check()?;
    Ok(Found {
        study: study.clone(),
        model,
        trajectory,
    })
}

/// Instants of the time history.
fn instants(table: &SimulateTable, model: &Model) -> Result<Instants, CommandError> {
    let Some(times) = &table.times else {
        let kept = table.periods - table.transient.min(table.periods);
        return Ok(Instants::Last {
            periods: table.history.min(kept).into(),
            points: table.samples_per_period,
        });
    };
    let end = f64::from(table.periods) * model.scales().period();
    match times.last() {
        // the end itself, rounded
        Some(&last) if last > end * (1.0 + f64::EPSILON) => Err(CommandError::refused(
            format!("simulate.times: {last} s lies after the end of the run, {end} s"),
            "simulate.periods says how long it is",
        )),
        _ => Ok(Instants::At(times.clone())),
    }
}

/// One trajectory.
pub(crate) fn parts(study: &Study) -> Result<Vec<Part>, CommandError> {
    let model = study.setup().model_with_energy()?;
    let start = model.start(study.start.z, study.start.v);
    let periods = study.simulate.periods.into();
    Ok(vec![Part::new([(model, start)], 0, periods)?])
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

    fn shortfall(&self) -> Option<CommandError> {
        let end = &self.trajectory.end;
        let short = end.status != Status::Completed;
        short.then(|| {
            CommandError::computation(format!(
                "the run ended in forcing period {} of {}: {}",
                end.periods + 1,
                self.study.simulate.periods,
                status::text(&end.status, Some(self.model.scales().omega))
            ))
        })
    }
}

impl Found {
    fn jumpers(&self) -> usize {
        self.study.jumper.len()
    }

    /// First periods that figures and ratios leave out.
    fn transient(&self) -> usize {
        self.study.simulate.transient as usize
    }

    /// Seconds at the end of period `index`, counted from 0.
    fn section_time(&self, index: usize) -> f64 {
        (index + 1) as f64 * self.model.scales().period()
    }
}
