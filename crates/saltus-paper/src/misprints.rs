//! The paper's misprints and gaps, and how much each would change.

use std::f64::consts::TAU;
use std::sync::Arc;

use saltus::model::{Contact, GRAVITY, Inertia, PreparedPlate};
use saltus::physics::{ContactLaw, FrequencyReference, Jumper, Mode, Plate};
use saltus::study::{Control, StudyError, simulate};

use crate::setting::setup;

/// One place where the paper cannot mean what it prints.
#[derive(Clone, Debug, PartialEq)]
pub struct Misprint {
    /// Place in the paper.
    pub place: &'static str,
    /// Text as printed.
    pub printed: &'static str,
    /// Reading that we use, and why.
    pub used: &'static str,
    /// Size of the change.
    pub effect: String,
}

/// The table, with the size of each effect computed.
///
/// # Errors
/// [`StudyError`] if there is no model of the paper's plate, or when stopped.
pub fn misprints(control: &Control) -> Result<Vec<Misprint>, StudyError> {
    let plate = Plate::dias_del_prado();
    let jumper = Jumper::dias_del_prado(plate.length, plate.width);
    let right = body_hz(&plate, &jumper)?;
    let mut table = of_frequencies(&plate, &jumper, right)?;
    table.extend(of_forces(&jumper, control)?);
    table.push(Misprint {
        place: "section 3, Omega = 0.9, 1.0, 1.1 omega_h",
        printed: "omega_h without saying which",
        used: "the occupied body frequency; the free one is offered and contradicts two statements",
        effect: format!(
            "Omega = 1.0 omega_h is {right:.4} Hz or {:.4} Hz; see F4 to F8",
            jumper.omega() / TAU
        ),
    });
    Ok(table)
}

/// Misprints that change the body's frequency on the plate; `right` is the true one (Hz).
fn of_frequencies(plate: &Plate, jumper: &Jumper, right: f64) -> Result<Vec<Misprint>, StudyError> {
    let mut without = plate.clone();
    without.modes.w.retain(|mode| *mode != Mode::new(3, 1));
    let stiffer = Jumper {
        stiffness: jumper.mass * (TAU * 2.48).powi(2),
        ..*jumper
    };
    Ok(vec![
        Misprint {
            place: "section 3, the 16 coordinates",
            printed: "14 names, one u_{1,2} among the v",
            used: "u 21 23 41 43 61 81, v 12 14 16 18 32 34, w 11 13 31 33: sixteen, and the printed \
                   occupied frequencies need w_31",
            effect: format!(
                "body frequency {:.4} Hz without w_31, {right:.4} Hz with it (printed 2.537)",
                body_hz(&without, jumper)?
            ),
        },
        Misprint {
            place: "section 3, k_h and omega_h",
            printed: "18.6 kN/m and 2.48 Hz",
            used: "k_h = 18 600 N/m, so omega_h = 2.4794 Hz",
            effect: format!(
                "occupied body frequency {:.4} Hz from 2.48 Hz exactly, {right:.4} Hz from 18.6 kN/m",
                body_hz(plate, &stiffer)?
            ),
        },
        Misprint {
            place: "Eq. (9a)",
            printed: "psi_i^2 in the sums over i",
            used: "psi_i psi_j, from Lagrange's equations of (2) and (6)",
            effect: format!(
                "occupied body frequency {:.4} Hz as printed, {right:.4} Hz as derived",
                printed_9a(plate, jumper)
            ),
        },
    ])
}

/// Misprints that change a force or a flight.
fn of_forces(jumper: &Jumper, control: &Control) -> Result<Vec<Misprint>, StudyError> {
    let weight = jumper.mass * GRAVITY;
    Ok(vec![
        Misprint {
            place: "Eqs. (9c), (11b)",
            printed: "4^2/pi^2 for every coordinate",
            used: "16/(pi^2 m_j n_j) for odd m_j n_j, else 0: the integral of psi_j",
            effect: format!(
                "load 3, 3, 9 times too large on w_13, w_31, w_33; the 2T orbit of Fig. 3e moves by {:.1e} eta",
                printed_9c(control)?
            ),
        },
        Misprint {
            place: "Eq. (10)",
            printed: "+ k_h (...)",
            used: "- k_h (...): at rest the reaction must equal the weight",
            effect: format!("at rest {:.1} N instead of {weight:.1} N", -weight),
        },
        Misprint {
            place: "Eq. (13a)",
            printed: "... - t_0 q(t_0)",
            used: "... - t_0 q'(t_0): free fall",
            effect: printed_13a(control)?,
        },
    ])
}

