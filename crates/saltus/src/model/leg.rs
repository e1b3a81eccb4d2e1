//! The leg of one jumper as a program: compression, force, and the automaton of the foot. DP Eqs. (6), (10), (12).

use saltus_hybrid::{Mode, Node, SystemBuilder, Transition, Unit};

use super::drive::Drive;
use super::layout::Layout;
use super::scales::Scales;
use super::setup::Setup;
use crate::physics::ContactLaw;

/// Contact state of one jumper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Contact {
    /// On the floor.
    Stance,
    /// In the air: no force.
    Flight,
}

/// Modes of a jumper's unit. `LIFTED` exists under the gap law only: no force, gap still closed.
pub(super) const STANCE: Mode = 0;
pub(super) const FLIGHT: Mode = 1;
pub(super) const LIFTED: Mode = 2;

impl Contact {
    /// The contact state that a mode of the engine stands for.
    pub fn of(mode: Mode) -> Self {
        if mode == STANCE {
            Self::Stance
        } else {
            Self::Flight
        }
    }
}

/// The model around the legs: what all of them share.
#[derive(Clone, Copy)]
pub(super) struct Surroundings<'a> {
    pub(super) setup: &'a Setup,
    pub(super) scales: &'a Scales,
    pub(super) layout: Layout,
    pub(super) drive: Drive,
}

/// Nodes and numbers of one jumper.
pub(super) struct Leg {
    /// Force of spring and damper over m_h h Omega^2, whatever the phase.
    pub(super) force: Node,
    /// The same, zero in flight.
    pub(super) gated: Node,
    /// c_h/(m_h Omega).
    pub(super) damping: f64,
    /// Its contact automaton.
    pub(super) unit: Unit,
    /// d' = W' - Z'.
    pub(super) rate: Node,
    pub(super) psi: Vec<f64>,
    pub(super) mass_ratio: f64,
}

/// Compression of a leg as if on the floor.
#[derive(Clone, Copy)]
struct Compression {
    /// d = W - Z.
    gap: Node,
    /// d' = W' - Z'.
    rate: Node,
    /// Force of spring and damper.
    force: Node,
}

/// Declares compression, force and contact of one jumper, and its equation of motion.
pub(super) fn leg(b: &mut SystemBuilder, around: Surroundings<'_>, index: usize) -> Leg {
    let Surroundings {
        setup,
        scales,
        layout,
        drive,
    } = around;
    let jumper = &setup.jumpers[index];
    let psi = setup.plate.mode_shape(jumper.x, jumper.y);
    let omega = scales.omega;
    let stiffness = jumper.stiffness / (jumper.mass * omega * omega);
    let damping = jumper.damping() / (jumper.mass * omega);
    let (z, dz) = (b.state(layout.z(index)), b.state(layout.dz(index)));

    let mut gap = shaped(b, &psi, |j| layout.r(j));
    gap.extend([(drive.amplitude, drive.cos), (-1.0, z)]);
    let mut rate = shaped(b, &psi, |j| layout.dr(j));
    rate.extend([(-drive.amplitude, drive.sin), (-1.0, dz)]);
    let gap = b.linear(0.0, &gap);
    let rate = b.linear(0.0, &rate);
    let terms = [(stiffness, gap), (damping, rate)];
    let force = b.linear(0.0, &terms);

    let unit = b.reserve_unit();
    let gated = b.gated_linear(unit, on_floor(setup.contact), &terms);
    let weight = -setup.gravity / scales.acceleration();
    let fall = b.linear(weight, &[(1.0, gated)]);
    b.derivative(layout.z(index), dz);
    b.derivative(layout.dz(index), fall);

    let compression = Compression { gap, rate, force };
    let modes = match setup.contact {
        ContactLaw::ReactionForce => reaction_force(compression),
        ContactLaw::Gap => closing_gap(compression),
        ContactLaw::RelaxingLeg => {
            let state = layout.leg(index);
            relaxing(b, unit, state, compression, stiffness / damping)
        }
    };
    b.define_unit(unit, modes);
    Leg {
        force,
        gated,
        unit,
        damping,
        rate,
        psi,
        mass_ratio: jumper.mass / setup.plate.modal_mass(),
    }
}

/// sum_j psi_j x_j, with the place of each x_j.
fn shaped(b: &SystemBuilder, psi: &[f64], place: impl Fn(usize) -> usize) -> Vec<(f64, Node)> {
    let terms = psi.iter().enumerate();
    terms.map(|(j, &psi)| (psi, b.state(place(j)))).collect()
}

/// 1 in stance and 0 in flight, for each mode of a jumper's unit.
pub(super) fn on_floor(law: ContactLaw) -> &'static [f64] {
    match law {
        ContactLaw::Gap => &[1.0, 0.0, 0.0],
        ContactLaw::ReactionForce | ContactLaw::RelaxingLeg => &[1.0, 0.0],
    }
}

/// The guards of [`ContactLaw::ReactionForce`], mode by mode, as those of the other laws below.
fn reaction_force(Compression { force, .. }: Compression) -> Vec<Vec<Transition>> {
    vec![
        vec![Transition::falling(force, FLIGHT)],
        vec![Transition::rising(force, STANCE)],
    ]
}

fn closing_gap(Compression { gap, force, .. }: Compression) -> Vec<Vec<Transition>> {
    vec![
        vec![Transition::falling(force, LIFTED)],
        vec![Transition::rising(gap, STANCE)],
        vec![
            Transition::rising(force, STANCE),
            Transition::falling(gap, FLIGHT),
        ],
    ]
}

/// A leg whose compression s follows the floor in stance and relaxes, s' = -(k_h/c_h) s, in flight.
fn relaxing(
    b: &mut SystemBuilder,
    unit: Unit,
    state: usize,
    Compression { gap, rate, force }: Compression,
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
