//! What event code owes its users: half-open steps, no root missed, none counted twice, and a word
//! for everything that is not a plain crossing. Both steppers pass the same list.

#![allow(clippy::unwrap_used)]

use std::sync::atomic::AtomicBool;

use saltus_hybrid::{
    End, Method, Options, Point, Recording, Sample, Segment, Status, SwitchKind, System,
    SystemBuilder, Task, Transition, integrate, record, testing,
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
        &Segment {
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
    segment: Option<Segment>,
    id: usize,
    samples: Vec<Vec<u64>>,
    status: Option<Status>,
}

impl Task for Watcher {
    fn begin(&mut self) -> Option<Segment> {
        self.segment.take()
    }
    fn sample(&mut self, sample: &Sample<'_>) -> bool {
        self.samples
            .push(sample.x.iter().map(|v| v.to_bits()).collect());
        true
    }
    fn end(&mut self, end: End) -> Option<Segment> {
        self.status = Some(end.status);
        None
    }
}

fn watch_all(starts: &[f64]) -> Vec<Watcher> {
    let system = testing::forced_oscillator(0.05, 1.0, 0.8, 1.0);
    let tasks = starts.iter().enumerate().map(|(id, &x)| Watcher {
        segment: Some(Segment {
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
        out.push(t);
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
fn a_lane_that_chatters_or_never_lands_disturbs_nobody() {
    // Elastic balls bounce for ever; one loses height in every bounce, one is far above the floor.
    let starts = |odd: bool| -> Vec<(System, f64)> {
        let ball = |i: u32| match i {
            3 if odd => (testing::bouncing_ball(9.81, 0.8, 10.0), 1.0),
            5 if odd => (testing::bouncing_ball(9.81, 1.0, 10.0), 1e9),
            _ => (testing::bouncing_ball(9.81, 1.0, 10.0), 1.0 + f64::from(i)),
        };
        (0..11).map(ball).collect()
    };
    let watch = |balls: Vec<(System, f64)>| {
        let tasks = balls
            .into_iter()
            .enumerate()
            .map(|(id, (system, height))| Watcher {
                segment: Some(Segment {
                    start: system.point(&[0], &[height, 0.0]),
                    system,
                    periods: 3,
                }),
                id,
                samples: Vec::new(),
                status: None,
            });
        let mut out = Vec::new();
        integrate(&options(METHODS[0]), tasks, &AtomicBool::new(false), |t| {
            out.push(t);
        })
        .unwrap();
        out.sort_by_key(|t| t.id);
        out
    };
    let (good, mixed) = (watch(starts(false)), watch(starts(true)));
    assert!(matches!(mixed[3].status, Some(Status::Chattering { .. })));
    assert_eq!(mixed[5].status, Some(Status::Completed));
    for i in (0..11).filter(|i| ![3, 5].contains(i)) {
        assert_eq!(good[i].samples, mixed[i].samples, "lane {i}");
        assert_eq!(good[i].samples.len(), 3);
    }
}

#[test]
fn a_raised_flag_stops_the_run() {
    let system = testing::forced_oscillator(0.05, 1.0, 0.8, 1.0);
    let segment = Segment {
        start: system.point(&[0], &[0.0, 0.0]),
        system,
        periods: u64::MAX,
    };
    let task = Watcher {
        segment: Some(segment),
        id: 0,
        samples: Vec::new(),
        status: None,
    };
    for method in METHODS {
        let task = Watcher {
            segment: task.segment.clone(),
            samples: Vec::new(),
            ..task
        };
        let stopped = integrate(&options(method), [task], &AtomicBool::new(true), |_| {});
        assert_eq!(stopped, Err(saltus_hybrid::IntegrateError::Interrupted));
    }
}

#[test]
fn an_event_on_a_grid_point_of_a_fixed_step_counts_once() {
    for root in [0.25, 0.5, 0.75, 1.0, 1.25] {
        let system = testing::ramp_with_roots(&[root], 1.0);
        let method = Method::Rk4 {
            steps_per_period: 4,
        };
        let recording = run(&system, &[1], &[0.0], 3, method);
        assert_times(&crossings(&recording), &[root], 1e-15);
        assert_eq!(recording.end.steps, 12, "no step of length zero");
    }
}

#[test]
fn a_double_zero_at_the_start_is_left_to_the_side_it_opens_to() {
    // y^2 at y = 0 opens upwards: the mode that wants it positive lasts, the other is left at once.
    let system = testing::ramp_with_roots(&[0.0, 0.0], 10.0);
    for method in METHODS {
        assert_times(&crossings(&run(&system, &[0], &[0.0], 1, method)), &[], 0.0);
        assert_times(
            &crossings(&run(&system, &[1], &[0.0], 1, method)),
            &[0.0],
            0.0,
        );
    }
}

/// y' = 0 with the guard y, in a unit of one mode for y > 0 and one for y < 0.
fn still() -> System {
    let mut b = SystemBuilder::new(1);
    let y = b.state(0);
    let zero = b.linear(0.0, &[]);
    b.derivative(0, zero);
    b.unit(vec![
        vec![Transition::falling(y, 1)],
        vec![Transition::rising(y, 0)],
    ]);
    b.build(1.0).unwrap()
}

#[test]
fn a_guard_that_stays_zero_never_fires() {
    for method in METHODS {
        for mode in [0, 1] {
            let recording = run(&still(), &[mode], &[0.0], 5, method);
            assert_eq!(recording.end.switches, 0);
            assert_eq!(recording.end.status, Status::Completed);
        }
    }
}

#[test]
fn a_ball_at_rest_neither_falls_nor_hangs() {
    let system = testing::bouncing_ball(9.81, 0.8, 1.0);
    for method in METHODS {
        let end = run(&system, &[0], &[0.0, 0.0], 1, method).end;
        assert_eq!(
            end.status,
            Status::Chattering {
                time: 0.0,
                count: 101,
                at_once: true
            }
        );
        assert_eq!(end.point.x, [0.0, 0.0]);
    }
}

#[test]
fn a_field_that_pushes_to_the_switch_from_both_sides_says_so() {
    // x' = -sign(x), reached at t = 1: no motion leaves x = 0.
    let mut b = SystemBuilder::new(1);
    let x = b.state(0);
    let side = b.reserve_unit();
    let one = b.linear(1.0, &[]);
    let back = b.gate(side, &[-1.0, 1.0], one);
    b.derivative(0, back);
    b.define_unit(
        side,
        vec![
            vec![Transition::falling(x, 1)],
            vec![Transition::rising(x, 0)],
        ],
    );
    let system = b.build(10.0).unwrap();
    for method in METHODS {
        let end = run(&system, &[0], &[1.0], 1, method).end;
        let Status::Chattering { time, .. } = end.status else {
            panic!("{:?}", end.status)
        };
        assert!((time - 1.0).abs() < 1e-15 && end.point.x[0].abs() < 1e-15);
    }
}

#[test]
fn switches_allowed_are_per_period() {
    // One bounce per 2 s, seen every 2 s: 40 in all, never more than one at a time.
    let system = testing::bouncing_ball(1.0, 1.0, 2.0);
    for method in METHODS {
        let start = system.point(&[0], &[0.5, 0.0]);
        let segment = Segment {
            system: system.clone(),
            start,
            periods: 40,
        };
        let options = Options {
            max_switches: 1,
            ..options(method)
        };
        let end = record(&segment, &options).unwrap().end;
        assert_eq!((end.status, end.switches), (Status::Completed, 40));
    }
}

/// A leg of length s against a floor at d = cos(t). In stance s follows d; it lets go when
/// d + d' falls to 0, at t = pi/4, and then relaxes by s' = -s until the floor is back. There
/// d - s has a double zero at the instant it lets go.
fn relaxing() -> System {
    let mut b = SystemBuilder::new(1);
    let s = b.state(0);
    let (d, sin) = b.drive(1.0);
    let unit = b.reserve_unit();
    let rate = b.linear(0.0, &[(-1.0, sin)]);
    let follows = b.gate(unit, &[1.0, 0.0], rate);
    let relaxes = b.gate(unit, &[0.0, -1.0], s);
    let ds = b.linear(0.0, &[(1.0, follows), (1.0, relaxes)]);
    b.derivative(0, ds);
    let force = b.linear(0.0, &[(1.0, d), (1.0, rate)]);
    let reach = b.linear(0.0, &[(1.0, d), (-1.0, s)]);
    let floor = b.linear(0.0, &[(1.0, d)]);
    b.define_unit(
        unit,
        vec![
            vec![
                Transition::falling(force, 1)
                    .reset(0, floor)
                    .vanishing(reach, 2),
            ],
            vec![Transition::rising(reach, 0).reset(0, floor)],
        ],
    );
    b.build(0.0).unwrap()
}

#[test]
fn a_guard_that_vanishes_twice_by_construction_does_not_fire_at_once() {
    use std::f64::consts::{FRAC_PI_4, PI, TAU};
    // cos t = cos(pi/4) exp(pi/4 - t) between 3/2 pi and 2 pi, by halving
    let ahead = |t: f64| t.cos() - FRAC_PI_4.cos() * (FRAC_PI_4 - t).exp();
    let (mut lo, mut hi) = (1.5 * PI, TAU);
    for _ in 0..60 {
        let middle = 0.5 * (lo + hi);
        if ahead(middle) < 0.0 {
            lo = middle;
        } else {
            hi = middle;
        }
    }
    let cases = [
        (METHODS[0], 1e-13),
        (
            Method::Taylor {
                tolerance: 1e-6,
                order: 8,
            },
            1e-5,
        ),
        // s has an error of (h^4/120) s; d is known exactly
        (
            Method::Rk4 {
                steps_per_period: 101,
            },
            1e-7,
        ),
        (
            Method::Rk4 {
                steps_per_period: 1001,
            },
            1e-11,
        ),
    ];
    for (method, tolerance) in cases {
        let periods = 20;
        let recording = run(&relaxing(), &[0], &[1.0], periods, method);
        let expected: Vec<f64> = (0..periods)
            .flat_map(|n| [FRAC_PI_4, lo].map(|t| t + n as f64 * TAU))
            .collect();
        assert_times(&crossings(&recording), &expected, tolerance);
    }
}

#[test]
fn resets_are_evaluated_before_the_first_is_assigned() {
    // Exchange of two states at y = 1: neither may see the other's new value.
    let mut b = SystemBuilder::new(3);
    let [y, p, q] = [0, 1, 2].map(|i| b.state(i));
    let (one, zero) = (b.linear(1.0, &[]), b.linear(0.0, &[]));
    b.derivative(0, one);
    b.derivative(1, zero);
    b.derivative(2, zero);
    let guard = b.linear(-1.0, &[(1.0, y)]);
    b.unit(vec![
        vec![Transition::rising(guard, 1).reset(1, q).reset(2, p)],
        vec![],
    ]);
    let system = b.build(2.0).unwrap();
    for method in METHODS {
        let end = run(&system, &[0], &[0.0, 3.0, 7.0], 1, method).end;
        assert_eq!(end.point.x[1..], [7.0, 3.0]);
    }
}

/// Two balls of restitution 0.8 that do not know each other.
fn two_balls() -> System {
    let mut b = SystemBuilder::new(4);
    let fall = b.linear(-1.0, &[]);
    for i in 0..2 {
        let (height, speed) = (b.state(2 * i), b.state(2 * i + 1));
        let rebound = b.linear(0.0, &[(-0.8, speed)]);
        b.derivative(2 * i, speed);
        b.derivative(2 * i + 1, fall);
        b.unit(vec![vec![
            Transition::falling(height, 0).reset(2 * i + 1, rebound),
        ]]);
    }
    b.build(1.7).unwrap()
}

#[test]
fn balls_that_land_together_bounce_as_if_alone() {
    // Two events in one step, at the same instant or within rounding of it: none is lost.
    for method in METHODS {
        for second in [0.5, 0.5 + 1e-15, 0.5 - 1e-15, 0.5 + 1e-9] {
            let pair = run(&two_balls(), &[0, 0], &[0.5, 0.0, second, 0.0], 3, method);
            for (height, ball) in [(0.5, 0), (second, 1)] {
                let system = testing::bouncing_ball(1.0, 0.8, 1.7);
                let alone = run(&system, &[0], &[height, 0.0], 3, method);
                let own: Vec<f64> = pair
                    .switches
                    .iter()
                    .filter(|s| s.unit == ball)
                    .map(|s| s.time)
                    .collect();
                // a landing time moves by rounding over the speed, some times over
                assert_times(&own, &crossings(&alone), 1e-13);
                for i in 0..2 {
                    let (a, b) = (pair.end.point.x[2 * ball + i], alone.end.point.x[i]);
                    assert!((a - b).abs() < 1e-13, "{a} {b}");
                }
            }
        }
    }
}

/// A ball of restitution e above a table at y = gamma cos(t), gravity 1.
fn ball_on_a_table(gamma: f64, e: f64) -> System {
    let mut b = SystemBuilder::new(2);
    let (z, v) = (b.state(0), b.state(1));
    let (cos, sin) = b.drive(1.0);
    let fall = b.linear(-1.0, &[]);
    let height = b.linear(0.0, &[(1.0, z), (-gamma, cos)]);
    let rebound = b.linear(0.0, &[(-e, v), (-gamma * (1.0 + e), sin)]);
    b.derivative(0, v);
    b.derivative(1, fall);
    b.unit(vec![vec![Transition::falling(height, 0).reset(1, rebound)]]);
    b.build(0.0).unwrap()
}

#[test]
fn a_ball_on_a_shaken_table_doubles_its_period_where_the_theory_says() {
    // One impact per period exists for gamma > pi (1 - e)/(1 + e) and flips at
    // gamma^2 = [pi (1 - e)/(1 + e)]^2 + [2 (1 + e^2)/(1 + e)^2]^2 (Luo & Han 1996; Bapat 1986).
    use std::f64::consts::PI;
    let e = 0.8_f64;
    let least = PI * (1.0 - e) / (1.0 + e);
    assert!((least - 0.349_065_850).abs() < 1e-9);
    let flip = least.hypot(2.0 * (1.0 + e * e) / (1.0 + e).powi(2));
    assert!((flip - 1.070_836_468).abs() < 1e-9);
    // Leaves at speed pi at the phase t* in (-2 pi, 0] where the table's speed is `least`.
    let at_phase_zero = |gamma: f64| {
        let since = (least / gamma).asin(); // sin t* = -least/gamma
        let leaves = gamma * since.cos();
        [leaves + PI * since - 0.5 * since * since, PI - since]
    };
    let map = |gamma: f64, x: [f64; 2]| {
        let end = run(&ball_on_a_table(gamma, e), &[0], &x, 1, METHODS[0]).end;
        assert_eq!(end.switches, 1);
        [end.point.x[0], end.point.x[1]]
    };
    for gamma in [0.5, 0.9, flip, 1.2] {
        let x = at_phase_zero(gamma);
        let y = map(gamma, x);
        for i in 0..2 {
            assert!((x[i] - y[i]).abs() < 1e-12, "{gamma} {x:?} {y:?}");
        }
    }
    // Central differences of step 1e-5: error near h^2 and rounding/h, both 1e-10.
    let h = 1e-5;
    let x = at_phase_zero(flip);
    let column = |i: usize| {
        let at = |s: f64| {
            let mut x = x;
            x[i] += s * h;
            map(flip, x)
        };
        let (up, down) = (at(1.0), at(-1.0));
        [0, 1].map(|k| (up[k] - down[k]) / (2.0 * h))
    };
    let (a, b) = (column(0), column(1));
    let (trace, det) = (a[0] + b[1], a[0] * b[1] - a[1] * b[0]);
    assert!((det - e * e).abs() < 1e-8, "{det}");
    assert!((1.0 + trace + det).abs() < 1e-8, "{trace} {det}");
}

#[test]
fn a_run_that_fails_ends_with_its_last_good_state() {
    // x' = x^2 from 0.7 is 0.7/(1 - 0.7 t): good until t = 1/0.7.
    for method in [
        METHODS[0],
        Method::Rk4 {
            steps_per_period: 1000,
        },
    ] {
        let end = run(&blow_up(), &[0], &[0.7], 40, method).end;
        assert_eq!(end.periods, 2);
        let (Status::NotFinite { time, .. } | Status::TooManySteps { time, .. }) = end.status
        else {
            panic!("{:?}", end.status)
        };
        assert!(time > 1.4 && end.point.x[0] > 30.0, "{end:?}");
    }
    // Not a number from the start: the start comes back.
    for method in METHODS {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let end = run(&blow_up(), &[0], &[bad], 3, method).end;
            assert_eq!((end.periods, end.steps), (0, 0));
            let state = Status::NotFinite {
                time: 0.0,
                state: 0,
            };
            assert_eq!(end.status, state);
            assert_eq!(end.point.x[0].to_bits(), bad.to_bits());
        }
    }
}

#[test]
fn a_ball_that_lands_on_a_sampling_instant_bounces_once() {
    // Landings at 1, 3, 5, ... seen at multiples of 1/n: each lands on a sample, to rounding.
    for n in 1..=40 {
        let system = testing::bouncing_ball(1.0, 1.0, 1.0 / f64::from(n));
        for method in METHODS {
            let recording = run(&system, &[0], &[0.5, 0.0], 6 * n as u64, method);
            // rounding of 240 steps
            assert_times(&crossings(&recording), &[1.0, 3.0, 5.0], 1e-12);
            assert_eq!(recording.end.status, Status::Completed);
        }
    }
}
