//! From physics to equations of motion, and back to units.
//!
//! A [`Model`] in hand is valid and never changes. Inside it lengths are measured in plate
//! thicknesses h and time in radians of the drive (tau = Omega t); [`Scales`] is the only type that
//! converts. The engine receives a program of sums and products and knows nothing of plates.

mod divergence;
mod elastic;
mod energy;
mod equations;
mod frame;
mod probe;
mod scales;
mod state;

use std::sync::Arc;

use saltus_hybrid::{BuildError, Evaluator, Node, Options, System};

use crate::physics::{Base, ContactLaw, Elasticity, Jumper, PhysicsError, Plate};
use elastic::Stretching;
pub use energy::{EnergyBalance, EnergyLedger};
pub use equations::Contact;
pub use probe::{Probe, Reading};
pub use scales::Scales;
pub use state::{Observation, Section};

/// What to do with the in-plane degrees of freedom.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Inertia {
    /// All degrees of freedom, as DP integrates them: in-plane motion at hundreds of hertz included.
    #[default]
    Full,
    /// In-plane amplitudes follow the transverse ones as oscillators far above the driving frequency do:
    /// statically, and by two terms of their inertia and damping; their free oscillations are lost.
    /// For the paper's plate 20 periods end 2e-10 h from the full ones (at zeta_h 0.45, Omega 0.9; 2e-9 at
    /// 1.1; `tests/main/slow_manifold.rs`), at a twenty-fifth of the cost. At most 9 w terms.
    SlowManifold,
    /// In-plane amplitudes follow statically, p = -K^-1 B r r. For the paper's plate orbits differ
    /// from the full ones by less than 1e-3 eta (4e-6 far from bifurcations, see `tests/main/motion.rs` and
    /// `saltus reproduce`), at some hundredth of the cost.
    Condensed,
}

impl Inertia {
    /// The word used in study files and legends.
    pub fn name(self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::SlowManifold => "slow-manifold",
            Self::Condensed => "condensed",
        }
    }
}

/// Standard gravity as DP uses it (m/s^2).
pub const GRAVITY: f64 = 9.81;

/// A complete physical question in SI units: what stands where on what, and how the base moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    /// The plate.
    pub plate: Plate,
    /// The people; none is the empty plate.
    pub jumpers: Vec<Jumper>,
    /// When feet leave the floor and when they are back.
    pub contact: ContactLaw,
    /// The base motion.
    pub base: Base,
    /// Acceleration of gravity g (m/s^2).
    pub gravity: f64,
    /// Full or condensed.
    pub inertia: Inertia,
}

/// Why there is no model.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    /// The physics makes no sense.
    #[error(transparent)]
    Physics(#[from] PhysicsError),
    /// A contact law that needs damping.
    #[error(
        "jumper.{index}.damping_ratio = 0: contact.law = \"{law}\" needs a damped leg; \
         without damping it is the same as \"reaction-force\""
    )]
    Undamped {
        /// Which jumper.
        index: usize,
        /// The law.
        law: &'static str,
    },
    /// More w terms than the slow manifold is written for.
    #[error(
        "plate.inertia = \"slow-manifold\" with {terms} w terms: at most {limit} are possible; \
         take \"condensed\" or \"full\""
    )]
    SlowManifold {
        /// Terms of the plate.
        terms: usize,
        /// Most possible.
        limit: usize,
    },
    /// More terms and people than a program can hold.
    #[error(
        "plate.modes with {terms} w terms: the equations of motion have {quantities} quantities and \
         at most 65536 are possible; take fewer terms (some 140)"
    )]
    TooLarge {
        /// Transverse terms of the plate.
        terms: usize,
        /// Quantities of the program.
        quantities: usize,
    },
    /// Numbers that combine to something no machine can hold.
    #[error("the equations of motion are out of range ({0}); are the numbers in SI units?")]
    Range(#[from] BuildError),
    /// A fixed step the integration cannot survive.
    #[error(
        "solver.steps_per_period = {steps}: RK4 is unstable above {limit:.3e} s per step for a fastest \
         rate of 2 pi x {hz:.1} Hz; at least {needed} steps are needed (or plate.inertia = \"condensed\")"
    )]
    UnstableStep {
        /// Steps asked for.
        steps: u32,
        /// Largest stable step (s).
        limit: f64,
        /// Fastest linear rate over 2 pi (Hz).
        hz: f64,
        /// Steps needed.
        needed: u32,
    },
}

/// A plate with its coefficients, computed once and shared by all models on it.
#[derive(Clone, Debug)]
pub struct PreparedPlate {
    /// The plate.
    pub plate: Plate,
    /// Its coefficients.
    pub elasticity: Elasticity,
    /// What its stretching contributes to the equations.
    pub(crate) stretching: Stretching,
}

impl PreparedPlate {
    /// Computes all coefficients.
    ///
    /// # Errors
    /// As [`Plate::elasticity`].
    pub fn new(plate: &Plate) -> Result<Arc<Self>, PhysicsError> {
        let elasticity = plate.elasticity()?;
        let stretching = Stretching::new(&elasticity)?;
        Ok(Arc::new(Self {
            plate: plate.clone(),
            elasticity,
            stretching,
        }))
    }
}

