//! Both steppers keep their order, away from switches and across them, and the answer depends on
//! nothing but the question: not on quadratures, interruptions, neighbours or threads.

#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Sender, channel};

use saltus_hybrid::{
    End, IntegrateError, Method, Options, Point, Recording, Sample, Segment, Status, Step, System,
    SystemBuilder, Task, Transition, integrate, integrate_all, record, testing,
};

fn rk4(steps_per_period: u32) -> Options {
    with(Method::Rk4 { steps_per_period })
}

fn taylor(tolerance: f64, order: usize) -> Options {
    with(Method::Taylor { tolerance, order })
}

fn with(method: Method) -> Options {
    Options {
        method,
        ..Options::default()
    }
}

/// x as a function of time.
type Orbit = Box<dyn Fn(f64) -> f64 + Send + Sync>;

/// A system, a start, and its first state in closed form.
struct Case {
    name: &'static str,
    segment: Segment,
    exact: Orbit,
}

fn case(name: &'static str, system: System, mode: usize, x: [f64; 2], exact: Orbit) -> Case {
    let start = system.point(&[mode], &x);
    let segment = Segment {
        system,
        start,
        periods: 12,
    };
    Case {
        name,
        segment,
        exact,
    }
}

/// x'' + 2 zeta x' + x = a cos(omega t) from rest at 0: no switch.
fn smooth() -> Case {
    let (zeta, a, omega) = (0.05_f64, 1.0, 0.8_f64);
    let system = testing::forced_oscillator(zeta, a, omega, 1e3);
    let exact = Box::new(move |t: f64| {
        let (p, q) = (1.0 - omega * omega, 2.0 * zeta * omega);
        let size = a / (p * p + q * q);
        let (c, s) = (p * size, q * size); // steady state c cos + s sin
        let fast = (1.0 - zeta * zeta).sqrt();
        let (c0, s0) = (-c, (-zeta * c - omega * s) / fast);
        let decay = (-zeta * t).exp();
        c * (omega * t).cos()
            + s * (omega * t).sin()
            + decay * (c0 * (fast * t).cos() + s0 * (fast * t).sin())
    });
    case("smooth", system, 0, [0.0, 0.0], exact)
}

/// Soft spring below zero, stiff above: arcs of two sines. The field is continuous, its slope is not.
fn bilinear() -> Case {
    let system = testing::bilinear_oscillator(9.0, 1.3);
    let exact = Box::new(|t: f64| {
        let phase = t.rem_euclid(PI * 4.0 / 3.0);
        if phase < PI / 3.0 {
            (3.0 * phase).sin() / 3.0
        } else {
            -(phase - PI / 3.0).sin()
        }
    });
    case("bilinear", system, 1, [0.0, 1.0], exact)
}

/// x'' = -x - c sign(x): the field jumps at x = 0. Arcs of circles about -c and c.
fn relay() -> Case {
    let (c, v) = (0.7_f64, 1.0_f64);
    let mut b = SystemBuilder::new(2);
    let (x, speed) = (b.state(0), b.state(1));
    let side = b.reserve_unit();
    let one = b.linear(c, &[]);
    let pull = b.gate(side, &[1.0, -1.0], one);
    let acceleration = b.linear(0.0, &[(-1.0, x), (1.0, pull)]);
    b.derivative(0, speed);
    b.derivative(1, acceleration);
    b.define_unit(
        side,
        vec![
            vec![Transition::rising(x, 1)],
            vec![Transition::falling(x, 0)],
        ],
    );
    let (radius, half) = (c.hypot(v), (v / c).atan());
    let exact = Box::new(move |t: f64| {
        let phase = t.rem_euclid(4.0 * half);
        if phase < 2.0 * half {
            -c + radius * (phase - half).cos()
        } else {
            c - radius * (phase - 3.0 * half).cos()
        }
    });
    case("relay", b.build(1.3).unwrap(), 1, [0.0, v], exact)
}

/// x'' + 2 zeta x' + x = 0 with a wall at 0 that returns 0.9 of the speed: the state jumps.
fn impacts() -> Case {
    let (zeta, e) = (0.02_f64, 0.9_f64);
    let mut b = SystemBuilder::new(2);
    let (x, v) = (b.state(0), b.state(1));
    let acceleration = b.linear(0.0, &[(-1.0, x), (-2.0 * zeta, v)]);
    let rebound = b.linear(0.0, &[(-e, v)]);
    b.derivative(0, v);
    b.derivative(1, acceleration);
    b.unit(vec![vec![Transition::falling(x, 0).reset(1, rebound)]]);
    let fast = (1.0 - zeta * zeta).sqrt();
    let exact = Box::new(move |t: f64| {
        let bounces = (t * fast / PI).floor();
        let since = t - bounces * PI / fast;
        // each arc takes pi/fast and keeps e exp(-zeta pi/fast) of the speed
        let kept = (e * (-zeta * PI / fast).exp()).powf(bounces);
        kept * (-zeta * since).exp() * (fast * since).sin() / fast
    });
    case("impacts", b.build(1.3).unwrap(), 0, [0.0, 1.0], exact)
}

