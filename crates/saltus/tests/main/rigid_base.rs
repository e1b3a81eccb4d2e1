//! The jumper alone and the jumper on a linear plate, against closed forms.
//!
//! Whoever stands on a nodal line of every w term feels a rigid base exactly, so the production
//! equations themselves are tested, not a copy of them. Units of the closed forms: lengths in
//! eta = g/omega_h^2, time in 1/omega_h, r = Omega/omega_h, Gamma = A_b Omega^2/g.

#![allow(clippy::approx_constant)] // published digits stay as published

use std::f64::consts::{PI, TAU};
use std::ops::{Add, Div, Mul, Sub};

use saltus::hybrid::{Method, Options, Point};
use saltus::model::{Contact, GRAVITY, Inertia, Model, Setup};
use saltus::physics::{
    Base, BaseFrequency, ContactLaw, FrequencyReference, Jumper, Load, Mode, ModeSet, Plate,
};
use saltus::study::{Control, Trajectory, simulate};

fn modes(list: &[(u32, u32)]) -> ModeSet {
    ModeSet {
        u: Vec::new(),
        v: Vec::new(),
        w: list.iter().map(|&(m, n)| Mode::new(m, n)).collect(),
    }
}

fn jumper(damping_ratio: f64) -> Jumper {
    let plate = Plate::dias_del_prado();
    Jumper {
        damping_ratio,
        ..Jumper::dias_del_prado(plate.length, plate.width)
    }
}

/// A jumper on the nodal line x = a/2 of the only mode (2, 1), which no base motion excites.
fn on_rigid_base(zeta: f64, gamma: f64, r: f64) -> Setup {
    let jumper = jumper(zeta);
    let setup = Setup {
        plate: Plate {
            modes: modes(&[(2, 1)]),
            ..Plate::dias_del_prado()
        },
        jumpers: vec![jumper],
        contact: ContactLaw::ReactionForce,
        base: Base {
            amplitude: gamma * GRAVITY / (r * jumper.omega()).powi(2),
            frequency: BaseFrequency::Ratio {
                ratio: r,
                reference: FrequencyReference::Free,
            },
        },
        gravity: GRAVITY,
        inertia: Inertia::Condensed,
    };
    assert!(setup.plate.on_nodal_lines(&jumper));
    setup
}

fn with(method: Method) -> Control {
    Control {
        options: Options {
            method,
            ..Options::default()
        },
        threads: 1,
        ..Control::default()
    }
}

fn taylor(tolerance: f64) -> Control {
    with(Method::taylor(tolerance))
}

fn run(model: &Model, start: &Point, periods: u64, control: &Control) -> Trajectory {
    let out = simulate(model, start, periods, 1, 200, control).unwrap();
    assert_eq!(out.end.periods, periods);
    out
}

// ---------------------------------------------------------------- loss of contact

#[derive(Clone, Copy, Debug)]
struct Complex(f64, f64);

impl Add for Complex {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self(self.0 + o.0, self.1 + o.1)
    }
}
impl Sub for Complex {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self(self.0 - o.0, self.1 - o.1)
    }
}
impl Mul for Complex {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self(self.0 * o.0 - self.1 * o.1, self.0 * o.1 + self.1 * o.0)
    }
}
impl Div for Complex {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let size = o.0 * o.0 + o.1 * o.1;
        self * Self(o.0 / size, -o.1 / size)
    }
}
impl Complex {
    fn abs(self) -> f64 {
        self.0.hypot(self.1)
    }
}

/// Body over base in steady contact: (1 + 2 i zeta r)/(1 - r^2 + 2 i zeta r).
fn transmissibility(zeta: f64, r: f64) -> Complex {
    let d = 2.0 * zeta * r;
    Complex(1.0, d) / Complex(1.0 - r * r, d)
}

/// (z, v) of the steady state in contact when the base is at its top.
fn steady(zeta: f64, gamma: f64, r: f64) -> (f64, f64) {
    let body = transmissibility(zeta, r);
    let a = gamma / (r * r);
    (a * body.0 - 1.0, -r * a * body.1)
}

