//! The plainest subject: a system whose section shows its states.

use saltus_hybrid::{BuildError, Mode, Point, System};

use crate::subject::{Probe, Starts, Subject};
use crate::{Range, spread};

/// A system of the engine, with its states as the channels of the section.
///
/// ```
/// use saltus_hybrid::SystemBuilder;
/// use saltus_study::Flow;
/// let mut b = SystemBuilder::new(2);
/// let (x, v) = (b.state(0), b.state(1));
/// let (cos, _) = b.drive(1.2);
/// let pull = b.linear(0.0, &[(-1.0, x), (-0.1, v), (0.3, cos)]);
/// b.derivative(0, v);
/// b.derivative(1, pull);
/// // positions of some millimetres, in metres
/// let oscillator = Flow::new(b.build(0.0)?).scaled(&[1e-3, 1e-3]);
/// # Ok::<(), saltus_hybrid::BuildError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Flow {
    system: System,
    modes: Vec<Mode>,
    channels: Vec<usize>,
    scales: Vec<f64>,
    contacts: Vec<Vec<Mode>>,
}

impl Flow {
    /// A system that starts with each unit in its first mode. All declared states are shown, in units of 1, and no unit
    /// is a contact.
    pub fn new(system: System) -> Self {
        let states = system.declared_len();
        Self {
            modes: vec![0; system.unit_count()],
            channels: (0..states).collect(),
            scales: vec![1.0; states],
            contacts: Vec::new(),
            system,
        }
    }

    /// The same, started with its units in these modes.
    ///
    /// # Panics
    /// If there is not one for each unit.
    #[must_use]
    pub fn started_in(self, modes: &[Mode]) -> Self {
        assert_eq!(
            modes.len(),
            self.system.unit_count(),
            "a mode for each unit"
        );
        Self {
            modes: modes.to_vec(),
            ..self
        }
    }

    /// The same with these states in its section.
    ///
    /// # Panics
    /// If there is no such state.
    #[must_use]
    pub fn showing(self, states: &[usize]) -> Self {
        let known = self.system.declared_len();
        assert!(
            states.iter().all(|&state| state < known),
            "states {states:?} of {known}"
        );
        Self {
            channels: states.to_vec(),
            ..self
        }
    }

    /// The same with a size of each declared state: a thousandth of it is a small difference. Two states are the same
    /// if they agree in all states by that measure.
    ///
    /// # Panics
    /// If there is not one positive number for each declared state.
    #[must_use]
    pub fn scaled(self, scales: &[f64]) -> Self {
        let sizes = scales.iter().all(|&size| size > 0.0 && size.is_finite());
        assert!(
            sizes && scales.len() == self.system.declared_len(),
            "scales {scales:?}: one positive number for each declared state is needed"
        );
        Self {
            scales: scales.to_vec(),
            ..self
        }
    }

    /// The same with the modes of each of the first units that count as contact.
    ///
    /// # Panics
    /// If there are more than units.
    #[must_use]
    pub fn touching(self, contacts: &[&[Mode]]) -> Self {
        assert!(
            contacts.len() <= self.system.unit_count(),
            "contacts are units"
        );
        Self {
            contacts: contacts.iter().map(|modes| modes.to_vec()).collect(),
            ..self
        }
    }
}

impl Subject for Flow {
    type NoModel = BuildError;
    type Start = Vec<f64>;
    type Probe = Nothing;

    fn system(&self) -> &System {
        &self.system
    }

    fn set_system(&mut self, system: System) {
        self.system = system;
    }

    /// The state with these declared states.
    fn start(&self, start: &Vec<f64>) -> Point {
        self.system.point(&self.modes, start)
    }

    fn channels(&self) -> usize {
        self.channels.len()
    }

    fn channel(&self, channel: usize, x: &[f64]) -> f64 {
        x[self.channels[channel]]
    }

    /// The channels, then all states, in units of their sizes.
    fn width(&self) -> usize {
        self.channels.len() + self.scales.len()
    }

    fn coordinates(&self, x: &[f64], row: &mut [f64]) {
        let shown = self.channels.iter().map(|&state| x[state]);
        let all = x.iter().zip(&self.scales).map(|(x, scale)| x / scale);
        for (out, value) in row.iter_mut().zip(shown.chain(all)) {
            *out = value;
        }
    }

    fn contacts(&self) -> usize {
        self.contacts.len()
    }

    fn touches(&self, contact: usize, mode: Mode) -> bool {
        self.contacts[contact].contains(&mode)
    }

    fn peaks(&self) -> usize {
        0
    }

    fn probe(&self) -> Nothing {
        Nothing
    }
}

/// The probe of a subject without peaks.
#[derive(Clone, Copy, Debug)]
pub struct Nothing;

impl Probe for Nothing {
    fn read(&mut self, _: &[Mode], _: &[f64], _: &mut [f64]) {}
}

/// A box of declared states, for subjects that start at these; starts are spread evenly over it ([`spread`]).
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Number of starts.
    pub count: usize,
    /// Range of each declared state; equal ends fix it.
    pub ranges: Vec<Range>,
}

impl<S: Subject<Start = Vec<f64>>> Starts<S> for Region {
    fn count(&self) -> usize {
        self.count
    }

    fn point(&self, subject: &S, number: usize) -> Point {
        let ranges = self.ranges.iter().enumerate();
        let place = |(dimension, [from, to]): (usize, &Range)| {
            from + (to - from) * spread(number, dimension)
        };
        subject.start(&ranges.map(place).collect())
    }
}
