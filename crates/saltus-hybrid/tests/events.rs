//! What event code owes its users: half-open steps, no root missed, none counted twice, and a word
//! for everything that is not a plain crossing. Both steppers pass the same list.

#![allow(clippy::unwrap_used)]

use std::sync::atomic::AtomicBool;

use saltus_hybrid::{
    End, Leg, Method, Options, Point, Recording, Sample, Status, SwitchKind, System, SystemBuilder,
    Task, Transition, integrate, record, testing,
};

const METHODS: [Method; 2] = [
    Method::Taylor {
        tolerance: 1e-12,
        order: 16,
    },
    Method::Rk4 {
        steps_per_period: 1,
    },
];

fn options(method: Method) -> Options {
    Options {
        method,
        ..Options::default()
    }
}

fn run(system: &System, modes: &[usize], x: &[f64], periods: u64, method: Method) -> Recording {
    let start = system.point(modes, x);
    record(
        &Leg {
            system: system.clone(),
            start,
            periods,
        },
        &options(method),
    )
    .unwrap()
}

fn crossings(recording: &Recording) -> Vec<f64> {
    let crossing = |s: &&saltus_hybrid::RecordedSwitch| matches!(s.kind, SwitchKind::Mode { .. });
    recording
        .switches
        .iter()
        .filter(crossing)
        .map(|s| s.time)
        .collect()
}

fn assert_times(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{found:?} for {expected:?}");
    for (f, e) in found.iter().zip(expected) {
        assert!((f - e).abs() <= tolerance, "{found:?} for {expected:?}");
    }
}

#[test]
fn three_crossings_in_one_step_are_all_found_in_order() {
    // SciPy #9228: of (y+6)(y+2)(y-2) crossed in one large step others report one.
    let system = testing::ramp_with_roots(&[-6.0, -2.0, 2.0], 10.0);
    for method in METHODS {
        let recording = run(&system, &[1], &[-7.0], 1, method);
        // Rounding of a cubic with values up to 45, slope at least 16.
        assert_times(&crossings(&recording), &[1.0, 5.0, 9.0], 1e-13);
    }
}

#[test]
fn touch_and_leave_inside_one_step_is_found() {
    // Two crossings 0.002 apart in a step of 10: no sign change from end to end.
    let system = testing::ramp_with_roots(&[4.0, 4.002], 10.0);
    for method in METHODS {
        assert_times(
            &crossings(&run(&system, &[0], &[0.0], 1, method)),
            &[4.0, 4.002],
            1e-11,
        );
    }
}

#[test]
fn a_tangency_is_reported_and_switches_nothing() {
    let system = testing::ramp_with_roots(&[5.0, 5.0], 10.0);
    for method in METHODS {
        let recording = run(&system, &[0], &[0.0], 1, method);
        assert_eq!(recording.end.switches, 0);
        assert_eq!(recording.end.tangencies, 1);
        assert!((recording.switches[0].time - 5.0).abs() < 1e-8); // a double root, sqrt of rounding
        assert_eq!(recording.switches[0].kind, SwitchKind::Tangency);
        assert_eq!(recording.end.status, Status::Completed);
    }
}

#[test]
fn a_zero_at_the_start_is_no_event_and_the_next_one_is() {
    let system = testing::ramp_with_roots(&[0.0, 3.0], 10.0);
    for method in METHODS {
        // y (y - 3) is zero at the start and negative after it: mode 1 lasts until 3.
        assert_times(
            &crossings(&run(&system, &[1], &[0.0], 1, method)),
            &[3.0],
            1e-14,
        );
        // Mode 0 wants it positive: it is left at once, not never.
        assert_times(
            &crossings(&run(&system, &[0], &[0.0], 1, method)),
            &[0.0, 3.0],
            1e-14,
        );
    }
}

#[test]
fn a_guard_already_on_the_wrong_side_fires_at_once() {
    let system = testing::ramp_with_roots(&[5.0], 10.0);
    for method in METHODS {
        // y - 5 = -4 in mode 0, which lasts while it is positive.
        assert_times(
            &crossings(&run(&system, &[0], &[1.0], 1, method)),
            &[0.0, 4.0],
            1e-14,
        );
    }
}

