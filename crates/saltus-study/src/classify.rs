//! The kind of a motion without a period: its tangent is followed until the largest exponent tells.
//!
//! The verdict is [`judge`]'s, asked for whenever the record has doubled; samples go on to be taken, so a cycle
//! that is reached meanwhile is found, and confirmed by its multipliers. Systems with and without tangents cannot
//! share lanes, so this is a second round, for those that need it.

use std::sync::OnceLock;

use saltus_hybrid::{End, Method, Point, Sample, Segment, Status, System, Task, integrate_stream};
use saltus_orbits::{Criteria, MotionKind, Samples, Spectrum, Verdict, judge};

use crate::attractor::{Found, Lost};
use crate::confirm::{self, Near};
use crate::ensemble::{Control, Refused, StudyError};
use crate::recording::around;
use crate::search::Search;
use crate::subject::Subject;

/// Periods in which the column turns into its direction.
const ALIGNMENT: u64 = 40;

/// Periods recorded before the first verdict; it doubles before each other one.
const FIRST: u64 = 100;

/// A motion that was found to have no period.
pub(crate) struct Doubtful<E> {
    number: usize,
    found: Found<E>,
}

impl<E> Doubtful<E> {
    pub(crate) fn new(number: usize, found: Found<E>) -> Self {
        Self { number, found }
    }
}

/// Names the motions, into `sink`.
pub(crate) fn settle<S, F, E>(
    mut doubtful: Vec<Doubtful<S::NoModel>>,
    start_at: &F,
    search: &Search,
    control: &Control,
    sink: &mut (impl FnMut(usize, Found<S::NoModel>) -> Result<(), E> + Send),
) -> Result<(), E>
where
    F: Fn(usize) -> Result<(S, Point), S::NoModel> + Sync,
    E: From<StudyError<S::NoModel>> + Send,
    S: Subject,
{
    let criteria = Criteria {
        noise: noise(control),
        ..Criteria::default()
    };
    // In an order of their own, whatever threads found them.
    doubtful.sort_by_key(|one| one.number);
    while !doubtful.is_empty() {
        let structure = OnceLock::new();
        let tasks = doubtful.into_iter().map(|one| Ascent {
            number: one.number,
            found: Some(one.found),
            start_at,
            search,
            control,
            criteria: &criteria,
            structure: &structure,
            motion: None,
            done: false,
        });
        let mut later = Vec::new();
        let take = |task: Ascent<'_, S, F>| match task.found {
            Some(found) if task.done => sink(task.number, found).map_err(Refused::Sink),
            Some(found) => {
                later.push(Doubtful::new(task.number, found));
                Ok(())
            }
            None => Ok(()),
        };
        let (options, threads) = (&control.options, control.threads);
        integrate_stream(options, tasks, threads, &control.stop, take)
            .map_err(Refused::into_error)?;
        doubtful = later;
        doubtful.sort_by_key(|one| one.number);
    }
    Ok(())
}

/// Error of the growth per period: a period has some twenty steps, each to the tolerance.
fn noise(control: &Control) -> f64 {
    match control.options.method {
        Method::Taylor { tolerance, .. } => 20.0 * tolerance,
        Method::Rk4 { .. } => 1e-6,
    }
}

/// A motion with one column of its tangent.
struct Ascent<'a, S: Subject, F> {
    number: usize,
    found: Option<Found<S::NoModel>>,
    start_at: &'a F,
    search: &'a Search,
    control: &'a Control,
    criteria: &'a Criteria,
    structure: &'a OnceLock<System>,
    motion: Option<Motion<S>>,
    done: bool,
}

struct Motion<S> {
    model: S,
    spectrum: Spectrum,
    samples: Samples,
    /// Periods recorded, and those after which to judge.
    recorded: u64,
    look: u64,
    verdict: Option<Verdict>,
    lost: bool,
}

