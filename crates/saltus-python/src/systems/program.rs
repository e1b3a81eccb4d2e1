//! A system of a user's own, ready to be asked.

use std::sync::Arc;

use numpy::PyReadonlyArray2;
use pyo3::prelude::*;

use super::blueprint::{Blueprint, Clock, Leave};
use super::ensemble::{self, Plan, Trajectories};
use super::exponents::{self, Exponents};
use super::formula::Op;
use super::input::{Definition, Settings};
use super::lower::lower;
use super::members::Members;
use super::orbit::{self, Orbit, Search};
use crate::error::of_definition;
use crate::running::{Counting, sound};

/// A system as a program of the engine. It never changes.
#[pyclass(frozen, module = "saltus._native")]
pub(crate) struct Program {
    blueprint: Arc<Blueprint>,
    parameters: usize,
}

impl Program {
    fn members(
        &self,
        parameters: &PyReadonlyArray2<'_, f64>,
        starts: &PyReadonlyArray2<'_, f64>,
        modes: &PyReadonlyArray2<'_, u8>,
    ) -> PyResult<Members> {
        let blueprint = &self.blueprint;
        sound(|| Members::new(blueprint, self.parameters, parameters, starts, modes))
    }
}

#[pymethods]
impl Program {
    /// From operations in which each reads earlier ones, and the places of rates, units and clock among them.
    #[new]
    #[expect(clippy::too_many_arguments, reason = "named in Python")]
    #[pyo3(signature = (*, operations, parameters, rates, forced, clock, units, scales=Vec::new(), signs=Vec::new()))]
    fn new(
        operations: Vec<Op>,
        parameters: usize,
        rates: Vec<usize>,
        forced: bool,
        clock: usize,
        units: Vec<Vec<Vec<Leave<usize>>>>,
        scales: Vec<Option<usize>>,
        signs: Vec<usize>,
    ) -> PyResult<Self> {
        let definition = Definition {
            ops: operations,
            parameters,
            rates,
            scales,
            clock: if forced {
                Clock::Forcing(clock)
            } else {
                Clock::Interval(clock)
            },
            units,
            signs,
        };
        let blueprint = sound(|| lower(&definition).map_err(of_definition))?;
        Ok(Self {
            blueprint: Arc::new(blueprint),
            parameters,
        })
    }

    /// Number of quantities that it computes beside its states.
    #[getter]
    fn quantities(&self) -> usize {
        self.blueprint.made
    }

    /// The forcing period, or the interval, for each row of parameters.
    fn periods(&self, parameters: PyReadonlyArray2<'_, f64>) -> PyResult<Vec<f64>> {
        let parameters = parameters.as_array();
        let row = |row: numpy::ndarray::ArrayView1<'_, f64>| {
            if row.len() != self.parameters {
                return Err(of_definition("a row needs a value of each parameter"));
            }
            let system = self
                .blueprint
                .system(&row.to_vec())
                .map_err(of_definition)?;
            Ok(system.period())
        };
        sound(|| parameters.rows().into_iter().map(row).collect())
    }

    /// Runs every member and keeps its samples.
    #[pyo3(signature = (*, parameters, starts, modes, periods, transient, per_period, switches, settings, progress))]
    #[expect(clippy::too_many_arguments, reason = "named in Python")]
    fn integrate(
        &self,
        py: Python<'_>,
        parameters: PyReadonlyArray2<'_, f64>,
        starts: PyReadonlyArray2<'_, f64>,
        modes: PyReadonlyArray2<'_, u8>,
        periods: u64,
        transient: u64,
        per_period: usize,
        switches: bool,
        settings: Settings,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Trajectories> {
        let members = self.members(&parameters, &starts, &modes)?;
        let plan = Plan {
            periods,
            transient,
            per_period,
            switches,
        };
        let progress = Counting {
            call: progress,
            what: "integrating",
            total: Some(plan.work(&members)),
        };
        ensemble::run(py, &self.blueprint, members, plan, settings, &progress)
    }

    /// The periodic orbit near one start for each of its periods, or near the orbit of a single start.
    #[pyo3(signature = (*, parameters, starts, modes, period, tolerance, iterations, settings))]
    #[expect(clippy::too_many_arguments, reason = "named in Python")]
    fn find_orbit(
        &self,
        py: Python<'_>,
        parameters: PyReadonlyArray2<'_, f64>,
        starts: PyReadonlyArray2<'_, f64>,
        modes: PyReadonlyArray2<'_, u8>,
        period: usize,
        tolerance: f64,
        iterations: usize,
        settings: Settings,
    ) -> PyResult<Orbit> {
        let members = self.members(&parameters, &starts, &modes)?;
        let search = Search {
            period,
            tolerance,
            iterations,
        };
        orbit::find(py, &self.blueprint, members, search, settings)
    }

    /// The largest exponents of every member.
    #[pyo3(signature = (*, parameters, starts, modes, periods, transient, count, settings, progress))]
    #[expect(clippy::too_many_arguments, reason = "named in Python")]
    fn lyapunov(
        &self,
        py: Python<'_>,
        parameters: PyReadonlyArray2<'_, f64>,
        starts: PyReadonlyArray2<'_, f64>,
        modes: PyReadonlyArray2<'_, u8>,
        periods: u64,
        transient: u64,
        count: usize,
        settings: Settings,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Exponents> {
        let members = self.members(&parameters, &starts, &modes)?;
        let progress = Counting {
            call: progress,
            what: "exponents",
            total: Some((periods + transient).saturating_mul(members.count as u64)),
        };
        let length = (transient, periods);
        exponents::run(
            py,
            &self.blueprint,
            members,
            length,
            count,
            settings,
            &progress,
        )
    }
}
