//! A start on its way to its attractor: run until it has settled, recorded, and named by its returns.

use std::sync::OnceLock;

use saltus_hybrid::{End, Point, Sample, Segment, Status, Step, System, Task, integrate_stream};
use saltus_orbits::{Closeness, MotionKind, OnCycle, Recurrence, Samples};

use crate::attractor::{Arrival, Attractor, Found, Lost};
use crate::confirm::{self, Near};
use crate::ensemble::{Control, Refused, StudyError};
use crate::recording::{Recording, around};
use crate::search::Search;
use crate::subject::Subject;

/// Runs all starts, those whose systems share a structure together: the others cannot share lanes with them.
pub(crate) fn approach<S, F, E>(
    starts: impl IntoIterator<Item = usize, IntoIter: Send>,
    start_at: &F,
    search: &Search,
    control: &Control,
    mut sink: impl FnMut(usize, Found<S::NoModel>) -> Result<(), E> + Send,
) -> Result<(), E>
where
    F: Fn(usize) -> Result<(S, Point), S::NoModel> + Sync,
    E: From<StudyError<S::NoModel>> + Send,
    S: Subject,
{
    let mut later = round(starts.into_iter(), start_at, search, control, &mut sink)?;
    while !later.is_empty() {
        later.sort_unstable();
        later = round(later.into_iter(), start_at, search, control, &mut sink)?;
    }
    Ok(())
}

/// Runs all starts whose systems share the structure of the first; gives back the others.
fn round<S, F, E>(
    starts: impl Iterator<Item = usize> + Send,
    start_at: &F,
    search: &Search,
    control: &Control,
    sink: &mut (impl FnMut(usize, Found<S::NoModel>) -> Result<(), E> + Send),
) -> Result<Vec<usize>, E>
where
    F: Fn(usize) -> Result<(S, Point), S::NoModel> + Sync,
    E: From<StudyError<S::NoModel>> + Send,
    S: Subject,
{
    let structure = OnceLock::new();
    let mut later = Vec::new();
    let tasks = starts.map(|number| Pursuit {
        number,
        start_at,
        search,
        control,
        structure: &structure,
        found: None,
        motion: None,
        extended: false,
    });
    let take = |task: Pursuit<'_, S, F>| match task.found {
        Some(found) => sink(task.number, found).map_err(Refused::Sink),
        None => {
            later.push(task.number);
            Ok(())
        }
    };
    integrate_stream(
        &control.options,
        tasks,
        control.threads,
        &control.stop,
        take,
    )
    .map_err(Refused::into_error)?;
    Ok(later)
}

/// One start on its way to its attractor.
struct Pursuit<'a, S: Subject, F> {
    number: usize,
    start_at: &'a F,
    search: &'a Search,
    control: &'a Control,
    structure: &'a OnceLock<System>,
    found: Option<Found<S::NoModel>>,
    /// Made when its turn comes, gone when it has ended.
    motion: Option<Motion<S>>,
    /// Whether it has had more time because it was on its way.
    extended: bool,
}

/// Times the transient that a motion on its way gets, and forcing periods at most.
const PATIENCE: u64 = 4;
const LONGEST: u64 = 4000;

/// Record of a motion while it runs.
struct Motion<S: Subject> {
    model: S,
    samples: Samples,
    /// Period of the cycle on which the motion settled before the end of the transient, and what was left.
    settled: Option<OnCycle>,
    recording: Option<Recording<S>>,
    periods: u64,
}

/// Samples between two looks whether the motion has settled.
const LOOK: usize = 8;

