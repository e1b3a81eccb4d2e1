//! A long-term motion, and what is known of the start that leads to it.

use saltus_hybrid::{Point, Status};
use saltus_orbits::{Exponent, MotionKind};

use crate::model::ModelError;

/// Motion that a start leads to.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The long-term motion, or why there is none.
    pub attractor: Result<Attractor, Lost>,
    /// Forcing periods run in all.
    pub periods: u64,
    /// State that the start has arrived at; `None` if there is no long-term motion.
    pub arrival: Option<Arrival>,
}

impl Found {
    /// The last state of a motion that is undecided, to go on from.
    pub(super) fn undecided_at(&self) -> Option<&Point> {
        let motion = self.attractor.as_ref().ok()?;
        let arrival = self.arrival.as_ref()?;
        (motion.kind == MotionKind::Undecided).then_some(&arrival.point)
    }

    /// Whether there is a motion, and no period of it is known.
    pub(super) fn has_no_period(&self) -> bool {
        let kind = self.attractor.as_ref().map(|motion| motion.kind);
        matches!(kind, Ok(MotionKind::NotPeriodic | MotionKind::Undecided))
    }

    pub(super) fn is_chaotic(&self) -> bool {
        let kind = self.attractor.as_ref().map(|motion| motion.kind);
        kind == Ok(MotionKind::Chaotic)
    }

    /// This chaotic motion, run on to what `later` says: still without a period, or not.
    pub(super) fn followed_by(&self, later: Self) -> Self {
        let periods = self.periods + later.periods;
        let chaotic =
            matches!(&later.attractor, Ok(motion) if motion.kind == MotionKind::NotPeriodic);
        Self {
            periods,
            attractor: if chaotic {
                self.attractor.clone()
            } else {
                later.attractor
            },
            arrival: later.arrival,
        }
    }
}

/// Arrival of a start: all it takes to draw the motion and to go on from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrival {
    /// The last state, at phase 0.
    pub point: Point,
    /// The last samples, [z/eta, z'/(eta omega_h)]: `section[body][sample]`. Of a cycle, each of its points
    /// once; otherwise what was recorded, 256 at most.
    pub section: Vec<Vec<[f64; 2]>>,
}

/// Reasons why there is no long-term motion.
#[derive(Clone, Debug, PartialEq)]
pub enum Lost {
    /// There is no model at this place.
    NoModel(ModelError),
    /// The run ended early; never [`Status::Completed`].
    Ended(Status),
}

/// Smallest and largest value.
pub type Range = [f64; 2];

/// A long-term motion, and what it does to floor and people.
#[derive(Clone, Debug, PartialEq)]
pub struct Attractor {
    /// Kind of the motion.
    pub kind: MotionKind,
    /// Part of the time on the floor, of each body.
    pub contact_ratio: Vec<f64>,
    /// Largest plate reaction force on each body, in units of its weight.
    pub peak_reaction: Vec<f64>,
    /// Largest absolute vertical acceleration of the floor under the first body, base motion
    /// included (m/s^2); 0 without people.
    pub peak_acceleration: f64,
    /// Section of a cycle, z/eta body by body: `z[body][sample]`. No samples if not periodic.
    pub z: Vec<Vec<f64>>,
    /// z'/(eta omega_h) likewise.
    pub v: Vec<Vec<f64>>,
    /// Ranges of z and v of each body at the recorded samples.
    pub ranges: Vec<(Range, Range)>,
    /// Bound on what is left of the transient (eta); 0 if not periodic, and of a cycle that Newton's method gave.
    pub rest: f64,
    /// Largest modulus of the Floquet multipliers of a cycle, below 1, where Newton's method confirmed it.
    pub multiplier: Option<f64>,
    /// The largest Lyapunov exponent (per forcing period), where it took one to say what the motion is.
    pub exponent: Option<Exponent>,
    /// Confidence of the test by which it got its name, or of the sign of the exponent where it is undecided (see
    /// [`saltus_orbits::judge`]); `None` for a cycle known by its returns, whose measure is `rest`.
    pub confidence: Option<f64>,
}
