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

use saltus_hybrid::{Node, Point, SystemBuilder};

use super::equations::{Leg, on_floor};
use super::{Layout, Model, PreparedPlate};
use crate::physics::ContactLaw;

/// Where the energy integrals are in the state vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EnergyLedger {
    base: usize,
    plate: usize,
    legs: usize,
    dampers: usize,
}

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

/// How the base acts on the plate, in the model's units.
pub(crate) struct BaseMotion<'a> {
    /// (G_j/M) a.
    pub(crate) loads: &'a [f64],
    /// c/Omega.
    pub(crate) damping: f64,
    /// a = A_b/h.
    pub(crate) amplitude: f64,
    pub(crate) cos: Node,
    pub(crate) sin: Node,
}

impl EnergyLedger {
    /// Declares the integrals, in units of M h^2 Omega^2.
    pub(crate) fn declare(
        b: &mut SystemBuilder,
        plate: &PreparedPlate,
        layout: Layout,
        law: ContactLaw,
        legs: &[Leg],
        motion: &BaseMotion<'_>,
    ) -> Self {
        let e = &plate.elasticity;
        let &BaseMotion {
            loads,
            damping,
            amplitude,
            cos,
            sin,
        } = motion;
        let drive = b.linear(0.0, &[(1.0, cos), (damping, sin)]);
        let speed: Vec<(f64, Node)> = loads
            .iter()
            .enumerate()
            .map(|(j, &load)| (load, b.state(layout.dr(j))))
            .collect();
        let speed = b.linear(0.0, &speed);
        let push: Vec<(f64, Node)> = legs
            .iter()
            .map(|leg| (-leg.mass_ratio * amplitude, leg.gated))
            .collect();
        let push = b.linear(0.0, &push);
        let base = b.dot(&[(drive, speed), (push, sin)]);

        let mut squares = Vec::new();
        for j in 0..layout.transverse {
            let rate = b.state(layout.dr(j));
            squares.push((b.linear(0.0, &[(damping, rate)]), rate));
        }
        for i in 0..layout.in_plane {
            let rate = b.state(layout.dp(i));
            let weight = damping * e.in_plane_mass[i] / e.transverse_mass;
            squares.push((b.linear(0.0, &[(weight, rate)]), rate));
        }
        let plate = b.dot(&squares);

        let mut taken = Vec::new();
        for leg in legs {
            taken.push((b.linear(0.0, &[(leg.mass_ratio, leg.gated)]), leg.rate));
        }
        let taken = b.dot(&taken);
        let mut damped = Vec::new();
        for leg in legs {
            let rate = b.gate(leg.unit, on_floor(law), leg.rate);
            damped.push((
                b.linear(0.0, &[(leg.mass_ratio * leg.damping, rate)]),
                leg.rate,
            ));
        }
        let damped = b.dot(&damped);
        Self {
            base: b.quadrature(base),
            plate: b.quadrature(plate),
            legs: b.quadrature(taken),
            dampers: b.quadrature(damped),
        }
    }
}

impl Model {
    /// Kinetic energy of plate and bodies plus elastic energy of the plate (J).
    pub fn stored_energy(&self, point: &Point) -> f64 {
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
    pub fn energy_balance(&self, from: &Point, to: &Point) -> Option<EnergyBalance> {
        let ledger = self.ledger?;
        let unit = self.plate.elasticity.transverse_mass * self.scales.velocity().powi(2);
        let integral = |index: usize| unit * (to.x[index] - from.x[index]);
        let fall = |(i, s): (usize, &super::scales::JumperScale)| {
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
