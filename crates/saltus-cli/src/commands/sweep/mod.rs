//! `saltus sweep`: long-term motion while one parameter changes.

mod figures;
mod report;
mod summary;
mod tables;

use super::models::Models;
use crate::args::WorkArgs;
use crate::exit::Failure;
use crate::folder::Folder;
use crate::{interrupt, progress, status};
use report::Report;
use saltus::hybrid::Status;
use saltus::study::{Pass, Sweep, SweepRow};
use saltus_config::{Direction, Parameter, Study, SweepTable};

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
struct Run<'a> {
    study: &'a Study,
    parameter: Parameter,
    sweep: Sweep,
    rows: Vec<SweepRow>,
}

pub(super) fn run(args: &WorkArgs) -> Result<(), Failure> {
    let study = super::load(&args.study, &[])?;
    let (table, parameter) = question(&study)?;
    let sweep = plan(&study, table);
    let control = super::control(&study, &args.threads);
    let folder = super::folder(&args.output, &study)?;
    let models = Models::new(&study, &[&parameter], control.options);
    let work = || saltus::study::sweep(&sweep, |value| models.at(&[value]), &control);
    let (total, quiet) = (sweep.periods(), args.output.quiet);
    let rows = progress::follow(total, "periods", quiet, &control.done, work)?;
    interrupt::check()?;
    refuse_if_all_failed(&rows)?;
    let run = Run {
        study: &study,
        parameter,
        sweep,
        rows,
    };
    let report = Report::new(&run);
    if let Some(folder) = folder {
        write(folder, &run, &report)?;
    }
    super::tell(&args.output, &report, || summary::text(&run, &report))
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

fn write(mut folder: Folder, run: &Run, report: &Report) -> Result<(), Failure> {
    folder.json("sweep.json", report)?;
    tables::write(&mut folder, run, report)?;
    folder.figure("bifurcation", &figures::bifurcation(run))?;
    folder.commit().map(drop)
}

impl Run<'_> {
    fn jumpers(&self) -> usize {
        self.study.jumper.len()
    }
}