/// Force over weight swings by gamma |H|: it touches zero at gamma = 1/|H|.
fn critical(zeta: f64, r: f64) -> f64 {
    let d = 2.0 * zeta * r;
    (1.0 - r * r).hypot(d) / 1.0_f64.hypot(d)
}

#[test]
fn contact_is_lost_at_the_closed_form_amplitude() {
    // Published for r = 1 to nine digits. The model is run on its steady state in contact, and the
    // amplitude where it first switches is found by halving: errors are those of the orbit, 1e-12.
    let mut cases: Vec<(f64, f64, Option<f64>)> = [
        (0.1, 0.196_116_135),
        (0.2, 0.371_390_676),
        (0.3, 0.514_495_755),
        (0.5, 0.707_106_781),
    ]
    .map(|(zeta, gamma)| (zeta, 1.0, Some(gamma)))
    .to_vec();
    for r in [0.3, 0.7, 0.9, 1.1, 1.5, 3.0] {
        cases.extend([0.05, 0.1, 0.3, 0.6].map(|zeta| (zeta, r, None)));
    }
    for (zeta, r, published) in cases {
        let expected = critical(zeta, r);
        if let Some(published) = published {
            assert!((expected - published).abs() < 6e-10, "{zeta} {expected}");
        }
        let leaves = |gamma: f64| {
            let model = on_rigid_base(zeta, gamma, r).model().unwrap();
            let (z, v) = steady(zeta, gamma, r);
            let out = run(&model, &model.start(z, v), 2, &taylor(1e-14));
            out.switches.iter().any(|s| s.into == Some(Contact::Flight))
        };
        let (mut lo, mut hi) = (0.5 * expected, 1.5 * expected);
        assert!(!leaves(lo) && leaves(hi));
        while hi - lo > 1e-12 {
            let middle = 0.5 * (lo + hi);
            if leaves(middle) {
                hi = middle;
            } else {
                lo = middle;
            }
        }
        let error = (lo - expected).abs();
        assert!(error < 1e-10, "zeta {zeta} r {r}: {lo} for {expected}");
    }
}

#[test]
fn below_that_amplitude_every_start_settles_on_the_linear_response() {
    for (zeta, r) in [(0.1, 1.0), (0.3, 0.7), (0.5, 1.6)] {
        let gamma = 0.9 * critical(zeta, r);
        let model = on_rigid_base(zeta, gamma, r).model().unwrap();
        // 100 periods: exp(-2 pi zeta 100/r) < 1e-26
        let out = run(&model, &model.start(2.0, -1.0), 100, &taylor(1e-13));
        let (z, v) = steady(zeta, gamma, r);
        let last = out.section.last().unwrap();
        assert!((last.z[0] - z).abs() < 1e-11 && (last.v[0] - v).abs() < 1e-11);
        // Force at all times: 1 - gamma Re(H exp(i r t)), as z'' = PRF - 1.
        let body = transmissibility(zeta, r);
        let points = out.history.states.len();
        assert_eq!(points, 200);
        for (i, seen) in out.history.states.iter().enumerate() {
            let phase = TAU * i as f64 / points as f64;
            let force = 1.0 - gamma * (body * Complex(phase.cos(), phase.sin())).0;
            assert!((seen.prf[0] - force).abs() < 1e-11);
        }
    }
}

// ---------------------------------------------------------------- the undamped hop

