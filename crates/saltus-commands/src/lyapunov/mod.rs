//! `saltus lyapunov`: how fast neighbours of the long-term motion part.

mod data;
mod figures;
mod summary;
mod words;

use crate::answer::{Answer, Take};
use crate::context::RunContext;
use crate::estimate::Part;
use crate::failure::CommandError;
use crate::repeats;
use crate::status;
use saltus::hybrid::{Point, Status};
use saltus::model::Model;
use saltus::orbits::{Criteria, Recurrence, Running, Verdict, judge};
use saltus::study::{Control, LyapunovRun, Measurement, StudyError, lyapunov, settle, simulate};
use saltus_config::Study;
use saltus_results::Dataset;

/// Forcing periods in which a repetition is looked for; those of up to half as many are seen.
const SEEN: u64 = 128;

/// The finding for a study.
struct Found {
    study: Study,
    model: Model,
    how: Measurement,
    growth: LyapunovRun,
    /// The exponents from the first periods of the record, over how many these are.
    convergence: Vec<Running>,
    verdict: Verdict,
}

pub(crate) fn ask(study: &Study, context: &RunContext) -> Result<Box<dyn Answer>, CommandError> {
    let model = study.setup().model()?;
    let how = question(study, &model)?;
    let control = context.control(study);
    model.check_step(&control.options)?;
    Ok(Box::new(measure(study, model, how, &control, context)?))
}

/// The question, or an error that says why it makes no sense.
fn question(study: &Study, model: &Model) -> Result<Measurement, CommandError> {
    let (table, states) = (&study.lyapunov, model.free_states());
    let exponents = match table.exponents as usize {
        0 => states,
        asked if asked <= states => asked,
        asked => {
            let key = "lyapunov.exponents";
            return Err(crate::words::too_many_exponents(key, asked, states, "all"));
        }
    };
    Ok(Measurement {
        exponents,
        transient: table.transient.into(),
        periods: table.periods.into(),
        replicas: table.replicas as usize,
    })
}

fn measure(
    study: &Study,
    model: Model,
    how: Measurement,
    control: &Control,
    context: &RunContext,
) -> Result<Found, CommandError> {
    let start = model.start(study.start.z, study.start.v);
    let until = how.transient + how.periods;
    let work = || {
        let growth = lyapunov(&model, &start, &how, control)?;
        let recurrence = match &growth.cycle {
            Some(orbit) => Recurrence::Recurs {
                period: orbit.period() as u32,
                rest: 0.0,
            },
            None => recurrence(&model, &start, until, control)?,
        };
        Ok::<_, StudyError>((growth, recurrence))
    };
    let total = how.work() + until + SEEN;
    let (growth, recurrence) = context.follow(total, "periods", &control.done, work)?;
    context.check()?;
    if growth.spectrum.iterates() == 0 {
        return Err(CommandError::computation(format!(
            "the motion ended before an exponent could be measured: {}",
            status::text(&growth.status, None)
        )));
    }
    let criteria = Criteria {
        // what the sum of all exponents is off by
        noise: study.solver.tolerance,
        ..Criteria::default()
    };
    let verdict = judge(&growth.spectrum, recurrence, &criteria);
    Ok(Found {
        study: study.clone(),
        model,
        how,
        convergence: growth.spectrum.convergence(),
        growth,
        verdict,
    })
}

/// The motion, piece after piece, and the tangents of the pieces side by side.
pub(crate) fn parts(study: &Study) -> Result<Vec<Part>, CommandError> {
    let model = study.setup().model()?;
    let how = question(study, &model)?;
    let start = model.start(study.start.z, study.start.v);
    let pieces = how.replicas as u64;
    let before = how.transient + pieces.saturating_sub(1) * how.periods;
    let motion = before + how.transient + how.periods + SEEN;
    let replicas = vec![(model.clone(), start.clone()); how.replicas];
    let tangents = (how.work() - before) as f64;
    Ok(vec![
        Part::new([(model, start)], 0, motion as f64)?,
        Part::new(replicas, how.exponents, tangents)?,
    ])
}

/// Whether people and plate come back together, as they are `until` periods after the start.
fn recurrence(
    model: &Model,
    start: &Point,
    until: u64,
    control: &Control,
) -> Result<Recurrence, StudyError> {
    let settled = settle(&[(model.clone(), start.clone())], until, 0, control)?;
    let end = settled.into_iter().next().map(|settled| settled.end);
    let run = simulate(model, end.as_ref().unwrap_or(start), SEEN, 0, 1, control)?;
    if run.end.status != Status::Completed {
        return Ok(Recurrence::Open);
    }
    let jumpers = model.setup().jumpers.len();
    let amplitudes = model.setup().plate.modes.w.len();
    let samples = |i: usize| match i.checked_sub(jumpers) {
        None => run.section.iter().map(|at| (at.z[i], at.v[i])).unzip(),
        Some(j) => run.section.iter().map(|at| (at.w[j], at.w[j])).unzip(),
    };
    let every = repeats::every(jumpers + amplitudes, run.section.len(), samples);
    Ok(every.map_or(Recurrence::Open, |period| Recurrence::Recurs {
        period,
        rest: repeats::SAME,
    }))
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
        take("convergence", &figures::convergence(self))
    }

    fn shortfall(&self) -> Option<CommandError> {
        let short = self.growth.status != Status::Completed;
        short.then(|| {
            CommandError::computation(format!(
                "not every replica was run to its end: {}",
                status::text(&self.growth.status, None)
            ))
        })
    }
}
