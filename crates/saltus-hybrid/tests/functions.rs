//! Quotients, powers and elementary functions: closed forms, differences, bits, and where they end.

#![allow(clippy::unwrap_used)]

use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::atomic::AtomicBool;

use saltus_hybrid::{
    End, Instructions, Method, Node, Options, Recording, Sample, Segment, Status, System,
    SystemBuilder, Task, Transition, integrate, record,
};

const TAYLOR: Method = Method::Taylor {
    tolerance: 1e-14,
    order: 20,
};

fn options(method: Method) -> Options {
    Options {
        method,
        ..Options::default()
    }
}

fn run_by(system: &System, modes: &[usize], x: &[f64], periods: u64, method: Method) -> Recording {
    let segment = Segment {
        system: system.clone(),
        start: system.point(modes, x),
        periods,
    };
    record(&segment, &options(method)).unwrap()
}

fn end(system: &System, x: &[f64], periods: u64) -> End {
    run_by(system, &[], x, periods, TAYLOR).end
}

/// A function of one number: how it is built, and an integral of it.
type Case = (
    &'static str,
    fn(&mut SystemBuilder, Node) -> Node,
    fn(f64) -> f64,
);

const CASES: [Case; 14] = [
    ("exp", |b, u| b.exp(u), f64::exp),
    ("log", |b, u| b.log(u), |u| u * u.ln() - u),
    ("sin", |b, u| b.sin_cos(u).0, |u| -u.cos()),
    ("cos", |b, u| b.sin_cos(u).1, f64::sin),
    ("tan", |b, u| b.tan(u), |u| -u.cos().ln()),
    ("sinh", |b, u| b.sinh_cosh(u).0, f64::cosh),
    ("cosh", |b, u| b.sinh_cosh(u).1, f64::sinh),
    ("tanh", |b, u| b.tanh(u), |u| u.cosh().ln()),
    (
        "asin",
        |b, u| b.asin(u),
        |u| u * u.asin() + (1.0 - u * u).sqrt(),
    ),
    (
        "atan",
        |b, u| b.atan(u),
        |u| u * u.atan() - 0.5 * (1.0 + u * u).ln(),
    ),
    ("sqrt", |b, u| b.power(u, 0.5), |u| u.powf(1.5) / 1.5),
    ("Hertz", |b, u| b.power(u, 1.5), |u| u.powf(2.5) / 2.5),
    (
        "root",
        |b, u| b.power(u, -1.0 / 3.0),
        |u| 1.5 * u.powf(2.0 / 3.0),
    ),
    (
        "quotient",
        |b, u| {
            let square = b.squares(&[u])[0];
            let above = b.linear(1.0, &[(1.0, square)]);
            b.quotient(u, above)
        },
        |u| 0.5 * (1.0 + u * u).ln(),
    ),
];

/// u = 1/2 + 0.4 sin t, and for each case y' = F(u) u', so that y is the integral of F over u.
fn swinging() -> System {
    let mut b = SystemBuilder::new(2 + CASES.len());
    let (u, w) = (b.state(0), b.state(1));
    let back = b.linear(0.5, &[(-1.0, u)]);
    b.derivative(0, w);
    b.derivative(1, back);
    for (i, (_, function, _)) in CASES.iter().enumerate() {
        let value = function(&mut b, u);
        let rate = b.products(&[(value, w)])[0];
        b.derivative(2 + i, rate);
    }
    b.build(1.7).unwrap()
}

fn start_of_swing() -> Vec<f64> {
    let mut x = vec![0.0; 2 + CASES.len()];
    x[..2].copy_from_slice(&[0.5, 0.4]);
    x
}

#[test]
fn integrals_of_each_function_are_those_of_the_book() {
    for (method, error) in [
        (TAYLOR, 2e-13),
        (
            Method::Taylor {
                tolerance: 1e-10,
                order: 12,
            },
            1e-9,
        ),
        (
            Method::Rk4 {
                steps_per_period: 400,
            },
            3e-10,
        ),
    ] {
        let run = run_by(&swinging(), &[], &start_of_swing(), 7, method);
        assert_eq!(run.end.status, Status::Completed);
        let u = 0.5 + 0.4 * (7.0 * 1.7_f64).sin();
        for ((name, _, integral), y) in CASES.iter().zip(&run.end.point.x[2..]) {
            let exact = integral(u) - integral(0.5);
            assert!((y - exact).abs() < error, "{name}: {y} {exact}");
        }
    }
}

