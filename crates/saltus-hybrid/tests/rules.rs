//! The rule book of events (docs/numerics.md, "Rules of events"), a test for each sentence. Both methods pass
//! the same list.

#![allow(clippy::unwrap_used)]

use saltus_hybrid::{
    Method, Node, Options, Recording, Segment, Status, SwitchKind, System, SystemBuilder,
    Transition, record,
};

const METHODS: [Method; 2] = [
    Method::Taylor {
        tolerance: 1e-12,
        order: 16,
    },
    Method::Rk4 {
        steps_per_period: 200,
    },
];

fn run_with(
    system: &System,
    modes: &[usize],
    x: &[f64],
    periods: u64,
    options: &Options,
) -> Recording {
    let segment = Segment {
        system: system.clone(),
        start: system.point(modes, x),
        periods,
    };
    record(&segment, options).unwrap()
}

fn run(system: &System, modes: &[usize], x: &[f64], periods: u64, method: Method) -> Recording {
    let options = Options {
        method,
        ..Options::default()
    };
    run_with(system, modes, x, periods, &options)
}

fn times(recording: &Recording) -> Vec<f64> {
    let crossings = recording.switches.iter();
    let crossings = crossings.filter(|s| matches!(s.kind, SwitchKind::Mode { .. }));
    crossings.map(|s| s.time).collect()
}

fn assert_times(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{found:?} for {expected:?}");
    for (f, e) in found.iter().zip(expected) {
        assert!((f - e).abs() <= tolerance, "{found:?} for {expected:?}");
    }
}

/// x' = rate, set to `to` when it reaches `at`.
fn sawtooth(rate: f64, at: f64, to: f64, interval: f64) -> System {
    let mut b = SystemBuilder::new(1);
    let x = b.state(0);
    let (rate, to) = (b.linear(rate, &[]), b.linear(to, &[]));
    b.derivative(0, rate);
    let guard = b.linear(-at, &[(1.0, x)]);
    b.unit(vec![vec![Transition::rising(guard, 0).reset(0, to)]]);
    b.build(interval).unwrap()
}

#[test]
fn a_reset_that_moves_its_own_guard_is_seen_where_it_moved_it() {
    for method in METHODS {
        for (to, interval) in [
            (0.0, 0.7),
            (0.25, 0.7),
            (-3.0, 2.5),
            (0.999, 0.011),
            (0.0, 1.0),
        ] {
            let system = sawtooth(1.0, 1.0, to, interval);
            let recording = run(&system, &[0], &[to], 40, method);
            assert_eq!(recording.end.status, Status::Completed, "{to} {interval}");
            for (n, sample) in (1..).zip(&recording.samples) {
                let phase = f64::from(n) * interval / (1.0 - to);
                // At a whole number of teeth either end is right to rounding; after the switch it is the lower.
                let whole = (phase - phase.round()).abs() < 1e-9;
                let part = if whole { 0.0 } else { phase.fract() };
                let expected = to + part * (1.0 - to);
                // rounding of some ten teeth
                assert!(
                    (sample.x[0] - expected).abs() < 1e-12,
                    "{to} {n} {sample:?} {expected}"
                );
            }
        }
    }
}

#[test]
fn a_reset_that_lifts_off_its_guard_lands_when_the_parabola_does() {
    // y'' = -9.81 from (1, 0); y := 1e-3, v := -0.8 v at the floor.
    let mut b = SystemBuilder::new(2);
    let (y, v) = (b.state(0), b.state(1));
    let fall = b.linear(-9.81, &[]);
    let (lift, rebound) = (b.linear(1e-3, &[]), b.linear(0.0, &[(-0.8, v)]));
    b.derivative(0, v);
    b.derivative(1, fall);
    b.unit(vec![vec![
        Transition::falling(y, 0).reset(0, lift).reset(1, rebound),
    ]]);
    let system = b.build(1.5).unwrap();
    let first = (2.0 / 9.81_f64).sqrt();
    let speed = 0.8 * 9.81 * first;
    let second = first + (speed + (speed * speed + 2.0 * 9.81 * 1e-3).sqrt()) / 9.81;
    assert!((second - 1.174_243_56).abs() < 1e-8);
    for method in METHODS {
        let recording = run(&system, &[0], &[1.0, 0.0], 1, method);
        assert_times(&times(&recording)[..2], &[first, second], 1e-12);
    }
}

