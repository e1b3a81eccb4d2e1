//! The stability limit of a fixed step.

use std::f64::consts::TAU;

use saltus_hybrid::{Method, Options};

use super::{Inertia, Model, ModelError};
use crate::physics::{Jumper, PhysicsError};

impl Model {
    /// Fastest linear rate of the model (rad/s), for the stability limit of explicit steps: its
    /// highest frequency, or the decay rate of its dampers, sum of c_h (1/m_h + sum psi_j^2/M), if
    /// that is larger.
    ///
    /// # Errors
    /// [`PhysicsError::Algebra`] if the eigenvalues cannot be computed.
    fn fastest_rate(&self) -> Result<f64, PhysicsError> {
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
        Ok(dampers.max(TAU * highest))
    }

    /// Refuses a fixed step above RK4's stability limit, dt omega_max < 2.785 (Hairer & Wanner,
    /// Solving ODEs II, section IV.2: the interval on the negative real axis, within 2.83 on the imaginary one).
    ///
    /// # Errors
    /// [`ModelError::UnstableStep`] says how many steps are needed.
    pub fn check_step(&self, options: &Options) -> Result<(), ModelError> {
        let Method::Rk4 {
            steps_per_period: steps,
        } = options.method
        else {
            return Ok(());
        };
        let highest = self.fastest_rate()?;
        let limit = 2.785 / highest;
        let period = TAU / self.scales.omega;
        if period / f64::from(steps) <= limit {
            return Ok(());
        }
        let needed = (period / limit).ceil().min(f64::from(u32::MAX)) as u32;
        let hz = highest / TAU;
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
    use crate::model::Setup;
    use crate::physics::BaseFrequency;

    #[test]
    fn a_strong_damper_counts_against_a_fixed_step() {
        // 2 zeta omega_h = 2 x 10 x 1e4 rad/s on 10 g, against 21 Hz of the condensed plate.
        let mut setup = Setup::dias_del_prado(10.0, 1.0);
        (setup.jumpers[0].mass, setup.jumpers[0].stiffness) = (0.01, 1e6);
        setup.base.frequency = BaseFrequency::Hertz(2.5);
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
