//! Periodic orbits of a system and their Floquet multipliers.

use std::sync::Arc;

use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use saltus_orbits::{
    MapPoint, MapRequest, NewtonOptions, NoImage, ParametricMap, Stroboscopic, find_orbit,
};

use super::blueprint::Blueprint;
use super::input::Settings;
use super::members::Members;
use crate::error::of_computation;
use crate::running::{Counting, run};

/// Period of the orbit, and limits of Newton's method.
pub(crate) struct Search {
    pub(crate) period: usize,
    pub(crate) tolerance: f64,
    pub(crate) iterations: usize,
}

/// A periodic orbit.
#[pyclass(frozen, get_all, module = "saltus._native")]
pub(crate) struct Orbit {
    /// Periods of the forcing.
    period: usize,
    /// (period, states).
    places: Py<PyArray1<f64>>,
    /// (period, units).
    modes: Py<PyArray1<u8>>,
    /// Real and imaginary part of each multiplier, by falling modulus.
    multipliers: Vec<(f64, f64)>,
    multiplier_errors: Vec<f64>,
    /// "stable", "unstable" or "neutral".
    stability: &'static str,
    in_family: bool,
    /// (states, states).
    monodromy: Py<PyArray1<f64>>,
    /// Of each switch: place on the way, in periods since the start, unit, mode left, mode entered.
    switches: Vec<(f64, usize, usize, usize)>,
    residual: f64,
    iterations: usize,
}

/// The orbit near the members: one for each period, or the first one of them.
pub(crate) fn find(
    py: Python<'_>,
    blueprint: &Arc<Blueprint>,
    members: Members,
    search: Search,
    settings: Settings,
) -> PyResult<Orbit> {
    let blueprint = Arc::clone(blueprint);
    let states = blueprint.states();
    let newton = NewtonOptions {
        tolerance: search.tolerance,
        iterations: search.iterations,
        segments: None,
    };
    let progress = Counting {
        call: None,
        what: "orbit",
        total: None,
    };
    let orbit = run(py, &progress, move |stop, _| {
        let place = |i: usize| MapPoint {
            modes: members.modes.row(i).to_vec(),
            x: members.starts.row(i).to_vec(),
        };
        let given: Vec<MapPoint> = (0..members.count).map(place).collect();
        let parameters = members.parameters.row(0);
        let system_at = |p: &[f64]| blueprint.system(p).map_err(|error| error.to_string());
        let options = settings.options();
        let map = Stroboscopic::new(system_at, states, options, settings.threads, stop);
        let start = led_on(&map, parameters, given, search.period).map_err(of_computation)?;
        find_orbit(&map, parameters, &start, &newton).map_err(of_computation)
    })?;
    let monodromy = |row: usize| (0..states).map(move |column| (row, column));
    let monodromy: Vec<f64> = (0..states)
        .flat_map(monodromy)
        .map(|(row, column)| orbit.monodromy[(row, column)])
        .collect();
    let places: Vec<f64> = orbit.places.iter().flat_map(|p| p.x.clone()).collect();
    let modes = orbit.places.iter().flat_map(|p| p.modes.clone());
    let modes: Vec<u8> = modes.map(|mode| mode as u8).collect();
    let switches = orbit.crossings.iter().enumerate().flat_map(|(i, all)| {
        let told = move |c: &saltus_orbits::Crossing| (i as f64 + c.at, c.unit, c.from, c.to);
        all.iter().map(told).collect::<Vec<_>>()
    });
    Ok(Orbit {
        period: orbit.period(),
        switches: switches.collect(),
        places: places.into_pyarray(py).unbind(),
        modes: modes.into_pyarray(py).unbind(),
        multipliers: orbit.multipliers.iter().map(|m| (m.re, m.im)).collect(),
        multiplier_errors: orbit.multipliers.iter().map(|m| m.error).collect(),
        stability: orbit.stability().name(),
        in_family: orbit.in_family(),
        monodromy: monodromy.into_pyarray(py).unbind(),
        residual: orbit.residual,
        iterations: orbit.iterations,
    })
}

/// Places to begin with: those given and, until there are enough, the images of the last.
fn led_on(
    map: &impl ParametricMap,
    parameters: &[f64],
    mut places: Vec<MapPoint>,
    period: usize,
) -> Result<Vec<MapPoint>, NoImage> {
    while let Some(start) = places.last().filter(|_| places.len() < period) {
        let shot = MapRequest {
            parameters,
            start,
            derivative: false,
        };
        places.extend(
            map.images(&[shot])
                .into_iter()
                .next()
                .transpose()?
                .map(|image| image.place),
        );
    }
    Ok(places)
}
