//! `saltus attractors`: all coexisting attractors, in one place or matched along a parameter.

mod data;
mod figures;
mod ranges;
mod section;
mod summary;

use crate::answer::{Answer, Take};
use crate::context::RunContext;
use crate::estimate::Part;
use crate::failure::CommandError;
use crate::models::Models;
use crate::plane::{self, Loss};
use saltus::orbits::MotionKind;
use saltus::study::{
    ContinuedAttractors, Control, CountedAttractor, Row, Search, Starts, Transient,
};
use saltus_config::{Parameter, Study};
use saltus_results::Dataset;
use std::sync::atomic::Ordering;

/// The question and its finding.
struct Found {
    study: Study,
    /// Without a parameter there is one row, whose value means nothing.
    parameter: Option<Parameter>,
    /// Samples of their cycles connect along the parameter.
    all: ContinuedAttractors,
    periods_run: u64,
}

pub(crate) fn ask(study: &Study, context: &RunContext) -> Result<Box<dyn Answer>, CommandError> {
    plane::need_people(study, "a search for attractors")?;
    let (parameter, values) = question(study)?;
    refuse_if_too_many(study, values.len())?;
    let control = context.control(study);
    let mut all = followed(study, parameter.as_ref(), &values, &control, context)?;
    section::connect(&mut all);
    Ok(Box::new(Found {
        study: study.clone(),
        parameter,
        all,
        periods_run: control.done.load(Ordering::Relaxed),
    }))
}

/// The attractors at all values, matched.
fn followed(
    study: &Study,
    parameter: Option<&Parameter>,
    values: &[f64],
    control: &Control,
    context: &RunContext,
) -> Result<ContinuedAttractors, CommandError> {
    let models = parameter.map(|parameter| Models::new(study, &[parameter], control.options));
    let model_at = |value| match &models {
        Some(models) => models.at(&[value]),
        None => study.setup().model(),
    };
    let (starts, search) = plan(study);
    let work = || saltus::study::follow(values, model_at, &starts, &search, control);
    // most runs settle early, and some are run on: about right, and known from the beginning
    let total = (values.len() * starts.count) as u64 * (search.transient + search.record);
    let found = context.follow(total, "periods, at most about", &control.done, work)?;
    context.check()?;
    refuse_if_all_lost(&found.rows)?;
    Ok(found)
}

/// A trajectory for each first state.
pub(crate) fn parts(study: &Study, threads: usize) -> Result<Vec<Part>, CommandError> {
    plane::need_people(study, "a search for attractors")?;
    let (parameter, values) = question(study)?;
    let changed: Vec<&Parameter> = parameter.iter().collect();
    let models = Models::new(study, &changed, study.options());
    let (starts, search) = plan(study);
    let periods = plane::settling(&search);
    let start_at = |i: usize| {
        let own = &values[i / starts.count..][..changed.len()];
        let model = models.at(own)?;
        let start = starts.point(&model, i % starts.count);
        Ok((model, start))
    };
    let count = values.len() * starts.count;
    Ok(vec![Part::spread(count, threads, 0, periods, start_at)?])
}

/// The attractors along the sweep of [attractors], and the study's own value on it: what gives a picture of basins the
/// numbers that they have there.
pub(super) fn along_the_sweep(
    study: &Study,
    control: &Control,
    context: &RunContext,
) -> Result<(ContinuedAttractors, f64), CommandError> {
    let (parameter, mut values) = question(study)?;
    let own = parameter
        .as_ref()
        .and_then(|parameter| parameter.value(study));
    let (Some(parameter), Some(own)) = (parameter, own) else {
        let message = "--match takes numbers along a parameter, and [attractors] has no sweep";
        let help = "add attractors.parameter, from, to and count, or leave --match out";
        return Err(CommandError::refused(message, help));
    };
    if !values.contains(&own) {
        values.push(own);
        values.sort_by(f64::total_cmp);
    }
    refuse_if_too_many(study, values.len())?;
    let found = followed(study, Some(&parameter), &values, control, context)?;
    Ok((found, own))
}

/// The parameter that changes and its values, the lowest first.
fn question(study: &Study) -> Result<(Option<Parameter>, Vec<f64>), CommandError> {
    let Some(axis) = study.attractors.sweep() else {
        return Ok((None, vec![0.0]));
    };
    let mut values = axis.values();
    values.sort_by(f64::total_cmp);
    Ok((Some(Parameter::parse(&axis.parameter)?), values))
}

