//! `saltus map`: long-term motion at each point of a plane of two parameters.

mod figures;
mod report;
mod summary;

use super::models::Models;
use super::plane::{self, Cell, Gather, Layers, Plane};
use crate::args::PlaneArgs;
use crate::exit::Failure;
use crate::folder::Folder;
use report::Report;
use saltus_config::Study;

/// Shown to those whose study has none.
const EXAMPLE: &str = "\
add a table that says what changes, such as

  [map.x]
  parameter = \"jumper.damping_ratio\"
  from = 0.1
  to = 0.5
  count = 64

  [map.y]
  parameter = \"base.frequency_ratio\"
  from = 0.85
  to = 1.15
  count = 64";

pub(super) fn run(args: &PlaneArgs) -> Result<(), Failure> {
    let study = super::load(&args.work.study, &[])?;
    let plane = question(&study)?;
    let control = super::control(&study, &args.work.threads);
    let models = Models::new(
        &study,
        &[&plane.y.parameter, &plane.x.parameter],
        control.options,
    );
    let start_at = |pixel| {
        let (x, y) = plane.grid.at(pixel);
        let model = models.at(&[y, x])?;
        let start = model.start(study.start.z, study.start.v);
        Ok((model, start))
    };
    let layers = Layers::new(study.jumper.len());
    let write = |layers, folder| write(&study, &plane, layers, folder);
    let report = plane::run(
        args,
        ("map", &study, &plane),
        &control,
        start_at,
        layers,
        write,
    )?;
    super::tell(&args.work.output, &report, || {
        summary::text(&plane, &report)
    })
}

/// What is asked, or what is missing in the question.
fn question(study: &Study) -> Result<Plane, Failure> {
    let table = study
        .map
        .as_ref()
        .ok_or_else(|| Failure::refused("the study has no [map] table", EXAMPLE))?;
    plane::need_people(study, "a map")?;
    Plane::new(
        &table.x,
        &table.y,
        table.transient,
        table.record,
        table.exponent,
    )
}

impl Gather for Layers {
    fn cell(&mut self, _: usize, cell: Cell) {
        self.push(&cell);
    }
}

fn write<'a>(
    study: &'a Study,
    plane: &Plane,
    layers: Layers,
    folder: Option<Folder>,
) -> Result<Report<'a>, Failure> {
    layers.refuse_if_all_lost()?;
    let report = Report::new(study, plane, &layers);
    if let Some(mut folder) = folder {
        folder.json("map.json", &report)?;
        folder.figure("map", &figures::periods(plane, &layers))?;
        folder.figure("layers", &plane::layers_figure(plane, &layers))?;
        let title = "Attractors of a jumper on a plate over two parameters";
        folder.dataset("map.nc", plane::dataset(title, study, plane, layers))?;
        folder.commit()?;
    }
    Ok(report)
}