/// A dose of 10 to x' = -x whenever sin rises through zero, at the end of each period.
fn dose(omega: f64, tolerance: f64, parts: u32) -> Recording {
    let mut b = SystemBuilder::new(1);
    let x = b.state(0);
    let (_, sin) = b.drive(omega);
    let decay = b.linear(0.0, &[(-1.0, x)]);
    let more = b.linear(10.0, &[(1.0, x)]);
    b.derivative(0, decay);
    b.unit(vec![
        vec![Transition::rising(sin, 1).reset(0, more)],
        vec![Transition::falling(sin, 0)],
    ]);
    let system = b.build(0.0).unwrap();
    let options = Options {
        method: Method::taylor(tolerance),
        samples_per_period: parts,
        ..Options::default()
    };
    run_with(&system, &[0], &[0.0], 300, &options)
}

#[test]
fn a_sample_is_the_state_after_all_switches_at_its_instant() {
    for omega in [0.467_919_799_498_746_85, 1.0, 0.3, 7.123_456_789] {
        for tolerance in [1e-4, 1e-6, 1e-8, 1e-10, 1e-13] {
            let recording = dose(omega, tolerance, 1);
            let decay = (-std::f64::consts::TAU / omega).exp();
            let mut expected = 10.0; // the start is phase 0: sin leaves zero upwards at once
            for (n, sample) in recording.samples.iter().enumerate() {
                expected = expected * decay + 10.0;
                let error = (sample.x[0] - expected).abs();
                assert!(
                    error < 100.0 * tolerance.max(1e-13) * 10.0,
                    "{omega} {tolerance} {n} {error}"
                );
                assert_eq!(sample.modes, [1]);
            }
            let doses = recording
                .switches
                .iter()
                .filter(|s| s.kind == SwitchKind::Mode { from: 0, to: 1 });
            assert_eq!(doses.count(), 301);
        }
    }
}

#[test]
fn inner_samples_follow_the_rule_of_the_last() {
    // sin falls through zero in the middle of the period: mode 0 from there on, whatever the tolerance.
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10, 1e-13] {
        for omega in [0.467_919_799_498_746_85, 1.0, 3.3] {
            let recording = dose(omega, tolerance, 2);
            let modes: Vec<usize> = recording.samples.iter().map(|p| p.modes[0]).collect();
            let expected: Vec<usize> = (0..600).map(|i| i % 2).collect();
            assert_eq!(modes, expected, "{omega} {tolerance}");
        }
    }
}

#[test]
fn a_switch_at_any_inner_sample_comes_before_it() {
    // A ramp through j/n: the mode at sample j is the one after.
    for parts in 2..=12 {
        for j in 1..=parts {
            let mut b = SystemBuilder::new(1);
            let x = b.state(0);
            let one = b.linear(1.0, &[]);
            b.derivative(0, one);
            let guard = b.linear(-f64::from(j) / f64::from(parts), &[(1.0, x)]);
            b.unit(vec![vec![Transition::rising(guard, 1)], vec![]]);
            let system = b.build(1.0).unwrap();
            for method in METHODS {
                let options = Options {
                    method,
                    samples_per_period: parts,
                    ..Options::default()
                };
                let recording = run_with(&system, &[0], &[0.0], 1, &options);
                let modes: Vec<usize> = recording.samples.iter().map(|p| p.modes[0]).collect();
                let expected: Vec<usize> = (1..=parts).map(|i| usize::from(i >= j)).collect();
                assert_eq!(modes, expected, "{parts} {j}");
            }
        }
    }
}

/// Two masses in a row: 1 on a spring of stiffness 4, the other free; they stay together from an impact
/// without rebound until the force between them falls to zero.
fn masses() -> System {
    let mut b = SystemBuilder::new(4);
    let [x, v, y, w] = [0, 1, 2, 3].map(|i| b.state(i));
    let unit = b.reserve_unit();
    let spring = b.gate(unit, &[-4.0, -2.0], x);
    let carried = b.gate(unit, &[0.0, -2.0], x);
    b.derivative(0, v);
    b.derivative(1, spring);
    b.derivative(2, w);
    b.derivative(3, carried);
    let gap = b.linear(0.0, &[(1.0, x), (-1.0, y)]);
    let force = b.linear(0.0, &[(-2.0, x)]);
    let common = b.linear(0.0, &[(0.5, v), (0.5, w)]);
    b.define_unit(
        unit,
        vec![
            vec![
                Transition::falling(gap, 1)
                    .reset(1, common)
                    .reset(3, common),
            ],
            vec![Transition::rising(force, 0)],
        ],
    );
    b.build(10.0).unwrap()
}

