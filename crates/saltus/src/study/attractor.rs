//! Which attractor does a start lead to? One answer per start, for maps of parameters and of starts.
//!
//! A start is run until it is surely on a cycle (see [`Samples`]), or for the whole transient; then
//! the cycle once, or the recording, with dense output for peaks. Where samples leave a doubt, Newton's method says
//! which stable cycle it is, if any (`confirm`). A motion that is still on its way then is
//! given four times as long. What still has no period is run on with its tangent, until its largest
//! exponent tells what it is (`doubt`), and chaos once more, to see whether it lasts. Starts are independent of each
//! other to the bit: so any part of a map can be computed at any time, by any number of threads.

use std::sync::OnceLock;

use saltus_hybrid::integrate_stream;
use saltus_hybrid::{End, IntegrateError, Leg, Point, Sample, Status, Step, System, Task};
use saltus_orbits::{Closeness, Exponent, OnCycle, Recurrence, Samples};

use super::confirm::{self, Near};
use super::doubt::{self, Doubtful};
use super::recording::{Recording, around};
use super::{Control, StudyError};
use crate::model::{Model, ModelError};

/// How long to look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// Forcing periods, at most, before anything is recorded.
    pub transient: u64,
    /// Periods recorded of a motion that has not surely settled before.
    pub record: u64,
    /// Whether the transient ends as soon as the motion has surely settled. The answer is the same within
    /// 1e-6 eta; without it each start takes all its periods.
    pub early_stop: bool,
    /// Forcing periods, at most, over which the largest exponent of a motion without a period is followed, to
    /// say what it is. 0 leaves it at [`Kind::NotPeriodic`].
    pub exponent: u64,
    /// Forcing periods for which a motion that was found to be chaotic is run on, to see whether it stays so. A
    /// transient that outlives all of these is called chaotic; [`Found::periods`] says over how many it was seen.
    pub watch: u64,
    /// Whether Newton's method confirms every cycle, and not only those of which the samples leave a doubt: for
    /// motions that were carried to where they start, since those may sit on an unstable one.
    pub confirm: bool,
}

impl Default for Search {
    /// 400 periods: the paper's plate modes lose a tenth of their amplitude per period. 64 recorded show
    /// each period up to 32 twice. 2000 tell an exponent of 0.02 from zero. 500 more are about what it takes to find
    /// chaos, and cost less, since they need neither its tangent nor what it does to floor and people.
    fn default() -> Self {
        Self {
            transient: 400,
            record: 64,
            early_stop: true,
            exponent: 2000,
            watch: 500,
            confirm: false,
        }
    }
}

/// What a start leads to.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The long-term motion, or why there is none.
    pub attractor: Result<Attractor, Lost>,
    /// Forcing periods run in all.
    pub periods: u64,
    /// Where the start has arrived; `None` if there is no long-term motion.
    pub arrival: Option<Arrival>,
}

impl Found {
    /// The last state of a motion that is undecided, to go on from.
    pub(super) fn undecided_at(&self) -> Option<&Point> {
        let motion = self.attractor.as_ref().ok()?;
        let arrival = self.arrival.as_ref()?;
        (motion.kind == Kind::Undecided).then_some(&arrival.point)
    }
}

impl Found {
    /// Whether there is a motion, and no period of it is known.
    fn has_no_period(&self) -> bool {
        let kind = self.attractor.as_ref().map(|motion| motion.kind);
        matches!(kind, Ok(Kind::NotPeriodic | Kind::Undecided))
    }

    fn is_chaotic(&self) -> bool {
        let kind = self.attractor.as_ref().map(|motion| motion.kind);
        kind == Ok(Kind::Chaotic)
    }

    /// This chaotic motion, run on to what `later` says: still without a period, or not.
    fn followed_by(&self, later: Self) -> Self {
        let periods = self.periods + later.periods;
        let chaotic = matches!(&later.attractor, Ok(motion) if motion.kind == Kind::NotPeriodic);
        Self {
            periods,
            attractor: if chaotic {
                self.attractor.clone()
            } else {
                later.attractor
            },
            arrival: later.arrival,
        }
    }
}

/// Where a start has arrived: what it takes to draw the motion and to go on from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrival {
    /// The last state, at phase 0.
    pub point: Point,
    /// The last samples, [z/eta, z'/(eta omega_h)]: `section[body][sample]`. Of a cycle, each of its points
    /// once; otherwise what was recorded, 256 at most.
    pub section: Vec<Vec<[f64; 2]>>,
}

/// Why there is no long-term motion.
#[derive(Clone, Debug, PartialEq)]
pub enum Lost {
    /// There is no model at this place.
    NoModel(ModelError),
    /// The run ended early; never [`Status::Completed`].
    Ended(Status),
}

