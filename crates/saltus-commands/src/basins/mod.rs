//! `saltus basins`: which long-term motion each initial condition leads to.

mod data;
mod figures;
mod summary;

use crate::answer::{Answer, Take};
use crate::attractors;
use crate::context::RunContext;
use crate::estimate::Part;
use crate::failure::CommandError;
use crate::pieces::{self, Divided, PieceFolder};
use crate::plane::{self, Begun, Cell, Layers, Pixels, Plane};
use saltus::study::{AttractorCatalogue, Entry};
use saltus_config::Study;
use saltus_results::Dataset;
use std::path::Path;

/// Shown to those whose study has none.
const EXAMPLE: &str = "\
add a table that says which initial conditions, such as

  [basins.x]
  parameter = \"start.z\"
  from = -2.0
  to = 6.0
  count = 64

  [basins.y]
  parameter = \"start.v\"
  from = -4.0
  to = 4.0
  count = 64";

/// The finding.
struct Basins {
    layers: Layers,
    /// The most frequent first.
    attractors: Vec<Entry>,
    /// Its number from 1; 0 for none.
    attractor: Vec<u16>,
    /// Of each attractor its number along the sweep of [attractors], from 0; empty where nobody asked for it.
    identities: Vec<Option<usize>>,
}

/// Findings so far, pixel by pixel.
struct Finding {
    layers: Layers,
    catalogue: AttractorCatalogue,
    /// In the order of discovery.
    number: Vec<Option<usize>>,
}

/// The finding for a study.
struct Found {
    study: Study,
    plane: Plane,
    basins: Basins,
    kept: PieceFolder,
}

pub(crate) fn ask(
    study: &Study,
    matched: bool,
    context: &RunContext,
) -> Result<Box<dyn Answer>, CommandError> {
    let job = job(study)?;
    let control = context.control(study);
    // Sought first, so that a sweep that cannot be made is refused at once.
    let sweep = matched.then(|| attractors::along_the_sweep(study, &control, context));
    let sweep = sweep.transpose()?;
    let mut finding = Finding {
        layers: Layers::new(study.jumper.len()),
        catalogue: AttractorCatalogue::default(),
        number: Vec::new(),
    };
    let mut kept = pieces::run(&job, context, &mut |pixel, cell| finding.take(pixel, cell))?;
    let mut basins = finding.ranked();
    if let Err(failure) = basins.layers.refuse_if_all_lost() {
        return kept.remove().and(Err(failure));
    }
    if let Some((found, own)) = &sweep {
        let identity = |entry: &Entry| found.identity(*own, &entry.attractor);
        basins.identities = basins.attractors.iter().map(identity).collect();
    }
    Ok(Box::new(Found {
        study: study.clone(),
        plane: job.plane,
        basins,
        kept,
    }))
}

/// Its pixels, and the attractors that they are matched with.
pub(crate) fn parts(
    study: &Study,
    matched: bool,
    threads: usize,
) -> Result<Vec<Part>, CommandError> {
    let mut parts = job(study)?.parts(threads)?;
    if matched {
        parts.extend(attractors::parts(study, threads)?);
    }
    Ok(parts)
}

/// The basins as work that can be cut.
pub(crate) fn divided(study: &Study) -> Result<Box<dyn Divided + '_>, CommandError> {
    Ok(Box::new(job(study)?))
}

fn job(study: &Study) -> Result<Pixels<'_, impl Fn(f64, f64) -> Begun + Sync>, CommandError> {
    let plane = question(study)?;
    let model = study.setup().model()?;
    model.check_step(&study.options())?;
    let swapped = plane.x.parameter.key() == "start.v";
    let start_at = move |x, y| {
        let (z, v) = if swapped { (y, x) } else { (x, y) };
        Ok((model.clone(), model.start(z, v)))
    };
    Ok(Pixels {
        command: "basins",
        study,
        plane,
        start_at,
    })
}

/// The question, or an error that names what is missing in it.
fn question(study: &Study) -> Result<Plane, CommandError> {
    let table = study
        .basins
        .as_ref()
        .ok_or_else(|| CommandError::refused("the study has no [basins] table", EXAMPLE))?;
    plane::need_people(study, "a map of basins")?;
    Plane::new(
        &table.x,
        &table.y,
        table.transient,
        table.record,
        table.exponent,
    )
}

impl Finding {
    fn take(&mut self, pixel: usize, cell: Cell) {
        self.layers.push(&cell);
        let motion = cell.attractor.ok();
        let number = motion.and_then(|motion| self.catalogue.file(pixel, motion));
        self.number.push(number);
    }

    fn ranked(self) -> Basins {
        let (attractors, rank) = self.catalogue.ranked();
        let place = |number: Option<usize>| {
            number.map_or(0, |number| {
                u16::try_from(rank[number] + 1).unwrap_or(u16::MAX)
            })
        };
        Basins {
            layers: self.layers,
            attractors,
            attractor: self.number.into_iter().map(place).collect(),
            identities: Vec::new(),
        }
    }
}

impl Basins {
    /// Number of an attractor along the sweep of [attractors].
    fn identity(&self, place: usize) -> Option<usize> {
        self.identities.get(place).copied().flatten()
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
        summary::text(&self.plane, &self.basins)
    }

    fn draw(&self, take: Take) -> Result<(), CommandError> {
        let Self { plane, basins, .. } = self;
        take("basins", &figures::basins(plane, basins))?;
        take("layers", &plane::layers_figure(plane, &basins.layers))
    }

    fn pieces(&self) -> Option<&Path> {
        self.kept.path()
    }

    fn stored(&mut self) -> Result<(), CommandError> {
        self.kept.remove()
    }
}