#[test]
fn the_undamped_hop_has_its_period_and_its_peak_force() {
    // Leaves at speed v: flight 2 v, stance 2 (pi - atan v), peak 1 + sqrt(1 + v^2).
    // v = 1: 6.712388980 and 2.414213562. Conservative: errors grow with time, here to 1e-12.
    assert!((2.0 * (PI - 1.0_f64.atan()) + 2.0 - 6.712_388_980).abs() < 5e-10);
    for v in [0.1, 1.0, 3.0] {
        let (flight, stance) = (2.0 * v, 2.0 * (PI - f64::atan(v)));
        // A base that rests, whose period ends at the lowest point of the second stance.
        let lowest = flight + stance + flight + stance / 2.0;
        let setup = on_rigid_base(0.0, 0.0, TAU / lowest);
        let model = setup.model().unwrap();
        for (control, tolerance) in [
            (taylor(1e-14), 1e-12),
            // h = 0.02 or less: h^4/120 per unit of time
            (
                with(Method::Rk4 {
                    steps_per_period: 2000,
                }),
                1e-8,
            ),
        ] {
            let out = run(&model, &model.start(0.0, v), 1, &control);
            let times: Vec<f64> = out
                .switches
                .iter()
                .map(|s| s.time * setup.jumpers[0].omega())
                .collect();
            let expected = [flight, flight + stance, flight + stance + flight];
            assert_eq!(times.len(), 3, "{times:?}");
            for (t, e) in times.iter().zip(expected) {
                assert!((t - e).abs() < tolerance, "{times:?} {expected:?}");
            }
            let last = out.section.last().unwrap();
            let peak = 1.0 + 1.0_f64.hypot(v);
            assert!((last.z[0] + peak).abs() < tolerance && last.v[0].abs() < tolerance);
            let end = &out.end.point;
            let seen = model.observe(&mut model.evaluator(), &end.modes, &end.x);
            assert!((seen.prf[0] - peak).abs() < tolerance);
        }
    }
}

// ---------------------------------------------------------------- flight

/// Largest distance from the parabola of gravity through both ends of each flight, in eta.
fn off_the_parabola(model: &Model, out: &Trajectory) -> (f64, usize) {
    let omega = model.setup().jumpers[0].omega();
    let (mut worst, mut flights) = (0.0_f64, 0);
    let seen: Vec<(f64, f64, bool)> = out
        .history
        .time
        .iter()
        .zip(&out.history.states)
        .map(|(t, s)| (omega * t, s.z[0], s.prf[0] == 0.0))
        .collect();
    for flight in seen.chunk_by(|a, b| a.2 == b.2).filter(|c| c[0].2) {
        let [first, .., last] = flight else { continue };
        flights += 1;
        let duration = last.0 - first.0;
        for (t, z, _) in flight {
            let s = t - first.0;
            let chord = first.1 + (last.1 - first.1) * s / duration;
            worst = worst.max((z - chord - 0.5 * s * (duration - s)).abs());
        }
    }
    (worst, flights)
}

#[test]
fn flight_is_a_parabola() {
    // Both steppers integrate a parabola exactly; what is left is the rounding of times of some
    // hundred periods (1e-13) and of heights of some eta, summed over the steps of a flight.
    let rigid = |contact| Setup {
        contact,
        ..on_rigid_base(0.2, 0.9, 1.0)
    };
    let flexible = |contact| Setup {
        contact,
        ..Setup::dias_del_prado(0.2, 1.0)
    };
    for contact in ContactLaw::ALL {
        for setup in [rigid(contact), flexible(contact)] {
            let model = setup.model().unwrap();
            for control in [
                taylor(1e-10),
                with(Method::Rk4 {
                    steps_per_period: 100,
                }),
            ] {
                let out = simulate(&model, &model.start(2.0, 0.0), 30, 30, 300, &control).unwrap();
                let (worst, flights) = off_the_parabola(&model, &out);
                assert!(flights >= 10, "{contact:?}: {flights} flights");
                assert!(worst < 1e-12, "{contact:?}: {worst:e}");
            }
        }
    }
}

// ---------------------------------------------------------------- the linear plate