/// Frequency (Hz) of the body on the plate.
fn body_hz(plate: &Plate, jumper: &Jumper) -> Result<f64, StudyError> {
    let modes = plate.occupied(&[*jumper])?;
    Ok(modes.hz[modes.body_index.unwrap_or(0)])
}

/// Body frequency (Hz) of the equations as (9a) prints them: with D_j = K_j - lambda M and
/// B_n = sum psi_j^n/D_j the determinant condition is
/// k - lambda m = k^2 (B_2 - k B_1 B_3/(1 + k B_2)).
fn printed_9a(plate: &Plate, jumper: &Jumper) -> f64 {
    let psi = plate.mode_shape(jumper.x, jumper.y);
    let (bending, mass, k) = (
        plate.bending_stiffness(),
        plate.modal_mass(),
        jumper.stiffness,
    );
    let residual = |hz: f64| {
        let lambda = (TAU * hz).powi(2);
        let sum = |n: i32| -> f64 {
            psi.iter()
                .zip(&bending)
                .map(|(p, kb)| p.powi(n) / (kb - lambda * mass))
                .sum()
        };
        let (b1, b2, b3) = (sum(1), sum(2), sum(3));
        k - lambda * jumper.mass - k * k * (b2 - k * b1 * b3 / (1.0 + k * b2))
    };
    // The body's root lies between the first and the second frequency of the empty plate; (9a)
    // moves it, so look for the change of sign closest above the free frequency.
    let mut low = jumper.omega() / TAU;
    let step = 1e-3;
    while residual(low) * residual(low + step) > 0.0 && low < 4.0 {
        low += step;
    }
    let (mut a, mut b) = (low, low + step);
    for _ in 0..60 {
        let middle = 0.5 * (a + b);
        if residual(a) * residual(middle) <= 0.0 {
            b = middle;
        } else {
            a = middle;
        }
    }
    0.5 * (a + b)
}

/// Largest move of the 2T orbit at Omega = 1.0, zeta_h = 0.28 (in eta) under the printed load.
fn printed_9c(control: &Control) -> Result<f64, StudyError> {
    let setup = setup(
        0.28,
        1.0,
        FrequencyReference::Occupied,
        ContactLaw::ReactionForce,
        Inertia::Condensed,
    );
    let right = PreparedPlate::new(&setup.plate)?;
    let mut printed = PreparedPlate::clone(&right);
    for load in &mut printed.elasticity.base_load {
        *load = 16.0 / std::f64::consts::PI.powi(2) * printed.elasticity.transverse_mass;
    }
    let mut orbits = Vec::new();
    for plate in [&right, &Arc::new(printed)] {
        let model = setup.model_on(plate)?;
        let run = simulate(&model, &model.start(3.0, 2.0), 500, 0, 1, control)?;
        let mut z: Vec<f64> = run.section[run.section.len() - 2..]
            .iter()
            .map(|s| s.z[0])
            .collect();
        z.sort_by(f64::total_cmp);
        orbits.push(z);
    }
    Ok(orbits[0]
        .iter()
        .zip(&orbits[1])
        .fold(0.0, |m: f64, (a, b)| m.max((a - b).abs())))
}

/// By how much (13a) as printed misses the height at a take-off: t_0 (q'(t_0) - q(t_0)).
fn printed_13a(control: &Control) -> Result<String, StudyError> {
    let setup = setup(
        0.28,
        1.0,
        FrequencyReference::Occupied,
        ContactLaw::ReactionForce,
        Inertia::Condensed,
    );
    let model = setup.model()?;
    let run = simulate(&model, &model.start(3.0, 2.0), 100, 2, 2000, control)?;
    let scale = model.scales().jumpers[0];
    let history = &run.history;
    let first = history.time.first().copied().unwrap_or(0.0);
    let take_off = run
        .switches
        .iter()
        .find(|s| s.into == Some(Contact::Flight) && s.time >= first)
        .map(|s| s.time);
    let at = take_off.and_then(|t| {
        let i = history.time.iter().position(|&s| s >= t)?;
        let state = &history.states[i];
        Some((t, state.z[0] * scale.position, state.v[0] * scale.velocity))
    });
    Ok(match at {
        Some((t, q, dq)) => format!(
            "at a take-off of Fig. 3e, t_0 = {t:.1} s, the body would jump by {:.1} m",
            (t * (dq - q)).abs()
        ),
        None => "the height at take-off would jump by t_0 (q' - q)".into(),
    })
}
