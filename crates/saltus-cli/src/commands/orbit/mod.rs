//! `saltus orbit`: the periodic orbit near the long-term motion.

mod figures;
mod report;
mod summary;
mod tables;

use crate::args::WorkArgs;
use crate::exit::Failure;
use crate::folder::Folder;
use crate::{interrupt, progress};
use report::Report;
use saltus::model::Model;
use saltus::orbits::Orbit;
use saltus::study::{Control, OrbitSearch, Portrait, orbit, portrait};
use saltus_config::{OrbitTable, Study};

/// An orbit with what it is an orbit of.
struct Run<'a> {
    study: &'a Study,
    model: Model,
    orbit: Orbit,
    portrait: Portrait,
}

pub(super) fn run(args: &WorkArgs) -> Result<(), Failure> {
    let study = super::load(&args.study, &[])?;
    let control = super::control(&study, &args.threads);
    let folder = super::folder(&args.output, &study)?;
    let work = || find(&study, &control);
    let run = progress::count("searching", args.output.quiet, &control.done, work)?;
    interrupt::check()?;
    let report = Report::new(&run);
    if let Some(folder) = folder {
        write(folder, &run, &report)?;
    }
    super::tell(&args.output, &report, || summary::text(&run, &report))
}

fn find<'a>(study: &'a Study, control: &Control) -> Result<Run<'a>, Failure> {
    let model = study.setup().model()?;
    model.check_step(&control.options)?;
    let start = model.start(study.start.z, study.start.v);
    let orbit = orbit(&model, &start, &search(&study.orbit), control).map_err(|error| {
        Failure::from(error)
            .advise("[start], orbit.transient and orbit.period say where the search begins")
    })?;
    Ok(Run {
        study,
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

fn write(mut folder: Folder, run: &Run, report: &Report) -> Result<(), Failure> {
    folder.json("orbit.json", report)?;
    tables::write(&mut folder, run, report)?;
    figures::write(&mut folder, run)?;
    folder.commit().map(drop)
}
