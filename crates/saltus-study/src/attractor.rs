//! A long-term motion, and what is known of the start that leads to it.

use saltus_hybrid::{Point, Status};
use saltus_orbits::{Exponent, MotionKind};

/// Motion that a start leads to.
#[derive(Clone, Debug, PartialEq)]
pub struct Found<E> {
    /// The long-term motion, or why there is none.
    pub attractor: Result<Attractor, Lost<E>>,
    /// Forcing periods run in all.
    pub periods: u64,
    /// State that the start has arrived at; `None` if there is no long-term motion.
    pub arrival: Option<Arrival>,
}

impl<E: Clone> Found<E> {
    /// The last state of a motion that is undecided, to go on from.
    pub(crate) fn undecided_at(&self) -> Option<&Point> {
        let motion = self.attractor.as_ref().ok()?;
        let arrival = self.arrival.as_ref()?;
        (motion.kind == MotionKind::Undecided).then_some(&arrival.point)
    }

    /// Whether there is a motion, and no period of it is known.
    pub(crate) fn has_no_period(&self) -> bool {
        let kind = self.attractor.as_ref().map(|motion| motion.kind);
        matches!(kind, Ok(MotionKind::NotPeriodic | MotionKind::Undecided))
    }

    pub(crate) fn is_chaotic(&self) -> bool {
        let kind = self.attractor.as_ref().map(|motion| motion.kind);
        matches!(kind, Ok(MotionKind::Chaotic))
    }

    /// This chaotic motion, run on to what `later` says: still without a period, or not.
    pub(crate) fn followed_by(&self, later: Self) -> Self {
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
    /// The last samples, channel by channel: `section[channel][sample]`. Of a cycle, each of its points once; otherwise
    /// what was recorded, 256 at most.
    pub section: Vec<Vec<f64>>,
}

/// Reasons why there is no long-term motion.
#[derive(Clone, Debug, PartialEq)]
pub enum Lost<E> {
    /// There is no model at this place.
    NoModel(E),
    /// The run ended early; never [`Status::Completed`].
    Ended(Status),
}

/// Smallest and largest value.
pub type Range = [f64; 2];

/// A long-term motion, and what is seen of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Attractor {
    /// Kind of the motion.
    pub kind: MotionKind,
    /// Part of the time that each contact is closed.
    pub contact_ratio: Vec<f64>,
    /// Largest value of each peak.
    pub peaks: Vec<f64>,
    /// Section of a cycle, channel by channel: `section[channel][sample]`. No samples if not periodic.
    pub section: Vec<Vec<f64>>,
    /// Range of each channel at the recorded samples.
    pub ranges: Vec<Range>,
    /// Bound on what is left of the transient; 0 if not periodic, and of a cycle that Newton's method gave.
    pub rest: f64,
    /// Largest modulus of the Floquet multipliers of a cycle, below 1, where Newton's method confirmed it.
    pub multiplier: Option<f64>,
    /// The largest Lyapunov exponent (per forcing period), where it took one to say what the motion is.
    pub exponent: Option<Exponent>,
    /// Confidence of the test by which it got its name, or of the sign of the exponent where it is undecided (see
    /// [`saltus_orbits::judge`]); `None` for a cycle known by its returns, whose measure is `rest`.
    pub confidence: Option<f64>,
}