fn cases() -> [Case; 4] {
    [smooth(), bilinear(), relay(), impacts()]
}

/// z'' = -1 + max(0, F), F = (y - z) + 2 zeta (y' - z'), y = a cos(omega t): a gate whose field is
/// continuous at the switch. No closed form; with `energy` an integral runs beside it.
fn hopper(zeta: f64, a: f64, omega: f64, energy: bool) -> System {
    let mut b = SystemBuilder::new(2);
    let (z, v) = (b.state(0), b.state(1));
    let (cos, sin) = b.drive(omega);
    let damping = 2.0 * zeta;
    let force = b.linear(
        0.0,
        &[
            (a, cos),
            (-1.0, z),
            (-damping * a * omega, sin),
            (-damping, v),
        ],
    );
    let contact = b.reserve_unit();
    let gated = b.gate(contact, &[1.0, 0.0], force);
    let fall = b.linear(-1.0, &[(1.0, gated)]);
    b.derivative(0, v);
    b.derivative(1, fall);
    b.define_unit(
        contact,
        vec![
            vec![Transition::falling(force, 1)],
            vec![Transition::rising(force, 0)],
        ],
    );
    if energy {
        let work = b.dot(&[(gated, v), (force, force)]);
        b.quadrature(work);
    }
    b.build(0.0).unwrap()
}

/// From a height, in flight.
fn hop(system: System, z: f64, periods: u64) -> Segment {
    let start = system.point(&[1], &[z, 0.3]);
    Segment {
        system,
        start,
        periods,
    }
}

fn run(segment: &Segment, options: &Options) -> Recording {
    let recording = record(segment, options).unwrap();
    assert_eq!(recording.end.status, Status::Completed);
    recording
}

/// Largest error of the first state over all samples.
fn sample_error(case: &Case, options: &Options) -> f64 {
    let period = case.segment.system.period();
    let samples = run(&case.segment, options).samples;
    (1..)
        .zip(&samples)
        .map(|(n, p)| (p.x[0] - (case.exact)(f64::from(n) * period)).abs())
        .fold(0.0, f64::max)
}

/// Error at dense points: 7 in each step, ends left out.
struct Dense<'a> {
    segment: Option<Segment>,
    exact: &'a Orbit,
    period: f64,
    worst: f64,
}

impl Task for Dense<'_> {
    fn begin(&mut self) -> Option<Segment> {
        self.segment.take()
    }
    fn sample(&mut self, _: &Sample<'_>) -> bool {
        true
    }
    fn wants_steps(&self) -> bool {
        true
    }
    fn step(&mut self, step: &Step<'_>) {
        let start = step.period as f64 * self.period + step.time;
        let mut x = [0.0; 2];
        for i in 1..8 {
            let since = step.length * f64::from(i) / 8.0;
            step.state(since, &mut x);
            self.worst = self.worst.max((x[0] - (self.exact)(start + since)).abs());
        }
    }
    fn end(&mut self, _: End) -> Option<Segment> {
        None
    }
}

fn dense_error(segment: &Segment, exact: &Orbit, options: &Options) -> f64 {
    let task = Dense {
        segment: Some(segment.clone()),
        exact,
        period: segment.system.period(),
        worst: 0.0,
    };
    let mut worst = f64::NAN;
    integrate(options, [task], &AtomicBool::new(false), |t| {
        worst = t.worst;
    })
    .unwrap();
    worst
}

#[test]
fn rk4_error_falls_sixteenfold_when_the_step_halves() {
    // h = 0.0065 to 0.05; at smaller steps rounding would show. The ratio leaves 16 by O(h), and
    // across switches by the share of the steps that a switch cuts in two.
    for case in cases() {
        let steps = if case.name == "smooth" { 160 } else { 50 };
        let errors = [1, 2, 4].map(|k| sample_error(&case, &rk4(steps * k)));
        for pair in errors.windows(2) {
            let ratio = pair[0] / pair[1];
            assert!((14.0..18.0).contains(&ratio), "{} {errors:?}", case.name);
        }
    }
}

