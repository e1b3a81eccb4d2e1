//! Energy balance: what the base and gravity put in is dissipated or stored.
//!
//! With d' the leg's rate of compression and F its force in stance:
//!
//! ```text
//! d/dt [ 1/2 M (|p'|^2 + |r'|^2) + U_p + 1/2 sum m_h z'^2 ]
//!   = base:     sum G_j (A_b Omega^2 cos + c A_b Omega sin) r_j' - sum F A_b Omega sin
//!   + gravity:  - sum m_h g z'
//!   - plate:    c M (|p'|^2 + |r'|^2)
//!   - legs:     sum F d'
//! ```
//!
//! The leg term is what springs and dampers take up; a spring that leaves the floor compressed takes
//! its energy along and loses it in flight, so only the damper's part is dissipation for certain.

use saltus_hybrid::Point;

use super::Model;
use super::scales::JumperScale;

/// Energies over some time (J). `residual` is what the equation above leaves over: the error of
/// the integration.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyBalance {
    /// Work done by the moving base.
    pub base: f64,
    /// Work done by gravity on the bodies.
    pub gravity: f64,
    /// Dissipated by the plate's damping.
    pub plate: f64,
    /// Taken up by the legs (springs and dampers).
    pub legs: f64,
    /// The dampers' part of it.
    pub dampers: f64,
    /// Increase of the kinetic energy of plate and bodies and of the plate's elastic energy.
    pub stored: f64,
    /// stored - (base + gravity - plate - legs).
    pub residual: f64,
}

impl Model {
    /// Kinetic energy of plate and bodies plus elastic energy of the plate (J).
    fn stored_energy(&self, point: &Point) -> f64 {
        let (x, layout, e) = (&point.x, self.layout, &self.plate.elasticity);
        let (h, rate) = (self.scales.length, self.scales.velocity());
        let r: Vec<f64> = (0..layout.transverse).map(|j| h * x[layout.r(j)]).collect();
        let p: Vec<f64> = if layout.in_plane == 0 {
            e.in_plane_from_transverse(&r)
        } else {
            (0..layout.in_plane).map(|i| h * x[layout.p(i)]).collect()
        };
        let kinetic = |mass: f64, v: f64| 0.5 * mass * (rate * v).powi(2);
        let transverse: f64 = (0..layout.transverse)
            .map(|j| kinetic(e.transverse_mass, x[layout.dr(j)]))
            .sum();
        let in_plane: f64 = (0..layout.in_plane)
            .map(|i| kinetic(e.in_plane_mass[i], x[layout.dp(i)]))
            .sum();
        let bodies: f64 = self
            .scales
            .jumpers
            .iter()
            .enumerate()
            .map(|(i, s)| kinetic(s.mass, x[layout.dz(i)]))
            .sum();
        e.strain_energy(&p, &r) + transverse + in_plane + bodies
    }

    /// Balance between two points of one run, if the model keeps the integrals
    /// ([`super::Setup::model_with_energy`]).
    pub(crate) fn energy_balance(&self, from: &Point, to: &Point) -> Option<EnergyBalance> {
        let ledger = self.ledger?;
        let unit = self.plate.elasticity.transverse_mass * self.scales.velocity().powi(2);
        let integral = |index: usize| unit * (to.x[index] - from.x[index]);
        let fall = |(i, s): (usize, &JumperScale)| {
            let z = self.layout.z(i);
            s.weight * self.scales.length * (from.x[z] - to.x[z])
        };
        let gravity: f64 = self.scales.jumpers.iter().enumerate().map(fall).sum();
        let stored = self.stored_energy(to) - self.stored_energy(from);
        let (base, plate, legs) = (
            integral(ledger.base),
            integral(ledger.plate),
            integral(ledger.legs),
        );
        Some(EnergyBalance {
            base,
            gravity,
            plate,
            legs,
            dampers: integral(ledger.dampers),
            stored,
            residual: stored - (base + gravity - plate - legs),
        })
    }
}