#[test]
fn columns_are_the_differences_of_the_flow() {
    let system = swinging();
    let (x, size, periods) = (start_of_swing(), 2 + CASES.len(), 2);
    let wide = system.with_tangents(2).unwrap();
    let mut start = wide.point(&[], &x);
    let columns = wide.columns_mut(&mut start.x);
    (columns[0], columns[size + 1]) = (1.0, 1.0);
    let segment = Segment {
        system: wide.clone(),
        start,
        periods,
    };
    let ended = record(&segment, &options(TAYLOR)).unwrap().end;
    for (i, column) in wide.columns(&ended.point.x).chunks(size).enumerate() {
        let moved = |by: f64| {
            let mut x = x.clone();
            x[i] += by;
            end(&system, &x, periods).point.x
        };
        let (ahead, behind) = (moved(1e-5), moved(-1e-5));
        for (j, exact) in column.iter().enumerate() {
            let difference = (ahead[j] - behind[j]) / 2e-5;
            assert!(
                (difference - exact).abs() < 1e-8,
                "{i} {j}: {difference} {exact}"
            );
        }
    }
}

/// Keeps the last state of one of many trajectories.
struct Last(Option<Segment>, Vec<f64>);

impl Task for Last {
    fn begin(&mut self) -> Option<Segment> {
        self.0.take()
    }
    fn sample(&mut self, _: &Sample<'_>) -> bool {
        true
    }
    fn end(&mut self, end: End) -> Option<Segment> {
        self.1 = end.point.x;
        None
    }
}

#[test]
fn a_lane_has_the_bits_of_a_single_trajectory_with_any_instructions() {
    let system = swinging();
    let segment = |i: usize| {
        let mut x = start_of_swing();
        x[1] -= 0.01 * i as f64;
        Segment {
            start: system.point(&[], &x),
            system: system.clone(),
            periods: 3 + i as u64 % 3,
        }
    };
    let together = |count: std::ops::Range<usize>, instructions: Instructions| {
        let options = Options {
            instructions,
            ..options(Method::taylor(1e-9))
        };
        let mut ends = Vec::new();
        let tasks = count.map(|i| Last(Some(segment(i)), Vec::new()));
        integrate(&options, tasks, &AtomicBool::new(false), |task| {
            ends.push(task.1.iter().map(|x| x.to_bits()).collect::<Vec<_>>());
        })
        .unwrap();
        ends.sort();
        ends
    };
    let all = together(0..19, Instructions::Best);
    let mut alone: Vec<_> = (0..19)
        .flat_map(|i| together(i..i + 1, Instructions::Best))
        .collect();
    alone.sort();
    assert_eq!(all, alone);
    assert_eq!(all, together(0..19, Instructions::Avx2));
}

/// x'' = -sin x.
fn pendulum(interval: f64) -> System {
    let mut b = SystemBuilder::new(2);
    let (x, v) = (b.state(0), b.state(1));
    let sin = b.sin_cos(x).0;
    let pull = b.linear(0.0, &[(-1.0, sin)]);
    b.derivative(0, v);
    b.derivative(1, pull);
    b.build(interval).unwrap()
}

#[test]
fn a_pendulum_swings_as_long_as_its_elliptic_integral() {
    // from rest at a right angle: 4 K(1/sqrt 2) = Gamma(1/4)^2/sqrt(pi)
    let period = 7.416_298_709_205_487;
    let x = end(&pendulum(period), &[FRAC_PI_2, 0.0], 10).point.x;
    assert!(
        (x[0] - FRAC_PI_2).abs() < 1e-11 && x[1].abs() < 1e-11,
        "{x:?}"
    );
}

