//! From physics to equations of motion, and back to units.
//!
//! A [`Model`] in hand is valid and never changes. Inside it lengths are measured in plate
//! thicknesses h and time in radians of the drive (tau = Omega t); [`Scales`] is the only type that
//! converts. The engine receives a program of sums and products and knows nothing of plates.

mod divergence;
mod drive;
mod elastic;
mod energy;
mod equations;
mod error;
mod frame;
mod layout;
mod ledger;
mod leg;
mod prepared;
mod probe;
mod scales;
mod setup;
mod state;
mod step;

use std::sync::Arc;

use saltus_hybrid::{BuildError, Evaluator, Node, System};

use crate::physics::ContactLaw;
pub use energy::EnergyBalance;
pub use error::ModelError;
use layout::Layout;
use ledger::EnergyLedger;
pub use leg::Contact;
pub use prepared::PreparedPlate;
pub use probe::Probe;
pub use scales::{JumperScale, Scales};
pub use setup::{GRAVITY, Inertia, Setup};
pub use state::{Observation, Section};

/// Equations of motion of one setup, ready to integrate.
#[derive(Clone, Debug)]
pub struct Model {
    setup: Setup,
    plate: Arc<PreparedPlate>,
    pub(crate) scales: Scales,
    pub(crate) layout: Layout,
    system: System,
    /// Spring-damper force on each jumper, in force also in flight (divide by m_h h Omega^2).
    leg_force: Vec<Node>,
    /// R_j'' of each transverse term (multiply by h Omega^2).
    plate_acceleration: Vec<Node>,
    ledger: Option<EnergyLedger>,
}

impl Setup {
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
}

impl Model {
    fn new(
        setup: &Setup,
        plate: &Arc<PreparedPlate>,
        with_energy: bool,
    ) -> Result<Self, ModelError> {
        setup.check()?;
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

    /// Replaces the system by the same one that shares its program with others.
    pub(crate) fn replace_system(&mut self, system: System) {
        self.system = system;
    }

    /// An evaluator of forces and accelerations at states of this model.
    pub fn evaluator(&self) -> Evaluator {
        Evaluator::new(&self.system)
    }
}
