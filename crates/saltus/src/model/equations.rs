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

use std::collections::HashMap;

use saltus_hybrid::{BuildError, Mode, Node, System, SystemBuilder, Transition, Unit};

use super::energy::{BaseMotion, EnergyLedger};
use super::{Inertia, Layout, PreparedPlate, Scales, Setup};
use crate::physics::{ContactLaw, Jumper, QuarticTerm};

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
    let elastic = elastic_forces(&mut b, setup, plate, scales, layout);
    for (j, &load) in loads.iter().enumerate() {
        let mut terms = vec![
            (
                -e.bending[j] / (e.transverse_mass * scales.omega.powi(2)),
                b.state(layout.r(j)),
            ),
            (-damping, b.state(layout.dr(j))),
            (load, cos),
            (load * damping, sin),
        ];
        terms.extend(elastic.transverse[j].map(|node| (-1.0, node)));
        terms.extend(
            legs.iter()
                .map(|leg| (-leg.mass_ratio * leg.psi[j], leg.gated)),
        );
        let acceleration = b.linear(0.0, &terms);
        b.derivative(layout.r(j), b.state(layout.dr(j)));
        b.derivative(layout.dr(j), acceleration);
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
        ledger,
    })
}

/// Elastic forces beyond linear bending, as nodes.
struct Elastic {
    /// sum_k T_jk R_k; none where nothing couples.
    transverse: Vec<Option<Node>>,
    /// Terms of P_i''.
    in_plane: Vec<Vec<(f64, Node)>>,
}

fn elastic_forces(
    b: &mut SystemBuilder,
    setup: &Setup,
    plate: &PreparedPlate,
    scales: &Scales,
    layout: Layout,
) -> Elastic {
    let e = &plate.elasticity;
    let n = layout.transverse;
    let h = scales.length;
    let per_mass = 1.0 / (e.transverse_mass * scales.omega.powi(2));
    // All products R_j R_k, j <= k.
    let factors: Vec<_> = pairs(n)
        .map(|(j, k)| (b.state(layout.r(j)), b.state(layout.r(k))))
        .collect();
    let squares: HashMap<(usize, usize), Node> = pairs(n).zip(b.products(&factors)).collect();
    // T_jk as sums over R_l R_m and P_i.
    let mut tension: HashMap<(usize, usize), Vec<(f64, Node)>> = HashMap::new();
    let quartic = match setup.inertia {
        Inertia::Full => &e.quartic,
        Inertia::Condensed => &plate.condensed,
    };
    for term in quartic {
        for ((j, k), (l, m), weight) in splits(term) {
            let value = 4.0 * weight * term.value * h * h * per_mass;
            tension
                .entry((j, k))
                .or_default()
                .push((value, squares[&(l, m)]));
        }
    }
    let mut in_plane = vec![Vec::new(); layout.in_plane];
    if setup.inertia == Inertia::Full {
        for term in &e.coupling {
            let p = b.state(layout.p(term.i));
            tension
                .entry((term.j, term.k))
                .or_default()
                .push((2.0 * term.value * h * per_mass, p));
            let inertia = e.in_plane_mass[term.i] * scales.omega.powi(2);
            let value = -term.multiplicity() * term.value * h / inertia;
            in_plane[term.i].push((value, squares[&(term.j, term.k)]));
        }
        for (i, terms) in in_plane.iter_mut().enumerate() {
            let inertia = e.in_plane_mass[i] * scales.omega.powi(2);
            for k in (0..layout.in_plane).filter(|&k| e.membrane_at(i, k) != 0.0) {
                terms.push((-e.membrane_at(i, k) / inertia, b.state(layout.p(k))));
            }
        }
    }
    let tension = tension_nodes(b, &tension, n);
    let transverse = (0..n)
        .map(|j| {
            let products: Vec<_> = (0..n)
                .filter_map(|k| {
                    let node = tension.get(&(j.min(k), j.max(k)))?;
                    Some((*node, b.state(layout.r(k))))
                })
                .collect();
            (!products.is_empty()).then(|| b.dot(&products))
        })
        .collect();
    Elastic {
        transverse,
        in_plane,
    }
}

/// One node per T_jk that is not zero: as a matrix where that is mostly full, else as sums.
fn tension_nodes(
    b: &mut SystemBuilder,
    tension: &HashMap<Pair, Vec<(f64, Node)>>,
    n: usize,
) -> HashMap<Pair, Node> {
    let present: Vec<(Pair, &Vec<(f64, Node)>)> = pairs(n)
        .filter_map(|pair| Some((pair, tension.get(&pair)?)))
        .collect();
    let mut nodes: Vec<Node> = Vec::new();
    for (_, node) in present.iter().flat_map(|(_, terms)| terms.iter()) {
        if !nodes.contains(node) {
            nodes.push(*node);
        }
    }
    let entries: usize = present.iter().map(|(_, terms)| terms.len()).sum();
    if 2 * entries < present.len() * nodes.len() {
        return present
            .into_iter()
            .map(|(pair, terms)| (pair, b.linear(0.0, terms)))
            .collect();
    }
    let row = |terms: &[(f64, Node)]| -> Vec<f64> {
        let entry = |node: &Node| terms.iter().filter(|t| t.1 == *node).map(|t| t.0).sum();
        nodes.iter().map(entry).collect()
    };
    let rows: Vec<Vec<f64>> = present.iter().map(|(_, terms)| row(terms)).collect();
    present
        .iter()
        .map(|(pair, _)| *pair)
        .zip(b.matrix(&nodes, &rows))
        .collect()
}

/// A pair of transverse indices, the smaller first.
type Pair = (usize, usize);

/// j <= k < n, in a fixed order.
fn pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |k| (0..=k).map(move |j| (j, k)))
}

/// (j <= k), (l <= m), and the number of orders of (l, m).
type Split = (Pair, Pair, f64);

/// The distinct ways to split a sorted quadruple into (j <= k) and (l <= m), with the number of
/// orders of (l, m): the entries of sum_lm Q_jklm R_l R_m for each pair jk.
fn splits(term: &QuarticTerm) -> Vec<Split> {
    let q = term.indices();
    let mut out: Vec<Split> = Vec::new();
    for (first, second) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
        let rest: Vec<usize> = (0..4).filter(|i| *i != first && *i != second).collect();
        let (outer, inner) = ((q[first], q[second]), (q[rest[0]], q[rest[1]]));
        if !out.iter().any(|o| o.0 == outer && o.1 == inner) {
            out.push((outer, inner, if inner.0 == inner.1 { 1.0 } else { 2.0 }));
        }
    }
    out
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
    let gated = b.gate(unit, on_floor(setup.contact), force);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splits_cover_the_full_quartic_sum() {
        // For indices jklm all different: 6 outer pairs, each with two orders inside.
        let term = |j, k, l, m| QuarticTerm {
            j,
            k,
            l,
            m,
            value: 1.0,
        };
        for (term, outer) in [
            (term(0, 1, 2, 3), 6),
            (term(0, 0, 0, 0), 1),
            (term(0, 0, 1, 1), 3),
        ] {
            let parts = splits(&term);
            assert_eq!(parts.len(), outer);
            // sum over ordered outer pairs of the inner weights = number of orders of the quadruple
            let total: f64 = parts
                .iter()
                .map(|(o, _, w)| w * if o.0 == o.1 { 1.0 } else { 2.0 })
                .sum();
            assert_eq!(total, term.multiplicity());
        }
    }
}
