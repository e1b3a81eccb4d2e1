//! `saltus sweep`: long-term motion while one parameter changes.

mod dataset;
mod figures;
mod report;
mod summary;
mod tables;

use crate::context::Context;
use crate::failure::Failure;
use crate::models::Models;
use crate::request::Answer;
use crate::status;
use crate::store::{self, Store};
use report::Report;
use saltus::hybrid::Status;
use saltus::model::ModelError;
use saltus::orbits::Exponent;
use saltus::study::{Control, Label, Pass, StudyError, Sweep, SweepRow};
use saltus_config::{Direction, Parameter, Study, SweepTable};
use std::io::{self, Write};

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
}

/// Forcing periods that a label takes, roughly: most motions are on a cycle when their row ends.
const LABELLING: u64 = 50;

pub(crate) fn ask(study: &Study, context: &Context) -> Result<Box<dyn Answer>, Failure> {
    let (table, parameter) = question(study)?;
    let sweep = plan(study, table);
    let control = context.control(study);
    let models = Models::new(study, &[&parameter], control.options);
    refuse_if_too_many_exponents(table, &models)?;
    let work = || measure(&sweep, table, &models, &control);
    let total = periods(&sweep, table);
    let (rows, labels, exponents) = context.follow(total, "periods, about", &control.done, work)?;
    context.check()?;
    refuse_if_all_failed(&rows)?;
    Ok(Box::new(Run {
        study: study.clone(),
        table: table.clone(),
        parameter,
        sweep,
        rows,
        labels,
        exponents,
    }))
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

/// About how many forcing periods it takes in all.
fn periods(sweep: &Sweep, table: &SweepTable) -> u64 {
    let rows = (sweep.values.len() * sweep.passes.len()) as u64;
    let followed = match table.exponents {
        0 => 0,
        _ => table.exponent_periods.into(),
    };
    sweep.periods() + rows * (LABELLING + followed)
}

type Measured = (Vec<SweepRow>, Vec<Option<Label>>, Vec<Vec<Exponent>>);

/// The rows, what each is, and its exponents.
fn measure(
    sweep: &Sweep,
    table: &SweepTable,
    models: &Models,
    control: &Control,
) -> Result<Measured, StudyError> {
    let model_at = |value| models.at(&[value]);
    let rows = saltus::study::sweep(sweep, model_at, control)?;
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
    fn summary(&self) -> String {
        summary::text(self, &Report::new(self))
    }

    fn document(&self, to: &mut dyn Write) -> io::Result<()> {
        store::stream_json(to, &Report::new(self))
    }

    fn fill(&self, store: &mut dyn Store) -> Result<(), Failure> {
        let report = Report::new(self);
        tables::write(store, self, &report)?;
        store.dataset("sweep.nc", dataset::dataset(self, &report))?;
        store.figure("bifurcation", &figures::bifurcation(self))?;
        if self.table.exponents > 0 {
            store.figure("exponents", &figures::exponents(self, &report))?;
        }
        Ok(())
    }
}

impl Run {
    fn jumpers(&self) -> usize {
        self.study.jumper.len()
    }
}