#[test]
fn an_event_on_a_sampling_instant_counts_once() {
    let system = testing::ramp_with_roots(&[2.0], 1.0);
    for method in METHODS {
        let recording = run(&system, &[1], &[0.0], 4, method);
        assert_times(&crossings(&recording), &[2.0], 1e-15);
        let modes: Vec<usize> = recording.samples.iter().map(|p| p.modes[0]).collect();
        assert_eq!(modes, [1, 0, 0, 0], "the sample is taken after the switch");
    }
}

#[test]
fn an_event_on_the_last_instant_counts() {
    let system = testing::ramp_with_roots(&[2.0], 1.0);
    for method in METHODS {
        let recording = run(&system, &[1], &[0.0], 2, method);
        assert_times(&crossings(&recording), &[2.0], 1e-15);
    }
}

#[test]
fn bounces_accumulate_and_the_run_says_so() {
    // g 9.81 m/s^2, e 0.8, H 1 m: sqrt(2 H/g) (1 + e)/(1 - e) = 4.063712769 s.
    let system = testing::bouncing_ball(9.81, 0.8, 10.0);
    for method in METHODS {
        let recording = run(&system, &[0], &[1.0, 0.0], 1, method);
        let Status::Chattering { time, .. } = recording.end.status else {
            panic!("{:?}", recording.end.status)
        };
        // 100 bounces leave 0.8^100 = 2e-10 of the time; the ball never falls through the floor.
        assert!((time - 4.063_712_769).abs() < 2e-9, "{time}");
        assert!(recording.end.point.x[0] > -1e-12);
        assert!((recording.switches[0].time - (2.0 / 9.81_f64).sqrt()).abs() < 1e-15);
    }
}

/// Two ramps with a guard each; `order` exchanges the units.
fn two_units(at: [f64; 2]) -> System {
    let mut b = SystemBuilder::new(1);
    let y = b.state(0);
    let one = b.linear(1.0, &[]);
    b.derivative(0, one);
    for t in at {
        let guard = b.linear(-t, &[(1.0, y)]);
        b.unit(vec![vec![Transition::rising(guard, 1)], vec![]]);
    }
    b.build(10.0).unwrap()
}

#[test]
fn two_units_at_the_same_instant_both_switch_in_either_order() {
    for method in METHODS {
        for at in [
            [3.0, 3.0],
            [3.0, 3.0 + 1e-15],
            [3.0 + 1e-15, 3.0],
            [3.0, 7.0],
            [7.0, 3.0],
        ] {
            let recording = run(&two_units(at), &[0, 0], &[0.0], 1, method);
            let mut expected = at.to_vec();
            expected.sort_by(f64::total_cmp);
            assert_times(&crossings(&recording), &expected, 1e-14);
            assert_eq!(recording.end.point.modes, [1, 1]);
        }
    }
}

#[test]
fn flights_may_be_longer_than_a_period_and_shorter_than_a_step() {
    // A ball with restitution 1 from height 0.5, g 1: bounces at 1, 3, 5, ...
    for (interval, periods) in [(0.25, 28), (6.9, 1)] {
        let system = testing::bouncing_ball(1.0, 1.0, interval);
        for method in METHODS {
            let recording = run(&system, &[0], &[0.5, 0.0], periods, method);
            assert_times(&crossings(&recording)[..3], &[1.0, 3.0, 5.0], 1e-13);
        }
    }
}

#[test]
fn a_bilinear_oscillator_keeps_its_period_and_speed() {
    let k = 9.0;
    let system = testing::bilinear_oscillator(k, std::f64::consts::PI * (1.0 + 1.0 / 3.0));
    let recording = run(&system, &[1], &[0.0, 1.0], 50, METHODS[0]);
    for sample in &recording.samples {
        assert!(
            sample.x[0].abs() < 1e-10 && (sample.x[1] - 1.0).abs() < 1e-10,
            "{:?}",
            sample.x
        );
    }
    assert_eq!(
        recording.end.switches,
        99 + u64::from(recording.end.point.modes[0] == 1)
    );
}

#[test]
fn grazing_of_the_linear_oscillator_is_found_at_the_published_wall() {
    // zeta 0.05, omega 0.8, unit forcing: steady amplitude = wall distance of grazing.
    let amplitude = 2.711_630_723;
    for (offset, expected) in [(-1e-6, 2), (1e-6, 0)] {
        let system = testing::forced_oscillator(0.05, 1.0, 0.8, amplitude + offset);
        let long = run(&system, &[0], &[0.0, 0.0], 200, METHODS[0]);
        let Point { modes, x } = &long.end.point;
        let steady = run(&system, modes, &x[..2], 1, METHODS[0]);
        assert_eq!(steady.end.switches, expected);
    }
}

