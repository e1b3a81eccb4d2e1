//! People on a plate as what questions are asked of: z and v of each are the channels of the section, contact with the
//! floor is the contact, and the peaks are the floor's acceleration and the plate reaction forces.

use saltus_hybrid::{Mode, Options, Point, System};
use saltus_study::{Attractor, Range, Subject};

use crate::model::{Contact, Model, ModelError, Probe};
use crate::physics::PhysicsError;

/// Errors of a study that has no answer.
pub type StudyError = saltus_study::StudyError<ModelError>;
/// Motion that a start leads to.
pub type Found = saltus_study::Found<ModelError>;
/// Reasons why there is no long-term motion.
pub type Lost = saltus_study::Lost<ModelError>;
/// Ends of all starts of a box.
pub type AttractorCensus = saltus_study::AttractorCensus<ModelError>;
/// The attractors at one value of a parameter.
pub type Row = saltus_study::Row<ModelError>;
/// The attractors along a parameter.
pub type ContinuedAttractors = saltus_study::ContinuedAttractors<ModelError>;
/// A sweep; a start is (z/eta, z'/(eta omega_h)) of every body, with the plate at rest.
pub type Sweep = saltus_study::Sweep<(f64, f64)>;
/// One way through the values of a sweep.
pub type Pass = saltus_study::Pass<(f64, f64)>;
/// Samples and status at one value in one pass.
pub type SweepRow = saltus_study::SweepRow<ModelError>;
/// Reasons why no orbit was found.
pub type OrbitError = saltus_study::OrbitError<ModelError>;

impl From<ModelError> for StudyError {
    fn from(error: ModelError) -> Self {
        Self::Model(error)
    }
}

impl From<PhysicsError> for StudyError {
    fn from(error: PhysicsError) -> Self {
        Self::Model(error.into())
    }
}

impl Subject for Model {
    type NoModel = ModelError;
    type Start = (f64, f64);
    type Probe = Probe;

    fn system(&self) -> &System {
        self.system()
    }

    fn set_system(&mut self, system: System) {
        self.replace_system(system);
    }

    fn check(&self, options: &Options) -> Result<(), ModelError> {
        self.check_step(options)
    }

    fn is_like(&self, other: &Self) -> bool {
        self.layout == other.layout
    }

    fn carry(&self, other: &Self, point: &Point) -> Point {
        self.carry(other, point)
    }

    fn start(&self, &(z, v): &(f64, f64)) -> Point {
        self.start(z, v)
    }

    fn channels(&self) -> usize {
        2 * self.layout.jumpers
    }

    fn channel(&self, channel: usize, x: &[f64]) -> f64 {
        match channel.checked_sub(self.layout.jumpers) {
            None => self.z(channel, x),
            Some(body) => self.v(body, x),
        }
    }

    /// z and v of each body, then r_j and r_j', then what a leg remembers.
    fn width(&self) -> usize {
        let layout = self.layout;
        let legs = if layout.legs { layout.jumpers } else { 0 };
        2 * (layout.jumpers + layout.transverse) + legs
    }

    /// In units of eta and eta omega_h of its body, those of the plate of the first one. In-plane amplitudes are left
    /// out: they follow the others.
    fn coordinates(&self, x: &[f64], row: &mut [f64]) {
        let (layout, scales) = (self.layout, &self.scales);
        let first = scales.jumpers.first();
        let (length, speed) = first.map_or((1.0, 1.0), |unit| {
            let speed = scales.velocity() / unit.velocity;
            (scales.length / unit.position, speed)
        });
        let bodies = 0..layout.jumpers;
        let values = (0..self.channels())
            .map(|channel| self.channel(channel, x))
            .chain((0..layout.transverse).map(|j| x[layout.r(j)] * length))
            .chain((0..layout.transverse).map(|j| x[layout.dr(j)] * speed))
            .chain(
                bodies
                    .filter(|_| layout.legs)
                    .map(|i| x[layout.leg(i)] * length),
            );
        for (out, value) in row.iter_mut().zip(values) {
            *out = value;
        }
    }

    fn contacts(&self) -> usize {
        self.layout.jumpers
    }

    fn touches(&self, _: usize, mode: Mode) -> bool {
        Contact::of(mode) == Contact::Stance
    }

    /// Acceleration of the floor under the first body (m/s^2), then the reaction on each body in units of its weight.
    fn peaks(&self) -> usize {
        1 + self.layout.jumpers
    }

    fn probe(&self) -> Probe {
        self.probe()
    }

    fn divergence(&self, dwell: &[Vec<f64>]) -> f64 {
        self.divergence(dwell)
    }
}

impl saltus_study::Probe for Probe {
    fn read(&mut self, modes: &[Mode], x: &[f64], out: &mut [f64]) {
        let reading = self.reading(modes, x);
        out[0] = reading.floor.first().map_or(0.0, |a| a.abs());
        out[1..].copy_from_slice(reading.reaction);
    }
}

/// A section of people, in which z of all bodies come first and then v of all.
pub trait Bodies {
    /// All channels.
    fn channels(&self) -> &[Vec<f64>];

    /// z/eta, body by body: `z()[body][sample]`.
    fn z(&self) -> &[Vec<f64>] {
        let all = self.channels();
        &all[..all.len() / 2]
    }

    /// z'/(eta omega_h) likewise.
    fn v(&self) -> &[Vec<f64>] {
        let all = self.channels();
        &all[all.len() / 2..]
    }
}

impl Bodies for SweepRow {
    fn channels(&self) -> &[Vec<f64>] {
        &self.section
    }
}

impl Bodies for Attractor {
    fn channels(&self) -> &[Vec<f64>] {
        &self.section
    }
}

impl Bodies for saltus_study::Arrival {
    fn channels(&self) -> &[Vec<f64>] {
        &self.section
    }
}

impl Bodies for saltus_study::Settled {
    fn channels(&self) -> &[Vec<f64>] {
        &self.section
    }
}

/// Effects of a motion on people and floor.
pub trait Effects {
    /// Largest absolute vertical acceleration of the floor under the first body, base motion included (m/s^2); 0
    /// without people.
    fn peak_acceleration(&self) -> f64;

    /// Largest plate reaction force on each body, in units of its weight.
    fn peak_reaction(&self) -> &[f64];

    /// Ranges of z and v of a body at the recorded samples.
    fn range(&self, body: usize) -> (Range, Range);
}

impl Effects for Attractor {
    fn peak_acceleration(&self) -> f64 {
        self.peaks[0]
    }

    fn peak_reaction(&self) -> &[f64] {
        &self.peaks[1..]
    }

    fn range(&self, body: usize) -> (Range, Range) {
        (self.ranges[body], self.ranges[self.ranges.len() / 2 + body])
    }
}