/// A ball of mass 1 on a Hertzian spring, x'' = -x^1.5 while x > 0.
fn hertz() -> System {
    let mut b = SystemBuilder::new(2);
    let (x, v) = (b.state(0), b.state(1));
    let contact = b.reserve_unit();
    let force = b.power(x, 1.5);
    let force = b.gate(contact, &[0.0, -1.0], force);
    b.derivative(0, v);
    b.derivative(1, force);
    b.define_unit(
        contact,
        vec![
            vec![Transition::rising(x, 1)],
            vec![Transition::falling(x, 0)],
        ],
    );
    b.build(0.5).unwrap()
}

#[test]
fn a_hertzian_impact_lasts_as_long_as_its_beta_function() {
    // from -1/4 at speed 1: contact from 1/4 on for 0.8 1.25^(2/5) B(2/5, 1/2), and the speed is kept
    let run = run_by(&hertz(), &[0], &[-0.25, 1.0], 8, TAYLOR);
    let times: Vec<f64> = run.switches.iter().map(|switch| switch.time).collect();
    assert_eq!(times.len(), 2, "{:?}", run.end);
    assert!((times[0] - 0.25).abs() < 1e-14, "{times:?}");
    assert!(
        (times[1] - times[0] - 3.218_065_459_719_043).abs() < 1e-11,
        "{times:?}"
    );
    let x = &run.end.point.x;
    assert!((x[1] + 1.0).abs() < 1e-12, "{x:?}");
    // some steps more in short ones after the touch-down, not hundreds
    assert!(run.end.steps < 150, "{}", run.end.steps);
}

#[test]
fn a_guard_may_be_a_function() {
    // the sign of sin x, with x = t: switches at every multiple of pi, and one begins on such a zero
    let mut b = SystemBuilder::new(1);
    let x = b.state(0);
    let one = b.linear(1.0, &[]);
    let sin = b.sin_cos(x).0;
    b.derivative(0, one);
    b.unit(vec![
        vec![Transition::falling(sin, 1)],
        vec![Transition::rising(sin, 0)],
    ]);
    let system = b.build(TAU).unwrap();
    let run = run_by(&system, &[0], &[0.0], 3, TAYLOR);
    let times: Vec<f64> = run.switches.iter().map(|s| s.time).collect();
    // the sample at 2 pi is after its switch
    assert_eq!(times.len(), 6, "{times:?}");
    for (i, time) in times.iter().enumerate() {
        let exact = (i + 1) as f64 * TAU / 2.0;
        assert!((time - exact).abs() < 1e-13 * exact, "{times:?}");
    }
}

#[test]
fn out_of_its_domain_a_trajectory_ends_and_says_by_what() {
    let falls = |function: fn(&mut SystemBuilder, Node) -> Node| {
        let mut b = SystemBuilder::new(2);
        let (x, minus) = (b.state(0), b.linear(-1.0, &[]));
        let value = function(&mut b, x);
        b.derivative(0, minus);
        b.derivative(1, value);
        b.build(2.0).unwrap()
    };
    type Ends = (fn(&mut SystemBuilder, Node) -> Node, &'static str);
    let cases: [Ends; 4] = [
        (|b, x| b.log(x), "the logarithm of"),
        (|b, x| b.power(x, 0.5), "a root or power of"),
        (
            |b, x| {
                let one = b.linear(1.0, &[]);
                b.quotient(one, x)
            },
            "a division by",
        ),
        (
            |b, x| {
                let beyond = b.linear(2.0, &[(-1.0, x)]);
                b.asin(beyond)
            },
            "root",
        ),
    ];
    for method in [
        TAYLOR,
        Method::Rk4 {
            steps_per_period: 64,
        },
    ] {
        for (function, said) in cases {
            // RK4 steps over a pole unless it meets it
            let ended = run_by(&falls(function), &[], &[1.0, 0.0], 1, method).end;
            let told = ended.status.to_string();
            assert!(told.contains(said), "{method:?} {said}: {told}");
            assert!(ended.point.x.iter().all(|x| x.is_finite()));
        }
    }
}