impl<S, F> Task for Pursuit<'_, S, F>
where
    S: Subject,
    F: Fn(usize) -> Result<(S, Point), S::NoModel> + Sync,
{
    fn begin(&mut self) -> Option<Segment> {
        let (mut model, start) = match (self.start_at)(self.number) {
            Ok(ready) => ready,
            Err(error) => {
                self.found = Some(Found {
                    attractor: Err(Lost::NoModel(error)),
                    periods: 0,
                    arrival: None,
                });
                return None;
            }
        };
        let first = self.structure.get_or_init(|| model.system().clone());
        if !model.share(first) {
            return None;
        }
        let system = model.system().clone();
        self.motion = Some(Motion {
            samples: Samples::new(model.width()),
            model,
            settled: None,
            recording: None,
            periods: 0,
        });
        Some(Segment {
            system,
            start,
            periods: self.search.transient,
        })
    }

    fn sample(&mut self, sample: &Sample<'_>) -> bool {
        self.control.count_period();
        let Some(motion) = &mut self.motion else {
            return false;
        };
        let model = &motion.model;
        motion.samples.push(|row| model.coordinates(sample.x, row));
        if let Some(recording) = &mut motion.recording {
            recording.end_period(model, sample);
            return true;
        }
        if self.search.early_stop && motion.samples.count().is_multiple_of(LOOK) {
            motion.settled = motion.samples.settled(Closeness::TIGHT);
        }
        motion.settled.is_none()
    }

    fn wants_steps(&self) -> bool {
        let recording = |motion: &Motion<S>| motion.recording.is_some();
        self.motion.as_ref().is_some_and(recording)
    }

    fn step(&mut self, step: &Step<'_>) {
        let recording = self.motion.as_mut().and_then(|m| m.recording.as_mut());
        if let Some(recording) = recording {
            recording.step(step);
        }
    }

    fn end(&mut self, end: End) -> Option<Segment> {
        let motion = self.motion.as_mut()?;
        motion.periods += end.periods;
        if end.status != Status::Completed {
            self.found = Some(Found {
                attractor: Err(Lost::Ended(end.status)),
                periods: motion.periods,
                arrival: None,
            });
        } else if let Some(recording) = motion.recording.take() {
            match motion.conclude(&recording, &end.point, self.search, self.control) {
                Conclusion::GoOn(start) if !self.extended => {
                    self.extended = true;
                    return Some(Segment {
                        system: motion.model.system().clone(),
                        start,
                        periods: (PATIENCE * self.search.transient).min(LONGEST),
                    });
                }
                Conclusion::GoOn(point) => {
                    let (attractor, section) =
                        motion.as_it_looks(&recording, MotionKind::Undecided);
                    self.found = Some(motion.found(attractor, Arrival { point, section }));
                }
                Conclusion::Is(seen) => {
                    let (attractor, arrival) = *seen;
                    self.found = Some(motion.found(attractor, arrival));
                }
            }
        } else {
            motion.recording = Some(Recording::new(&motion.model));
            let whole = self.search.record;
            let periods = motion.settled.map_or(whole, |found| found.period.into());
            return Some(Segment {
                system: motion.model.system().clone(),
                start: end.point,
                periods,
            });
        }
        self.motion = None;
        None
    }
}

/// Conclusion from a motion's record: what it is, or that it must go on.
enum Conclusion {
    Is(Box<(Attractor, Arrival)>),
    /// It is on its way, and should be run on from here.
    GoOn(Point),
}

impl<S: Subject> Motion<S> {
    fn found(&self, attractor: Attractor, arrival: Arrival) -> Found<S::NoModel> {
        Found {
            attractor: Ok(attractor),
            periods: self.periods,
            arrival: Some(arrival),
        }
    }

    /// Conclusion from the whole motion, which has come to `end`.
    fn conclude(
        &mut self,
        recording: &Recording<S>,
        end: &Point,
        search: &Search,
        control: &Control,
    ) -> Conclusion {
        let on = self
            .settled
            .take()
            .or_else(|| self.samples.settled(Closeness::FAIR));
        let looks = |motion: &Self, kind: MotionKind, rest: f64| {
            let (attractor, section) = motion.as_it_looks(recording, kind);
            let arrival = Arrival {
                point: end.clone(),
                section,
            };
            Conclusion::Is(Box::new((Attractor { rest, ..attractor }, arrival)))
        };
        if let Some(on) = on.filter(|on| on.is_sure() && !search.confirm) {
            return looks(self, MotionKind::Periodic(on.period), on.rest);
        }
        match confirm::cycle(&self.model, end, &self.samples, control) {
            Near::Stable(orbit) => match around(&self.model, &orbit, control) {
                Some(cycle) => Conclusion::Is(Box::new(cycle)),
                None => Conclusion::GoOn(end.clone()),
            },
            Near::Unstable(orbit) => {
                self.samples = Samples::new(self.model.width());
                Conclusion::GoOn(confirm::beside(&self.model, &orbit))
            }
            Near::Nothing if on.is_some() || self.samples.judge() == Recurrence::Drifting => {
                Conclusion::GoOn(end.clone())
            }
            Near::Nothing => looks(self, MotionKind::NotPeriodic, 0.0),
        }
    }

    /// A motion of this kind, as its last samples and the recording show it, and its section: the samples of the cycle, or
    /// of the last recorded periods.
    fn as_it_looks(
        &self,
        recording: &Recording<S>,
        kind: MotionKind,
    ) -> (Attractor, Vec<Vec<f64>>) {
        let count = match kind {
            MotionKind::Periodic(n) => n as usize,
            _ => recording
                .periods()
                .min(Samples::ROWS)
                .min(self.samples.count()),
        };
        // the channels come first in a sample
        let of = |channel: usize| {
            let rows = (0..count).rev().map(|back| self.samples.back(back));
            rows.map(|row| row[channel]).collect()
        };
        let section: Vec<Vec<f64>> = (0..self.model.channels()).map(of).collect();
        let attractor = recording.motion(&self.model, kind, &section);
        (attractor, section)
    }
}
