//! Units: the only place where SI and the model's numbers meet.

use super::setup::Setup;

/// Units of the model in SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Scales {
    /// Length: the plate thickness h (m).
    pub length: f64,
    /// Angular frequency of the drive, Omega (rad/s); one unit of time is 1/Omega.
    pub omega: f64,
    /// For each jumper, the paper's units of position and velocity.
    pub jumpers: Vec<JumperScale>,
}

/// The paper's units for one jumper (DP section 3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JumperScale {
    /// eta = g/omega_h^2 (m): static compression of the leg.
    pub position: f64,
    /// eta omega_h = g/omega_h (m/s).
    pub velocity: f64,
    /// Weight m_h g (N).
    pub weight: f64,
    /// Body mass m_h (kg).
    pub mass: f64,
}

impl Scales {
    pub(crate) fn new(setup: &Setup, omega: f64) -> Self {
        let jumpers = setup.jumpers.iter().map(|jumper| {
            let position = jumper.static_compression(setup.gravity);
            JumperScale {
                position,
                velocity: position * jumper.omega(),
                weight: jumper.mass * setup.gravity,
                mass: jumper.mass,
            }
        });
        Self {
            length: setup.plate.thickness,
            omega,
            jumpers: jumpers.collect(),
        }
    }

    /// Forcing period T (s).
    pub fn period(&self) -> f64 {
        std::f64::consts::TAU / self.omega
    }

    /// One unit of velocity, h Omega (m/s).
    pub fn velocity(&self) -> f64 {
        self.length * self.omega
    }

    /// One unit of acceleration, h Omega^2 (m/s^2).
    pub fn acceleration(&self) -> f64 {
        self.length * self.omega.powi(2)
    }
}
