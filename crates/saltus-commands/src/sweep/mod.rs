//! `saltus sweep`: long-term motion while one parameter changes.

mod data;
mod figures;
mod job;
mod summary;

use crate::answer::{Answer, Take};
use crate::context::{Existing, RunContext};
use crate::estimate::Part;
use crate::failure::CommandError;
use crate::models::Models;
use crate::pieces::{self, Divided, PieceFolder};
use crate::status;
use job::Restarts;
use saltus::hybrid::Status;
use saltus::model::ModelError;
use saltus::orbits::Exponent;
use saltus::study::{Control, Label, Pass, StudyError, Sweep, SweepRow};
use saltus_config::{Direction, Parameter, Study, SweepTable};
use saltus_results::Dataset;
use std::path::Path;

/// Shown to those whose study has none.
const EXAMPLE: &str = "\
add a table that says what changes, such as

  [sweep]
  parameter = \"jumper.damping_ratio\"
  from = 0.1
  to = 0.5
  count = 201
  direction = \"both\"";

/// A sweep with its question.
struct Found {
    study: Study,
    table: SweepTable,
    parameter: Parameter,
    sweep: Sweep,
    /// One for each value, pass by pass, in the order of the values.
    rows: Vec<Row>,
    /// The pieces of restarts.
    kept: Option<PieceFolder>,
}

/// One value of one pass.
struct Row {
    run: SweepRow,
    /// The kind of its motion; none if it was not run to its end.
    label: Option<Label>,
    /// As many as were asked for, or the one that the label took.
    exponents: Vec<Exponent>,
}

/// Forcing periods that a label takes, roughly: most motions are on a cycle when their row ends.
const LABELLING: u64 = 50;

pub(crate) fn ask(study: &Study, context: &RunContext) -> Result<Box<dyn Answer>, CommandError> {
    let (table, parameter) = question(study)?;
    let models = Models::new(study, &[&parameter], study.options());
    refuse_if_too_many_exponents(table, &models)?;
    let sweep = plan(study, table);
    let (rows, mut kept) = match table.direction {
        Direction::Restarts => restarts(&Restarts::new(study, table, &sweep, models), context)?,
        _ => {
            refuse_pieces_of_carried_states(table, context)?;
            (carried(&sweep, table, &models, context)?, None)
        }
    };
    if let Err(failure) = refuse_if_all_failed(&rows) {
        return kept
            .as_mut()
            .map_or(Ok(()), PieceFolder::remove)
            .and(Err(failure));
    }
    Ok(Box::new(Found {
        study: study.clone(),
        table: table.clone(),
        parameter,
        sweep,
        rows,
        kept,
    }))
}

/// The sweep as work that can be cut.
pub(crate) fn divided(study: &Study) -> Result<Box<dyn Divided + '_>, CommandError> {
    let (table, parameter) = question(study)?;
    if table.direction != Direction::Restarts {
        return Err(indivisible(table));
    }
    let models = Models::new(study, &[&parameter], study.options());
    refuse_if_too_many_exponents(table, &models)?;
    let sweep = plan(study, table);
    Ok(Box::new(Restarts::new(study, table, &sweep, models)))
}

/// A trajectory for each pass, or for each value of each pass; then those of the exponents.
pub(crate) fn parts(study: &Study, threads: usize) -> Result<Vec<Part>, CommandError> {
    let (table, parameter) = question(study)?;
    let models = Models::new(study, &[&parameter], study.options());
    let Sweep { values, passes, .. } = plan(study, table);
    let start_at = |i: usize| {
        let model = models.at(&[values[i % values.len()]])?;
        let start = model.start(study.start.z, study.start.v);
        Ok((model, start))
    };
    let rows = values.len() * passes.len();
    let (columns, followed) = (table.exponents as usize, followed(table) as f64);
    let each = periods(table) as f64 - followed;
    let mut parts = vec![match table.direction {
        Direction::Restarts => Part::spread(rows, threads, 0, each, start_at)?,
        _ => Part::spread(
            passes.len(),
            threads,
            0,
            each * values.len() as f64,
            start_at,
        )?,
    }];
    if columns > 0 {
        parts.push(Part::spread(rows, threads, columns, followed, start_at)?);
    }
    Ok(parts)
}

