//! `saltus sweep`: long-term motion while one parameter changes.

mod dataset;
mod figures;
mod job;
mod report;
mod summary;
mod tables;

use crate::answer::{Answer, Take, stream_json};
use crate::context::{Context, Found};
use crate::failure::Failure;
use crate::models::Models;
use crate::pieces::{self, Divided, Kept};
use crate::status;
use crate::store::Store;
use job::Restarts;
use report::Report;
use saltus::hybrid::Status;
use saltus::model::ModelError;
use saltus::orbits::Exponent;
use saltus::study::{Control, Label, Pass, StudyError, Sweep, SweepRow};
use saltus_config::{Direction, Parameter, Study, SweepTable};
use saltus_results::Dataset;
use std::io::{self, Write};
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
struct Run {
    study: Study,
    table: SweepTable,
    parameter: Parameter,
    sweep: Sweep,
    rows: Vec<SweepRow>,
    /// What each row is; none if it was not run to its end.
    labels: Vec<Option<Label>>,
    /// Of each row as many as were asked for, or that one which its label took.
    exponents: Vec<Vec<Exponent>>,
    /// The pieces of restarts.
    kept: Option<Kept>,
}

/// Forcing periods that a label takes, roughly: most motions are on a cycle when their row ends.
const LABELLING: u64 = 50;

pub(crate) fn ask(study: &Study, context: &Context) -> Result<Box<dyn Answer>, Failure> {
    let (table, parameter) = question(study)?;
    let models = Models::new(study, &[&parameter], study.options());
    refuse_if_too_many_exponents(table, &models)?;
    let sweep = plan(study, table);
    let ((rows, labels, exponents), mut kept) = match table.direction {
        Direction::Restarts => restarts(&Restarts::new(study, table, &sweep, models), context)?,
        _ => {
            refuse_pieces_of_carried_states(table, context)?;
            (carried(&sweep, table, &models, context)?, None)
        }
    };
    if let Err(failure) = refuse_if_all_failed(&rows) {
        return kept.as_mut().map_or(Ok(()), Kept::remove).and(Err(failure));
    }
    Ok(Box::new(Run {
        study: study.clone(),
        table: table.clone(),
        parameter,
        sweep,
        rows,
        labels,
        exponents,
        kept,
    }))
}

/// The sweep as work that can be cut.
pub(crate) fn divided(study: &Study) -> Result<Box<dyn Divided + '_>, Failure> {
    let (table, parameter) = question(study)?;
    if table.direction != Direction::Restarts {
        return Err(indivisible(table));
    }
    let models = Models::new(study, &[&parameter], study.options());
    refuse_if_too_many_exponents(table, &models)?;
    let sweep = plan(study, table);
    Ok(Box::new(Restarts::new(study, table, &sweep, models)))
}

/// Each value anew, in pieces.
fn restarts(job: &Restarts, context: &Context) -> Result<(Measured, Option<Kept>), Failure> {
    let mut all = Measured::default();
    let kept = pieces::run(job, context, &mut |_, (row, label, exponents)| {
        all.0.push(row);
        all.1.push(label);
        all.2.push(exponents);
    })?;
    Ok((all, Some(kept)))
}

/// Each value from the last state of the one before.
fn carried(
    sweep: &Sweep,
    table: &SweepTable,
    models: &Models,
    context: &Context,
) -> Result<Measured, Failure> {
    let control = context.control(models.study());
    let total = (sweep.values.len() * sweep.passes.len()) as u64 * periods(table);
    let work = || measure(std::slice::from_ref(sweep), table, models, &control);
    let measured = context.follow(total, PERIODS, &control.done, work)?;
    context.check()?;
    Ok(measured)
}

/// Only restarts leave pieces, so there are none to go on with.
fn refuse_pieces_of_carried_states(table: &SweepTable, context: &Context) -> Result<(), Failure> {
    match &context.keep {
        Some(keep) if keep.found != Found::InTheWay => Err(indivisible(table)),
        _ => Ok(()),
    }
}

