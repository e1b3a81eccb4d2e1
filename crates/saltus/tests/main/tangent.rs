//! The tangent flow of people on a plate: against differences of the flow under every contact law, and
//! against Liouville's formula.

use std::sync::atomic::AtomicBool;

use saltus::hybrid::{Method, Options, System};
use saltus::model::{Contact, GRAVITY, Inertia, Model, Setup};
use saltus::orbits::{Image, MapPoint, MapRequest, Matrix, ParametricMap, Stroboscopic};
use saltus::physics::{
    Base, BaseFrequency, ContactLaw, FrequencyReference, Jumper, Mode, ModeSet, Plate,
};
use saltus::study::{Control, simulate};

const LAWS: [ContactLaw; 3] = [
    ContactLaw::ReactionForce,
    ContactLaw::Gap,
    ContactLaw::RelaxingLeg,
];

fn options(tolerance: f64) -> Options {
    Options {
        method: Method::Taylor {
            tolerance,
            order: 22,
        },
        ..Options::default()
    }
}

/// Images of places under one model, with the derivative or without.
fn images(model: &Model, starts: &[MapPoint], derivative: bool) -> Vec<Image> {
    let system = |_: &[f64]| -> Result<System, String> { Ok(model.system().clone()) };
    let stop = AtomicBool::new(false);
    let map = Stroboscopic::new(system, model.free_states(), options(1e-14), 1, &stop);
    let shot = |start| MapRequest {
        parameters: &[],
        start,
        derivative,
    };
    let shots: Vec<_> = starts.iter().map(shot).collect();
    map.images(&shots).into_iter().map(Result::unwrap).collect()
}

/// A place on the way to the long-term motion.
fn place(model: &Model, periods: u64) -> MapPoint {
    let start = model.start(3.0, 2.0);
    let run = simulate(model, &start, periods, 0, 1, &Control::default()).unwrap();
    let end = run.end.point;
    MapPoint {
        modes: end.modes,
        x: end.x[..model.free_states()].to_vec(),
    }
}

/// Largest difference between the derivative and central differences, over the largest entry.
fn against_differences(model: &Model, from: &MapPoint) -> f64 {
    let exact = images(model, std::slice::from_ref(from), true)
        .remove(0)
        .derivative
        .unwrap();
    let n = from.x.len();
    let step = 1e-6;
    let moved: Vec<MapPoint> = (0..2 * n)
        .map(|i| {
            let mut place = from.clone();
            place.x[i / 2] += if i % 2 == 0 { step } else { -step };
            place
        })
        .collect();
    let ends = images(model, &moved, false);
    let largest = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let size = largest
        .clone()
        .fold(0.0, |m: f64, at| m.max(exact[at].abs()));
    largest.fold(0.0, |worst: f64, (i, j)| {
        let difference = (ends[2 * j].place.x[i] - ends[2 * j + 1].place.x[i]) / (2.0 * step);
        worst.max((difference - exact[(i, j)]).abs() / size)
    })
}

fn determinant(matrix: &Matrix) -> f64 {
    matrix.determinant()
}

#[test]
fn the_derivative_matches_differences_under_every_law() {
    for law in LAWS {
        for (zeta, ratio) in [(0.12, 0.9), (0.28, 1.0), (0.33, 1.1)] {
            let setup = Setup {
                contact: law,
                ..Setup::dias_del_prado(zeta, ratio)
            };
            let model = setup.model().unwrap();
            for periods in [0, 7, 30] {
                let from = place(&model, periods);
                let image = images(&model, std::slice::from_ref(&from), true).remove(0);
                let worst = against_differences(&model, &from);
                // Differences of step 1e-6 see 1e-12 of curvature and 1e-14/1e-6 of rounding; a leg that has
                // left the floor early is curved more strongly near its touch-down.
                assert!(worst < 3e-7, "{law:?} {zeta} {periods}: {worst}");
                assert!(!image.crossings.is_empty(), "{law:?} {zeta} {periods}");
            }
        }
    }
}

