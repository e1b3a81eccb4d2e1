//! Many trajectories of a system, kept as arrays.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use numpy::{IntoPyArray, PyArray1};
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use saltus_hybrid::{
    End, IntegrateError, Options, Sample, Segment, Switch, SwitchKind, System, Task, integrate_all,
};

use super::blueprint::Blueprint;
use super::input::Settings;
use super::members::Members;
use crate::error::{of_computation, of_definition};
use crate::running::{Counting, run as run_beside};

/// Length of the runs, and the samples to keep.
pub(crate) struct Plan {
    pub(crate) periods: u64,
    /// Periods before, of which nothing is kept.
    pub(crate) transient: u64,
    /// Samples in each period, the last at its end.
    pub(crate) per_period: usize,
    pub(crate) switches: bool,
}

impl Plan {
    /// Periods to run, of all members together.
    pub(crate) fn work(&self, members: &Members) -> u64 {
        (self.periods.saturating_add(self.transient)).saturating_mul(members.count as u64)
    }
}

/// Trajectories as flat arrays, in the order of the members.
#[pyclass(frozen, get_all, module = "saltus._native")]
pub(crate) struct Trajectories {
    /// (members, samples, states); NaN where a trajectory had ended.
    samples: Py<PyArray1<f64>>,
    /// (members, samples, units).
    modes: Py<PyArray1<u8>>,
    /// (members, states), where each ended.
    end: Py<PyArray1<f64>>,
    /// (members, units).
    end_modes: Py<PyArray1<u8>>,
    /// Periods completed, of each member.
    periods: Py<PyArray1<u64>>,
    steps: Py<PyArray1<u64>>,
    /// Ending of each, as a word and a sentence.
    status: Vec<(String, String)>,
    /// Of each switch: its member,
    switch_member: Py<PyArray1<u64>>,
    /// time since the start,
    switch_time: Py<PyArray1<f64>>,
    /// unit,
    switch_unit: Py<PyArray1<u8>>,
    /// mode left,
    switch_source: Py<PyArray1<u8>>,
    /// mode entered,
    switch_target: Py<PyArray1<u8>>,
    /// and state just before: (switches, states).
    switch_state: Py<PyArray1<f64>>,
}

/// Runs every member.
pub(crate) fn run(
    py: Python<'_>,
    blueprint: &Arc<Blueprint>,
    members: Members,
    plan: Plan,
    settings: Settings,
    progress: &Counting<'_>,
) -> PyResult<Trajectories> {
    let blueprint = Arc::clone(blueprint);
    let (states, units) = (blueprint.states(), blueprint.units.len());
    let rows = usize::try_from(plan.periods)
        .ok()
        .and_then(|periods| periods.checked_mul(plan.per_period))
        .ok_or_else(too_much)?;
    let mut samples = filled(f64::NAN, members.count, rows, states)?;
    let mut modes = filled(0u8, members.count, rows, units)?;
    let samples_per_period = u32::try_from(plan.per_period).map_err(|_| too_much())?;
    let options = Options {
        samples_per_period,
        ..settings.options()
    };
    let work = move |stop: &AtomicBool, done: &AtomicU64| {
        let mut ended = Vec::new();
        if members.count > 0 {
            let first = blueprint
                .system(members.parameters.row(0))
                .map_err(of_definition)?;
            let mut kept = samples.chunks_mut((rows * states).max(1));
            let mut kept_modes = modes.chunks_mut((rows * units).max(1));
            let member = |index: usize| Member {
                blueprint: &blueprint,
                first: &first,
                members: &members,
                index,
                plan: &plan,
                samples: kept.next().unwrap_or_default(),
                modes: kept_modes.next().unwrap_or_default(),
                period: first.period(),
                switches: Switches::default(),
                end: None,
                done,
            };
            let tasks = (0..members.count).map(member).collect();
            let all = integrate_all(&options, tasks, settings.threads, stop).map_err(of_run)?;
            ended.extend(all.into_iter().map(|m| (m.switches, m.end)));
        }
        Ok((ended, samples, modes))
    };
    let (ended, samples, modes) = run_beside(py, progress, work)?;
    collect(py, ended, states, samples, modes)
}

fn of_run(error: IntegrateError) -> PyErr {
    match error {
        IntegrateError::Option { .. } => pyo3::exceptions::PyValueError::new_err(error.to_string()),
        other => of_computation(other),
    }
}

fn too_much() -> PyErr {
    PyMemoryError::new_err("the samples do not fit into memory: keep fewer of them")
}

fn filled<T: Copy>(value: T, members: usize, rows: usize, width: usize) -> PyResult<Vec<T>> {
    let length = members.checked_mul(rows).and_then(|n| n.checked_mul(width));
    let length = length.ok_or_else(too_much)?;
    let mut out = Vec::new();
    out.try_reserve_exact(length).map_err(|_| too_much())?;
    out.resize(length, value);
    Ok(out)
}

