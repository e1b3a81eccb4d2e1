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

use saltus_hybrid::{BuildError, Mode, Node, System, SystemBuilder, Transition, Unit};

use super::energy::{BaseMotion, EnergyLedger};
use super::{Layout, PreparedPlate, Scales, Setup};
use crate::physics::{ContactLaw, Jumper};

/// Contact state of one jumper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Contact {
    /// On the floor.
    Stance,
    /// In the air: no force.
    Flight,
}

/// Modes of a jumper's unit. `LIFTED` exists under the gap law only: no force, gap still closed.
pub(crate) const STANCE: Mode = 0;
pub(crate) const FLIGHT: Mode = 1;
pub(crate) const LIFTED: Mode = 2;

impl Contact {
    /// What a mode of the engine means.
    pub fn of(mode: Mode) -> Self {
        if mode == STANCE {
            Self::Stance
        } else {
            Self::Flight
        }
    }
}

pub(crate) struct Equations {
    pub(crate) system: System,
    pub(crate) leg_force: Vec<Node>,
    /// R_j''.
    pub(crate) plate_acceleration: Vec<Node>,
    pub(crate) ledger: Option<EnergyLedger>,
}

/// One jumper's nodes.
pub(crate) struct Leg {
    /// Force of spring and damper over m_h h Omega^2, whatever the phase.
    pub(crate) force: Node,
    /// The same, zero in flight.
    pub(crate) gated: Node,
    /// c_h/(m_h Omega).
    pub(crate) damping: f64,
    /// Its contact automaton.
    pub(crate) unit: Unit,
    /// d' = W' - Z'.
    pub(crate) rate: Node,
    psi: Vec<f64>,
    pub(crate) mass_ratio: f64,
}

pub(crate) fn build(
    setup: &Setup,
    plate: &PreparedPlate,
    scales: &Scales,
    layout: Layout,
    with_energy: bool,
) -> Result<Equations, BuildError> {
    let mut b = SystemBuilder::new(layout.len());
    // Motions of a thickness matter, and the first mode of a plate at rest need not be known to 1e-10 of itself.
    b.scale_together(1.0);
    let (cos, sin) = b.drive(1.0);
    let amplitude = setup.base.amplitude / scales.length;
    let legs: Vec<Leg> = setup
        .jumpers
        .iter()
        .enumerate()
        .map(|(i, jumper)| {
            leg(
                &mut b,
                setup,
                scales,
                layout,
                i,
                jumper,
                amplitude,
                (cos, sin),
            )
        })
        .collect();

    // Inertial load of the base: (G_j/M) a (cos tau + (c/Omega) sin tau).
    let e = &plate.elasticity;
    let damping = e.damping / scales.omega;
    let loads: Vec<f64> = e
        .base_load
        .iter()
        .map(|g| g / e.transverse_mass * amplitude)
        .collect();
    let base = b.linear(0.0, &[(1.0, cos), (damping, sin)]);
    let elastic = plate
        .stretching
        .forces(&mut b, e, setup.inertia, scales, layout);
    let mut plate_acceleration = Vec::with_capacity(loads.len());
    for (j, &load) in loads.iter().enumerate() {
        let mut terms = vec![
            (
                -e.bending[j] / (e.transverse_mass * scales.omega.powi(2)),
                b.state(layout.r(j)),
            ),
            (-damping, b.state(layout.dr(j))),
            (load, base),
        ];
        terms.extend(elastic.transverse[j].iter().map(|&node| (-1.0, node)));
        terms.extend(
            legs.iter()
                .map(|leg| (-leg.mass_ratio * leg.psi[j], leg.gated)),
        );
        let acceleration = b.linear(0.0, &terms);
        b.derivative(layout.r(j), b.state(layout.dr(j)));
        b.derivative(layout.dr(j), acceleration);
        plate_acceleration.push(acceleration);
    }
    for i in 0..layout.in_plane {
        let mut terms = elastic.in_plane[i].clone();
        terms.push((-damping, b.state(layout.dp(i))));
        let acceleration = b.linear(0.0, &terms);
        b.derivative(layout.p(i), b.state(layout.dp(i)));
        b.derivative(layout.dp(i), acceleration);
    }
    let ledger = with_energy.then(|| {
        let base = BaseMotion {
            loads: &loads,
            damping,
            amplitude,
            cos,
            sin,
        };
        EnergyLedger::declare(&mut b, plate, layout, setup.contact, &legs, &base)
    });
    Ok(Equations {
        system: b.build(0.0)?,
        leg_force: legs.iter().map(|leg| leg.force).collect(),
        plate_acceleration,
        ledger,
    })
}

