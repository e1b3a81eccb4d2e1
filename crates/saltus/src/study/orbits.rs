//! Periodic orbits of people on a plate: the maps whose fixed points they are, one orbit near a long-term
//! motion, and what it does to floor and people.

use std::f64::consts::TAU;

use saltus_hybrid::{Method, Options, Point, Segment, Status, System, record};
use saltus_orbits::{
    MAX_PERIOD, MapPoint, NewtonOptions, NoImage, NotFound, Orbit, Stroboscopic, find_orbit,
};

use super::settle::settle;
use super::trajectory::{History, TrajectorySwitch, simulate};
use super::{Control, StudyError};
use crate::model::{Contact, Model, ModelError, Section};

/// Method by which orbits are integrated, whatever the study says of other motions: 1e-13 leaves residuals of
/// 1e-12, and special points to some 1e-10.
pub const ORBIT_METHOD: Method = Method::Taylor {
    tolerance: 1e-13,
    order: 20,
};

/// Points per period of the way around.
const POINTS: u32 = 2000;

/// A motion that comes back nearer than this, in the units of the model, may be near a cycle.
const NEAR: f64 = 0.02;

/// The stroboscopic maps of the models that `model_at` makes of parameter values. All of them have the
/// states of `like`. Raise [`Control::stop`] to end what asks them.
pub fn stroboscopic<'a, F>(
    like: &Model,
    model_at: F,
    control: &'a Control,
) -> Stroboscopic<'a, impl Fn(&[f64]) -> Result<System, String> + Sync + 'a>
where
    F: Fn(&[f64]) -> Result<Model, ModelError> + Sync + 'a,
{
    let options = Options {
        method: ORBIT_METHOD,
        ..control.options
    };
    let system_at = move |parameters: &[f64]| {
        let model = model_at(parameters).map_err(|error| error.to_string())?;
        control.count_period();
        Ok(model.system().clone())
    };
    let (states, threads) = (like.free_states(), control.threads);
    Stroboscopic::new(system_at, states, options, threads, &control.stop)
}

/// Description of the orbit that is meant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OrbitSearch {
    /// Forcing periods after which it closes; `None` for those of the long-term motion.
    pub period: Option<usize>,
    /// Forcing periods run before Newton's method begins.
    pub transient: u64,
    /// Pieces whose ends Newton's method joins; `None` for one per period.
    pub segments: Option<usize>,
}

/// Reasons why no orbit was found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OrbitError {
    /// No model, or no integration.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// The motion before Newton's method ended early.
    #[error("the motion before Newton's method ended early: {0}")]
    Ended(Status),
    /// Nothing near a cycle.
    #[error(
        "after {transient} periods the motion does not come back within {MAX_PERIOD} periods (nearest after \
         {period}, by {distance:.1e} h): it may be chaotic or still on its way; give the period of the orbit, \
         or a longer transient"
    )]
    NoReturn {
        /// Periods run.
        transient: u64,
        /// Periods after which it comes nearest.
        period: usize,
        /// Distance then (h, h Omega).
        distance: f64,
    },
    /// Newton's method failed.
    #[error(transparent)]
    Newton(#[from] NotFound),
}

impl OrbitError {
    /// Whether the search was stopped from outside.
    pub fn is_interrupt(&self) -> bool {
        match self {
            Self::Study(error) => error.is_interrupt(),
            Self::Newton(NotFound::NoImage { reason, .. }) => *reason == NoImage::Interrupted,
            _ => false,
        }
    }
}

/// The periodic orbit near the motion that `start` leads to.
///
/// # Errors
/// [`OrbitError`] says how far the search came.
pub fn orbit(
    model: &Model,
    start: &Point,
    search: &OrbitSearch,
    control: &Control,
) -> Result<Orbit, OrbitError> {
    let family = stroboscopic(model, |_: &[f64]| Ok(model.clone()), control);
    orbit_of(&family, model, &[], start, search, control)
}

/// As [`orbit`], of a family with parameters; `model` is the one at `parameters`.
///
/// # Errors
/// As [`orbit`].
pub fn orbit_of<F>(
    family: &Stroboscopic<'_, F>,
    model: &Model,
    parameters: &[f64],
    start: &Point,
    search: &OrbitSearch,
    control: &Control,
) -> Result<Orbit, OrbitError>
where
    F: Fn(&[f64]) -> Result<System, String> + Sync,
{
    let newton = NewtonOptions {
        segments: search.segments,
        ..NewtonOptions::default()
    };
    let way = run(model, start, search, control)?;
    let solve = |period: usize| {
        let places: Vec<MapPoint> = way[way.len() - 1 - period..way.len() - 1]
            .iter()
            .map(|point| place(model, point))
            .collect();
        find_orbit(family, parameters, &places, &newton)
    };
    if let Some(period) = search.period {
        return Ok(solve(period)?);
    }
    let back = |period: usize| {
        let ends = [way.len() - 1, way.len() - 1 - period].map(|i| &way[i].x);
        let pairs = ends[0].iter().zip(ends[1]);
        pairs.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
    };
    let near = (1..=MAX_PERIOD).filter(|&period| back(period) <= NEAR);
    let mut failure = None;
    for period in near {
        match solve(period) {
            // Newton's method may lead far away from a motion that is near no cycle.
            Ok(orbit) if is_near(model, &orbit, &way) => return Ok(orbit),
            Ok(_) => {}
            Err(reason @ NotFound::NoImage { .. }) => return Err(reason.into()),
            Err(reason) => failure = Some(reason),
        }
    }
    let nearest = (1..=MAX_PERIOD).min_by(|&a, &b| back(a).total_cmp(&back(b)));
    let period = nearest.unwrap_or(1);
    Err(match failure {
        Some(reason) => reason.into(),
        None => OrbitError::NoReturn {
            transient: search.transient,
            period,
            distance: back(period),
        },
    })
}