/// dx/dt = x^2 blows up at t = 1/x0.
fn blow_up() -> System {
    let mut b = SystemBuilder::new(1);
    let x = b.state(0);
    let square = b.dot(&[(x, x)]);
    b.derivative(0, square);
    b.unit(vec![vec![]]);
    b.build(0.5).unwrap()
}

#[test]
fn a_singularity_ends_the_run_with_a_status_and_the_last_good_state() {
    for method in METHODS {
        let recording = run(&blow_up(), &[0], &[0.7], 40, method);
        assert!(
            matches!(
                recording.end.status,
                Status::NotFinite { .. } | Status::TooManySteps { .. }
            ),
            "{:?}",
            recording.end.status
        );
        assert!(recording.end.point.x[0].is_finite());
    }
}

struct Watcher {
    leg: Option<Leg>,
    id: usize,
    samples: Vec<Vec<u64>>,
    status: Option<Status>,
}

impl Task for Watcher {
    fn begin(&mut self) -> Option<Leg> {
        self.leg.take()
    }
    fn sample(&mut self, sample: &Sample<'_>) -> bool {
        self.samples
            .push(sample.x.iter().map(|v| v.to_bits()).collect());
        true
    }
    fn end(&mut self, end: End) -> Option<Leg> {
        self.status = Some(end.status);
        None
    }
}

fn watch_all(starts: &[f64]) -> Vec<Watcher> {
    let system = testing::forced_oscillator(0.05, 1.0, 0.8, 1.0);
    let tasks = starts.iter().enumerate().map(|(id, &x)| Watcher {
        leg: Some(Leg {
            start: system.point(&[usize::from(x > 1.0)], &[x, 0.0]),
            system: system.clone(),
            periods: 5 + id as u64 % 3,
        }),
        id,
        samples: Vec::new(),
        status: None,
    });
    let mut out = Vec::new();
    integrate(&options(METHODS[0]), tasks, &AtomicBool::new(false), |t| {
        out.push(t)
    })
    .unwrap();
    out.sort_by_key(|t| t.id);
    out
}

#[test]
fn lanes_do_not_disturb_each_other() {
    let mut starts: Vec<f64> = (0..19).map(|i| 0.1 * f64::from(i)).collect();
    let good = watch_all(&starts);
    // Alone, the same bits.
    for i in [0, 7, 18] {
        let mut alone = watch_all(&starts[i..=i]);
        let n = alone[0].samples.len().min(good[i].samples.len());
        assert_eq!(alone.remove(0).samples[..n], good[i].samples[..n]);
    }
    // Beside a NaN, an infinity and an overflow, the same bits.
    for (i, bad) in [(3, f64::NAN), (4, f64::INFINITY), (12, 1e308)] {
        starts[i] = bad;
    }
    let mixed = watch_all(&starts);
    for (i, (a, b)) in good.iter().zip(&mixed).enumerate() {
        if [3, 4].contains(&i) {
            assert!(
                matches!(b.status, Some(Status::NotFinite { .. })),
                "{i} {:?}",
                b.status
            );
        } else if i == 12 {
            assert!(b.status.is_some()); // huge but linear: it may well complete
        } else {
            assert_eq!(a.samples, b.samples, "lane {i}");
        }
    }
}

#[test]
fn a_raised_flag_stops_the_run() {
    let system = testing::forced_oscillator(0.05, 1.0, 0.8, 1.0);
    let leg = Leg {
        start: system.point(&[0], &[0.0, 0.0]),
        system,
        periods: u64::MAX,
    };
    let task = Watcher {
        leg: Some(leg),
        id: 0,
        samples: Vec::new(),
        status: None,
    };
    for method in METHODS {
        let task = Watcher {
            leg: task.leg.clone(),
            samples: Vec::new(),
            ..task
        };
        let stopped = integrate(&options(method), [task], &AtomicBool::new(true), |_| {});
        assert_eq!(stopped, Err(saltus_hybrid::IntegrateError::Interrupted));
    }
}