/// Complex amplitudes of (r_1 .. r_N, z) for base motion cos(Omega t) of amplitude 1, people in
/// contact, from the equations of motion as printed in the reference, in SI units.
fn linear_response(setup: &Setup, omega: f64) -> Vec<Complex> {
    let plate = &setup.plate;
    let bending = plate.bending_stiffness();
    let (n, mass, c) = (bending.len(), plate.modal_mass(), plate.damping());
    let size = n + setup.jumpers.len();
    let mut a = vec![vec![Complex(0.0, 0.0); size + 1]; size];
    for (j, mode) in plate.modes.w.iter().enumerate() {
        a[j][j] = Complex(bending[j] - mass * omega * omega, mass * c * omega);
        // integral of rho h psi over the plate
        let odd = mode.m % 2 == 1 && mode.n % 2 == 1;
        let load = if odd {
            16.0 * mass / (PI * PI * f64::from(mode.m * mode.n))
        } else {
            0.0
        };
        a[j][size] = Complex(load * omega * omega, -load * c * omega);
    }
    for (i, jumper) in setup.jumpers.iter().enumerate() {
        let leg = Complex(
            jumper.stiffness,
            2.0 * jumper.damping_ratio * (jumper.stiffness * jumper.mass).sqrt() * omega,
        );
        let psi = plate.mode_shape(jumper.x, jumper.y);
        let z = n + i;
        for j in 0..n {
            let on_leg = leg * Complex(psi[j], 0.0);
            for k in 0..n {
                a[j][k] = a[j][k] + on_leg * Complex(psi[k], 0.0);
            }
            a[j][z] = a[j][z] - on_leg;
            a[z][j] = a[z][j] - on_leg;
            a[j][size] = a[j][size] - on_leg;
        }
        a[z][z] = leg - Complex(jumper.mass * omega * omega, 0.0);
        a[z][size] = leg;
    }
    gauss(a)
}

/// Gaussian elimination with partial pivoting; the right-hand side is the last column.
fn gauss(mut a: Vec<Vec<Complex>>) -> Vec<Complex> {
    let n = a.len();
    for k in 0..n {
        let pivot = (k..n)
            .max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()))
            .unwrap();
        a.swap(k, pivot);
        for i in 0..n {
            if i != k {
                let factor = a[i][k] / a[k][k];
                let row = a[k].clone();
                for (a, pivot) in a[i].iter_mut().zip(row) {
                    *a = *a - factor * pivot;
                }
            }
        }
    }
    (0..n).map(|i| a[i][n] / a[i][i]).collect()
}

/// The paper's plate, well damped so that transients die, with gravity and base so weak that
/// deflections are some 1e-6 to 1e-5 h and the stretching of the plate 1e-10 of its bending.
fn weak(jumpers: Vec<Jumper>, ratio: f64) -> Setup {
    let paper = Setup::dias_del_prado(0.3, 1.0);
    Setup {
        plate: Plate {
            damping_ratio: 0.15,
            ..paper.plate.clone()
        },
        jumpers,
        gravity: 1e-3 * GRAVITY,
        base: Base {
            amplitude: 1e-7,
            frequency: BaseFrequency::Ratio {
                ratio,
                reference: FrequencyReference::Plate,
            },
        },
        ..paper
    }
}

/// The last of 60 periods from rest, exp(-2 pi 0.15 60/1.3) = 1e-19.
fn settled(setup: &Setup) -> (Model, Trajectory) {
    let model = setup.model().unwrap();
    let control = with(Method::Taylor {
        tolerance: 1e-16, // of h, where deflections are 1e-5 h
        order: 20,
    });
    let out = run(&model, &model.start(-1.0, 0.0), 60, &control);
    (model, out)
}