/// Each value anew, in pieces.
fn restarts(
    job: &Restarts,
    context: &RunContext,
) -> Result<(Vec<Row>, Option<PieceFolder>), CommandError> {
    let mut rows = Vec::new();
    let kept = pieces::run(job, context, &mut |_, row| rows.push(row))?;
    Ok((rows, Some(kept)))
}

/// Each value from the last state of the one before.
fn carried(
    sweep: &Sweep,
    table: &SweepTable,
    models: &Models,
    context: &RunContext,
) -> Result<Vec<Row>, CommandError> {
    let control = context.control(models.study());
    let total = (sweep.values.len() * sweep.passes.len()) as u64 * periods(table);
    let work = || measure(std::slice::from_ref(sweep), table, models, &control);
    let rows = context.follow(total, PERIODS, &control.done, work)?;
    context.check()?;
    Ok(rows)
}

/// Only restarts leave pieces, so there are none to go on with.
fn refuse_pieces_of_carried_states(
    table: &SweepTable,
    context: &RunContext,
) -> Result<(), CommandError> {
    match &context.keep {
        Some(keep) if keep.found != Existing::Refuse => Err(indivisible(table)),
        _ => Ok(()),
    }
}

/// Work that has no pieces.
fn indivisible(table: &SweepTable) -> CommandError {
    let direction = serde_json::to_value(table.direction).unwrap_or_default();
    CommandError::refused(
        format!(
            "sweep.direction = {direction} goes on from value to value, so it cannot be cut into pieces"
        ),
        "take each value anew, with sweep.direction = \"restarts\"",
    )
}

/// The question, or an error that names what is missing in it.
fn question(study: &Study) -> Result<(&SweepTable, Parameter), CommandError> {
    let table = study
        .sweep
        .as_ref()
        .ok_or_else(|| CommandError::refused("the study has no [sweep] table", EXAMPLE))?;
    if study.jumper.is_empty() {
        return Err(CommandError::refused(
            "a sweep shows the motion of people, and the study has no [[jumper]]",
            "add a [[jumper]] table",
        ));
    }
    let parameter = Parameter::parse(&table.parameter)?;
    let refused = |what: &str, help: &str| {
        let message = format!("sweep.parameter = {:?}: {what}", table.parameter);
        Err(CommandError::refused(message, help))
    };
    match table.parameter.split('.').next() {
        Some("start") => refused(
            "the initial condition is not a parameter of the system",
            "to begin from several states give them in sweep.starts, with sweep.direction = \"restarts\"",
        ),
        Some("solver") => refused(
            "the solver is not a part of the system",
            "to compare settings run `saltus simulate` with --set for each",
        ),
        _ => Ok((table, parameter)),
    }
}

fn plan(study: &Study, table: &SweepTable) -> Sweep {
    let restart = |&[z, v]: &[f64; 2]| Pass::Start((z, v));
    Sweep {
        values: table.values(),
        passes: match table.direction {
            Direction::Up => vec![Pass::Up],
            Direction::Down => vec![Pass::Down],
            Direction::Both => vec![Pass::Up, Pass::Down],
            Direction::Restarts => table.starts.iter().map(restart).collect(),
        },
        start: (study.start.z, study.start.v),
        transient: table.transient.into(),
        record: table.record.into(),
    }
}