/// What kind of motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// A cycle of so many forcing periods, at most 32.
    Periodic(u32),
    /// On a torus: its largest exponent is zero far more closely than chance allows.
    QuasiPeriodic,
    /// Its largest exponent is positive.
    Chaotic,
    /// No cycle of at most 32 periods, and nobody asked for its exponent.
    NotPeriodic,
    /// Still on its way when the time was up, on a longer cycle, or its exponent too small to tell its sign.
    Undecided,
}

impl Kind {
    /// As in results; of a cycle without its period.
    pub fn name(self) -> &'static str {
        match self {
            Self::Periodic(_) => "periodic",
            Self::QuasiPeriodic => "quasi-periodic",
            Self::Chaotic => "chaotic",
            Self::NotPeriodic => "not-periodic",
            Self::Undecided => "undecided",
        }
    }

    /// The period of a cycle.
    pub fn period(self) -> Option<u32> {
        match self {
            Self::Periodic(n) => Some(n),
            _ => None,
        }
    }

    /// Whether it is known not to repeat.
    pub fn never_repeats(self) -> bool {
        matches!(
            self,
            Self::QuasiPeriodic | Self::Chaotic | Self::NotPeriodic
        )
    }
}

/// Smallest and largest value.
pub type Range = [f64; 2];

/// A long-term motion, and what it does to floor and people.
#[derive(Clone, Debug, PartialEq)]
pub struct Attractor {
    /// What it is.
    pub kind: Kind,
    /// Part of the time on the floor, of each body.
    pub contact_ratio: Vec<f64>,
    /// Largest plate reaction force on each body, in units of its weight.
    pub peak_reaction: Vec<f64>,
    /// Largest absolute vertical acceleration of the floor under the first body, base motion
    /// included (m/s^2); 0 without people.
    pub peak_acceleration: f64,
    /// Section of a cycle, z/eta body by body: `z[body][sample]`. No samples if not periodic.
    pub z: Vec<Vec<f64>>,
    /// z'/(eta omega_h) likewise.
    pub v: Vec<Vec<f64>>,
    /// Ranges of z and v of each body at the recorded samples.
    pub ranges: Vec<(Range, Range)>,
    /// What may be left of the transient (eta); 0 if not periodic, and of a cycle that Newton's method gave.
    pub rest: f64,
    /// Largest modulus of the Floquet multipliers of a cycle, below 1, where Newton's method confirmed it.
    pub multiplier: Option<f64>,
    /// The largest Lyapunov exponent (per forcing period), where it took one to say what the motion is.
    pub exponent: Option<Exponent>,
    /// Confidence of the test by which it got its name, or of the sign of the exponent where it is undecided (see
    /// [`saltus_orbits::judge`]); `None` for a cycle known by its returns, whose measure is `rest`.
    pub confidence: Option<f64>,
}

/// The attractor that each of the `starts` leads to, into `sink`, in no particular order.
///
/// `start_at` makes model and start of a number; it is called when the start's turn comes, by several
/// threads at once, and nothing is kept after `sink` has seen the answer. A place without a model, or a
/// run that ends early, is an answer too.
///
/// # Errors
/// [`StudyError::Integrate`] for options out of range or when stopped, and whatever `sink` refuses with.
pub fn attractors<F, E>(
    starts: impl IntoIterator<Item = usize, IntoIter: Send>,
    start_at: F,
    search: &Search,
    control: &Control,
    mut sink: impl FnMut(usize, Found) -> Result<(), E> + Send,
) -> Result<(), E>
where
    F: Fn(usize) -> Result<(Model, Point), ModelError> + Sync,
    E: From<StudyError> + Send,
{
    let mut doubtful = Vec::new();
    rounds(starts, &start_at, search, control, |number, found| {
        if search.exponent > 0 && found.has_no_period() {
            doubtful.push(Doubtful::new(number, found));
            return Ok(());
        }
        sink(number, found)
    })?;
    let mut chaotic = Vec::new();
    doubt::settle(
        doubtful,
        &start_at,
        search,
        control,
        &mut |number, found: Found| {
            if search.watch > 0 && found.is_chaotic() {
                chaotic.push((number, found));
                return Ok(());
            }
            sink(number, found)
        },
    )?;
    watch(chaotic, &start_at, search, control, &mut sink)
}

