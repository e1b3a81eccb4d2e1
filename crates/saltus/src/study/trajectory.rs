//! One trajectory in full: section, switches, time history, energies.

use saltus_hybrid::{
    End, Evaluator, Point, Sample, Segment, Status, Step, Switch, SwitchKind, Task, integrate,
};

use saltus_study::{Control, Peaks};

use super::StudyError;
use crate::model::{Contact, EnergyBalance, Model, Observation, Probe, Section};

/// A change of contact, or a tangency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrajectorySwitch {
    /// Time since the start (s).
    pub time: f64,
    /// Number of the jumper, from 0.
    pub jumper: usize,
    /// The contact entered; `None` for a tangency, where the contact force touches its threshold
    /// and does not cross it.
    pub into: Option<Contact>,
}

/// Observations along a trajectory.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History {
    /// Times since the start (s).
    pub time: Vec<f64>,
    /// Observation at each.
    pub states: Vec<Observation>,
}

/// Instants of a time history.
#[derive(Clone, Debug, PartialEq)]
pub enum Instants {
    /// Equal times in the last periods, from the beginning of each.
    Last {
        /// Periods covered.
        periods: u64,
        /// Points in each.
        points: u32,
    },
    /// These times since the start (s), rising; those after the end of the run are left out.
    At(Vec<f64>),
}

/// Everything about one trajectory.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    /// The section at the end of each period (cos(Omega t) = 1), the start not included.
    pub section: Vec<Section>,
    /// Switches in time order.
    pub switches: Vec<TrajectorySwitch>,
    /// Time history at the instants asked for.
    pub history: History,
    /// Largest plate reaction force on each body, in units of its weight, from the period in which the time history
    /// begins on; from the dense output, so it does not depend on the points of the history. None if the run ended
    /// before it.
    pub peak_reaction: Vec<f64>,
    /// Part of the time each body spent on the floor, period by period.
    pub contact_ratio: Vec<Vec<f64>>,
    /// Energy balance of each period, if the model keeps it.
    pub energy: Vec<EnergyBalance>,
    /// End of the run.
    pub end: End,
}

/// Runs `periods` periods from `start`; the time history covers the last `history` of them with
/// `points` points each.
///
/// # Errors
/// [`StudyError::Integrate`] for options out of range or when stopped.
pub fn simulate(
    model: &Model,
    start: &Point,
    periods: u64,
    history: u64,
    points: u32,
    control: &Control,
) -> Result<Trajectory, StudyError> {
    let instants = Instants::Last {
        periods: history,
        points,
    };
    simulate_at(model, start, periods, instants, control)
}

/// As [`simulate`], with the time history at `instants`: states of the solution's own polynomials, not of an
/// interpolation between steps.
///
/// # Errors
/// As [`simulate`].
pub fn simulate_at(
    model: &Model,
    start: &Point,
    periods: u64,
    instants: Instants,
    control: &Control,
) -> Result<Trajectory, StudyError> {
    model.check_step(&control.options)?;
    let omega = model.scales().omega;
    let from = match &instants {
        Instants::Last {
            periods: history, ..
        } => periods.saturating_sub(*history),
        Instants::At(times) => times.first().map_or(periods, |first| {
            (first * omega / model.system().period()).floor() as u64
        }),
    };
    let bodies = model.setup().jumpers.len();
    let task = Recorder {
        model,
        control,
        probe: model.probe(),
        peaks: Peaks::new(bodies, model.system().state_len()),
        evaluator: model.evaluator(),
        segment: Some(Segment {
            system: model.system().clone(),
            start: start.clone(),
            periods,
        }),
        from,
        instants,
        next: 0,
        before: start.clone(),
        out: Trajectory {
            section: Vec::new(),
            switches: Vec::new(),
            history: History::default(),
            peak_reaction: Vec::new(),
            contact_ratio: Vec::new(),
            energy: Vec::new(),
            end: End {
                status: Status::Completed,
                point: start.clone(),
                periods: 0,
                steps: 0,
                switches: 0,
                tangencies: 0,
            },
        },
    };
    let mut out = None;
    integrate(&control.options, [task], &control.stop, |task| {
        out = Some(task.out);
    })?;
    out.ok_or(StudyError::Integrate(
        saltus_hybrid::IntegrateError::Interrupted,
    ))
}

