//! The subject of questions: a system, and what of it is seen.

use saltus_hybrid::{Mode, Options, Point, System};

/// A system with what its questions show and compare. Cheap to clone: members of a family share their program.
///
/// A section is a list of *channels*, numbers that are read off a state at a sampling instant; a sweep shows them, and
/// attractors are told apart by them. A *contact* is a unit of the system of which a part of the time is told. A *peak*
/// is a quantity whose largest value between samples is kept.
pub trait Subject: Clone + Send + Sync {
    /// Reason why there is no system at some parameters.
    type NoModel: std::error::Error + Clone + PartialEq + Send + Sync + 'static;
    /// A start as people give it.
    type Start: Clone + Send + Sync;
    /// Reads peaks.
    type Probe: Probe;

    /// The system as the engine sees it.
    fn system(&self) -> &System;

    /// Replaces the system by the same one that shares its program with others.
    fn set_system(&mut self, system: System);

    /// Number of states that may be chosen freely.
    fn free_states(&self) -> usize {
        self.system().declared_len()
    }

    /// Whether the stepper can take the system.
    ///
    /// # Errors
    /// A reason that names the option.
    fn check(&self, options: &Options) -> Result<(), Self::NoModel> {
        let _ = options;
        Ok(())
    }

    /// Whether states of the other are states of this one.
    fn is_like(&self, other: &Self) -> bool {
        self.free_states() == other.free_states()
    }

    /// A state of `other` as a state of this one.
    fn carry(&self, other: &Self, point: &Point) -> Point {
        let _ = other;
        point.clone()
    }

    /// The state at a start.
    fn start(&self, start: &Self::Start) -> Point;

    /// Number of channels of the section.
    fn channels(&self) -> usize;

    /// A channel of the section at a state.
    fn channel(&self, channel: usize, x: &[f64]) -> f64;

    /// Numbers by which two states are compared: the channels first, then whatever else a motion must repeat.
    fn width(&self) -> usize;

    /// These numbers at a state, in a scale in which 1e-3 is a small difference.
    fn coordinates(&self, x: &[f64], row: &mut [f64]);

    /// Number of contacts: the first units of the system.
    fn contacts(&self) -> usize;

    /// Whether a mode of a contact counts as contact.
    fn touches(&self, contact: usize, mode: Mode) -> bool;

    /// Number of peaks.
    fn peaks(&self) -> usize;

    /// A probe for peaks.
    fn probe(&self) -> Self::Probe;

    /// Time integral of the divergence of the field over a period, from the time spent in each mode of each unit; NaN
    /// where it is not known.
    fn divergence(&self, dwell: &[Vec<f64>]) -> f64 {
        let _ = dwell;
        f64::NAN
    }

    /// Shares the program of another system; whether it has the same.
    fn share(&mut self, other: &System) -> bool {
        let shared = self.system().clone().sharing(other);
        self.set_system(shared);
        self.system().same_structure(other)
    }

    /// All channels at a state.
    fn section(&self, x: &[f64]) -> Vec<f64> {
        (0..self.channels()).map(|i| self.channel(i, x)).collect()
    }

    /// Part of the time that a contact was closed, from the time spent in its modes.
    fn contact_time(&self, contact: usize, dwell: &[Vec<f64>]) -> f64 {
        let times = dwell[contact].iter().enumerate();
        let closed = times.filter(|&(mode, _)| self.touches(contact, mode));
        closed.map(|(_, time)| time).sum()
    }
}

/// Reads quantities at states, without allocating.
pub trait Probe: Send {
    /// The quantities at a state, into `out`.
    fn read(&mut self, modes: &[Mode], x: &[f64], out: &mut [f64]);
}

/// Starts spread over a box, numbered from 0.
pub trait Starts<S: Subject>: Sync {
    /// Number of starts. Start k is the same for any number.
    fn count(&self) -> usize;

    /// Start `number` for this subject.
    fn point(&self, subject: &S, number: usize) -> Point;
}