#[test]
fn without_flight_the_response_is_the_linear_one() {
    let at = |x: f64, y: f64| Jumper {
        x,
        y,
        ..jumper(0.3)
    };
    for (jumpers, inertia, ratio) in [
        (vec![at(7.0, 5.0)], Inertia::Condensed, 0.8),
        (vec![at(7.0, 5.0)], Inertia::Condensed, 1.05),
        (vec![at(7.0, 5.0)], Inertia::Full, 1.05),
        (vec![at(3.0, 4.0), at(9.5, 6.5)], Inertia::Condensed, 0.95),
        (vec![], Inertia::Condensed, 1.1),
    ] {
        let setup = Setup {
            inertia,
            ..weak(jumpers, ratio)
        };
        let (model, out) = settled(&setup);
        assert!(
            out.history
                .states
                .iter()
                .all(|s| s.prf.iter().all(|f| *f > 0.0))
        );
        let amplitudes = linear_response(&setup, model.scales().omega);
        let people: Vec<Load> = setup
            .jumpers
            .iter()
            .map(|j| Load::weight(j, setup.gravity))
            .collect();
        let rest = setup.plate.linear_deflection(&people).unwrap();
        let (a, h) = (setup.base.amplitude, setup.plate.thickness);
        let largest = amplitudes.iter().fold(0.0, |m: f64, z| m.max(z.abs())) * a;
        // Of the largest amplitude: stretching (w/h)^2 = 1e-10 (found: 5e-10), orbit 1e-16 h in
        // 1e-5 h. Rounding cannot be reached in a plate that stretches.
        let tolerance = 2e-9 * largest;
        let last = out.section.last().unwrap();
        for (j, rest) in rest.iter().enumerate() {
            let expected = rest + a * amplitudes[j].0;
            let found = last.w[j] * h;
            assert!((found - expected).abs() < tolerance, "{found} {expected}");
        }
        for (i, jumper) in setup.jumpers.iter().enumerate() {
            let eta = jumper.static_compression(setup.gravity);
            let floor = setup.plate.deflection_at(&rest, jumper.x, jumper.y);
            let z = amplitudes[rest.len() + i];
            let expected = floor - eta + a * z.0;
            let found = last.z[i] * eta;
            assert!((found - expected).abs() < tolerance, "{found} {expected}");
            let expected = -a * model.scales().omega * z.1;
            let found = last.v[i] * eta * jumper.omega();
            let speed = tolerance * model.scales().omega;
            assert!((found - expected).abs() < speed, "{found} {expected}");
        }
    }
}

#[test]
fn reaction_at_rest_is_the_weight() {
    // DP Eq. (10) with the sign of (9b). The base rests; 80 periods of the plate at 15 % damping.
    for jumpers in [
        vec![jumper(0.3)],
        vec![
            jumper(0.3),
            Jumper {
                x: 3.0,
                y: 8.0,
                mass: 120.0,
                ..jumper(0.2)
            },
        ],
    ] {
        for inertia in [Inertia::Condensed, Inertia::Full] {
            let setup = Setup {
                gravity: GRAVITY,
                inertia,
                base: Base {
                    amplitude: 0.0,
                    frequency: BaseFrequency::Hertz(2.0),
                },
                ..weak(jumpers.clone(), 1.0)
            };
            let model = setup.model().unwrap();
            let out = run(&model, &model.start(-1.0, 0.0), 80, &taylor(1e-13));
            for seen in &out.history.states {
                for force in &seen.prf {
                    // the orbit's 1e-13 h over the leg's compression, 0.4 h
                    assert!((force - 1.0).abs() < 1e-11, "{force}");
                }
            }
            // ... and the plate hangs where statics says, von Karman's stretching included.
            let people: Vec<Load> = setup
                .jumpers
                .iter()
                .map(|j| Load::weight(j, GRAVITY))
                .collect();
            let rest = setup.plate.deflection(&people).unwrap();
            for (found, rest) in out.section.last().unwrap().w.iter().zip(rest) {
                let rest = rest / setup.plate.thickness;
                assert!((found - rest).abs() < 1e-11, "{found} {rest}");
            }
        }
    }
}

