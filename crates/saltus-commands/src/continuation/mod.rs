//! `saltus continue`: branches of periodic orbits over a parameter, and curves of their special points over two.

mod curves;
mod data;
mod diagram;
mod figures;
mod origin;
mod over;
mod question;
mod summary;
mod view;

use crate::answer::{Answer, Take};
use crate::context::RunContext;
use crate::estimate::Part;
use crate::failure::CommandError;
use crate::models::Models;
use curves::Followed;
pub use origin::Labelled;
use origin::Origin;
use question::Question;
use saltus::hybrid::System;
use saltus::model::{Model, ModelError};
use saltus::orbits::{BranchWithOrigin, NewtonOptions, Orbit, Stroboscopic, branches, find_orbit};
use saltus::study::{
    Control, OrbitSearch, Pass, Sweep, SweepRow, linspace, orbit_of, stroboscopic, sweep,
};
use saltus_config::Study;
use saltus_results::{ClassMap, Dataset};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use view::View;

/// Forcing periods per value of the cloud: left out, and shown.
const CLOUD: (u64, u64) = (150, 50);

/// Forcing periods that a point of a branch takes, about, with all tangents in one lane: as in the paper's case.
const PER_POINT: f64 = 7.0;

/// The finding.
struct Found {
    study: Study,
    /// At the start.
    model: Model,
    question: Question,
    limbs: Vec<BranchWithOrigin>,
    /// The map under the curves.
    over: Option<ClassMap>,
    /// The limbs in the paper's units.
    views: Vec<View>,
    curves: Vec<Followed>,
    cloud: Vec<SweepRow>,
}

/// The study at the orbit that the branches begin with.
pub(crate) fn adopted(origin: &Labelled, study: &Study) -> Result<Study, CommandError> {
    Origin::read(&origin.from, &origin.at)?.adopt(study)
}

pub(crate) fn ask(
    study: &Study,
    origin: Option<&Labelled>,
    over: Option<&Path>,
    context: &RunContext,
) -> Result<Box<dyn Answer>, CommandError> {
    let origin = origin.map(|origin| Origin::read(&origin.from, &origin.at));
    let origin = origin.transpose()?;
    let question = Question::new(study)?;
    let over = over
        .map(|folder| over::map(folder, &question))
        .transpose()?;
    let found = follow(study, question, origin.as_ref(), context)?;
    Ok(Box::new(Found { over, ..found }))
}

fn follow(
    study: &Study,
    question: Question,
    origin: Option<&Origin>,
    context: &RunContext,
) -> Result<Found, CommandError> {
    let control = &context.control(study);
    let models = Models::new(study, &question.parameters(), control.options);
    let model_at = |values: &[f64]| models.at(values);
    let model = models.at(&question.start)?;
    let family = stroboscopic(&model, model_at, control);
    let found: Arc<AtomicU64> = Arc::default();
    let go_on = || {
        found.fetch_add(1, Ordering::Relaxed);
        !control.stop.load(Ordering::Relaxed)
    };
    let limbs = context.count("points of branches", &found, || {
        let (options, along) = (question.options(), question.along());
        let first = first(&family, &model, study, &question, origin, control)?;
        branches(&family, &first, &along, &options, &mut |_| go_on())
            .map_err(CommandError::computation)
    });
    context.check()?;
    let limbs = limbs?;
    let view = |limb| View::new(limb, model_at);
    let views: Vec<View> = limbs.iter().map(view).collect::<Result<_, ModelError>>()?;
    let curves = context.count("points of curves", &found, || {
        curves::follow(&family, &question, &limbs, &mut || go_on())
    });
    context.check()?;
    let cloud = cloud(study, &question, &models, context)?;
    context.check()?;
    Ok(Found {
        study: study.clone(),
        model,
        question,
        over: None,
        limbs,
        views,
        curves,
        cloud,
    })
}

/// The cloud, and the tangents of orbits.
pub(crate) fn parts(study: &Study, threads: usize) -> Result<Vec<Part>, CommandError> {
    let question = Question::new(study)?;
    let models = Models::new(study, &question.parameters(), study.options());
    let along = question.along();
    let start_at = |values: &[f64]| {
        let model = models.at(values)?;
        let start = model.start(study.start.z, study.start.v);
        Ok((model, start))
    };
    let end = |i| start_at(&question.at([along.from, along.to][i]));
    let cloud = f64::from(question.table.cloud) * (CLOUD.0 + CLOUD.1) as f64;
    let first = start_at(&question.start)?;
    let columns = first.0.free_states();
    let orbits = Part::new([first], columns, question.points() * PER_POINT)?;
    let cloud = Part::spread(2, threads, 0, cloud, end)?;
    Ok([orbits]
        .into_iter()
        .chain((cloud.periods > 0.0).then_some(cloud))
        .collect())
}

/// The orbit that the branches begin with.
fn first<F>(
    family: &Stroboscopic<'_, F>,
    model: &Model,
    study: &Study,
    question: &Question,
    origin: Option<&Origin>,
    control: &Control,
) -> Result<Orbit, CommandError>
where
    F: Fn(&[f64]) -> Result<System, String> + Sync,
{
    let (table, values) = (&question.table, &question.start);
    if let Some(origin) = origin {
        let found = find_orbit(
            family,
            values,
            &origin.places(model),
            &NewtonOptions::default(),
        );
        return found.map_err(|error| {
            CommandError::computation(error).advise(
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
        CommandError::from(error)
            .advise("[start], continue.transient and continue.period say where the search begins")
    })
}

/// Long-term motions over the range, the state carried on both ways.
fn cloud(
    study: &Study,
    question: &Question,
    models: &Models,
    context: &RunContext,
) -> Result<Vec<SweepRow>, CommandError> {
    let control = context.control(study);
    let along = question.along();
    let (low, high) = (along.from.min(along.to), along.from.max(along.to));
    let (transient, record) = CLOUD;
    let plan = Sweep {
        values: linspace(low, high, question.table.cloud as usize),
        passes: vec![Pass::Up, Pass::Down],
        start: (study.start.z, study.start.v),
        transient,
        record,
    };
    let model_at = |value: f64| models.at(&question.at(value));
    let work = || sweep(&plan, model_at, &control);
    let rows = context.follow(plan.periods(), "periods", &control.done, work)?;
    Ok(rows)
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
