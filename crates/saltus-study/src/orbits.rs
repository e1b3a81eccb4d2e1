//! Periodic orbits of a subject: the maps whose fixed points they are, and one orbit near a long-term motion.

use saltus_hybrid::{Method, Options, Point, Segment, Status, System, record};
use saltus_orbits::{
    MAX_PERIOD, MapPoint, NewtonOptions, NoImage, NotFound, Orbit, Stroboscopic, find_orbit,
};

use crate::settle::settle;
use crate::subject::Subject;
use crate::{Control, StudyError};

/// Method by which orbits are integrated, whatever the study says of other motions: 1e-13 leaves residuals of
/// 1e-12, and special points to some 1e-10.
pub const ORBIT_METHOD: Method = Method::Taylor {
    tolerance: 1e-13,
    order: 20,
};

/// A motion that comes back nearer than this, in the units of the model, may be near a cycle.
const NEAR: f64 = 0.02;

/// The stroboscopic maps of the models that `model_at` makes of parameter values. All of them have the
/// states of `like`. Raise [`Control::stop`] to end what asks them.
pub fn stroboscopic<'a, S, F>(
    like: &S,
    model_at: F,
    control: &'a Control,
) -> Stroboscopic<'a, impl Fn(&[f64]) -> Result<System, String> + Sync + 'a>
where
    S: Subject + 'a,
    F: Fn(&[f64]) -> Result<S, S::NoModel> + Sync + 'a,
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
pub enum OrbitError<E: std::error::Error + 'static> {
    /// No model, or no integration.
    #[error(transparent)]
    Study(StudyError<E>),
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

impl<E: std::error::Error + 'static> From<StudyError<E>> for OrbitError<E> {
    fn from(error: StudyError<E>) -> Self {
        Self::Study(error)
    }
}

impl<E: std::error::Error + 'static> OrbitError<E> {
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
pub fn orbit<S: Subject>(
    model: &S,
    start: &Point,
    search: &OrbitSearch,
    control: &Control,
) -> Result<Orbit, OrbitError<S::NoModel>> {
    let family = stroboscopic(model, |_: &[f64]| Ok(model.clone()), control);
    orbit_of(&family, model, &[], start, search, control)
}

/// As [`orbit`], of a family with parameters; `model` is the one at `parameters`.
///
/// # Errors
/// As [`orbit`].
pub fn orbit_of<S: Subject, F>(
    family: &Stroboscopic<'_, F>,
    model: &S,
    parameters: &[f64],
    start: &Point,
    search: &OrbitSearch,
    control: &Control,
) -> Result<Orbit, OrbitError<S::NoModel>>
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
fn run<S: Subject>(
    model: &S,
    start: &Point,
    search: &OrbitSearch,
    control: &Control,
) -> Result<Vec<Point>, OrbitError<S::NoModel>> {
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

fn is_near<S: Subject>(model: &S, orbit: &Orbit, way: &[Point]) -> bool {
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
pub fn place<S: Subject>(model: &S, point: &Point) -> MapPoint {
    MapPoint {
        modes: point.modes.clone(),
        x: point.x[..model.free_states()].to_vec(),
    }
}

/// A place of the map as a point of the section.
pub fn point<S: Subject>(model: &S, place: &MapPoint) -> Point {
    model.system().point(&place.modes, &place.x)
}
