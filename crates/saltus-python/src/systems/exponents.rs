//! Lyapunov exponents of many trajectories.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use saltus_hybrid::{Method, Options, Sample, Status};
use saltus_orbits::{
    Ascent, ClimbError, Climbed, MapPoint, Orbit, Start, Stroboscopic, climb, settled,
};

use super::blueprint::Blueprint;
use super::input::Settings;
use super::members::Members;
use crate::error::{of_computation, of_definition};
use crate::running::{Counting, run as run_beside};

/// Method for orbits: the default of `find_orbit`.
const ORBITS: Method = Method::Taylor {
    tolerance: 1e-14,
    order: 22,
};

/// Exponents per unit of time, as flat arrays in the order of the members.
#[pyclass(frozen, get_all, module = "saltus._native")]
pub(crate) struct Exponents {
    /// (members, count), the largest first but for their errors.
    exponents: Py<PyArray1<f64>>,
    standard_errors: Py<PyArray1<f64>>,
    /// (members, count, 2).
    intervals: Py<PyArray1<f64>>,
    /// Whether each is on a cycle.
    on_cycle: Vec<bool>,
    /// Kaplan-Yorke dimension of each member and its standard error; NaN where it is not known.
    dimension: Py<PyArray1<f64>>,
    dimension_error: Py<PyArray1<f64>>,
    /// Ending of each trajectory, as a word and a sentence.
    status: Vec<(String, String)>,
}

/// A member whose run is over.
struct Ended {
    period: f64,
    climbed: Climbed,
    /// The stable cycle it has come to, if it decays and one is found.
    cycle: Option<Orbit>,
}

/// The `count` largest exponents from `length` = (transient, periods).
pub(crate) fn run(
    py: Python<'_>,
    blueprint: &Arc<Blueprint>,
    members: Members,
    length: (u64, u64),
    count: usize,
    settings: Settings,
    progress: &Counting<'_>,
) -> PyResult<Exponents> {
    let blueprint = Arc::clone(blueprint);
    let how = Ascent {
        columns: count,
        transient: length.0,
        periods: length.1,
    };
    let ended = run_beside(py, progress, move |stop, done| {
        measure(&blueprint, &members, &how, &settings, (stop, done))
    });
    Ok(collect(py, ended?))
}

/// Runs every member with its tangents, and looks for the cycle of those that decay.
fn measure(
    blueprint: &Blueprint,
    members: &Members,
    how: &Ascent,
    settings: &Settings,
    (stop, done): (&AtomicBool, &AtomicU64),
) -> PyResult<Vec<Ended>> {
    let options = settings.options();
    let start = |index: usize| {
        let system = blueprint
            .system(members.parameters.row(index))
            .map_err(of_definition)?;
        let (modes, x) = (members.modes.row(index), members.starts.row(index));
        Ok(Start {
            point: system.point(modes, x),
            system,
            watch: |_: &Sample<'_>| {
                done.fetch_add(1, Ordering::Relaxed);
            },
        })
    };
    let starts = (0..members.count)
        .map(start)
        .collect::<PyResult<Vec<_>>>()?;
    let periods: Vec<f64> = starts.iter().map(|start| start.system.period()).collect();
    let climbed = climb(starts, how, &options, settings.threads, stop);
    let climbed = climbed.map_err(|error| match error {
        ClimbError::Build(error) => of_definition(error),
        other => of_computation(other),
    })?;
    let system_at = |p: &[f64]| blueprint.system(p).map_err(|error| error.to_string());
    let states = blueprint.states();
    let exact = Options {
        method: ORBITS,
        ..options
    };
    let map = Stroboscopic::new(system_at, states, exact, settings.threads, stop);
    let ended = climbed.into_iter().zip(periods).enumerate();
    let with_cycle = |(index, (climbed, period)): (usize, (Climbed, f64))| {
        let decays = climbed.spectrum.estimate()[0].per_iterate < 0.0;
        let here = MapPoint {
            modes: climbed.end.point.modes.clone(),
            x: climbed.end.point.x[..states].to_vec(),
        };
        let asked = decays && climbed.end.status == Status::Completed;
        let parameters = members.parameters.row(index);
        let cycle = asked.then(|| settled(&map, parameters, &here)).flatten();
        Ended {
            period,
            climbed,
            cycle,
        }
    };
    Ok(ended.map(with_cycle).collect())
}

fn collect(py: Python<'_>, ended: Vec<Ended>) -> Exponents {
    let (mut exponents, mut errors, mut intervals) = (Vec::new(), Vec::new(), Vec::new());
    let (mut dimension, mut dimension_error) = (Vec::new(), Vec::new());
    let (mut status, mut on_cycle) = (Vec::new(), Vec::new());
    for member in ended {
        let (period, Climbed { spectrum, end }) = (member.period, member.climbed);
        let found = match &member.cycle {
            Some(orbit) => spectrum.on_cycle(orbit),
            None => spectrum.estimate(),
        };
        for exponent in found {
            exponents.push(exponent.per_iterate / period);
            errors.push(exponent.standard_error / period);
            intervals.extend(exponent.interval().map(|end| end / period));
        }
        let known = spectrum.kaplan_yorke();
        dimension.push(known.map_or(f64::NAN, |d| d.value));
        dimension_error.push(known.map_or(f64::NAN, |d| d.standard_error));
        status.push((end.status.name().to_owned(), end.status.to_string()));
        on_cycle.push(member.cycle.is_some());
    }
    Exponents {
        exponents: exponents.into_pyarray(py).unbind(),
        standard_errors: errors.into_pyarray(py).unbind(),
        intervals: intervals.into_pyarray(py).unbind(),
        on_cycle,
        dimension: dimension.into_pyarray(py).unbind(),
        dimension_error: dimension_error.into_pyarray(py).unbind(),
        status,
    }
}