/// The switches of a trajectory.
#[derive(Default)]
struct Switches {
    time: Vec<f64>,
    unit: Vec<u8>,
    source: Vec<u8>,
    target: Vec<u8>,
    state: Vec<f64>,
}

type Ended = (Switches, Option<End>);

fn collect(
    py: Python<'_>,
    ended: Vec<Ended>,
    states: usize,
    samples: Vec<f64>,
    modes: Vec<u8>,
) -> PyResult<Trajectories> {
    let mut all = Switches::default();
    let (mut member, mut end, mut end_modes) = (Vec::new(), Vec::new(), Vec::new());
    let (mut periods, mut steps, mut status) = (Vec::new(), Vec::new(), Vec::new());
    for (index, (mut switches, how)) in ended.into_iter().enumerate() {
        member.resize(member.len() + switches.time.len(), index as u64);
        all.time.append(&mut switches.time);
        all.unit.append(&mut switches.unit);
        all.source.append(&mut switches.source);
        all.target.append(&mut switches.target);
        all.state.append(&mut switches.state);
        let how = how.ok_or_else(|| of_computation(format!("member {index} did not run")))?;
        end.extend_from_slice(&how.point.x[..states]);
        end_modes.extend(how.point.modes.iter().map(|&mode| mode as u8));
        periods.push(how.periods);
        steps.push(how.steps);
        status.push((how.status.name().to_owned(), how.status.to_string()));
    }
    Ok(Trajectories {
        samples: samples.into_pyarray(py).unbind(),
        modes: modes.into_pyarray(py).unbind(),
        end: end.into_pyarray(py).unbind(),
        end_modes: end_modes.into_pyarray(py).unbind(),
        periods: periods.into_pyarray(py).unbind(),
        steps: steps.into_pyarray(py).unbind(),
        status,
        switch_member: member.into_pyarray(py).unbind(),
        switch_time: all.time.into_pyarray(py).unbind(),
        switch_unit: all.unit.into_pyarray(py).unbind(),
        switch_source: all.source.into_pyarray(py).unbind(),
        switch_target: all.target.into_pyarray(py).unbind(),
        switch_state: all.state.into_pyarray(py).unbind(),
    })
}

/// One trajectory and its samples.
struct Member<'a> {
    blueprint: &'a Blueprint,
    first: &'a System,
    members: &'a Members,
    index: usize,
    plan: &'a Plan,
    samples: &'a mut [f64],
    modes: &'a mut [u8],
    period: f64,
    switches: Switches,
    end: Option<End>,
    done: &'a AtomicU64,
}

impl Member<'_> {
    fn keep_modes(&mut self, place: usize, modes: &[usize]) {
        let into = self.modes.chunks_exact_mut(modes.len().max(1)).nth(place);
        for (out, &mode) in into.into_iter().flatten().zip(modes) {
            *out = mode as u8;
        }
    }

    fn sample_at(&mut self, place: usize) -> &mut [f64] {
        let states = self.blueprint.states();
        &mut self.samples[place * states..(place + 1) * states]
    }
}

impl Task for Member<'_> {
    fn begin(&mut self) -> Option<Segment> {
        let parameters = self.members.parameters.row(self.index);
        let system = if parameters.is_empty() {
            self.first.clone()
        } else {
            self.blueprint.system(parameters).ok()?.sharing(self.first)
        };
        self.period = system.period();
        let modes = self.members.modes.row(self.index);
        Some(Segment {
            start: system.point(modes, self.members.starts.row(self.index)),
            system,
            periods: self.plan.transient + self.plan.periods,
        })
    }

    fn sample(&mut self, sample: &Sample<'_>) -> bool {
        let per_period = self.plan.per_period;
        if let Some(kept) = (sample.period - 1).checked_sub(self.plan.transient) {
            let place = kept as usize * per_period + sample.part as usize - 1;
            let states = self.blueprint.states();
            self.sample_at(place).copy_from_slice(&sample.x[..states]);
            self.keep_modes(place, sample.modes);
        }
        if sample.part as usize == per_period {
            self.done.fetch_add(1, Ordering::Relaxed);
        }
        true
    }

    fn switch(&mut self, switch: &Switch<'_>) {
        if let SwitchKind::Mode { from, to } = switch.kind
            && self.plan.switches
            && switch.period >= self.plan.transient
        {
            let time = switch.period as f64 * self.period + switch.time;
            self.switches.time.push(time);
            self.switches.unit.push(switch.unit as u8);
            self.switches.source.push(from as u8);
            self.switches.target.push(to as u8);
            let states = self.blueprint.states();
            self.switches.state.extend_from_slice(&switch.x[..states]);
        }
    }

    fn end(&mut self, end: End) -> Option<Segment> {
        let left = self.plan.transient + self.plan.periods - end.periods;
        self.done.fetch_add(left, Ordering::Relaxed);
        self.end = Some(end);
        None
    }
}
