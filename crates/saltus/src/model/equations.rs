//! The equations of motion as a program of sums and products. DP Eqs. (9)-(12), in the readings of
//! the misprint table.
//!
//! With lengths in h and time tau = Omega t, a = A_b/h, mu = m_h/M, primes for d/dtau:
//!
//! ```text
//! P_i'' = -(c/Omega) P_i' - sum_k K_ik P_k/(M_i Omega^2) - B_ijk R_j R_k h/(M_i Omega^2)
//! R_j'' = -(c/Omega) R_j' - K_bj R_j/(M Omega^2) - sum_k T_jk R_k
//!         + (G_j/M) a (cos tau + (c/Omega) sin tau) - mu psi_j f
//! T_jk  = (2 B_ijk P_i h + 4 Q_jklm R_l R_m h^2)/(M Omega^2)
//! Z''   = -g/(h Omega^2) + f
//! contact: f = (k_h/(m_h Omega^2)) d + (c_h/(m_h Omega)) d',  d = W - Z,  W = psi.R + a cos tau
//! ```
//!
//! # Departures from the paper
//! - (9a) prints psi_i^2 where Lagrange's equations of (2) and (6) give psi_i psi_j.
//! - (9c) and (11b) print 16/pi^2 for every j; G_j = rho h times the integral of psi_j is 16 M/(pi^2 m_j n_j) for odd
//!   m_j n_j and zero else.
//! - (10) prints + k_h; with it the reaction at rest would be minus the weight.

use saltus_hybrid::{BuildError, Node, System, SystemBuilder};

use super::drive::{BaseLoad, Drive};
use super::elastic::{Elastic, Sum};
use super::layout::Layout;
use super::ledger::EnergyLedger;
use super::leg::{Leg, Surroundings, leg};
use super::prepared::PreparedPlate;
use super::scales::Scales;
use super::setup::Setup;

pub(super) struct Equations {
    pub(super) system: System,
    pub(super) leg_force: Vec<Node>,
    /// R_j''.
    pub(super) plate_acceleration: Vec<Node>,
    pub(super) ledger: Option<EnergyLedger>,
}

pub(super) fn build(
    setup: &Setup,
    plate: &PreparedPlate,
    scales: &Scales,
    layout: Layout,
    with_energy: bool,
) -> Result<Equations, BuildError> {
    let mut b = SystemBuilder::new(layout.len());
    // Motions of a thickness matter, and the first mode of a plate at rest need not be known to 1e-10 of itself.
    b.scale_together(1.0);
    let drive = Drive::new(&mut b, setup, scales);
    let around = Surroundings {
        setup,
        scales,
        layout,
        drive,
    };
    let legs: Vec<Leg> = (0..setup.jumpers.len())
        .map(|index| leg(&mut b, around, index))
        .collect();
    let load = BaseLoad::new(&plate.elasticity, scales, drive);
    let base = load.inertial(&mut b);
    let elastic = plate
        .stretching
        .forces(&mut b, &plate.elasticity, setup.inertia, scales, layout);
    let plate_acceleration = transverse(&mut b, plate, around, &legs, &load, base, &elastic);
    in_plane(&mut b, layout, &elastic.in_plane, load.damping);
    let ledger = with_energy
        .then(|| EnergyLedger::declare(&mut b, plate, layout, setup.contact, &legs, &load));
    Ok(Equations {
        system: b.build(0.0)?,
        leg_force: legs.iter().map(|leg| leg.force).collect(),
        plate_acceleration,
        ledger,
    })
}

/// Declares R_j''.
fn transverse(
    b: &mut SystemBuilder,
    plate: &PreparedPlate,
    Surroundings { scales, layout, .. }: Surroundings<'_>,
    legs: &[Leg],
    load: &BaseLoad,
    base: Node,
    elastic: &Elastic,
) -> Vec<Node> {
    let e = &plate.elasticity;
    let mut accelerations = Vec::with_capacity(load.shares.len());
    for (j, &share) in load.shares.iter().enumerate() {
        let mut terms = vec![
            (
                -e.bending[j] / (e.transverse_mass * scales.omega.powi(2)),
                b.state(layout.r(j)),
            ),
            (-load.damping, b.state(layout.dr(j))),
            (share, base),
        ];
        terms.extend(elastic.transverse[j].iter().map(|&node| (-1.0, node)));
        terms.extend(
            legs.iter()
                .map(|leg| (-leg.mass_ratio * leg.psi[j], leg.gated)),
        );
        let acceleration = b.linear(0.0, &terms);
        b.derivative(layout.r(j), b.state(layout.dr(j)));
        b.derivative(layout.dr(j), acceleration);
        accelerations.push(acceleration);
    }
    accelerations
}

/// Declares P_i'', where in-plane amplitudes are states.
fn in_plane(b: &mut SystemBuilder, layout: Layout, forces: &[Sum], damping: f64) {
    for (i, force) in forces.iter().enumerate() {
        let mut terms = force.clone();
        terms.push((-damping, b.state(layout.dp(i))));
        let acceleration = b.linear(0.0, &terms);
        b.derivative(layout.p(i), b.state(layout.dp(i)));
        b.derivative(layout.dp(i), acceleration);
    }
}