#[test]
fn contact_that_lasts_ends_when_its_force_does() {
    for method in METHODS {
        // y comes from x - 1 at speed 1: together from t = 1, half an oscillation of frequency sqrt 2 long
        let recording = run(&masses(), &[0], &[0.0, 0.0, -1.0, 1.0], 1, method);
        assert_eq!(recording.end.status, Status::Completed);
        let part = 1.0 + std::f64::consts::PI / 2.0_f64.sqrt();
        // RK4 with h = 0.05: h^4
        let tolerance = if method == METHODS[0] { 1e-11 } else { 1e-6 };
        assert_times(&times(&recording)[..2], &[1.0, part], tolerance);
        let end = &recording.end.point;
        assert!((end.x[3] + 0.5).abs() < tolerance, "{end:?}");
    }
}

/// Kelvin-Voigt contact with a floor at 0: force -k y - c v while y < 0, let go where it falls to zero.
fn kelvin_voigt(k: f64, c: f64, g: f64) -> System {
    let mut b = SystemBuilder::new(2);
    let (y, v) = (b.state(0), b.state(1));
    let unit = b.reserve_unit();
    let force = b.linear(0.0, &[(-k, y), (-c, v)]);
    let gated = b.gate(unit, &[0.0, 1.0], force);
    let a = b.linear(-g, &[(1.0, gated)]);
    b.derivative(0, v);
    b.derivative(1, a);
    b.define_unit(
        unit,
        vec![
            vec![Transition::falling(y, 1)],
            vec![Transition::falling(force, 0)],
        ],
    );
    b.build(1.0).unwrap()
}

#[test]
fn a_guard_beyond_zero_that_comes_back_is_held() {
    // The force falls to zero at y = -(c/k) v < 0, on the way up: flight begins below the floor.
    for (k, c) in [(100.0, 1.0), (1e4, 20.0), (400.0, 4.0)] {
        for method in METHODS {
            let system = kelvin_voigt(k, c, 9.81);
            let recording = run(&system, &[0], &[0.3, 0.0], 1, method);
            assert_eq!(recording.end.status, Status::Completed, "{k} {c}");
            let count = recording.end.switches;
            assert!((2..=12).contains(&count), "{k} {c} {count}");
            let up = &recording.switches[1];
            assert_eq!(up.kind, SwitchKind::Mode { from: 1, to: 0 });
        }
    }
}

