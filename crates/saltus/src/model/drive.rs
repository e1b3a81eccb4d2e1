//! The motion of the base as nodes, and the load that it is on the plate.

use saltus_hybrid::{Node, SystemBuilder};

use super::scales::Scales;
use super::setup::Setup;
use crate::physics::Elasticity;

/// Motion of the base, a cos tau, in the model's units.
#[derive(Clone, Copy)]
pub(super) struct Drive {
    /// a = A_b/h.
    pub(super) amplitude: f64,
    pub(super) cos: Node,
    pub(super) sin: Node,
}

/// Load of the moving base on the plate.
pub(super) struct BaseLoad {
    /// (G_j/M) a.
    pub(super) shares: Vec<f64>,
    /// c/Omega.
    pub(super) damping: f64,
    pub(super) drive: Drive,
}

impl Drive {
    pub(super) fn new(b: &mut SystemBuilder, setup: &Setup, scales: &Scales) -> Self {
        let (cos, sin) = b.drive(1.0);
        Self {
            amplitude: setup.base.amplitude / scales.length,
            cos,
            sin,
        }
    }
}

impl BaseLoad {
    pub(super) fn new(e: &Elasticity, scales: &Scales, drive: Drive) -> Self {
        let share = |g: &f64| g / e.transverse_mass * drive.amplitude;
        Self {
            shares: e.base_load.iter().map(share).collect(),
            damping: e.damping / scales.omega,
            drive,
        }
    }

    /// cos tau + (c/Omega) sin tau: the load on R_j is its share of this.
    pub(super) fn inertial(&self, b: &mut SystemBuilder) -> Node {
        b.linear(
            0.0,
            &[(1.0, self.drive.cos), (self.damping, self.drive.sin)],
        )
    }
}
