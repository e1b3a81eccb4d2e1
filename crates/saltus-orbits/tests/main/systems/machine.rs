//! What every test here begins with: maps of systems, their orbits and branches, their exponents.

use std::sync::atomic::AtomicBool;

use saltus_hybrid::{End, Method, Options, Sample, Segment, Status, System, Task, integrate_all};
use saltus_orbits::{
    Branch, ContinuationOptions, CurvePoint, MapPoint, MapRequest, NewtonOptions, Orbit,
    ParameterRange, ParametricMap, Special, Spectrum, Stroboscopic, find_orbit, follow_both,
    follow_curve,
};

pub(crate) static STOP: AtomicBool = AtomicBool::new(false);

/// Errors of a period are some 1e-14, so that an orbit is limited by the tolerance of Newton's method.
pub(crate) fn options() -> Options {
    Options {
        method: Method::Taylor {
            tolerance: 1e-14,
            order: 22,
        },
        ..Options::default()
    }
}

pub(crate) fn map<F>(dimension: usize, system_at: F) -> Stroboscopic<'static, F>
where
    F: Fn(&[f64]) -> Result<System, String> + Sync,
{
    Stroboscopic::new(system_at, dimension, options(), 1, &STOP)
}

pub(crate) fn place(modes: &[usize], x: &[f64]) -> MapPoint {
    MapPoint {
        modes: modes.to_vec(),
        x: x.to_vec(),
    }
}

/// Where the motion from `at` is after so many periods.
pub(crate) fn settled(
    map: &impl ParametricMap,
    parameters: &[f64],
    mut at: MapPoint,
    periods: usize,
) -> MapPoint {
    for _ in 0..periods {
        let shot = MapRequest {
            parameters,
            start: &at,
            derivative: false,
        };
        at = map.images(&[shot]).remove(0).unwrap().place;
    }
    at
}

pub(crate) fn orbit(map: &impl ParametricMap, parameters: &[f64], at: MapPoint) -> Orbit {
    find_orbit(map, parameters, &[at], &NewtonOptions::default()).unwrap()
}

pub(crate) fn along(parameter: usize, from: f64, to: f64) -> ParameterRange {
    ParameterRange {
        parameter,
        from,
        to,
    }
}

pub(crate) fn both(map: &impl ParametricMap, start: &Orbit, range: &ParameterRange) -> Branch {
    let options = ContinuationOptions::default();
    follow_both(map, start, range, &options, &mut |_| true).unwrap()
}

/// The special point of a branch of this short name; there is one.
pub(crate) fn only<'a>(branch: &'a Branch, short: &str) -> &'a Special {
    let mut all = branch.specials.iter().filter(|s| s.kind.short() == short);
    let first = all.next().unwrap();
    assert_eq!(all.next(), None);
    first
}

/// The points of the curve of a special point over two parameters, at least ten.
pub(crate) fn curve(
    map: &impl ParametricMap,
    start: &Special,
    over: [&ParameterRange; 2],
) -> Vec<CurvePoint> {
    let options = ContinuationOptions::default();
    let curve = follow_curve(map, start, over, &options, &mut |_| true).unwrap();
    assert!(curve.points.len() >= 10, "{:?}", curve.ends);
    curve.points
}

/// Short names of the special points.
pub(crate) fn kinds(branch: &Branch) -> Vec<&str> {
    branch.specials.iter().map(|s| s.kind.short()).collect()
}

/// The record of all exponents from each start, after a transient.
pub(crate) fn exponents(
    system: &System,
    starts: &[Vec<f64>],
    transient: u64,
    periods: u64,
) -> Spectrum {
    let n = starts[0].len();
    let system = system.with_tangents(n).unwrap();
    let tasks = starts.iter().map(|x| {
        let spectrum = Spectrum::new(n, n).unwrap();
        let mut start = system.point(&[], x);
        let columns = spectrum.start_columns();
        system.columns_mut(&mut start.x).copy_from_slice(&columns);
        Climb {
            segment: Some(Segment {
                system: system.clone(),
                start,
                periods: transient + periods,
            }),
            transient,
            spectrum,
        }
    });
    let ended = integrate_all(&options(), tasks.collect(), 1, &STOP).unwrap();
    let records = ended.into_iter().map(|climb| climb.spectrum);
    let merge = |mut all: Spectrum, one: Spectrum| {
        all.merge(&one).unwrap();
        all
    };
    records.reduce(merge).unwrap()
}

struct Climb {
    segment: Option<Segment>,
    transient: u64,
    spectrum: Spectrum,
}

impl Task for Climb {
    fn begin(&mut self) -> Option<Segment> {
        self.segment.take()
    }

    fn sample(&mut self, sample: &Sample<'_>) -> bool {
        // The columns of this period come after this call.
        if sample.period <= self.transient + 1 {
            self.spectrum.forget();
        }
        true
    }

    fn tangents(&mut self, columns: &mut [f64]) {
        self.spectrum.feed(columns).unwrap();
    }

    fn end(&mut self, end: End) -> Option<Segment> {
        assert_eq!(end.status, Status::Completed);
        None
    }
}
