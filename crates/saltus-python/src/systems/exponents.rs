//! Lyapunov exponents of many trajectories.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use saltus_hybrid::{End, Leg, Sample, System, Task, integrate_all};
use saltus_orbits::Spectrum;

use super::blueprint::Blueprint;
use super::input::Settings;
use super::program::Members;
use crate::error::{of_computation, of_definition};
use crate::running::{Progress, run as run_beside};

/// Exponents per unit of time, as flat arrays in the order of the members.
#[pyclass(frozen, get_all, module = "saltus._native")]
pub(crate) struct Exponents {
    /// (members, count), the largest first but for their errors.
    exponents: Py<PyArray1<f64>>,
    standard_errors: Py<PyArray1<f64>>,
    /// Kaplan-Yorke dimension of each member and its standard error; NaN where it is not known.
    dimension: Py<PyArray1<f64>>,
    dimension_error: Py<PyArray1<f64>>,
    /// Word and sentence for how each trajectory ended.
    status: Vec<(String, String)>,
}

/// The `count` largest exponents from `length` = (transient, periods).
pub(crate) fn run(
    py: Python<'_>,
    blueprint: &Arc<Blueprint>,
    members: Members,
    length: (u64, u64),
    count: usize,
    settings: Settings,
    progress: &Progress<'_>,
) -> PyResult<Exponents> {
    let blueprint = Arc::clone(blueprint);
    let options = settings.options();
    let ended = run_beside(py, progress, move |stop, done| {
        let wide = |index: usize| {
            let system = blueprint
                .system(members.parameters.row(index))
                .map_err(of_definition)?;
            system.with_tangents(count).map_err(of_definition)
        };
        let mut tasks: Vec<Climb<'_>> = Vec::with_capacity(members.count);
        for index in 0..members.count {
            let mut system = wide(index)?;
            if let Some(first) = tasks.first() {
                system = system.sharing(&first.system);
            }
            tasks.push(Climb {
                spectrum: Spectrum::new(blueprint.states(), count).map_err(of_computation)?,
                start: Some((members.modes.row(index), members.starts.row(index))),
                system,
                length,
                end: None,
                done,
            });
        }
        integrate_all(&options, tasks, settings.threads, stop)
            .map(|ended| {
                let parts = |climb: Climb<'_>| (climb.system.period(), climb.spectrum, climb.end);
                ended.into_iter().map(parts).collect::<Vec<_>>()
            })
            .map_err(of_computation)
    });
    let (mut exponents, mut errors) = (Vec::new(), Vec::new());
    let (mut dimension, mut dimension_error, mut status) = (Vec::new(), Vec::new(), Vec::new());
    for (period, spectrum, end) in ended? {
        for exponent in spectrum.estimate() {
            exponents.push(exponent.per_iterate / period);
            errors.push(exponent.standard_error / period);
        }
        let known = spectrum.kaplan_yorke();
        dimension.push(known.map_or(f64::NAN, |d| d.value));
        dimension_error.push(known.map_or(f64::NAN, |d| d.standard_error));
        let end = end.ok_or_else(|| of_computation("a trajectory did not run"))?;
        status.push((end.status.name().to_owned(), end.status.to_string()));
    }
    Ok(Exponents {
        exponents: exponents.into_pyarray(py).unbind(),
        standard_errors: errors.into_pyarray(py).unbind(),
        dimension: dimension.into_pyarray(py).unbind(),
        dimension_error: dimension_error.into_pyarray(py).unbind(),
        status,
    })
}

/// One trajectory with its record of growth.
struct Climb<'a> {
    system: System,
    start: Option<(&'a [usize], &'a [f64])>,
    /// Transient and periods.
    length: (u64, u64),
    spectrum: Spectrum,
    end: Option<End>,
    done: &'a AtomicU64,
}

impl Task for Climb<'_> {
    fn begin(&mut self) -> Option<Leg> {
        let (modes, x) = self.start.take()?;
        let mut start = self.system.point(modes, x);
        let columns = self.spectrum.start_columns();
        self.system
            .columns_mut(&mut start.x)
            .copy_from_slice(&columns);
        Some(Leg {
            system: self.system.clone(),
            start,
            periods: self.length.0 + self.length.1,
        })
    }

    fn sample(&mut self, sample: &Sample<'_>) -> bool {
        // The columns of this period come after this call.
        if sample.period <= self.length.0 + 1 {
            self.spectrum.forget();
        }
        self.done.fetch_add(1, Ordering::Relaxed);
        true
    }

    fn tangents(&mut self, columns: &mut [f64]) {
        // Columns that are not finite end the run with a status of their own.
        let _ = self.spectrum.feed(columns);
    }

    fn end(&mut self, end: End) -> Option<Leg> {
        self.end = Some(end);
        None
    }
}
