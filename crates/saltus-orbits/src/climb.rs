//! Exponents of flows, by their tangent columns.

use std::sync::atomic::AtomicBool;

use saltus_hybrid::{
    BuildError, End, IntegrateError, Method, Options, Point, Sample, Segment, Status, Switch,
    SwitchKind, System, Task, integrate_groups,
};

use crate::{ExponentError, Spectrum};

/// A flow whose exponents are asked for, with its first state.
#[derive(Clone, Debug)]
pub struct Start<W> {
    /// The flow, without tangents.
    pub system: System,
    /// First state, at phase 0 of the drive.
    pub point: Point,
    /// Called with the sample of each period. A climb that begins anew, with more parts, begins with period 1 again.
    pub watch: W,
}

/// Settings for the measurement of exponents.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ascent {
    /// Number of exponents, the largest first.
    pub columns: usize,
    /// Periods in which the columns turn into their directions, before anything is recorded.
    pub transient: u64,
    /// Periods recorded.
    pub periods: u64,
}

/// Exponents of one flow, as measured.
#[derive(Clone, Debug)]
pub struct Climbed {
    /// The record, as far as the run went.
    pub spectrum: Spectrum,
    /// End of the run.
    pub end: End,
}

/// Reason why exponents of flows cannot be measured.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ClimbError {
    /// Columns that no state has.
    #[error(transparent)]
    Exponent(#[from] ExponentError),
    /// More columns than a program has room for.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// No run.
    #[error(transparent)]
    Integrate(#[from] IntegrateError),
}

/// The exponents along flows, each from its own start. Flows of the same program share the lanes.
///
/// Columns are made orthonormal at the end of each period. If they part by so much within one that rounding
/// swallows the shorter ones, the climb begins anew with as many parts in each period as that needs.
///
/// # Errors
/// [`ClimbError`] for options out of range, more columns than states, or when stopped.
pub fn climb<W: FnMut(&Sample<'_>) + Send>(
    starts: Vec<Start<W>>,
    how: &Ascent,
    options: &Options,
    threads: usize,
    stop: &AtomicBool,
) -> Result<Vec<Climbed>, ClimbError> {
    let make = |(number, start)| Climb::new(number, start, how, options);
    let mut open = starts
        .into_iter()
        .enumerate()
        .map(make)
        .collect::<Result<Vec<_>, _>>()?;
    let mut done: Vec<(usize, Climbed)> = Vec::with_capacity(open.len());
    while let Some(parts) = open.iter().map(|climb| climb.parts).min() {
        let (now, later) = open.into_iter().partition(|climb| climb.parts == parts);
        open = later;
        let options = Options {
            samples_per_period: parts,
            ..*options
        };
        let ended = integrate_groups(&options, grouped(now), threads, stop)?;
        for climb in ended.into_iter().flatten() {
            match climb.again(&options)? {
                Ok(climb) => open.push(climb),
                Err(climbed) => done.push(climbed),
            }
        }
    }
    done.sort_by_key(|(number, _)| *number);
    Ok(done.into_iter().map(|(_, climbed)| climbed).collect())
}

/// Groups flows of one program, and gives them one structure object, which makes later comparisons cheap.
fn grouped<W>(climbs: Vec<Climb<W>>) -> Vec<Vec<Climb<W>>> {
    let mut groups: Vec<Vec<Climb<W>>> = Vec::new();
    for mut climb in climbs {
        let like = |group: &&mut Vec<Climb<W>>| climb.system.same_structure(&group[0].system);
        match groups.iter_mut().find(like) {
            Some(group) => {
                climb.system = climb.system.sharing(&group[0].system);
                group.push(climb);
            }
            None => groups.push(vec![climb]),
        }
    }
    groups
}

/// Error of the columns over a period: it has some twenty steps, each to the tolerance.
fn noise(method: Method) -> f64 {
    match method {
        Method::Taylor { tolerance, .. } => 20.0 * tolerance,
        Method::Rk4 { .. } => 1e-6,
    }
}

/// One trajectory with its columns.
struct Climb<W> {
    number: usize,
    /// The system with the columns.
    system: System,
    start: Point,
    how: Ascent,
    parts: u32,
    spectrum: Spectrum,
    watch: W,
    /// Whether there was a switch in this part, and whether it ends a period to be recorded, or another.
    switched: bool,
    ends: Option<bool>,
    failed: bool,
    end: Option<End>,
}

impl<W: FnMut(&Sample<'_>) + Send> Climb<W> {
    fn new(
        number: usize,
        start: Start<W>,
        how: &Ascent,
        options: &Options,
    ) -> Result<Self, ClimbError> {
        let (states, columns) = (start.system.declared_len(), how.columns);
        let spectrum = Spectrum::of_flow(states, columns, 1, noise(options.method))?;
        Ok(Self {
            number,
            system: start.system.with_tangents(columns)?,
            start: start.point,
            how: *how,
            parts: 1,
            spectrum,
            watch: start.watch,
            switched: false,
            ends: None,
            failed: false,
            end: None,
        })
    }

    /// The climb once more with more parts, if it needs them, or its result.
    fn again(mut self, options: &Options) -> Result<Result<Self, (usize, Climbed)>, ClimbError> {
        let end = self.end.take().ok_or(IntegrateError::Interrupted)?;
        let (states, columns) = (self.system.declared_len(), self.how.columns);
        let first = self.system.state_len() - states * columns;
        let outgrown = matches!(end.status, Status::NotFinite { state, .. } if state >= first);
        let Some(parts) = self.spectrum.needs_parts(outgrown) else {
            let number = self.number;
            let spectrum = self.spectrum;
            return Ok(Err((number, Climbed { spectrum, end })));
        };
        let noise = noise(options.method) / f64::from(parts.min(20));
        self.spectrum = Spectrum::of_flow(states, columns, parts, noise)?;
        (self.parts, self.switched, self.failed) = (parts, false, false);
        Ok(Ok(self))
    }
}

impl<W: FnMut(&Sample<'_>) + Send> Task for Climb<W> {
    fn begin(&mut self) -> Option<Segment> {
        let states = self.system.declared_len();
        let mut start = self
            .system
            .point(&self.start.modes, &self.start.x[..states]);
        let columns = self.spectrum.start_columns();
        let to = self.system.columns_mut(&mut start.x);
        to.copy_from_slice(&columns);
        Some(Segment {
            system: self.system.clone(),
            start,
            periods: self.how.transient + self.how.periods,
        })
    }

    fn sample(&mut self, sample: &Sample<'_>) -> bool {
        let last = sample.part == self.parts;
        self.ends = last.then_some(sample.period > self.how.transient);
        if last {
            (self.watch)(sample);
        }
        !self.failed
    }

    fn tangents(&mut self, columns: &mut [f64]) {
        self.failed |= self.spectrum.part(columns, self.switched).is_err();
        if let Some(record) = self.ends {
            self.spectrum.close(record);
        }
        self.failed |= self.spectrum.needs_parts(false).is_some();
        self.switched = false;
    }

    fn switch(&mut self, switch: &Switch<'_>) {
        self.switched |= matches!(switch.kind, SwitchKind::Mode { .. });
    }

    fn end(&mut self, end: End) -> Option<Segment> {
        self.end = Some(end);
        None
    }
}