#[test]
fn every_inertia_and_two_people_have_their_derivative() {
    for inertia in [Inertia::Full, Inertia::SlowManifold, Inertia::Condensed] {
        let mut setup = Setup {
            inertia,
            ..Setup::dias_del_prado(0.3, 1.0)
        };
        let other = Jumper {
            x: 5.0,
            y: 3.0,
            mass: 60.0,
            ..setup.jumpers[0]
        };
        setup.jumpers.push(other);
        let model = setup.model().unwrap();
        let worst = against_differences(&model, &place(&model, 3));
        // In-plane oscillations at hundreds of hertz are curved a hundred times more strongly.
        let bound = if inertia == Inertia::Full { 1e-5 } else { 3e-7 };
        assert!(worst < bound, "{inertia:?}: {worst}");
    }
}

#[test]
fn areas_on_a_rigid_base_shrink_while_in_contact() {
    // Liouville: det = exp(-2 zeta omega_h t_contact), a body on a nodal line of the only w term.
    let plate = Plate::dias_del_prado();
    for (zeta, gamma) in [(0.1, 0.8), (0.3, 1.2), (0.2, 0.3)] {
        let jumper = Jumper {
            damping_ratio: zeta,
            ..Jumper::dias_del_prado(plate.length, plate.width)
        };
        let setup = Setup {
            plate: Plate {
                modes: ModeSet {
                    u: vec![],
                    v: vec![],
                    w: vec![Mode::new(2, 1)],
                },
                ..plate.clone()
            },
            jumpers: vec![jumper],
            contact: ContactLaw::ReactionForce,
            base: Base {
                amplitude: gamma * GRAVITY / jumper.omega().powi(2),
                frequency: BaseFrequency::Ratio {
                    ratio: 1.0,
                    reference: FrequencyReference::Free,
                },
            },
            gravity: GRAVITY,
            inertia: Inertia::Condensed,
        };
        let model = setup.model().unwrap();
        let from = place(&model, 5);
        let image = images(&model, std::slice::from_ref(&from), true).remove(0);
        let derivative = image.derivative.unwrap();
        // states r, r', z, z'
        let body = Matrix::from_fn(2, 2, |i, j| derivative[(2 + i, 2 + j)]);
        let contact = contact_time(&from, &image.crossings);
        let expected = (-2.0 * zeta * std::f64::consts::TAU * contact).exp();
        let error = determinant(&body) / expected - 1.0;
        assert!(error.abs() < 1e-12, "{zeta} {gamma}: {error}");
    }
}

/// Part of a period in contact.
fn contact_time(from: &MapPoint, crossings: &[saltus::orbits::Crossing]) -> f64 {
    let mut mode = from.modes[0];
    let (mut since, mut contact) = (0.0, 0.0);
    for crossing in crossings {
        if Contact::of(mode) == Contact::Stance {
            contact += crossing.at - since;
        }
        (mode, since) = (crossing.to, crossing.at);
    }
    if Contact::of(mode) == Contact::Stance {
        contact += 1.0 - since;
    }
    contact
}

#[test]
fn volumes_shrink_by_the_divergence() {
    // The trace formula: ln det = time average of the divergence; what is in contact changes it.
    for inertia in [Inertia::Condensed, Inertia::Full] {
        let setup = Setup {
            inertia,
            ..Setup::dias_del_prado(0.2, 1.0)
        };
        let model = setup.model().unwrap();
        let from = place(&model, 4);
        let image = images(&model, std::slice::from_ref(&from), true).remove(0);
        let contact = contact_time(&from, &image.crossings);
        assert!((0.1..0.9).contains(&contact));
        let dwell = [contact, 1.0 - contact].map(|part| part * std::f64::consts::TAU);
        let expected = model.divergence(&[dwell.to_vec()]);
        let found = determinant(&image.derivative.unwrap()).ln();
        // 34 states lose some digits in the determinant
        let bound = if inertia == Inertia::Full {
            1e-7
        } else {
            1e-11
        };
        assert!(
            (found - expected).abs() < bound,
            "{inertia:?}: {found} {expected}"
        );
    }
}