struct Recorder<'a> {
    model: &'a Model,
    control: &'a Control,
    evaluator: Evaluator,
    probe: Probe,
    peaks: Peaks,
    segment: Option<Segment>,
    /// First period of the history.
    from: u64,
    instants: Instants,
    /// Number of the next instant: within the period, or among the times.
    next: usize,
    before: Point,
    out: Trajectory,
}

impl Recorder<'_> {
    fn seconds(&self, period: u64, time: f64) -> f64 {
        (period as f64 * self.model.system().period() + time) / self.model.scales().omega
    }

    /// The next instant: time within the period of `step`, in units of the model, and time since the start (s).
    fn instant(&self, step: &Step<'_>) -> Option<(f64, f64)> {
        let period = self.model.system().period();
        match &self.instants {
            Instants::Last { points, .. } => (self.next < *points as usize).then(|| {
                let within = self.next as f64 * (period / f64::from(*points));
                (within, self.seconds(step.period, within))
            }),
            Instants::At(times) => times.get(self.next).map(|&time| {
                let within = time * self.model.scales().omega - step.period as f64 * period;
                (within, time)
            }),
        }
    }
}

impl Task for Recorder<'_> {
    fn begin(&mut self) -> Option<Segment> {
        self.segment.take()
    }

    fn sample(&mut self, sample: &Sample<'_>) -> bool {
        self.control.count_period();
        let period = self.model.system().period();
        self.out
            .section
            .push(self.model.section(sample.modes, sample.x));
        let stance = |dwell: &Vec<f64>| {
            let on_floor = |&(mode, _): &(usize, &f64)| Contact::of(mode) == Contact::Stance;
            dwell
                .iter()
                .enumerate()
                .filter(on_floor)
                .map(|(_, t)| t)
                .sum::<f64>()
                / period
        };
        self.out
            .contact_ratio
            .push(sample.dwell.iter().map(stance).collect());
        let point = Point {
            modes: sample.modes.to_vec(),
            x: sample.x.to_vec(),
        };
        self.out
            .energy
            .extend(self.model.energy_balance(&self.before, &point));
        self.before = point;
        if matches!(self.instants, Instants::Last { .. }) {
            self.next = 0;
        }
        true
    }

    fn switch(&mut self, switch: &Switch<'_>) {
        let into = match switch.kind {
            SwitchKind::Tangency => None,
            SwitchKind::Mode { from, to } => {
                let (from, to) = (Contact::of(from), Contact::of(to));
                if from == to {
                    return; // the gap law's two kinds of flight
                }
                Some(to)
            }
        };
        let time = self.seconds(switch.period, switch.time);
        self.out.switches.push(TrajectorySwitch {
            time,
            jumper: switch.unit,
            into,
        });
    }

    fn wants_steps(&self) -> bool {
        true
    }

    fn step(&mut self, step: &Step<'_>) {
        if step.period < self.from {
            return;
        }
        let mut x = vec![0.0; self.model.system().state_len()];
        // Half open like the steps themselves: each point belongs to one step.
        while let Some((within, time)) = self.instant(step) {
            let since = within - step.time;
            if since >= step.length {
                break;
            }
            step.state(since.max(0.0), &mut x);
            let seen = self.model.observe(&mut self.evaluator, step.modes, &x);
            self.out.history.time.push(time);
            self.out.history.states.push(seen);
            self.next += 1;
        }
        let probe = &mut self.probe;
        self.peaks.step(step, |x, out| {
            out.copy_from_slice(probe.reading(step.modes, x).reaction);
        });
        self.out.peak_reaction.clone_from(&self.peaks.largest);
    }

    fn end(&mut self, end: End) -> Option<Segment> {
        // steps are half open, and the end of the run belongs to none
        if let Instants::At(times) = &self.instants
            && let Some(&time) = times.get(self.next)
            && (self.seconds(end.periods, 0.0) - time).abs() <= f64::EPSILON * time
        {
            let (modes, x) = (&end.point.modes, &end.point.x);
            self.out.history.time.push(time);
            let seen = self.model.observe(&mut self.evaluator, modes, x);
            self.out.history.states.push(seen);
        }
        self.out.end = end;
        None
    }
}