/// Asked of the first value that has a model: all have the same states.
fn refuse_if_too_many_exponents(table: &SweepTable, models: &Models) -> Result<(), CommandError> {
    let asked = table.exponents as usize;
    let model = || {
        table
            .values()
            .into_iter()
            .find_map(|v| models.at(&[v]).ok())
    };
    let Some(model) = (asked > 0).then(model).flatten() else {
        return Ok(());
    };
    let states = model.free_states();
    if asked > states {
        let (key, zero) = ("sweep.exponents", "none but those that labels need");
        return Err(crate::words::too_many_exponents(key, asked, states, zero));
    }
    let program = model.system().with_tangents(asked);
    program
        .map(drop)
        .map_err(|error| ModelError::from(error).into())
}

/// In which progress is counted.
const PERIODS: &str = "periods, about";

/// About how many of them a value takes.
fn periods(table: &SweepTable) -> u64 {
    u64::from(table.transient) + u64::from(table.record) + LABELLING + followed(table)
}

/// Those of them that exponents take.
fn followed(table: &SweepTable) -> u64 {
    match table.exponents {
        0 => 0,
        _ => table.exponent_periods.into(),
    }
}

/// The rows, each with the kind of its motion and its exponents.
fn measure(
    sweeps: &[Sweep],
    table: &SweepTable,
    models: &Models,
    control: &Control,
) -> Result<Vec<Row>, StudyError> {
    let model_at = |value| models.at(&[value]);
    let sweeps: Vec<_> = sweeps
        .iter()
        .map(|sweep| (sweep.clone(), model_at))
        .collect();
    let rows = saltus::study::sweep_many(&sweeps, control)?.concat();
    let labels = saltus::study::labels(&rows, model_at, control)?;
    let exponents = match table.exponents as usize {
        0 => {
            let of_label = |label: &Option<Label>| label.as_ref().and_then(|label| label.exponent);
            labels
                .iter()
                .map(|l| of_label(l).into_iter().collect())
                .collect()
        }
        count => {
            let periods = table.exponent_periods.into();
            saltus::study::exponents(&rows, &labels, model_at, count, periods, control)?
        }
    };
    let rows = rows.into_iter().zip(labels).zip(exponents);
    let row = |((run, label), exponents)| Row {
        run,
        label,
        exponents,
    };
    Ok(rows.map(row).collect())
}

/// Nothing is worth keeping if no value was run to its end.
fn refuse_if_all_failed(rows: &[Row]) -> Result<(), CommandError> {
    if rows.iter().any(Row::is_completed) {
        return Ok(());
    }
    match rows.first().map(|row| &row.run.status) {
        Some(Err(error)) => Err(error.clone().into()),
        Some(Ok(end)) => Err(CommandError::computation(format!(
            "no value of the sweep was run to its end; the first: {}",
            status::text(end, None)
        ))),
        None => Err(CommandError::computation("the sweep has no values")),
    }
}

impl Row {
    fn is_completed(&self) -> bool {
        self.run.status == Ok(Status::Completed)
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
        take("bifurcation", &figures::bifurcation(self))?;
        match self.table.exponents {
            0 => Ok(()),
            _ => take("exponents", &figures::exponents(self)),
        }
    }

    fn pieces(&self) -> Option<&Path> {
        self.kept.as_ref().and_then(PieceFolder::path)
    }

    fn stored(&mut self) -> Result<(), CommandError> {
        self.kept.as_mut().map_or(Ok(()), PieceFolder::remove)
    }
}

impl Found {
    fn jumpers(&self) -> usize {
        self.study.jumper.len()
    }

    /// The rows of a pass.
    fn rows_of(&self, pass: usize) -> impl Iterator<Item = &Row> + Clone {
        self.rows.iter().filter(move |row| row.run.pass == pass)
    }

    /// Height and velocity with which a pass begins, over eta and eta omega_h.
    fn start(&self, pass: &Pass) -> [f64; 2] {
        match *pass {
            Pass::Start((z, v)) => [z, v],
            Pass::Up | Pass::Down => self.sweep.start.into(),
        }
    }
}