/// Equations of motion of one setup, ready to integrate.
#[derive(Clone, Debug)]
pub struct Model {
    pub(crate) setup: Setup,
    pub(crate) plate: Arc<PreparedPlate>,
    pub(crate) scales: Scales,
    pub(crate) layout: Layout,
    pub(crate) system: System,
    /// Spring-damper force on each jumper, in force also in flight (divide by m_h h Omega^2).
    pub(crate) leg_force: Vec<Node>,
    /// R_j'' of each transverse term (multiply by h Omega^2).
    pub(crate) plate_acceleration: Vec<Node>,
    pub(crate) ledger: Option<EnergyLedger>,
}

/// Where the coordinates are in the state vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Layout {
    /// In-plane amplitudes; 0 in the condensed model.
    pub(crate) in_plane: usize,
    pub(crate) transverse: usize,
    pub(crate) jumpers: usize,
    /// Whether each leg has a state of its own.
    pub(crate) legs: bool,
}

impl Layout {
    pub(crate) fn p(self, i: usize) -> usize {
        i
    }
    pub(crate) fn dp(self, i: usize) -> usize {
        self.in_plane + i
    }
    pub(crate) fn r(self, j: usize) -> usize {
        2 * self.in_plane + j
    }
    pub(crate) fn dr(self, j: usize) -> usize {
        2 * self.in_plane + self.transverse + j
    }
    pub(crate) fn z(self, i: usize) -> usize {
        2 * (self.in_plane + self.transverse) + i
    }
    pub(crate) fn dz(self, i: usize) -> usize {
        self.z(0) + self.jumpers + i
    }
    pub(crate) fn leg(self, i: usize) -> usize {
        self.z(0) + 2 * self.jumpers + i
    }
    pub(crate) fn len(self) -> usize {
        self.leg(0) + if self.legs { self.jumpers } else { 0 }
    }
}

impl Setup {
    /// The paper's case at one damping ratio zeta_h and one Omega/omega_h, with the occupied body
    /// frequency as reference.
    pub fn dias_del_prado(damping_ratio: f64, frequency_ratio: f64) -> Self {
        use crate::physics::{BaseFrequency, FrequencyReference};
        let plate = Plate::dias_del_prado();
        let jumper = Jumper::dias_del_prado(plate.length, plate.width);
        Self {
            jumpers: vec![Jumper {
                damping_ratio,
                ..jumper
            }],
            contact: ContactLaw::ReactionForce,
            base: Base {
                amplitude: 0.013, // 0.13 h
                frequency: BaseFrequency::Ratio {
                    ratio: frequency_ratio,
                    reference: FrequencyReference::Occupied,
                },
            },
            gravity: GRAVITY,
            inertia: Inertia::Condensed,
            plate,
        }
    }

    /// Its equations of motion.
    ///
    /// # Errors
    /// [`ModelError`] names the quantity that is wrong.
    pub fn model(&self) -> Result<Model, ModelError> {
        self.model_on(&PreparedPlate::new(&self.plate)?)
    }

    /// As [`Setup::model`], on a plate prepared before (which must be this setup's plate).
    ///
    /// # Errors
    /// [`ModelError`] names the quantity that is wrong.
    pub fn model_on(&self, plate: &Arc<PreparedPlate>) -> Result<Model, ModelError> {
        Model::new(self, plate, false)
    }

    /// As [`Setup::model`], with the energy integrals beside the state (see [`EnergyBalance`]).
    ///
    /// # Errors
    /// [`ModelError`] names the quantity that is wrong.
    pub fn model_with_energy(&self) -> Result<Model, ModelError> {
        Model::new(self, &PreparedPlate::new(&self.plate)?, true)
    }

    fn check(&self) -> Result<(), ModelError> {
        self.base.check()?;
        PhysicsError::require(
            self.gravity > 0.0,
            "gravity.acceleration",
            self.gravity,
            "a positive number of m/s^2 is needed",
        )?;
        Jumper::check_all(&self.jumpers, &self.plate)?;
        for (index, jumper) in self.jumpers.iter().enumerate() {
            if jumper.damping_ratio == 0.0 && self.contact != ContactLaw::ReactionForce {
                return Err(ModelError::Undamped {
                    index,
                    law: self.contact.name(),
                });
            }
        }
        Ok(())
    }
}

