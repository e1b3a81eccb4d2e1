//! The effect of a motion on floor and people, period by period.

use saltus_hybrid::{End, Point, Sample, Segment, Step, Task, integrate};
use saltus_orbits::{MapPoint, MotionKind, Orbit};

use super::attractor::{Arrival, Attractor, Range};
use super::peaks::Peaks;
use super::{Control, point};
use crate::model::{Contact, Model, Probe};

/// Record of a motion, period by period.
pub(super) struct Recording {
    probe: Probe,
    peaks: Peaks,
    /// Time of each body on the floor.
    stance: Vec<Vec<f64>>,
    /// Largest floor acceleration, and reaction of each body.
    tops: Vec<Vec<f64>>,
    /// Of z and v of each body at the samples.
    ranges: Vec<(Range, Range)>,
}

impl Recording {
    pub(super) fn new(model: &Model) -> Self {
        let bodies = model.setup().jumpers.len();
        Self {
            probe: model.probe(),
            peaks: Peaks::new(1 + bodies, model.system().state_len()),
            stance: Vec::new(),
            tops: Vec::new(),
            ranges: vec![(NOTHING, NOTHING); bodies],
        }
    }

    pub(super) fn step(&mut self, step: &Step<'_>) {
        let probe = &mut self.probe;
        self.peaks.step(step, |x, out| {
            let reading = probe.read(step.modes, x);
            out[0] = reading.floor.first().map_or(0.0, |a| a.abs());
            out[1..].copy_from_slice(reading.reaction);
        });
    }

    pub(super) fn end_period(&mut self, model: &Model, sample: &Sample<'_>) {
        for (body, (z, v)) in self.ranges.iter_mut().enumerate() {
            *z = widened(*z, model.z(body, sample.x));
            *v = widened(*v, model.v(body, sample.x));
        }
        let on_floor = |&(mode, _): &(usize, &f64)| Contact::of(mode) == Contact::Stance;
        let stance = |dwell: &Vec<f64>| -> f64 {
            let times = dwell.iter().enumerate().filter(on_floor);
            times.map(|(_, time)| time).sum()
        };
        self.stance.push(sample.dwell.iter().map(stance).collect());
        self.tops.push(self.peaks.largest.clone());
        self.peaks.clear();
    }

    /// Periods recorded.
    pub(super) fn periods(&self) -> usize {
        self.stance.len()
    }

    /// A motion of this kind with this section, `section[body][sample]`.
    pub(super) fn motion(
        &self,
        model: &Model,
        kind: MotionKind,
        section: &[Vec<[f64; 2]>],
    ) -> Attractor {
        let recorded = self.periods();
        // whole cycles only, the last ones
        let used = match kind {
            MotionKind::Periodic(n) if n as usize <= recorded => recorded - recorded % n as usize,
            _ => recorded,
        };
        let last = recorded - used..recorded;
        let (stance, tops) = (&self.stance[last.clone()], &self.tops[last]);
        let bodies = model.setup().jumpers.len();
        let time = used as f64 * model.system().period();
        let on_floor = |body: usize| stance.iter().map(|s| s[body]).sum::<f64>() / time;
        let top = |channel: usize| {
            tops.iter()
                .fold(0.0, |most: f64, top| most.max(top[channel]))
        };
        let of_cycle = |part: usize| -> Vec<Vec<f64>> {
            let samples = |body: &Vec<[f64; 2]>| match kind {
                MotionKind::Periodic(_) => body.iter().map(|sample| sample[part]).collect(),
                _ => Vec::new(),
            };
            section.iter().map(samples).collect()
        };
        Attractor {
            kind,
            contact_ratio: (0..bodies).map(on_floor).collect(),
            peak_reaction: (0..bodies).map(|body| top(1 + body)).collect(),
            peak_acceleration: top(0),
            z: of_cycle(0),
            v: of_cycle(1),
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

pub(super) fn rounded(x: f64) -> f64 {
    (x * GRID).round() / GRID
}

/// The motion on a cycle, recorded once around; it ends at the first place of the orbit. `None` if stopped, or if
/// the cycle cannot be run at the tolerance of `control`.
pub(super) fn around(
    model: &Model,
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
    let body = |i: usize| {
        let sample = |point: &Point| [model.z(i, &point.x), model.v(i, &point.x)];
        points.iter().map(sample).collect()
    };
    let section: Vec<Vec<[f64; 2]>> = (0..model.setup().jumpers.len()).map(body).collect();
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
struct Lap<'a> {
    model: &'a Model,
    segment: Option<Segment>,
    recording: Recording,
}

impl Task for Lap<'_> {
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