#[test]
fn a_stiff_leg_is_an_added_mass_and_a_light_body_is_nobody() {
    let one_mode = |jumpers, ratio| {
        let setup = weak(jumpers, ratio);
        Setup {
            plate: Plate {
                modes: modes(&[(1, 1)]),
                ..setup.plate
            },
            ..setup
        }
    };
    let ratio = 0.9;
    // Amplitude of r_11 seen at phase 0, without the part at rest.
    let part = |setup: &Setup, people: &[Load]| {
        let rest = setup.plate.linear_deflection(people).unwrap()[0];
        let (_, out) = settled(setup);
        out.section.last().unwrap().w[0] * setup.plate.thickness - rest
    };
    let omega = ratio * Plate::dias_del_prado().first_omega();

    // (M + m) r'' + c M r' + K r = load + m A Omega^2 cos(Omega t), body at the centre
    let stiff = |factor: f64| {
        let body = jumper(0.3);
        let body = Jumper {
            stiffness: body.stiffness * factor,
            ..body
        };
        let setup = one_mode(vec![body], ratio);
        let (mass, c) = (setup.plate.modal_mass(), setup.plate.damping());
        let load = 16.0 * mass / (PI * PI);
        let stiffness = setup.plate.bending_stiffness()[0];
        let total = mass + body.mass;
        let push = Complex((load + body.mass) * omega * omega, -load * c * omega);
        let r = push / Complex(stiffness - total * omega * omega, mass * c * omega);
        let found = part(&setup, &[Load::weight(&body, setup.gravity)]);
        (found / setup.base.amplitude - r.0).abs() / r.abs()
    };
    // A leg of finite stiffness adds m (1 + (Omega/omega_h)^2): an error in the mass of 7e-5 at
    // factor 1e4, of which m/M = 0.009 is seen (found: 8e-7), and a tenth of that at 1e5.
    let (soft, hard) = (stiff(1e4), stiff(1e5));
    assert!(
        soft < 2e-6 && (soft / hard - 10.0).abs() < 0.5,
        "{soft} {hard}"
    );

    // m/M = 1e-8 in mass, some ten times that in a response near resonance (found: 2e-7)
    let light = Jumper {
        mass: 1e-4,
        stiffness: 18_600.0 * 1e-4 / 76.64,
        ..jumper(0.3)
    };
    let (with, without) = (one_mode(vec![light], ratio), one_mode(Vec::new(), ratio));
    let with_body = part(&with, &[Load::weight(&light, with.gravity)]);
    let empty = part(&without, &[]);
    let difference = (with_body - empty).abs() / empty.abs();
    assert!(difference < 1e-6, "{difference:e}");
}

// ---------------------------------------------------------------- Liouville

/// det of the derivative of the stroboscopic map at (z, v): five-point differences.
fn determinant(model: &Model, start: [f64; 2], h: f64) -> f64 {
    let control = with(Method::Taylor {
        tolerance: 1e-16,
        order: 24,
    });
    let map = |x: [f64; 2]| {
        let out = run(model, &model.start(x[0], x[1]), 1, &control);
        [out.section[0].z[0], out.section[0].v[0]]
    };
    let column = |i: usize| {
        let at = |s: f64| {
            let mut x = start;
            x[i] += s * h;
            map(x)
        };
        let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(at);
        [0, 1].map(|k| (a[k] - 8.0 * b[k] + 8.0 * c[k] - d[k]) / (12.0 * h))
    };
    let (p, q) = (column(0), column(1));
    p[0] * q[1] - p[1] * q[0]
}

#[test]
fn area_shrinks_with_the_time_on_the_floor_only() {
    // Liouville: det = exp(-2 zeta omega_h t_contact), for any orbit, because the field is
    // continuous at the switches of this law. Differences of step 1e-3: h^4 and 1e-14/h, both 1e-11.
    let mut hops = 0;
    for (zeta, gamma, r) in [(0.1, 0.6, 1.0), (0.3, 0.9, 0.9), (0.45, 1.2, 1.1)] {
        let model = on_rigid_base(zeta, gamma, r).model().unwrap();
        for start in [
            [3.0, 2.0],
            [0.3, -0.7],
            [-1.5, 0.4],
            [8.0, -1.0],
            [-0.5, 2.5],
        ] {
            let point = model.start(start[0], start[1]);
            let out = run(&model, &point, 1, &taylor(1e-14));
            hops += out.switches.len();
            let on_floor = out.contact_ratio[0][0] * TAU / r;
            let expected = (-2.0 * zeta * on_floor).exp();
            let found = determinant(&model, start, 1e-3);
            assert!(
                (found - expected).abs() < 1e-9,
                "zeta {zeta} from {start:?}: {found} for {expected}"
            );
        }
    }
    assert!(hops >= 15, "{hops}");
}