/// Compression, force and contact of one jumper.
#[allow(clippy::too_many_arguments)]
fn leg(
    b: &mut SystemBuilder,
    setup: &Setup,
    scales: &Scales,
    layout: Layout,
    index: usize,
    jumper: &Jumper,
    amplitude: f64,
    (cos, sin): (Node, Node),
) -> Leg {
    let psi = setup.plate.mode_shape(jumper.x, jumper.y);
    let omega = scales.omega;
    let stiffness = jumper.stiffness / (jumper.mass * omega * omega);
    let damping = jumper.damping() / (jumper.mass * omega);
    let (z, dz) = (b.state(layout.z(index)), b.state(layout.dz(index)));

    let mut gap: Vec<(f64, Node)> = psi
        .iter()
        .enumerate()
        .map(|(j, &psi)| (psi, b.state(layout.r(j))))
        .collect();
    gap.extend([(amplitude, cos), (-1.0, z)]);
    let mut rate: Vec<(f64, Node)> = psi
        .iter()
        .enumerate()
        .map(|(j, &psi)| (psi, b.state(layout.dr(j))))
        .collect();
    rate.extend([(-amplitude, sin), (-1.0, dz)]);
    let gap = b.linear(0.0, &gap);
    let rate = b.linear(0.0, &rate);
    let force = b.linear(0.0, &[(stiffness, gap), (damping, rate)]);

    let unit = b.reserve_unit();
    let gated = b.gated_linear(
        unit,
        on_floor(setup.contact),
        &[(stiffness, gap), (damping, rate)],
    );
    let weight = -setup.gravity / scales.acceleration();
    let fall = b.linear(weight, &[(1.0, gated)]);
    b.derivative(layout.z(index), dz);
    b.derivative(layout.dz(index), fall);

    let state = layout.leg(index);
    let modes = match setup.contact {
        ContactLaw::ReactionForce => {
            vec![
                vec![Transition::falling(force, FLIGHT)],
                vec![Transition::rising(force, STANCE)],
            ]
        }
        ContactLaw::Gap => vec![
            vec![Transition::falling(force, LIFTED)],
            vec![Transition::rising(gap, STANCE)],
            vec![
                Transition::rising(force, STANCE),
                Transition::falling(gap, FLIGHT),
            ],
        ],
        ContactLaw::RelaxingLeg => relaxing(b, unit, state, gap, rate, force, stiffness / damping),
    };
    b.define_unit(unit, modes);
    let mass_ratio = jumper.mass / setup.plate.modal_mass();
    Leg {
        force,
        gated,
        unit,
        damping,
        rate,
        psi,
        mass_ratio,
    }
}

/// 1 in stance and 0 in flight, for each mode of a jumper's unit.
pub(crate) fn on_floor(law: ContactLaw) -> &'static [f64] {
    match law {
        ContactLaw::Gap => &[1.0, 0.0, 0.0],
        ContactLaw::ReactionForce | ContactLaw::RelaxingLeg => &[1.0, 0.0],
    }
}

/// A leg whose compression s follows the floor in stance and relaxes, s' = -(k_h/c_h) s, in flight.
fn relaxing(
    b: &mut SystemBuilder,
    unit: Unit,
    state: usize,
    gap: Node,
    rate: Node,
    force: Node,
    relaxation: f64,
) -> Vec<Vec<Transition>> {
    let s = b.state(state);
    let follows = b.gate(unit, &[1.0, 0.0], rate);
    let relaxes = b.gate(unit, &[0.0, -relaxation], s);
    let ds = b.linear(0.0, &[(1.0, follows), (1.0, relaxes)]);
    b.derivative(state, ds);
    let reach = b.linear(0.0, &[(1.0, gap), (-1.0, s)]);
    // At take-off d = s and, because k s + c d' = 0 there, d' = s' too: a double zero.
    vec![
        vec![
            Transition::falling(force, FLIGHT)
                .reset(state, gap)
                .vanishing(reach, 2),
        ],
        vec![Transition::rising(reach, STANCE).reset(state, gap)],
    ]
}

// The unit of a jumper and its place in the list of jumpers are the same number, because legs are
// declared in that order and nothing else switches.
const _: () = assert!(STANCE == 0 && FLIGHT == 1 && LIFTED == 2);