impl Model {
    fn new(
        setup: &Setup,
        plate: &Arc<PreparedPlate>,
        with_energy: bool,
    ) -> Result<Self, ModelError> {
        setup.check()?;
        if setup.inertia == Inertia::SlowManifold && !plate.stretching.has_slow_manifold() {
            let (terms, limit) = (plate.elasticity.bending.len(), elastic::MANY - 1);
            return Err(ModelError::SlowManifold { terms, limit });
        }
        let omega = setup.base.omega(&setup.plate, &setup.jumpers)?;
        let scales = Scales::new(setup, omega);
        let layout = Layout {
            in_plane: match setup.inertia {
                Inertia::Full => plate.elasticity.in_plane_mass.len(),
                Inertia::SlowManifold | Inertia::Condensed => 0,
            },
            transverse: plate.elasticity.bending.len(),
            jumpers: setup.jumpers.len(),
            legs: setup.contact == ContactLaw::RelaxingLeg,
        };
        let equations =
            equations::build(setup, plate, &scales, layout, with_energy).map_err(|error| {
                match error {
                    BuildError::TooLarge(quantities) => ModelError::TooLarge {
                        terms: layout.transverse,
                        quantities,
                    },
                    other => other.into(),
                }
            })?;
        Ok(Self {
            setup: setup.clone(),
            plate: Arc::clone(plate),
            scales,
            layout,
            system: equations.system,
            leg_force: equations.leg_force,
            plate_acceleration: equations.plate_acceleration,
            ledger: equations.ledger,
        })
    }

    /// The setup it was made from.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// Number of states that may be chosen freely: all but the drive and the energy integrals, which
    /// come after them.
    pub fn free_states(&self) -> usize {
        self.layout.len()
    }

    /// Units of its state.
    pub fn scales(&self) -> &Scales {
        &self.scales
    }

    /// The system as the engine sees it.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// Shares the program of a model that has the same one, which makes comparing them cheap.
    pub(crate) fn share_structure(&mut self, other: &Self) {
        self.system = self.system.clone().sharing(&other.system);
    }

    /// As [`Self::share_structure`] with a system; whether it has the same program.
    pub(crate) fn share_system(&mut self, other: &System) -> bool {
        self.system = self.system.clone().sharing(other);
        self.system.same_structure(other)
    }

    /// An evaluator of forces and accelerations at states of this model.
    pub fn evaluator(&self) -> Evaluator {
        Evaluator::new(&self.system)
    }

    /// Fastest linear rate of the model (rad/s), for the stability limit of explicit steps: its
    /// highest frequency, or the decay rate of its dampers, sum of c_h (1/m_h + sum psi_j^2/M), if
    /// that is larger.
    ///
    /// # Errors
    /// [`PhysicsError::Algebra`] if the eigenvalues cannot be computed.
    pub fn fastest_rate(&self) -> Result<f64, PhysicsError> {
        let plate = &self.setup.plate;
        let occupied = plate.occupied(&self.setup.jumpers)?.hz;
        let in_plane = match self.setup.inertia {
            Inertia::Full => plate.in_plane_frequencies_hz()?,
            Inertia::SlowManifold | Inertia::Condensed => Vec::new(),
        };
        let highest = occupied
            .iter()
            .chain(&in_plane)
            .fold(0.0, |m: f64, f| m.max(*f));
        let damper = |jumper: &Jumper| {
            let psi = plate.mode_shape(jumper.x, jumper.y);
            let shapes: f64 = psi.iter().map(|psi| psi * psi).sum();
            jumper.damping() * (1.0 / jumper.mass + shapes / plate.modal_mass())
        };
        let dampers: f64 = self.setup.jumpers.iter().map(damper).sum();
        Ok(dampers.max(std::f64::consts::TAU * highest))
    }

    /// Refuses a fixed step above RK4's stability limit, dt omega_max < 2.785 (Hairer & Wanner,
    /// Solving ODEs II, section IV.2: the interval on the negative real axis, within 2.83 on the imaginary one).
    ///
    /// # Errors
    /// [`ModelError::UnstableStep`] says how many steps are needed.
    pub fn check_step(&self, options: &Options) -> Result<(), ModelError> {
        let saltus_hybrid::Method::Rk4 {
            steps_per_period: steps,
        } = options.method
        else {
            return Ok(());
        };
        let highest = self.fastest_rate()?;
        let limit = 2.785 / highest;
        let period = std::f64::consts::TAU / self.scales.omega;
        if period / f64::from(steps) <= limit {
            return Ok(());
        }
        let needed = (period / limit).ceil().min(f64::from(u32::MAX)) as u32;
        let hz = highest / std::f64::consts::TAU;
        Err(ModelError::UnstableStep {
            steps,
            limit,
            hz,
            needed,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use saltus_hybrid::Method;

    #[test]
    fn a_strong_damper_counts_against_a_fixed_step() {
        // 2 zeta omega_h = 2 x 10 x 1e4 rad/s on 10 g, against 21 Hz of the condensed plate.
        let mut setup = Setup::dias_del_prado(10.0, 1.0);
        (setup.jumpers[0].mass, setup.jumpers[0].stiffness) = (0.01, 1e6);
        setup.base.frequency = crate::physics::BaseFrequency::Hertz(2.5);
        let model = setup.model().expect("legal, if odd");
        assert!((model.fastest_rate().expect("finite") / 2e5 - 1.0).abs() < 1e-3);
        let method = Method::Rk4 {
            steps_per_period: 2000,
        };
        let options = Options {
            method,
            ..Options::default()
        };
        assert!(matches!(
            model.check_step(&options),
            Err(ModelError::UnstableStep { .. })
        ));
    }
}