#[test]
fn rk4_error_falls_sixteenfold_across_a_continuous_gate() {
    // F = max(0, .) as in the jumper's equations; against Taylor at the rounding of f64.
    let segment = hop(hopper(0.1, 0.6, 1.1, false), 2.0, 5);
    let exact = run(&segment, &taylor(1e-16, 24));
    assert_eq!(exact.end.switches, 5, "lands three times, leaves twice");
    let error = |steps| {
        let end = run(&segment, &rk4(steps)).end;
        assert_eq!(end.switches, exact.end.switches);
        let [z, v] = [0, 1].map(|i| end.point.x[i] - exact.end.point.x[i]);
        z.hypot(v)
    };
    let errors = [100, 200, 400].map(error);
    for pair in errors.windows(2) {
        let ratio = pair[0] / pair[1];
        assert!((14.0..18.0).contains(&ratio), "{errors:?}");
    }
}

#[test]
fn taylor_error_follows_the_tolerance() {
    // The tolerance is for the last term of one step; the errors of some tens of steps and switches
    // add up to at most 2.3 tolerances. Below 1e-13 rounding adds up as well.
    for case in cases() {
        for exponent in 3..=14 {
            let tolerance = 10.0_f64.powi(-exponent);
            for order in [8, 12, 18, 24] {
                let error = sample_error(&case, &taylor(tolerance, order));
                let bound = 10.0 * tolerance + 1e-13;
                assert!(
                    error <= bound,
                    "{} {tolerance:e} {order} {error:e}",
                    case.name
                );
            }
        }
    }
}

#[test]
fn every_order_reaches_the_same_accuracy() {
    for case in cases() {
        for order in 8..=24 {
            let error = sample_error(&case, &taylor(1e-12, order));
            // twelve intervals of some steps each, as above
            assert!(error <= 1e-11, "{} {order} {error:e}", case.name);
        }
    }
}

#[test]
fn the_default_order_does_what_its_tolerance_says() {
    for case in cases() {
        for tolerance in [1e-4, 1e-7, 1e-10, 1e-13] {
            let error = sample_error(&case, &with(Method::taylor(tolerance)));
            assert!(
                error <= 10.0 * tolerance + 1e-13,
                "{} {tolerance:e} {error:e}",
                case.name
            );
        }
    }
}

#[test]
fn dense_output_is_as_accurate_as_its_method() {
    for Case {
        name,
        segment,
        exact,
    } in cases()
    {
        for tolerance in [1e-6, 1e-9, 1e-12] {
            let error = dense_error(&segment, &exact, &taylor(tolerance, 18));
            assert!(
                error <= 10.0 * tolerance + 1e-13,
                "{name} {tolerance:e} {error:e}"
            );
        }
        // Cubic Hermite: h^4/384 of the fourth derivative, of the order of the method.
        let steps = if name == "smooth" { 160 } else { 50 };
        let errors = [1, 2, 4].map(|k| dense_error(&segment, &exact, &rk4(steps * k)));
        for pair in errors.windows(2) {
            let ratio = pair[0] / pair[1];
            assert!((13.0..19.0).contains(&ratio), "{name} {errors:?}");
        }
    }
}

#[test]
fn rk4_and_taylor_agree() {
    // Different in everything but the equations. RK4 at h = 0.0006: error 0.01 h^4, rounding 1e-13.
    for start in [0.5, 1.7, 2.6] {
        let segment = hop(hopper(0.2, 0.6, 1.1, false), start, 5);
        let one = run(&segment, &taylor(1e-14, 18));
        let other = run(&segment, &rk4(10_000));
        assert_eq!(one.switches.len(), other.switches.len());
        for (a, b) in one.switches.iter().zip(&other.switches) {
            assert!((a.time - b.time).abs() < 1e-10, "{a:?} {b:?}");
        }
        for (a, b) in one.samples.iter().zip(&other.samples) {
            assert_eq!(a.modes, b.modes);
            for (a, b) in a.x.iter().zip(&b.x) {
                assert!((a - b).abs() < 1e-11, "{a} {b}");
            }
        }
    }
}

fn bits(x: &[f64]) -> Vec<u64> {
    x.iter().map(|v| v.to_bits()).collect()
}

fn methods() -> [Options; 2] {
    [taylor(1e-11, 16), rk4(60)]
}