#[test]
fn a_start_a_little_inside_an_obstacle_on_its_way_out_is_no_impact() {
    for inside in [1e-16, 1e-12, 1e-9, 1e-4] {
        for e in [0.8, 0.0, 1.0] {
            let system = saltus_hybrid::testing::bouncing_ball(9.81, e, 0.1);
            for method in METHODS {
                let recording = run(&system, &[0], &[-inside, 1.0], 1, method);
                assert_eq!(recording.end.status, Status::Completed);
                assert_eq!(recording.end.switches, 0);
                let expected = -inside + 0.1 - 0.5 * 9.81 * 0.01;
                assert!((recording.end.point.x[0] - expected).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn a_held_guard_that_turns_away_fires() {
    // Below the floor and rising too slowly: it turns at v = 0 and bounces there (v := -v = 0, then at rest
    // below the floor it fires again and again), or enters contact if that is another mode.
    let system = kelvin_voigt(100.0, 4.0, 9.81);
    for method in METHODS {
        let recording = run(&system, &[0], &[-0.05, 0.1], 1, method);
        // In flight at first? The force -100 y - 4 v = 4.6 pushes: contact settles, so it is entered at once.
        assert_eq!(times(&recording)[0], 0.0);
        let recording = run(&system, &[0], &[-0.001, 0.1], 1, method);
        // The force would pull (0.1 - 0.4 < 0): flight goes on until v = 0 at t = 0.1/9.81, deeper is contact ...
        let top = -0.001 + 0.01 / (2.0 * 9.81);
        assert!(top < 0.0);
        assert_times(&times(&recording)[..1], &[0.1 / 9.81], 1e-9);
        assert_eq!(recording.end.status, Status::Completed);
    }
}

/// A carrier c' = 1 that falls from 1 to 0, and a switch that is on while c < u: pulse width modulation.
fn modulator(u: f64) -> System {
    let mut b = SystemBuilder::new(2);
    let c = b.state(0);
    let (one, zero) = (b.linear(1.0, &[]), b.linear(0.0, &[]));
    let top = b.linear(-1.0, &[(1.0, c)]);
    let above = b.linear(-u, &[(1.0, c)]);
    b.unit(vec![vec![Transition::rising(top, 0).reset(0, zero)]]);
    let on = b.unit(vec![
        vec![Transition::rising(above, 1)],
        vec![Transition::falling(above, 0)],
    ]);
    let pulse = b.gate(on, &[1.0, 0.0], one);
    b.derivative(0, one);
    b.derivative(1, pulse);
    b.build(7.0).unwrap()
}

#[test]
fn a_guard_carried_across_zero_by_another_switch_fires_with_it() {
    for u in [0.1, 0.3, 0.75] {
        for method in METHODS {
            let recording = run(&modulator(u), &[0, 0], &[0.0, 0.0], 1, method);
            assert_eq!(recording.end.status, Status::Completed);
            assert!(
                (recording.end.point.x[1] - 7.0 * u).abs() < 1e-12,
                "{u} {:?}",
                recording.end
            );
        }
    }
}

#[test]
fn switches_without_end_at_one_instant_are_told_as_such() {
    // A kick whenever sin rises: after it the guard is still beyond zero.
    let mut b = SystemBuilder::new(1);
    let x = b.state(0);
    let (_, sin) = b.drive(1.0);
    let decay = b.linear(0.0, &[(-1.0, x)]);
    let kick = b.linear(1.0, &[(1.0, x)]);
    b.derivative(0, decay);
    b.unit(vec![vec![Transition::rising(sin, 0).reset(0, kick)]]);
    let system = b.build(0.0).unwrap();
    for method in METHODS {
        let end = run(&system, &[0], &[1.0], 3, method).end;
        assert!(
            matches!(end.status, Status::Chattering { at_once: true, .. }),
            "{:?}",
            end.status
        );
        assert!(
            end.status
                .to_string()
                .contains("let the switch move it back")
        );
    }
}

/// x' = y' = -x y/s from (s, s): x = y = s/(1 + t).
fn shrinking(s: f64) -> System {
    let mut b = SystemBuilder::new(2);
    let (x, y) = (b.state(0), b.state(1));
    let product: Node = b.dot(&[(x, y)]);
    let rate = b.linear(0.0, &[(-1.0 / s, product)]);
    b.derivative(0, rate);
    b.derivative(1, rate);
    let guard = b.linear(-0.3 * s, &[(1.0, x)]);
    b.unit(vec![vec![Transition::falling(guard, 1)], vec![]]);
    b.build(0.5).unwrap()
}

#[test]
fn errors_are_relative_to_the_size_of_each_state() {
    for s in [1e-12, 1e-3, 1.0, 1e9] {
        let system = shrinking(s);
        let recording = run(&system, &[0], &[s, s], 8, METHODS[0]);
        assert_times(&times(&recording), &[7.0 / 3.0], 1e-11);
        for (n, sample) in (1..).zip(&recording.samples) {
            let expected = s / (1.0 + 0.5 * f64::from(n));
            assert!((sample.x[0] / expected - 1.0).abs() < 1e-11, "{s} {n}");
        }
    }
}

#[test]
fn a_large_state_does_not_spoil_a_small_one() {
    // An oscillator of amplitude 1e-3 beside an angle that grows by 1e6 in a period, and one at 6e6.
    let mut b = SystemBuilder::new(4);
    let (x, v) = (b.state(0), b.state(1));
    let back = b.linear(0.0, &[(-1.0, x)]);
    let (fast, still) = (b.linear(1e6, &[]), b.linear(0.0, &[]));
    b.derivative(0, v);
    b.derivative(1, back);
    b.derivative(2, fast);
    b.derivative(3, still);
    let system = b.build(1.0).unwrap();
    let tolerance = 1e-8;
    let recording = run(
        &system,
        &[],
        &[1e-3, 0.0, 0.0, 6e6],
        20,
        Method::taylor(tolerance),
    );
    for (n, sample) in (1..).zip(&recording.samples) {
        let error = (sample.x[0] - 1e-3 * f64::from(n).cos()).abs();
        assert!(error < 100.0 * tolerance * 1e-3, "{n} {error}");
    }
}

#[test]
fn states_that_start_at_zero_are_measured_by_what_they_become() {
    // x' = 1e-9, y' = x, z' = y, from zero: z = 1e-9 t^3/6.
    let mut b = SystemBuilder::new(3);
    let (x, y) = (b.state(0), b.state(1));
    let slow = b.linear(1e-9, &[]);
    let (dy, dz) = (b.linear(0.0, &[(1.0, x)]), b.linear(0.0, &[(1.0, y)]));
    b.derivative(0, slow);
    b.derivative(1, dy);
    b.derivative(2, dz);
    let system = b.build(1.0).unwrap();
    let recording = run(&system, &[], &[0.0; 3], 5, METHODS[0]);
    let z = recording.end.point.x[2];
    assert!((z / (1e-9 * 125.0 / 6.0) - 1.0).abs() < 1e-11, "{z}");
    assert!(recording.end.steps < 100, "{}", recording.end.steps);
}

#[test]
fn states_of_one_body_share_a_size() {
    // An oscillator of amplitude a/8 beside a part at rest of size a.
    let run_at = |a: f64| {
        let mut b = SystemBuilder::new(3);
        let (x, v) = (b.state(0), b.state(1));
        let back = b.linear(0.0, &[(-1.0, x)]);
        let still = b.linear(0.0, &[]);
        b.derivative(0, v);
        b.derivative(1, back);
        b.derivative(2, still);
        b.scale_together(1.0);
        let system = b.build(20.0).unwrap();
        let recording = run(&system, &[], &[a / 8.0, 0.0, a], 1, Method::taylor(1e-8));
        (recording.end.steps, recording.end.point.x[0] / a)
    };
    // Beyond the scale all grows with the largest, to the bit: these are powers of two.
    assert_eq!(run_at(8.0), run_at(1.0));
    // Below it steps grow, and errors stay those of the scale.
    let (steps, x) = run_at(1.0 / 1024.0);
    assert!(steps < run_at(1.0).0, "{steps}");
    assert!((x / 1024.0 - 20_f64.cos() / 8.0 / 1024.0).abs() < 1e-6);
}

#[test]
fn a_state_that_starts_at_zero_sets_the_step_by_what_it_becomes() {
    // x' = 30 (s - x) from zero, where nothing else says how long a step may be: x = s (1 - exp(-30 t)).
    for s in [1e-9, 1.0, 1e9] {
        let mut b = SystemBuilder::new(1);
        let x = b.state(0);
        let rate = b.linear(30.0 * s, &[(-30.0, x)]);
        b.derivative(0, rate);
        let system = b.build(0.25).unwrap();
        let recording = run(&system, &[], &[0.0], 4, METHODS[0]);
        for (n, sample) in (1..).zip(&recording.samples) {
            let expected = 1.0 - (-7.5 * f64::from(n)).exp();
            assert!((sample.x[0] / s - expected).abs() < 1e-11, "{s} {n}");
        }
    }
}

#[test]
fn states_that_leave_their_body_go_on_to_the_same_bits() {
    // A part thrown far away, and back, over an oscillator: its height passes 16 in both directions.
    let mut b = SystemBuilder::new(4);
    let [x, v, w] = [0, 1, 3].map(|i| b.state(i));
    let back = b.linear(0.0, &[(-1.0, x)]);
    let fall = b.linear(-1.0, &[]);
    b.derivative(0, v);
    b.derivative(1, back);
    b.derivative(2, w);
    b.derivative(3, fall);
    b.scale_together(1.0);
    let system = b.build(3.0).unwrap();
    let method = Method::taylor(1e-8);
    let whole = run(&system, &[], &[1.0, 0.0, 0.0, 9.0], 6, method);
    let highest = whole.samples.iter().map(|sample| sample.x[2]);
    assert!(highest.fold(0.0, f64::max) > 30.0);
    let mut at = vec![1.0, 0.0, 0.0, 9.0];
    for sample in &whole.samples {
        at = run(&system, &[], &at, 1, method).end.point.x;
        assert_eq!(at, sample.x);
    }
}
