//! `saltus continue`: branches of periodic orbits over a parameter, and curves of their special points over two.

mod curves;
mod diagram;
mod figures;
mod origin;
mod question;
mod report;
mod summary;
mod tables;
mod view;

use super::models::Models;
use crate::args::ContinueArgs;
use crate::exit::Failure;
use crate::folder::Folder;
use crate::{interrupt, progress};
use curves::Followed;
use origin::Origin;
use question::Question;
use report::Report;
use saltus::hybrid::System;
use saltus::model::{Model, ModelError};
use saltus::orbits::{Limb, NewtonOptions, Orbit, Stroboscopic, branches, find_orbit};
use saltus::study::{Control, OrbitSearch, Pass, Sweep, SweepRow, orbit_of, stroboscopic, sweep};
use saltus_config::Study;
use std::sync::atomic::{AtomicU64, Ordering};
use view::View;

/// Forcing periods per value of the cloud: left out, and shown.
const CLOUD: (u64, u64) = (150, 50);

/// What was found.
struct Run<'a> {
    study: &'a Study,
    /// At the start.
    model: Model,
    question: Question<'a>,
    limbs: Vec<Limb>,
    /// The limbs in the paper's units.
    views: Vec<View>,
    curves: Vec<Followed>,
    cloud: Vec<SweepRow>,
}

pub(super) fn run(args: &ContinueArgs) -> Result<(), Failure> {
    let mut study = super::load(&args.work.study, &[])?;
    let origin = args.from.as_deref().zip(args.at.as_deref());
    let origin = origin
        .map(|(folder, label)| Origin::read(folder, label))
        .transpose()?;
    if let Some(origin) = &origin {
        study = origin.adopt(&study)?;
    }
    let question = Question::new(&study)?;
    let control = super::control(&study, &args.work.threads);
    let folder = super::folder(&args.work.output, &study)?;
    let run = follow(
        &study,
        question,
        origin.as_ref(),
        &control,
        args.work.output.quiet,
    )?;
    let report = Report::new(&run);
    if let Some(folder) = folder {
        write(folder, &run, &report)?;
    }
    super::tell(&args.work.output, &report, || summary::text(&run, &report))
}

fn follow<'a>(
    study: &'a Study,
    question: Question<'a>,
    origin: Option<&Origin>,
    control: &Control,
    quiet: bool,
) -> Result<Run<'a>, Failure> {
    let models = Models::new(study, &question.parameters(), control.options);
    let model_at = |values: &[f64]| models.at(values);
    let model = models.at(&question.start)?;
    let family = stroboscopic(&model, model_at, control);
    let found = AtomicU64::new(0);
    let go_on = || {
        found.fetch_add(1, Ordering::Relaxed);
        !control.stop.load(Ordering::Relaxed)
    };
    let limbs = progress::count("points of branches", quiet, &found, || {
        let (options, along) = (question.options(), question.along());
        let first = first(&family, &model, study, &question, origin, control)?;
        branches(&family, &first, &along, &options, &mut |_| go_on()).map_err(Failure::computation)
    });
    interrupt::check()?;
    let limbs = limbs?;
    let view = |limb| View::new(limb, model_at);
    let views: Vec<View> = limbs.iter().map(view).collect::<Result<_, ModelError>>()?;
    let curves = progress::count("points of curves", quiet, &found, || {
        curves::follow(&family, &question, &limbs, &mut || go_on())
    });
    interrupt::check()?;
    let cloud = cloud(study, &question, &models, control, quiet)?;
    interrupt::check()?;
    Ok(Run {
        study,
        model,
        question,
        limbs,
        views,
        curves,
        cloud,
    })
}

/// The orbit that the branches begin with.
fn first<F>(
    family: &Stroboscopic<'_, F>,
    model: &Model,
    study: &Study,
    question: &Question,
    origin: Option<&Origin>,
    control: &Control,
) -> Result<Orbit, Failure>
where
    F: Fn(&[f64]) -> Result<System, String> + Sync,
{
    let (table, values) = (question.table, &question.start);
    if let Some(origin) = origin {
        let found = find_orbit(
            family,
            values,
            &origin.places(model),
            &NewtonOptions::default(),
        );
        return found.map_err(|error| {
            Failure::computation(error).advise(
                "the study must be near the one of the result: change fewer numbers at once",
            )
        });
    }
    let start = model.start(study.start.z, study.start.v);
    let search = OrbitSearch {
        period: (table.period > 0).then_some(table.period as usize),
        transient: table.transient.into(),
        segments: None,
    };
    orbit_of(family, model, values, &start, &search, control).map_err(|error| {
        Failure::from(error)
            .advise("[start], continue.transient and continue.period say where the search begins")
    })
}

/// Long-term motions over the range, the state carried on both ways.
fn cloud(
    study: &Study,
    question: &Question,
    models: &Models,
    control: &Control,
    quiet: bool,
) -> Result<Vec<SweepRow>, Failure> {
    let along = question.along();
    let (low, high) = (along.from.min(along.to), along.from.max(along.to));
    let (transient, record) = CLOUD;
    let plan = Sweep {
        values: Sweep::linspace(low, high, question.table.cloud as usize),
        passes: vec![Pass::Up, Pass::Down],
        start: (study.start.z, study.start.v),
        transient,
        record,
    };
    control.done.store(0, Ordering::Relaxed);
    let model_at = |value: f64| models.at(&question.at(value));
    let work = || sweep(&plan, model_at, control);
    let rows = progress::follow(plan.periods(), "periods", quiet, &control.done, work)?;
    Ok(rows)
}

fn write(mut folder: Folder, run: &Run, report: &Report) -> Result<(), Failure> {
    folder.json("continue.json", report)?;
    tables::write(&mut folder, run, report)?;
    figures::write(&mut folder, run)?;
    folder.commit().map(drop)
}