/// The state behind the transient and the samples after it, for as many periods as an orbit may have.
fn run(
    model: &Model,
    start: &Point,
    search: &OrbitSearch,
    control: &Control,
) -> Result<Vec<Point>, OrbitError> {
    let mut start = start.clone();
    if search.transient > 0 {
        let settled = settle(&[(model.clone(), start)], search.transient, 0, control)?.remove(0);
        if settled.status != Status::Completed {
            return Err(OrbitError::Ended(settled.status));
        }
        start = settled.end;
    }
    let segment = Segment {
        system: model.system().clone(),
        start: start.clone(),
        periods: search.period.unwrap_or(MAX_PERIOD) as u64,
    };
    let way = record(&segment, &control.options).map_err(StudyError::from)?;
    if way.end.status != Status::Completed {
        return Err(OrbitError::Ended(way.end.status));
    }
    let mut points = vec![start];
    points.extend(way.samples);
    Ok(points)
}

fn is_near(model: &Model, orbit: &Orbit, way: &[Point]) -> bool {
    let Some(last) = way.last() else { return false };
    let free = model.free_states();
    let distance = |place: &MapPoint| {
        let pairs = place.x.iter().zip(&last.x[..free]);
        pairs.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
    };
    orbit
        .places
        .iter()
        .any(|place| distance(place) <= 10.0 * NEAR)
}

/// A point of the section as a place of the map.
pub fn place(model: &Model, point: &Point) -> MapPoint {
    MapPoint {
        modes: point.modes.clone(),
        x: point.x[..model.free_states()].to_vec(),
    }
}

/// A place of the map as a point of the section.
pub fn point(model: &Model, place: &MapPoint) -> Point {
    model.system().point(&place.modes, &place.x)
}

/// Effect of an orbit on floor and people.
#[derive(Clone, Debug, PartialEq)]
pub struct Portrait {
    /// Its points at cos(Omega t) = 1 in the paper's units, one per forcing period.
    pub section: Vec<Section>,
    /// Switches over the whole orbit, in time order; times from the first point on (s).
    pub switches: Vec<TrajectorySwitch>,
    /// Part of the time on the floor, of each body.
    pub contact_ratio: Vec<f64>,
    /// Phases of the drive at each touch-down of each body, in (0, 2 pi] (rad).
    pub touch_down_phases: Vec<Vec<f64>>,
    /// Largest plate reaction force on each body, in units of its weight.
    pub peak_reaction: Vec<f64>,
    /// The way around, at 2000 equal times per forcing period.
    pub history: History,
}

/// Follows an orbit of `model` once around.
///
/// # Errors
/// [`StudyError::Integrate`] for options out of range or when stopped.
pub fn portrait(model: &Model, orbit: &Orbit, control: &Control) -> Result<Portrait, StudyError> {
    let control = Control {
        options: Options {
            method: ORBIT_METHOD,
            ..control.options
        },
        ..control.clone()
    };
    let bodies = model.setup().jumpers.len();
    let periods = orbit.period() as u64;
    let start = point(model, &orbit.places[0]);
    let way = simulate(model, &start, periods, periods, POINTS, &control)?;
    let seconds = model.scales().period();
    let phase = |switch: &TrajectorySwitch| {
        let turns = switch.time / seconds;
        let part = turns - turns.ceil() + 1.0;
        part * TAU
    };
    let touch_downs = |body: usize| {
        let lands = |s: &&TrajectorySwitch| s.jumper == body && s.into == Some(Contact::Stance);
        way.switches.iter().filter(lands).map(phase).collect()
    };
    let mean = |body: usize| {
        way.contact_ratio.iter().map(|r| r[body]).sum::<f64>() / way.contact_ratio.len() as f64
    };
    let here = |place: &MapPoint| {
        let point = point(model, place);
        model.section(&point.modes, &point.x)
    };
    Ok(Portrait {
        section: orbit.places.iter().map(here).collect(),
        contact_ratio: (0..bodies).map(mean).collect(),
        touch_down_phases: (0..bodies).map(touch_downs).collect(),
        peak_reaction: way.peak_reaction,
        switches: way.switches,
        history: way.history,
    })
}

/// The order of the switches of an orbit in letters: T for take-off and L for touch-down, with the number of the
/// body from 1 where there are several; a bar between forcing periods, such as `LT|LT`.
pub fn sequence(model: &Model, orbit: &Orbit) -> String {
    let several = model.setup().jumpers.len() > 1;
    let letter = |crossing: &saltus_orbits::Crossing| {
        let (from, to) = (Contact::of(crossing.from), Contact::of(crossing.to));
        let letter = match to {
            _ if from == to => return String::new(),
            Contact::Flight => "T",
            Contact::Stance => "L",
        };
        let body = if several {
            (crossing.unit + 1).to_string()
        } else {
            String::new()
        };
        format!("{letter}{body}")
    };
    let period = |crossings: &Vec<_>| crossings.iter().map(letter).collect::<String>();
    let periods: Vec<String> = orbit.crossings.iter().map(period).collect();
    periods.join("|")
}