impl<S, F> Ascent<'_, S, F>
where
    S: Subject,
    F: Fn(usize) -> Result<(S, Point), S::NoModel> + Sync,
{
    /// Everything for the run, or why there is none.
    fn prepare(&self) -> Result<(Motion<S>, Segment), Refusal> {
        let arrival = self.found.as_ref().and_then(|found| found.arrival.as_ref());
        let point = &arrival.ok_or(Refusal::Never)?.point;
        let (model, _) = (self.start_at)(self.number).map_err(|_| Refusal::Never)?;
        let spectrum = Spectrum::new(model.free_states(), 1).map_err(|_| Refusal::Never)?;
        let system = model
            .system()
            .with_tangents(1)
            .map_err(|_| Refusal::Never)?;
        let first = self.structure.get_or_init(|| system.clone());
        let system = system.sharing(first);
        if !system.same_structure(first) {
            return Err(Refusal::Later);
        }
        let mut start = system.point(&point.modes, &point.x[..model.free_states()]);
        let column = spectrum.start_columns();
        system.columns_mut(&mut start.x).copy_from_slice(&column);
        let motion = Motion {
            samples: Samples::new(model.width()),
            model,
            spectrum,
            recorded: 0,
            look: FIRST.min(self.search.exponent),
            verdict: None,
            lost: false,
        };
        let segment = Segment {
            system,
            start,
            periods: ALIGNMENT + self.search.exponent,
        };
        Ok((motion, segment))
    }
}

/// Reasons why a motion is not run on.
enum Refusal {
    /// Its system has another program than the others'.
    Later,
    /// Its tangent has no program; it stays what it was.
    Never,
}

impl<S, F> Task for Ascent<'_, S, F>
where
    S: Subject,
    F: Fn(usize) -> Result<(S, Point), S::NoModel> + Sync,
{
    fn begin(&mut self) -> Option<Segment> {
        match self.prepare() {
            Ok((motion, segment)) => {
                self.motion = Some(motion);
                Some(segment)
            }
            Err(refusal) => {
                self.done = matches!(refusal, Refusal::Never);
                None
            }
        }
    }

    fn sample(&mut self, sample: &Sample<'_>) -> bool {
        self.control.count_period();
        let Some(motion) = &mut self.motion else {
            return false;
        };
        let model = &motion.model;
        motion.samples.push(|row| model.coordinates(sample.x, row));
        motion.recorded = sample.period.saturating_sub(ALIGNMENT);
        // The column of this period comes after this call.
        if sample.period <= ALIGNMENT + 1 {
            motion.spectrum.forget();
        }
        if motion.recorded > motion.look {
            motion.judge(self.criteria);
            motion.look *= 2;
        }
        let open = motion.verdict.is_none_or(|verdict| verdict.needs_more());
        open && !motion.lost
    }

    fn tangents(&mut self, columns: &mut [f64]) {
        if let Some(motion) = &mut self.motion {
            motion.lost |= motion.spectrum.feed(columns).is_err();
        }
    }

    fn end(&mut self, end: End) -> Option<Segment> {
        let mut motion = self.motion.take()?;
        let found = self.found.as_mut()?;
        self.done = true;
        found.periods += end.periods;
        if end.status != Status::Completed {
            found.attractor = Err(Lost::Ended(end.status));
            found.arrival = None;
            return None;
        }
        if motion.verdict.is_none_or(|verdict| verdict.needs_more()) {
            motion.judge(self.criteria);
        }
        if let Some(arrival) = &mut found.arrival {
            let states = arrival.point.x.len();
            arrival.point = Point {
                modes: end.point.modes,
                x: end.point.x[..states].to_vec(),
            };
        }
        motion.name(found, self.control);
        None
    }
}

impl<S: Subject> Motion<S> {
    fn judge(&mut self, criteria: &Criteria) {
        self.verdict = Some(judge(&self.spectrum, self.samples.judge(), criteria));
    }

    /// Writes the verdict down. A cycle is one that Newton's method finds, and the motion's own.
    fn name(&self, found: &mut Found<S::NoModel>, control: &Control) {
        let (Ok(motion), Some(verdict), Some(arrival)) =
            (&mut found.attractor, self.verdict, &mut found.arrival)
        else {
            return;
        };
        if !verdict.kind.never_repeats() {
            let near = confirm::cycle(&self.model, &arrival.point, &self.samples, control);
            if let Near::Stable(orbit) = near
                && let Some(cycle) = around(&self.model, &orbit, control)
            {
                (*motion, *arrival) = cycle;
                return;
            }
        }
        motion.exponent = Some(verdict.exponent);
        motion.confidence = Some(verdict.confidence);
        motion.kind = match verdict.kind {
            kind if kind.never_repeats() => kind,
            _ => MotionKind::Undecided,
        };
    }
}
