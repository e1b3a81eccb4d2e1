//! The energy integrals of [`super::EnergyBalance`], declared beside the state.

use saltus_hybrid::{Node, SystemBuilder};

use super::drive::BaseLoad;
use super::layout::Layout;
use super::leg::{Leg, on_floor};
use super::prepared::PreparedPlate;
use crate::physics::ContactLaw;

/// Places of the energy integrals in the state vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct EnergyLedger {
    pub(super) base: usize,
    pub(super) plate: usize,
    pub(super) legs: usize,
    pub(super) dampers: usize,
}

impl EnergyLedger {
    /// Declares the integrals, in units of M h^2 Omega^2.
    pub(super) fn declare(
        b: &mut SystemBuilder,
        plate: &PreparedPlate,
        layout: Layout,
        law: ContactLaw,
        legs: &[Leg],
        load: &BaseLoad,
    ) -> Self {
        let base = base_power(b, layout, legs, load);
        let plate = plate_loss(b, plate, layout, load.damping);
        let taken = leg_power(b, legs);
        let damped = damper_loss(b, law, legs);
        Self {
            base: b.quadrature(base),
            plate: b.quadrature(plate),
            legs: b.quadrature(taken),
            dampers: b.quadrature(damped),
        }
    }
}

/// sum_j (G_j/M) a (cos tau + (c/Omega) sin tau) R_j' - sum mu f a sin tau.
fn base_power(b: &mut SystemBuilder, layout: Layout, legs: &[Leg], load: &BaseLoad) -> Node {
    let drive = load.inertial(b);
    let speed: Vec<(f64, Node)> = load
        .shares
        .iter()
        .enumerate()
        .map(|(j, &share)| (share, b.state(layout.dr(j))))
        .collect();
    let speed = b.linear(0.0, &speed);
    let push: Vec<(f64, Node)> = legs
        .iter()
        .map(|leg| (-leg.mass_ratio * load.drive.amplitude, leg.gated))
        .collect();
    let push = b.linear(0.0, &push);
    b.dot(&[(drive, speed), (push, load.drive.sin)])
}

/// (c/Omega) (sum_j R_j'^2 + sum_i (M_i/M) P_i'^2).
fn plate_loss(b: &mut SystemBuilder, plate: &PreparedPlate, layout: Layout, damping: f64) -> Node {
    let e = &plate.elasticity;
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
    b.dot(&squares)
}

/// sum mu f d'.
fn leg_power(b: &mut SystemBuilder, legs: &[Leg]) -> Node {
    let mut taken = Vec::new();
    for leg in legs {
        taken.push((b.linear(0.0, &[(leg.mass_ratio, leg.gated)]), leg.rate));
    }
    b.dot(&taken)
}

/// sum mu (c_h/(m_h Omega)) d'^2 over those on the floor.
fn damper_loss(b: &mut SystemBuilder, law: ContactLaw, legs: &[Leg]) -> Node {
    let mut damped = Vec::new();
    for leg in legs {
        let rate = b.gate(leg.unit, on_floor(law), leg.rate);
        let weight = leg.mass_ratio * leg.damping;
        damped.push((b.linear(0.0, &[(weight, rate)]), leg.rate));
    }
    b.dot(&damped)
}
