//! `saltus map`: long-term motion at each point of a plane of two parameters.

mod figures;
mod summary;

use crate::answer::{Answer, Take};
use crate::context::RunContext;
use crate::estimate::Part;
use crate::failure::CommandError;
use crate::models::Models;
use crate::pieces::{self, Divided, PieceFolder};
use crate::plane::{self, Begun, Cell, Layers, Pixels, Plane};
use saltus_config::Study;
use saltus_results::Dataset;
use std::path::Path;

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

/// The finding.
struct Found {
    study: Study,
    plane: Plane,
    layers: Layers,
    kept: PieceFolder,
}

pub(crate) fn ask(study: &Study, context: &RunContext) -> Result<Box<dyn Answer>, CommandError> {
    let job = job(study)?;
    let mut layers = Layers::new(study.jumper.len());
    let mut kept = pieces::run(&job, context, &mut |_, cell: Cell| layers.push(&cell))?;
    if let Err(failure) = layers.refuse_if_all_lost() {
        return kept.remove().and(Err(failure));
    }
    Ok(Box::new(Found {
        study: study.clone(),
        plane: job.plane,
        layers,
        kept,
    }))
}

/// Its pixels.
pub(crate) fn parts(study: &Study, threads: usize) -> Result<Vec<Part>, CommandError> {
    job(study)?.parts(threads)
}

/// The map as work that can be cut.
pub(crate) fn divided(study: &Study) -> Result<Box<dyn Divided + '_>, CommandError> {
    Ok(Box::new(job(study)?))
}

fn job(study: &Study) -> Result<Pixels<'_, impl Fn(f64, f64) -> Begun + Sync>, CommandError> {
    let plane = question(study)?;
    let parameters = [&plane.y.parameter, &plane.x.parameter];
    let models = Models::new(study, &parameters, study.options());
    let start_at = move |x, y| {
        let model = models.at(&[y, x])?;
        let start = model.start(study.start.z, study.start.v);
        Ok((model, start))
    };
    Ok(Pixels {
        command: "map",
        study,
        plane,
        start_at,
    })
}

/// The question, or an error that names what is missing in it.
fn question(study: &Study) -> Result<Plane, CommandError> {
    let table = study
        .map
        .as_ref()
        .ok_or_else(|| CommandError::refused("the study has no [map] table", EXAMPLE))?;
    plane::need_people(study, "a map")?;
    Plane::new(
        &table.x,
        &table.y,
        table.transient,
        table.record,
        table.exponent,
    )
}

impl Answer for Found {
    fn study(&self) -> &Study {
        &self.study
    }

    fn data(&self) -> Dataset {
        let title = "Attractors of a jumper on a plate over two parameters";
        plane::data(title, &self.study, &self.plane, &self.layers)
    }

    fn summary(&self) -> String {
        summary::text(self)
    }

    fn draw(&self, take: Take) -> Result<(), CommandError> {
        take("map", &figures::periods(&self.plane, &self.layers))?;
        take("layers", &plane::layers_figure(&self.plane, &self.layers))
    }

    fn pieces(&self) -> Option<&Path> {
        self.kept.path()
    }

    fn stored(&mut self) -> Result<(), CommandError> {
        self.kept.remove()
    }
}
