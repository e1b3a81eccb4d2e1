//! `saltus simulate`: the motion, once per forcing period.

mod figures;
mod flights;
mod report;
mod summary;
mod tables;

use crate::args::SimulateArgs;
use crate::exit::Failure;
use crate::folder::Folder;
use crate::{interrupt, progress};
use report::Report;
use saltus::hybrid::Status;
use saltus::model::Model;
use saltus::study::{Control, Trajectory};
use saltus_config::Study;

/// Periods of the time history at most: what a figure can show, and little memory however long the run.
const HISTORY: u32 = 20;

/// Points of the time history per period: a peak of the force is met to about 1e-4.
const POINTS: u32 = 400;

/// A run with what it ran.
struct Run<'a> {
    study: &'a Study,
    model: Model,
    trajectory: Trajectory,
}

pub(super) fn run(args: &SimulateArgs) -> Result<(), Failure> {
    let periods: Vec<String> = args
        .periods
        .iter()
        .map(|n| format!("simulate.periods={n}"))
        .collect();
    let study = super::load(&args.study, &periods)?;
    let control = super::control(&study, &args.threads);
    let folder = super::folder(&args.output, &study)?;
    let run = integrate(&study, &control, args.output.quiet)?;
    let report = Report::new(&run);
    if let Some(folder) = folder {
        write(folder, &run, &report)?;
    }
    super::tell(&args.output, &report, || summary::text(&run, &report))?;
    match run.trajectory.end.status {
        Status::Completed => Ok(()),
        _ => Err(Failure::computation(format!(
            "the run ended in forcing period {} of {}: {}",
            run.trajectory.end.periods + 1,
            study.simulate.periods,
            report.status_text
        ))),
    }
}

fn integrate<'a>(study: &'a Study, control: &Control, quiet: bool) -> Result<Run<'a>, Failure> {
    let model = study.setup().model_with_energy()?;
    let start = model.start(study.start.z, study.start.v);
    let periods = study.simulate.periods;
    let history = HISTORY.min(periods - study.simulate.transient.min(periods));
    let work = || {
        let (periods, history) = (periods.into(), history.into());
        saltus::study::simulate(&model, &start, periods, history, POINTS, control)
    };
    let trajectory = progress::follow(periods.into(), "periods", quiet, &control.done, work)?;
    interrupt::check()?;
    Ok(Run {
        study,
        model,
        trajectory,
    })
}

fn write(mut folder: Folder, run: &Run, report: &Report) -> Result<(), Failure> {
    folder.json("simulate.json", report)?;
    tables::write(&mut folder, run, report)?;
    figures::write(&mut folder, run)?;
    folder.commit().map(drop)
}

impl Run<'_> {
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
