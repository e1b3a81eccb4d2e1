//! A plane of pixels, each the attractor of one start: the part that `saltus map` and `saltus basins` share.

mod cell;
mod data;
mod figure;
mod layers;

use crate::estimate::Part;
use crate::failure::CommandError;
use crate::pieces::{Job, Reader, Sink, Writer};
use saltus::hybrid::Point;
use saltus::model::{Model, ModelError};
use saltus::study::{Control, Grid, Search};
use saltus_config::{AxisTable, Parameter, Study};
use std::sync::Arc;
use std::sync::atomic::Ordering;

use crate::words;
pub(super) use cell::{Cell, Loss};
pub(super) use data::data;
pub(crate) use figure::{layers_figure, motions};
pub(super) use layers::{Layers, Status, Tally, period};
use layers::{Span, span};

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

impl PlaneAxis {
    fn new(table: &AxisTable) -> Result<Self, CommandError> {
        Ok(Self {
            parameter: Parameter::parse(&table.parameter)?,
            table: table.clone(),
        })
    }
}

/// Part of the forcing periods allowed for an exponent for which chaos is run on, to see whether it lasts.
const WATCH: u32 = 4;

impl Plane {
    pub(super) fn new(
        x: &AxisTable,
        y: &AxisTable,
        transient: u32,
        record: u32,
        exponent: u32,
    ) -> Result<Self, CommandError> {
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
                watch: (exponent / WATCH).into(),
                ..Search::default()
            },
        })
    }

    /// The pixels as a figure has them.
    pub(super) fn figure_grid(&self) -> saltus_results::Grid {
        let axis = |axis: &PlaneAxis| words::axis(&axis.parameter);
        saltus_results::Grid::new(
            axis(&self.x),
            self.grid.x.clone(),
            axis(&self.y),
            self.grid.y.clone(),
        )
    }

    /// Its axes and its size in words.
    pub(super) fn text(&self) -> String {
        let range = |axis: &PlaneAxis| {
            let (label, table) = (axis.parameter.label(), &axis.table);
            format!("{label} from {} to {}", table.from(), table.to())
        };
        let (x, y) = (range(&self.x), range(&self.y));
        let (columns, rows) = (self.grid.x.len(), self.grid.y.len());
        format!("{x}, {y}: {columns} x {rows} pixels")
    }
}

/// Forcing periods that it takes to know the motion of a start, about: in the paper's plane a regular motion settles in half
/// its time, and a fourth of all are chaotic, which are followed to know them for chaos.
pub(super) fn settling(search: &Search) -> f64 {
    let regular = (search.transient + search.record) as f64 / 2.0;
    regular + (search.exponent + search.watch) as f64 / 4.0
}

/// Refuses a study without people: all layers are of them.
pub(super) fn need_people(study: &Study, command: &str) -> Result<(), CommandError> {
    if study.jumper.is_empty() {
        return Err(CommandError::refused(
            format!("{command} shows the motion of people, and the study has no [[jumper]]"),
            "add a [[jumper]] table",
        ));
    }
    Ok(())
}

/// Model and start of a pixel.
pub(super) type Begun = Result<(Model, Point), ModelError>;

/// The cells of a plane, as work that can be cut.
pub(super) struct Pixels<'a, F> {
    pub(super) command: &'static str,
    pub(super) study: &'a Study,
    pub(super) plane: Plane,
    /// Model and start at values (x, y).
    pub(super) start_at: F,
}

impl<F: Fn(f64, f64) -> Begun> Pixels<'_, F> {
    /// A trajectory for each pixel.
    pub(super) fn parts(&self, threads: usize) -> Result<Vec<Part>, CommandError> {
        let Plane { grid, search, .. } = &self.plane;
        let periods = settling(search);
        let start_at = |pixel| {
            let (x, y) = grid.at(pixel);
            (self.start_at)(x, y)
        };
        Ok(vec![Part::spread(
            grid.len(),
            threads,
            0,
            periods,
            start_at,
        )?])
    }
}

impl<F> Job for Pixels<'_, F>
where
    F: Fn(f64, f64) -> Begun + Sync,
{
    type Item = Cell;
    const LEAST: usize = 16;
    const ITEMS: &'static str = "pixels";

    fn command(&self) -> &'static str {
        self.command
    }

    fn study(&self) -> &Study {
        self.study
    }

    fn items(&self) -> usize {
        self.plane.grid.len()
    }

    fn effort(&self, items: usize) -> (u64, &'static str) {
        (items as u64, "pixels")
    }

    fn compute(
        &self,
        items: &[usize],
        control: &Control,
        sink: Sink<Cell>,
    ) -> Result<(), CommandError> {
        // counts periods, of which nobody knows how many there will be
        let uncounted = Control {
            done: Arc::default(),
            ..control.clone()
        };
        let Plane { grid, search, .. } = &self.plane;
        let pixels = items.iter().copied();
        saltus::study::map(
            grid,
            pixels,
            &self.start_at,
            search,
            &uncounted,
            |pixel, found| {
                control.done.fetch_add(1, Ordering::Relaxed);
                sink(pixel, found.into())
            },
        )
    }

    fn write(&self, cell: &Cell, out: &mut Writer) {
        cell.write(out);
    }

    fn read(&self, _: usize, from: &mut Reader) -> Option<Cell> {
        Cell::read(from)
    }
}
