//! Record of what is seen of a motion, period by period.

use saltus_hybrid::{End, Point, Sample, Segment, Step, Task, integrate};
use saltus_orbits::{MapPoint, MotionKind, Orbit};

use crate::attractor::{Arrival, Attractor, Range};
use crate::peaks::Peaks;
use crate::subject::{Probe, Subject};
use crate::{Control, point};

/// Record of a motion, period by period.
pub(crate) struct Recording<S: Subject> {
    probe: S::Probe,
    peaks: Peaks,
    /// Time of each contact.
    contact: Vec<Vec<f64>>,
    /// Largest of each peak.
    tops: Vec<Vec<f64>>,
    /// Of each channel at the samples.
    ranges: Vec<Range>,
}

impl<S: Subject> Recording<S> {
    pub(crate) fn new(model: &S) -> Self {
        Self {
            probe: model.probe(),
            peaks: Peaks::new(model.peaks(), model.system().state_len()),
            contact: Vec::new(),
            tops: Vec::new(),
            ranges: vec![NOTHING; model.channels()],
        }
    }

    pub(crate) fn step(&mut self, step: &Step<'_>) {
        let probe = &mut self.probe;
        self.peaks
            .step(step, |x, out| probe.read(step.modes, x, out));
    }

    pub(crate) fn end_period(&mut self, model: &S, sample: &Sample<'_>) {
        for (channel, range) in self.ranges.iter_mut().enumerate() {
            *range = widened(*range, model.channel(channel, sample.x));
        }
        let contacts = 0..model.contacts();
        let closed = contacts.map(|contact| model.contact_time(contact, sample.dwell));
        self.contact.push(closed.collect());
        self.tops.push(self.peaks.largest.clone());
        self.peaks.clear();
    }

    /// Periods recorded.
    pub(crate) fn periods(&self) -> usize {
        self.tops.len()
    }

    /// A motion of this kind with this section, `section[channel][sample]`.
    pub(crate) fn motion(&self, model: &S, kind: MotionKind, section: &[Vec<f64>]) -> Attractor {
        let recorded = self.periods();
        // whole cycles only, the last ones
        let used = match kind {
            MotionKind::Periodic(n) if n as usize <= recorded => recorded - recorded % n as usize,
            _ => recorded,
        };
        let last = recorded - used..recorded;
        let (contact, tops) = (&self.contact[last.clone()], &self.tops[last]);
        let time = used as f64 * model.system().period();
        let ratio = |number: usize| contact.iter().map(|all| all[number]).sum::<f64>() / time;
        let top = |peak: usize| tops.iter().fold(0.0, |most: f64, top| most.max(top[peak]));
        let of_cycle = |samples: &Vec<f64>| match kind {
            MotionKind::Periodic(_) => samples.clone(),
            _ => Vec::new(),
        };
        Attractor {
            kind,
            contact_ratio: (0..model.contacts()).map(ratio).collect(),
            peaks: (0..model.peaks()).map(top).collect(),
            section: section.iter().map(of_cycle).collect(),
            ranges: self.ranges.clone(),
            rest: 0.0,
            multiplier: None,
            exponent: None,
            confidence: None,
        }
    }
}

const NOTHING: Range = [f64::INFINITY, f64::NEG_INFINITY];

fn widened([low, high]: Range, value: f64) -> Range {
    [low.min(value), high.max(value)]
}

/// Places of an orbit are good to some 1e-12, and so is linear algebra, which rounds otherwise on other processors. What
/// is said of them is rounded to 1 / GRID, so that it is the same there too.
const GRID: f64 = (1_u64 << 30) as f64;

pub(crate) fn rounded(x: f64) -> f64 {
    (x * GRID).round() / GRID
}

/// The motion on a cycle, recorded once around; it ends at the first place of the orbit. `None` if stopped, or if
/// the cycle cannot be run at the tolerance of `control`.
pub(crate) fn around<S: Subject>(
    model: &S,
    orbit: &Orbit,
    control: &Control,
) -> Option<(Attractor, Arrival)> {
    let here = |place: &MapPoint| {
        let x = place.x.iter().copied().map(rounded).collect();
        let modes = place.modes.clone();
        point(model, &MapPoint { modes, x })
    };
    let lap = Lap {
        model,
        segment: Some(Segment {
            system: model.system().clone(),
            start: here(&orbit.places[0]),
            periods: orbit.period() as u64,
        }),
        recording: Recording::new(model),
    };
    let mut ended = None;
    integrate(&control.options, [lap], &control.stop, |lap| {
        ended = Some(lap.recording);
    })
    .ok()?;
    let recording = ended.filter(|recording| recording.periods() == orbit.period())?;
    // in the order of time, the first place last
    let ordered = orbit.places.iter().skip(1).chain(&orbit.places[..1]);
    let points: Vec<Point> = ordered.map(here).collect();
    let channel = |i: usize| {
        points
            .iter()
            .map(|point| model.channel(i, &point.x))
            .collect()
    };
    let section: Vec<Vec<f64>> = (0..model.channels()).map(channel).collect();
    let kind = MotionKind::Periodic(orbit.period() as u32);
    let motion = Attractor {
        multiplier: orbit
            .multipliers
            .first()
            .map(|largest| rounded(largest.modulus())),
        ..recording.motion(model, kind, &section)
    };
    let arrival = Arrival {
        point: points.last()?.clone(),
        section,
    };
    Some((motion, arrival))
}

/// Once around a cycle.
struct Lap<'a, S: Subject> {
    model: &'a S,
    segment: Option<Segment>,
    recording: Recording<S>,
}

impl<S: Subject> Task for Lap<'_, S> {
    fn begin(&mut self) -> Option<Segment> {
        self.segment.take()
    }

    fn sample(&mut self, sample: &Sample<'_>) -> bool {
        self.recording.end_period(self.model, sample);
        true
    }

    fn wants_steps(&self) -> bool {
        true
    }

    fn step(&mut self, step: &Step<'_>) {
        self.recording.step(step);
    }

    fn end(&mut self, _: End) -> Option<Segment> {
        None
    }
}