#[test]
fn a_quadrature_does_not_change_the_state_by_a_bit() {
    for options in methods() {
        let plain = run(&hop(hopper(0.1, 0.6, 1.1, false), 2.0, 30), &options);
        let energy = run(&hop(hopper(0.1, 0.6, 1.1, true), 2.0, 30), &options);
        assert_eq!(plain.switches, energy.switches);
        assert_eq!(plain.end.steps, energy.end.steps);
        for (a, b) in plain.samples.iter().zip(&energy.samples) {
            assert_eq!(bits(&a.x), bits(&b.x[..a.x.len()]));
        }
        assert!(energy.end.point.x[4] > 0.0);
    }
}

#[test]
fn a_quadrature_is_an_integral() {
    // x'' = -x from (1, 0): the integral of x'^2 over t is t/2 - sin(2 t)/4.
    let mut b = SystemBuilder::new(2);
    let (x, v) = (b.state(0), b.state(1));
    let pull = b.linear(0.0, &[(-1.0, x)]);
    b.derivative(0, v);
    b.derivative(1, pull);
    let square = b.dot(&[(v, v)]);
    let index = b.quadrature(square);
    b.unit(vec![vec![]]);
    let system = b.build(1.3).unwrap();
    let start = system.point(&[0], &[1.0, 0.0]);
    let segment = Segment {
        system,
        start,
        periods: 1,
    };
    let exact = 0.65 - 2.6_f64.sin() / 4.0;
    let error = |options| (run(&segment, &options).end.point.x[index] - exact).abs();
    // x'^2 turns twice as fast as x and is no part of the error control: of a step of 1.3 its series
    // leaves (2 x 1.3)^25/25!/4 = 4e-16 at order 24, but 2e-10 at order 18.
    assert!(error(taylor(1e-13, 24)) < 1e-14);
    assert!(error(taylor(1e-13, 18)) < 1e-9);
    let ratio = error(rk4(20)) / error(rk4(40));
    assert!((14.0..18.0).contains(&ratio), "{ratio}");
}

#[test]
fn ten_periods_are_four_and_then_six() {
    for options in methods() {
        for segment in [
            hop(hopper(0.1, 0.6, 1.1, true), 2.0, 10),
            smooth().segment,
            bilinear().segment,
        ] {
            let segment = Segment {
                periods: 10,
                ..segment
            };
            let whole = run(&segment, &options);
            let first = run(
                &Segment {
                    periods: 4,
                    ..segment.clone()
                },
                &options,
            );
            let second = run(
                &Segment {
                    start: first.end.point.clone(),
                    periods: 6,
                    ..segment
                },
                &options,
            );
            let parts = first.samples.iter().chain(&second.samples);
            for (a, b) in whole.samples.iter().zip(parts) {
                assert_eq!((&a.modes, bits(&a.x)), (&b.modes, bits(&b.x)));
            }
            assert_eq!(whole.end.steps, first.end.steps + second.end.steps);
            assert_eq!(whole.end.switches, first.end.switches + second.end.switches);
        }
    }
}

/// Sends its samples away and raises the flag at one of them.
struct Interrupter<'a> {
    segment: Option<Segment>,
    to: Sender<Point>,
    stop: &'a AtomicBool,
    at: u64,
}

impl Task for Interrupter<'_> {
    fn begin(&mut self) -> Option<Segment> {
        self.segment.take()
    }
    fn sample(&mut self, sample: &Sample<'_>) -> bool {
        let point = Point {
            modes: sample.modes.to_vec(),
            x: sample.x.to_vec(),
        };
        self.to.send(point).unwrap();
        self.stop.store(sample.period == self.at, Ordering::Relaxed);
        true
    }
    fn end(&mut self, _: End) -> Option<Segment> {
        None
    }
}

#[test]
fn an_interrupted_run_resumes_from_its_last_sample() {
    for options in methods() {
        let segment = hop(hopper(0.1, 0.6, 1.1, false), 2.0, 10);
        let whole = run(&segment, &options).samples;
        let (to, from) = channel();
        let stop = AtomicBool::new(false);
        let task = Interrupter {
            segment: Some(segment.clone()),
            to,
            stop: &stop,
            at: 7,
        };
        let ended = integrate(&options, [task], &stop, |_| {});
        assert_eq!(ended, Err(IntegrateError::Interrupted));
        let kept: Vec<Point> = from.iter().collect();
        assert_eq!(kept.len(), 7);
        let rest = Segment {
            start: kept[6].clone(),
            periods: 3,
            ..segment
        };
        let rest = run(&rest, &options).samples;
        for (a, b) in whole.iter().zip(kept.iter().chain(&rest)) {
            assert_eq!((&a.modes, bits(&a.x)), (&b.modes, bits(&b.x)));
        }
    }
}

