//! What `saltus map` and `saltus basins` share: a plane of pixels, each the attractor of one start.

mod codec;
mod dataset;
mod figure;
mod layers;
mod work;

use crate::context::Context;
use crate::failure::Failure;
use saltus::hybrid::Point;
use saltus::model::{Model, ModelError};
use saltus::study::{Found, Grid, Search};
use saltus_config::{AxisTable, Parameter, Study};
use saltus_results::Axis;
use serde::Serialize;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::words::capitalized;
pub(super) use codec::{Cell, Loss};
pub(super) use dataset::dataset;
pub(super) use figure::layers_figure;
pub(super) use layers::{FirstFailure, Layers, Span, Status, Tally, span};
pub(crate) use work::Kept;
use work::Work;

/// The plane that is asked about.
pub(super) struct Plane {
    pub(super) x: PlaneAxis,
    pub(super) y: PlaneAxis,
    pub(super) grid: Grid,
    pub(super) search: Search,
}

/// One axis of it.
pub(super) struct PlaneAxis {
    pub(super) parameter: Parameter,
    pub(super) table: AxisTable,
}

/// An axis in JSON.
#[derive(Serialize)]
pub(super) struct AxisReport {
    parameter: String,
    unit: &'static str,
    label: String,
    from: f64,
    to: f64,
    count: usize,
}

impl PlaneAxis {
    fn new(table: &AxisTable) -> Result<Self, Failure> {
        Ok(Self {
            parameter: Parameter::parse(&table.parameter)?,
            table: table.clone(),
        })
    }

    /// Name of a variable: `jumper_damping_ratio`.
    pub(super) fn variable(&self) -> String {
        self.parameter.key().replace('.', "_")
    }

    pub(super) fn report(&self) -> AxisReport {
        AxisReport {
            parameter: self.parameter.key(),
            unit: self.parameter.unit(),
            label: self.parameter.label(),
            from: self.table.from(),
            to: self.table.to(),
            count: self.table.count(),
        }
    }
}

impl Plane {
    pub(super) fn new(
        x: &AxisTable,
        y: &AxisTable,
        transient: u32,
        record: u32,
        exponent: u32,
    ) -> Result<Self, Failure> {
        Ok(Self {
            grid: Grid {
                x: x.values(),
                y: y.values(),
            },
            x: PlaneAxis::new(x)?,
            y: PlaneAxis::new(y)?,
            search: Search {
                transient: transient.into(),
                record: record.into(),
                exponent: exponent.into(),
                ..Search::default()
            },
        })
    }

    /// The pixels as a figure has them.
    pub(super) fn figure_grid(&self) -> saltus_results::Grid {
        let axis = |axis: &PlaneAxis| Axis::new(capitalized(&axis.parameter.label()));
        saltus_results::Grid::new(
            axis(&self.x),
            self.grid.x.clone(),
            axis(&self.y),
            self.grid.y.clone(),
        )
    }

    /// Size in words.
    pub(super) fn size(&self) -> String {
        format!("{} x {} pixels", self.grid.x.len(), self.grid.y.len())
    }
}

/// Refuses a study without people: all layers are of them.
pub(super) fn need_people(study: &Study, command: &str) -> Result<(), Failure> {
    if study.jumper.is_empty() {
        return Err(Failure::refused(
            format!("{command} shows the motion of people, and the study has no [[jumper]]"),
            "add a [[jumper]] table",
        ));
    }
    Ok(())
}

/// What a command does with the cells of its plane.
pub(super) trait Gather: Send {
    /// Called once for each pixel, in their order.
    fn cell(&mut self, pixel: usize, cell: Cell);
}

/// Computes the plane, or what is missing of it, and hands it cell by cell to `gather`. The pieces kept until
/// then are there until somebody removes them.
pub(super) fn run<G: Gather, F>(
    (command, study, plane): (&str, &Study, &Plane),
    context: &Context,
    start_at: F,
    gather: &mut G,
) -> Result<Kept, Failure>
where
    F: Fn(usize) -> Result<(Model, Point), ModelError> + Sync,
{
    let control = context.control(study);
    let mut work = Work::open(context, command, study, plane, gather)?;
    let done = Arc::new(AtomicU64::new(work.kept() as u64));
    let missing = work.missing();
    let compute = || {
        let sink = |pixel: usize, found: Found| {
            done.fetch_add(1, Ordering::Relaxed);
            work.put(pixel, Cell::from(found))
        };
        let pixels = missing.into_iter().flatten();
        saltus::study::attractors(pixels, start_at, &plane.search, &control, sink)
    };
    let total = plane.grid.len() as u64;
    let computed = context
        .follow(total, "pixels", &done, compute)
        .and_then(|()| work.hand_on());
    let kept = work.close();
    match computed.and_then(|()| context.check()) {
        Ok(()) => Ok(kept),
        Err(Failure::Interrupted) => Err(kept.suspended()),
        Err(failure) => Err(failure),
    }
}