/// Work that has no pieces.
fn indivisible(table: &SweepTable) -> Failure {
    let direction = serde_json::to_value(table.direction).unwrap_or_default();
    Failure::refused(
        format!(
            "sweep.direction = {direction} goes on from value to value, so it cannot be cut into pieces"
        ),
        "take each value anew, with sweep.direction = \"restarts\"",
    )
}

/// What is asked, or what is missing in the question.
fn question(study: &Study) -> Result<(&SweepTable, Parameter), Failure> {
    let table = study
        .sweep
        .as_ref()
        .ok_or_else(|| Failure::refused("the study has no [sweep] table", EXAMPLE))?;
    if study.jumper.is_empty() {
        return Err(Failure::refused(
            "a sweep shows the motion of people, and the study has no [[jumper]]",
            "add a [[jumper]] table",
        ));
    }
    let parameter = Parameter::parse(&table.parameter)?;
    let refused = |what: &str, help: &str| {
        let message = format!("sweep.parameter = {:?}: {what}", table.parameter);
        Err(Failure::refused(message, help))
    };
    match table.parameter.split('.').next() {
        Some("start") => refused(
            "the first state is not a parameter of the system",
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
    let restart = |&[z, v]: &[f64; 2]| Pass::Start { z, v };
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
fn refuse_if_too_many_exponents(table: &SweepTable, models: &Models) -> Result<(), Failure> {
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
    let followed = match table.exponents {
        0 => 0,
        _ => table.exponent_periods.into(),
    };
    u64::from(table.transient) + u64::from(table.record) + LABELLING + followed
}

type Measured = (Vec<SweepRow>, Vec<Option<Label>>, Vec<Vec<Exponent>>);

/// The rows, what each is, and its exponents.
fn measure(
    sweeps: &[Sweep],
    table: &SweepTable,
    models: &Models,
    control: &Control,
) -> Result<Measured, StudyError> {
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
    Ok((rows, labels, exponents))
}

/// Nothing is worth keeping if no value was run to its end.
fn refuse_if_all_failed(rows: &[SweepRow]) -> Result<(), Failure> {
    if rows.iter().any(completed) {
        return Ok(());
    }
    match rows.first().map(|row| &row.status) {
        Some(Err(error)) => Err(error.clone().into()),
        Some(Ok(end)) => Err(Failure::computation(format!(
            "no value of the sweep was run to its end; the first: {}",
            status::text(end, None)
        ))),
        None => Err(Failure::computation("the sweep has no values")),
    }
}

fn completed(row: &SweepRow) -> bool {
    row.status == Ok(Status::Completed)
}

impl Answer for Run {
    fn study(&self) -> &Study {
        &self.study
    }

    fn data(&self) -> Dataset {
        dataset::dataset(self, &Report::new(self))
    }

    fn draw(&self, _: Take) -> Result<(), Failure> {
        Ok(())
    }

    fn summary(&self) -> String {
        summary::text(self, &Report::new(self))
    }

    fn document(&self, _: &Dataset, to: &mut dyn Write) -> io::Result<()> {
        stream_json(to, &Report::new(self))
    }

    fn fill(&self, store: &mut dyn Store, name: &str, data: Dataset) -> Result<(), Failure> {
        let report = Report::new(self);
        tables::write(store, self, &report)?;
        store.put_dataset(name, data)?;
        store.figure("bifurcation", &figures::bifurcation(self))?;
        if self.table.exponents > 0 {
            store.figure("exponents", &figures::exponents(self, &report))?;
        }
        Ok(())
    }

    fn pieces(&self) -> Option<&Path> {
        self.kept.as_ref().and_then(Kept::path)
    }

    fn stored(&mut self) -> Result<(), Failure> {
        self.kept.as_mut().map_or(Ok(()), Kept::remove)
    }
}

impl Run {
    fn jumpers(&self) -> usize {
        self.study.jumper.len()
    }
}