/// Runs chaotic motions on, into `sink`: as what they become, or as chaotic over so many periods more.
fn watch<F, E>(
    mut chaotic: Vec<(usize, Found)>,
    start_at: &F,
    search: &Search,
    control: &Control,
    sink: &mut (impl FnMut(usize, Found) -> Result<(), E> + Send),
) -> Result<(), E>
where
    F: Fn(usize) -> Result<(Model, Point), ModelError> + Sync,
    E: From<StudyError> + Send,
{
    // In an order of their own, whatever threads found them.
    chaotic.sort_by_key(|one| one.0);
    // what chaos does to floor and people is known by now, and to read it off each step takes longer than the steps
    let search = Search {
        transient: search.watch,
        record: 1,
        exponent: 0,
        ..*search
    };
    let ends: Vec<(usize, Point)> = chaotic
        .iter()
        .filter_map(|(number, found)| Some((*number, found.arrival.as_ref()?.point.clone())))
        .collect();
    let go_on = |i: usize| {
        let (number, point) = &ends[i];
        Ok((start_at(*number)?.0, point.clone()))
    };
    rounds(0..ends.len(), &go_on, &search, control, |i, later| {
        let (number, before) = &chaotic[i];
        sink(*number, before.followed_by(later))
    })
}

/// An error of the engine or of the sink.
pub(super) enum Refused<E> {
    Engine(IntegrateError),
    Sink(E),
}

impl<E: From<StudyError>> Refused<E> {
    pub(super) fn into_error(self) -> E {
        match self {
            Self::Engine(error) => StudyError::from(error).into(),
            Self::Sink(error) => error,
        }
    }
}

impl<E> From<IntegrateError> for Refused<E> {
    fn from(error: IntegrateError) -> Self {
        Self::Engine(error)
    }
}

/// Runs all starts, those whose systems share a structure together: the others cannot share lanes with them.
fn rounds<F, E>(
    starts: impl IntoIterator<Item = usize, IntoIter: Send>,
    start_at: &F,
    search: &Search,
    control: &Control,
    mut sink: impl FnMut(usize, Found) -> Result<(), E> + Send,
) -> Result<(), E>
where
    F: Fn(usize) -> Result<(Model, Point), ModelError> + Sync,
    E: From<StudyError> + Send,
{
    let mut later = round(starts.into_iter(), start_at, search, control, &mut sink)?;
    while !later.is_empty() {
        later.sort_unstable();
        later = round(later.into_iter(), start_at, search, control, &mut sink)?;
    }
    Ok(())
}

/// Runs all starts whose systems share the structure of the first; gives back the others.
fn round<F, E>(
    starts: impl Iterator<Item = usize> + Send,
    start_at: &F,
    search: &Search,
    control: &Control,
    sink: &mut (impl FnMut(usize, Found) -> Result<(), E> + Send),
) -> Result<Vec<usize>, E>
where
    F: Fn(usize) -> Result<(Model, Point), ModelError> + Sync,
    E: From<StudyError> + Send,
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
    let take = |task: Pursuit<'_, F>| match task.found {
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
struct Pursuit<'a, F> {
    number: usize,
    start_at: &'a F,
    search: &'a Search,
    control: &'a Control,
    structure: &'a OnceLock<System>,
    found: Option<Found>,
    /// Made when its turn comes, gone when it has ended.
    motion: Option<Motion>,
    /// Whether it has had more time because it was on its way.
    extended: bool,
}

/// Times the transient that a motion on its way gets, and forcing periods at most.
const PATIENCE: u64 = 4;
const LONGEST: u64 = 4000;

/// What is kept of a motion while it runs.
struct Motion {
    model: Model,
    samples: Samples,
    /// Period of the cycle on which the motion settled before the end of the transient, and what was left.
    settled: Option<OnCycle>,
    recording: Option<Recording>,
    periods: u64,
}

/// Samples between two looks whether the motion has settled.
const LOOK: usize = 8;