fn plan(study: &Study) -> (Starts, Search) {
    let table = &study.attractors;
    let starts = Starts {
        count: table.starts as usize,
        z: table.z,
        v: table.v,
        plate: table.plate,
    };
    let search = Search {
        transient: table.transient.into(),
        record: table.record.into(),
        ..Search::default()
    };
    (starts, search)
}

/// Initial conditions of one jumper, at all values together: what each leads to is kept until all are known, some
/// 1 kB of a cycle and up to 5 kB of chaos.
const MOST: usize = 1_000_000;

fn refuse_if_too_many(study: &Study, values: usize) -> Result<(), CommandError> {
    let (starts, jumpers) = (study.attractors.starts as usize, study.jumper.len());
    let allowed = MOST / (values * jumpers);
    if starts <= allowed {
        return Ok(());
    }
    let people = match jumpers {
        1 => String::new(),
        _ => format!(" of {jumpers} jumpers"),
    };
    let message = format!(
        "attractors.starts = {starts} at each of {values} values{people} are more than the {MOST} motions \
         that fit into memory"
    );
    let help = match allowed {
        0 => "a smaller attractors.count is needed".to_owned(),
        _ => format!("attractors.starts = {allowed} at most, or a smaller attractors.count"),
    };
    Err(CommandError::refused(message, help))
}

/// Nothing is worth keeping if no initial condition had a long-term motion.
fn refuse_if_all_lost(rows: &[Row]) -> Result<(), CommandError> {
    let motion = |row: &Row| {
        let census = row.census.as_ref();
        census.is_ok_and(|census| census.lost.count < census.lost.of)
    };
    if rows.iter().any(motion) {
        return Ok(());
    }
    let first = match rows.first().map(|row| &row.census) {
        Some(Err(error)) => return Err(error.clone().into()),
        Some(Ok(census)) => census.first_lost.clone(),
        None => None,
    };
    let reason = first.map_or(String::new(), |lost| Loss::from(lost).reason);
    let what = "no initial condition was run to its end; the first";
    Err(CommandError::computation(format!("{what}: {reason}")))
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
        take("attractors", &figures::attractors(self))
    }
}

impl Found {
    fn jumpers(&self) -> usize {
        self.study.jumper.len()
    }

    /// The value of each row.
    fn values(&self) -> Vec<f64> {
        self.all.rows.iter().map(|row| row.value).collect()
    }

    /// A value of the parameter, if there is one.
    fn value(&self, row: &Row) -> Option<f64> {
        self.parameter.as_ref().map(|_| row.value)
    }

    /// The attractors of all rows, one after the other.
    fn met(&self) -> impl Iterator<Item = (&Row, &CountedAttractor)> {
        let all = self.all.rows.iter();
        all.flat_map(|row| row.attractors().iter().map(move |one| (row, one)))
    }

    /// Chaos that ends, of all rows.
    fn transients(&self) -> impl Iterator<Item = (&Row, &Transient)> + Clone {
        self.all.rows.iter().flat_map(|row| {
            let census = row.census.iter();
            let all = census.flat_map(|census| &census.transients);
            all.map(move |one| (row, one))
        })
    }

    /// Kinds of attractor `identity` along the parameter: `1T to 4T, chaotic`.
    fn kinds(&self, identity: usize) -> String {
        let its = self.met().filter(|(_, one)| one.identity == identity);
        let kinds: Vec<MotionKind> = its.map(|(_, one)| one.entry.attractor.kind).collect();
        let periods = kinds.iter().filter_map(|kind| kind.period());
        let ends = (periods.clone().min(), periods.max());
        let cycles = match ends {
            (Some(low), Some(high)) if low < high => Some(format!("{low}T to {high}T")),
            (Some(only), _) => Some(format!("{only}T")),
            _ => None,
        };
        let others = [
            (MotionKind::QuasiPeriodic, MotionKind::QuasiPeriodic.name()),
            (MotionKind::Chaotic, MotionKind::Chaotic.name()),
            (MotionKind::NotPeriodic, "not periodic"),
        ];
        let others = others.into_iter().filter(|(kind, _)| kinds.contains(kind));
        let parts: Vec<String> = cycles
            .into_iter()
            .chain(others.map(|(_, name)| name.to_owned()))
            .collect();
        parts.join(", ")
    }
}

/// Kind of an attractor at one value: `2T`, or `chaotic`.
fn name(one: &CountedAttractor) -> String {
    let kind = one.entry.attractor.kind;
    let period = kind.period().map(|n| format!("{n}T"));
    period.unwrap_or_else(|| kind.name().to_owned())
}
