//! A forced flow seen once per period: the stroboscopic map.
//!
//! A place has the declared states of the system; the drive is at phase 0 there.

use std::sync::atomic::AtomicBool;

use saltus_hybrid::{
    End, IntegrateError, Minimum, Options, Sample, Segment, Status, Step, Switch, SwitchKind,
    System, Task, integrate_all,
};

use crate::map::{Crossing, Image, MapPoint, MapRequest, NoImage, ParametricMap, Touch};
use crate::matrix::Matrix;

/// Trajectories that a thread runs at the cost of one.
const LANES: usize = 8;

/// The stroboscopic maps of a family of forced systems, all with the same states.
///
/// The derivative is the tangent flow over one period, its columns spread over trajectories that run side
/// by side; all of them follow the same orbit to the bit.
pub struct Stroboscopic<'a, F> {
    system_at: F,
    dimension: usize,
    options: Options,
    threads: usize,
    stop: &'a AtomicBool,
}

impl<'a, F> Stroboscopic<'a, F>
where
    F: Fn(&[f64]) -> Result<System, String> + Sync,
{
    /// The maps of the systems that `system_at` makes of parameter values, with `dimension` declared states each.
    /// `threads` 0 is as many as the machine has; raise `stop` to end a call with [`NoImage::Interrupted`].
    pub fn new(
        system_at: F,
        dimension: usize,
        options: Options,
        threads: usize,
        stop: &'a AtomicBool,
    ) -> Self {
        // Asked once: the answer takes as long as a short orbit.
        let available = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        Self {
            system_at,
            dimension,
            options,
            threads: if threads == 0 { available() } else { threads },
            stop,
        }
    }

    /// The different systems of the shots, and which of them each shot is of.
    fn systems(&self, shots: &[MapRequest<'_>]) -> (Vec<Made>, Vec<usize>) {
        let mut systems: Vec<Made> = Vec::new();
        let mut first: Vec<usize> = Vec::new();
        let mut of = Vec::with_capacity(shots.len());
        for (i, shot) in shots.iter().enumerate() {
            let same = |&earlier: &usize| shots[earlier].parameters == shot.parameters;
            of.push(first.iter().position(same).unwrap_or_else(|| {
                let system = (self.system_at)(shot.parameters).map_err(NoImage::NoMap);
                systems.push(system.map(|system| sharing(system, &systems)));
                first.push(i);
                systems.len() - 1
            }));
        }
        (systems, of)
    }

    /// Columns in a trajectory, for `shots` whole derivatives: the work of a register of trajectories
    /// grows as 1 + 2 k with their columns, the number of such registers falls as 1/k.
    fn columns(&self, shots: usize) -> usize {
        let cost = |k: &usize| {
            let trajectories = shots * self.dimension.div_ceil(*k);
            trajectories.div_ceil(LANES * self.threads) * (1 + 2 * k)
        };
        (1..=self.dimension).min_by_key(cost).unwrap_or(1)
    }
}

impl<F> ParametricMap for Stroboscopic<'_, F>
where
    F: Fn(&[f64]) -> Result<System, String> + Sync,
{
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn images(&self, shots: &[MapRequest<'_>]) -> Vec<Result<Image, NoImage>> {
        let (systems, of) = self.systems(shots);
        let mut out = vec![Err(NoImage::Interrupted); shots.len()];
        // Systems with and without tangents have different programs and cannot share a run.
        for derivative in [false, true] {
            let asked = || (0..shots.len()).filter(|&i| shots[i].derivative == derivative);
            let width = match asked().count() {
                0 => continue,
                count if derivative => self.columns(count),
                _ => 0,
            };
            let systems = widened(&systems, width);
            let mut flights = Vec::new();
            for index in asked() {
                match self.flights(index, &shots[index], &systems[of[index]], width) {
                    Ok(more) => flights.extend(more),
                    Err(lost) => out[index] = Err(lost),
                }
            }
            match integrate_all(&self.options, flights, self.threads, self.stop) {
                Ok(ended) => ended.into_iter().for_each(|flight| flight.land(&mut out)),
                Err(IntegrateError::Interrupted) => {}
                Err(error) => return vec![Err(NoImage::NoMap(error.to_string())); shots.len()],
            }
        }
        out
    }
}

impl<F> Stroboscopic<'_, F> {
    /// The trajectories of a shot: `width` columns of the derivative in each, or just one.
    fn flights(
        &self,
        index: usize,
        shot: &MapRequest<'_>,
        system: &Made,
        width: usize,
    ) -> Result<Vec<Flight>, NoImage> {
        let n = self.dimension;
        let system = system.as_ref().map_err(NoImage::clone)?;
        let (states, units) = (shot.start.x.len(), shot.start.modes.len());
        if states != n || units != system.unit_count() {
            let what = format!(
                "a place has {states} states and {units} modes, the map {n} and {}",
                system.unit_count()
            );
            return Err(NoImage::NoMap(what));
        }
        let firsts = (0..n).step_by(width.max(1));
        let flight = |first: usize| {
            let mut start = system.point(&shot.start.modes, &shot.start.x);
            let columns = system.columns_mut(&mut start.x);
            (0..width.min(n - first)).for_each(|i| columns[i * n + first + i] = 1.0);
            Flight {
                shot: index,
                first,
                dimension: n,
                period: system.period(),
                segment: Some(Segment {
                    system: system.clone(),
                    start,
                    periods: 1,
                }),
                columns: Vec::new(),
                crossings: Vec::new(),
                touches: Vec::new(),
                landed: Err(NoImage::Interrupted),
            }
        };
        let count = if width > 0 { n.div_ceil(width) } else { 1 };
        Ok(firsts.take(count).map(flight).collect())
    }
}

/// A system, or the reason why there is none.
type Made = Result<System, NoImage>;

/// The system with the program of the first one that is there: comparing is cheap then.
fn sharing(system: System, others: &[Made]) -> System {
    match others.iter().flatten().next() {
        Some(first) => system.sharing(first),
        None => system,
    }
}

/// The systems with `width` columns of their tangents.
fn widened(systems: &[Made], width: usize) -> Vec<Made> {
    if width == 0 {
        return systems.to_vec();
    }
    let mut wide: Vec<Made> = Vec::with_capacity(systems.len());
    for system in systems {
        let made = system.as_ref().map_err(NoImage::clone).and_then(|system| {
            let tangents = system.with_tangents(width);
            tangents.map_err(|error| NoImage::NoMap(error.to_string()))
        });
        wide.push(made.map(|system| sharing(system, &wide)));
    }
    wide
}

/// One trajectory: an image and some columns of its derivative.
struct Flight {
    shot: usize,
    /// The first of its columns; 0 also if it has none.
    first: usize,
    dimension: usize,
    period: f64,
    segment: Option<Segment>,
    columns: Vec<f64>,
    crossings: Vec<Crossing>,
    touches: Vec<Touch>,
    landed: Result<MapPoint, NoImage>,
}

impl Flight {
    /// Hands its part of the image over.
    fn land(self, out: &mut [Result<Image, NoImage>]) {
        let (n, out) = (self.dimension, &mut out[self.shot]);
        if self.first == 0 {
            let tangents = !self.columns.is_empty();
            *out = self.landed.map(|place| Image {
                place,
                derivative: tangents.then(|| Matrix::zeros(n, n)),
                crossings: self.crossings,
                touches: self.touches,
            });
        }
        let derivative = out
            .as_mut()
            .ok()
            .and_then(|image| image.derivative.as_mut());
        if let Some(derivative) = derivative {
            for (column, values) in (self.first..n).zip(self.columns.chunks_exact(n)) {
                for (row, &value) in values.iter().enumerate() {
                    derivative[(row, column)] = value;
                }
            }
        }
    }

    /// Whether it reports switches and touches on the way: one trajectory for each derivative does.
    fn reports(&self) -> bool {
        self.first == 0 && !self.columns.is_empty()
    }
}

impl Task for Flight {
    fn begin(&mut self) -> Option<Segment> {
        let segment = self.segment.take()?;
        self.columns = segment.system.columns(&segment.start.x).to_vec();
        Some(segment)
    }

    fn sample(&mut self, sample: &Sample<'_>) -> bool {
        self.landed = Ok(MapPoint {
            modes: sample.modes.to_vec(),
            x: sample.x[..self.dimension].to_vec(),
        });
        true
    }

    fn tangents(&mut self, columns: &mut [f64]) {
        self.columns.copy_from_slice(columns);
    }

    fn switch(&mut self, switch: &Switch<'_>) {
        if let SwitchKind::Mode { from, to } = switch.kind
            && self.reports()
        {
            self.crossings.push(Crossing {
                unit: switch.unit,
                from,
                to,
                at: switch.time / self.period,
            });
        }
    }

    fn wants_steps(&self) -> bool {
        self.reports()
    }

    fn step(&mut self, step: &Step<'_>) {
        let touch = |minimum: Minimum| Touch {
            unit: minimum.unit,
            mode: step.modes[minimum.unit],
            guard: minimum.transition,
            value: minimum.value,
            at: (step.time + minimum.since) / self.period,
        };
        self.touches.extend(step.minima().into_iter().map(touch));
    }

    fn end(&mut self, end: End) -> Option<Segment> {
        if end.status != Status::Completed {
            self.landed = Err(NoImage::Ended(end.status.to_string()));
        }
        None
    }
}