impl<F> Task for Pursuit<'_, F>
where
    F: Fn(usize) -> Result<(Model, Point), ModelError> + Sync,
{
    fn begin(&mut self) -> Option<Leg> {
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
        if !model.share_system(first) {
            return None;
        }
        let system = model.system().clone();
        self.motion = Some(Motion {
            samples: Samples::new(width(&model)),
            model,
            settled: None,
            recording: None,
            periods: 0,
        });
        Some(Leg {
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
        motion.samples.push(|row| coordinates(model, sample.x, row));
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
        let recording = |motion: &Motion| motion.recording.is_some();
        self.motion.as_ref().is_some_and(recording)
    }

    fn step(&mut self, step: &Step<'_>) {
        let recording = self.motion.as_mut().and_then(|m| m.recording.as_mut());
        if let Some(recording) = recording {
            recording.step(step);
        }
    }

    fn end(&mut self, end: End) -> Option<Leg> {
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
                    return Some(Leg {
                        system: motion.model.system().clone(),
                        start,
                        periods: (PATIENCE * self.search.transient).min(LONGEST),
                    });
                }
                Conclusion::GoOn(point) => {
                    let (attractor, section) = motion.as_it_looks(&recording, Kind::Undecided);
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
            return Some(Leg {
                system: motion.model.system().clone(),
                start: end.point,
                periods,
            });
        }
        self.motion = None;
        None
    }
}

/// What is to be said of a motion, or to be done with it.
enum Conclusion {
    Is(Box<(Attractor, Arrival)>),
    /// It is on its way, and should be run on from here.
    GoOn(Point),
}

impl Motion {
    fn found(&self, attractor: Attractor, arrival: Arrival) -> Found {
        Found {
            attractor: Ok(attractor),
            periods: self.periods,
            arrival: Some(arrival),
        }
    }

    /// What the whole motion says, which has come to `end`.
    fn conclude(
        &mut self,
        recording: &Recording,
        end: &Point,
        search: &Search,
        control: &Control,
    ) -> Conclusion {
        let on = self
            .settled
            .take()
            .or_else(|| self.samples.settled(Closeness::FAIR));
        let looks = |motion: &Self, kind: Kind, rest: f64| {
            let (attractor, section) = motion.as_it_looks(recording, kind);
            let arrival = Arrival {
                point: end.clone(),
                section,
            };
            Conclusion::Is(Box::new((Attractor { rest, ..attractor }, arrival)))
        };
        if let Some(on) = on.filter(|on| on.is_sure() && !search.confirm) {
            return looks(self, Kind::Periodic(on.period), on.rest);
        }
        match confirm::cycle(&self.model, end, &self.samples, control) {
            Near::Stable(orbit) => match around(&self.model, &orbit, control) {
                Some(cycle) => Conclusion::Is(Box::new(cycle)),
                None => Conclusion::GoOn(end.clone()),
            },
            Near::Unstable(orbit) => {
                self.samples = Samples::new(width(&self.model));
                Conclusion::GoOn(confirm::beside(&self.model, &orbit))
            }
            Near::Nothing if on.is_some() || self.samples.judge() == Recurrence::Drifting => {
                Conclusion::GoOn(end.clone())
            }
            Near::Nothing => looks(self, Kind::NotPeriodic, 0.0),
        }
    }

    /// A motion of this kind, as its last samples and the recording show it, and its section: the samples of the cycle, or
    /// of the last recorded periods.
    fn as_it_looks(&self, recording: &Recording, kind: Kind) -> (Attractor, Vec<Vec<[f64; 2]>>) {
        let count = match kind {
            Kind::Periodic(n) => n as usize,
            _ => recording
                .periods()
                .min(Samples::ROWS)
                .min(self.samples.count()),
        };
        // z of all bodies come first in a sample, then v of all
        let bodies = self.model.setup().jumpers.len();
        let of = |body: usize| {
            let rows = (0..count).rev().map(|back| self.samples.back(back));
            rows.map(|row| [row[body], row[bodies + body]]).collect()
        };
        let section: Vec<Vec<[f64; 2]>> = (0..bodies).map(of).collect();
        let attractor = recording.motion(&self.model, kind, &section);
        (attractor, section)
    }
}

/// Numbers in a sample: z and v of each body, then r_j and r_j', then what a leg remembers.
pub(super) fn width(model: &Model) -> usize {
    let layout = model.layout;
    let legs = if layout.legs { layout.jumpers } else { 0 };
    2 * (layout.jumpers + layout.transverse) + legs
}

/// A state in units of eta and eta omega_h of its body, those of the plate of the first one. In-plane
/// amplitudes are left out: they follow the others.
pub(super) fn coordinates(model: &Model, x: &[f64], row: &mut [f64]) {
    let (layout, scales) = (model.layout, &model.scales);
    let first = scales.jumpers.first();
    let (length, speed) = first.map_or((1.0, 1.0), |unit| {
        let speed = scales.velocity() / unit.velocity;
        (scales.length / unit.position, speed)
    });
    let bodies = 0..layout.jumpers;
    let values = bodies
        .clone()
        .map(|i| model.z(i, x))
        .chain(bodies.clone().map(|i| model.v(i, x)))
        .chain((0..layout.transverse).map(|j| x[layout.r(j)] * length))
        .chain((0..layout.transverse).map(|j| x[layout.dr(j)] * speed))
        .chain(
            bodies
                .filter(|_| layout.legs)
                .map(|i| x[layout.leg(i)] * length),
        );
    for (out, value) in row.iter_mut().zip(values) {
        *out = value;
    }
}