/// Two segments, the second from the end of the first, as a sweep with carried state.
#[derive(Clone)]
struct Chain {
    id: usize,
    segments: Vec<Segment>,
    seen: Vec<u64>,
}

impl Task for Chain {
    fn begin(&mut self) -> Option<Segment> {
        self.segments.pop()
    }
    fn sample(&mut self, sample: &Sample<'_>) -> bool {
        self.seen.extend(bits(sample.x));
        self.seen
            .extend(sample.dwell.iter().flatten().map(|d| d.to_bits()));
        true
    }
    fn switch(&mut self, switch: &saltus_hybrid::Switch<'_>) {
        self.seen.push(switch.time.to_bits());
    }
    fn end(&mut self, end: End) -> Option<Segment> {
        self.seen.extend([end.steps, end.switches, end.periods]);
        let next = self.segments.pop()?;
        Some(Segment {
            start: end.point,
            ..next
        })
    }
}

#[test]
fn any_number_of_threads_and_any_order_give_the_same_bits() {
    // 21 chains on 8 lanes, of unequal length, so that lanes are refilled at odd moments.
    let chain = |id: usize| {
        let segment = |zeta: f64| {
            let periods = 2 + id as u64 % 5;
            hop(
                hopper(zeta, 0.5, 0.9, false),
                1.5 + 0.1 * id as f64,
                periods,
            )
        };
        let zeta = 0.05 + 0.02 * id as f64;
        Chain {
            id,
            segments: vec![segment(zeta + 0.01), segment(zeta)],
            seen: Vec::new(),
        }
    };
    let count = 21;
    let stop = AtomicBool::new(false);
    for options in methods() {
        let alone: Vec<Vec<u64>> = (0..count)
            .map(|id| {
                let mut out = Vec::new();
                integrate(&options, [chain(id)], &stop, |t| {
                    out = t.seen;
                })
                .unwrap();
                assert!(!out.is_empty());
                out
            })
            .collect();
        for threads in [1, 2, 3, 5] {
            for stride in [1, 8, 20] {
                // Each stride is coprime to 21: a permutation.
                let tasks = (0..count).map(|i| chain(i * stride % count)).collect();
                let ended = integrate_all(&options, tasks, threads, &stop).unwrap();
                for (i, task) in ended.iter().enumerate() {
                    assert_eq!(task.id, i * stride % count, "given back in order");
                    assert!(task.seen == alone[task.id], "task {}", task.id);
                }
            }
        }
    }
}

/// Keeps the state at one instant of the first period.
struct Half {
    segment: Option<Segment>,
    at: f64,
    seen: Vec<f64>,
}

impl Task for Half {
    fn begin(&mut self) -> Option<Segment> {
        self.segment.take()
    }
    fn sample(&mut self, _: &Sample<'_>) -> bool {
        true
    }
    fn wants_steps(&self) -> bool {
        true
    }
    fn step(&mut self, step: &Step<'_>) {
        let since = self.at - step.time;
        if (0.0..step.length).contains(&since) {
            self.seen.resize(4, 0.0);
            step.state(since, &mut self.seen);
        }
    }
    fn end(&mut self, _: End) -> Option<Segment> {
        None
    }
}

#[test]
fn a_drive_of_minus_a_is_a_shift_of_half_a_period() {
    // -a cos(omega t) = a cos(omega t + pi): what the one does from t on the other does from t + T/2.
    // Both forget their starts; seen half a period apart they agree to the rounding of a stable orbit.
    let (zeta, a, omega) = (0.3, 0.4, 0.9);
    for options in [taylor(1e-14, 20), rk4(400)] {
        let late = |a: f64| {
            let segment = hop(hopper(zeta, a, omega, false), 1.2, 200);
            run(&segment, &options).end.point
        };
        let (plus, minus) = (late(a), late(-a));
        let half = Half {
            segment: Some(Segment {
                system: hopper(zeta, a, omega, false),
                start: plus,
                periods: 1,
            }),
            at: PI / omega,
            seen: Vec::new(),
        };
        let mut seen = Vec::new();
        integrate(&options, [half], &AtomicBool::new(false), |t| {
            seen = t.seen;
        })
        .unwrap();
        assert_eq!(seen.len(), 4);
        for (a, b) in seen.iter().zip(&minus.x).take(2) {
            assert!((a - b).abs() < 1e-12, "{seen:?} {:?}", minus.x);
        }
    }
}
