//! One measurement of one program, as a line of JSON.
//!
//! ```text
//! saltus-peers PROGRAM SETTING LABEL WORK VALUES PERIODS KEEP
//! saltus-peers peak
//! ```
//! PROGRAM is rk4, tsit45, dopri5 or dop853; SETTING its steps in one period of the body, or its
//! tolerance. LABEL is the problem whose error is measured, WORK the one whose rate is: VALUES values of
//! zeta in 0.1..0.5, PERIODS periods each, samples for the last KEEP.

mod clock;
mod erk;
mod peak;
mod problem;
mod rk4;
mod tsit45;

use clock::Clock;
use differential_equations::methods::ExplicitRungeKutta;
use problem::{Field, Problem};

/// A trajectory that advances by whole periods.
trait Program {
    fn advance(&mut self, periods: u32);
    fn state(&self) -> &[f64];
}

/// z of each sample, and the last state.
#[derive(Default)]
struct Samples {
    z: Vec<f64>,
    end: Vec<f64>,
}

impl Samples {
    fn keep(&mut self, z: f64, state: &[f64]) {
        self.z.push(z);
        self.end.clear();
        self.end.extend_from_slice(state);
    }
}

fn collect<const P: usize, const S: usize>(
    field: &Field<P, S>,
    mut program: impl Program,
    first: u32,
    more: u32,
) -> Samples {
    let mut samples = Samples::default();
    program.advance(first);
    samples.keep(field.z(program.state()), program.state());
    for _ in 0..more {
        program.advance(1);
        samples.keep(field.z(program.state()), program.state());
    }
    samples
}

/// Samples after `first` periods and after each of `more`.
fn run<const P: usize, const S: usize>(
    name: &str,
    setting: f64,
    field: &Field<P, S>,
    first: u32,
    more: u32,
) -> Samples {
    match name {
        "rk4" => collect(field, rk4::Rk4::new(field.clone(), setting), first, more),
        "tsit45" => tsit45::run(field, setting, first, more),
        "dopri5" => {
            let method = ExplicitRungeKutta::dopri5().rtol(setting).atol(setting);
            let method = method.h0(1e-3).max_steps(usize::MAX);
            collect(field, erk::Erk::new(field.clone(), method), first, more)
        }
        "dop853" => {
            let method = ExplicitRungeKutta::dop853().rtol(setting).atol(setting);
            let method = method.h0(1e-3).max_steps(usize::MAX);
            collect(field, erk::Erk::new(field.clone(), method), first, more)
        }
        _ => panic!("no program {name}"),
    }
}

struct Work {
    values: u32,
    periods: u32,
    keep: u32,
}

fn measure<const P: usize, const S: usize>(
    name: &str,
    setting: f64,
    label: &Problem,
    problem: &Problem,
    work: &Work,
) {
    let known = label.label.as_ref().expect("a problem with a known end");
    let field = Field::<P, S>::new(label, known.zeta);
    let end = run(name, setting, &field, known.periods, 0).end;
    let error = field.error(&end, &known.end);

    let clock = Clock::start();
    let mut sum = 0.0;
    for i in 0..work.values {
        let zeta = 0.1 + 0.4 * f64::from(i) / f64::from(work.values.max(2) - 1);
        let field = Field::<P, S>::new(problem, zeta);
        let samples = run(name, setting, &field, work.periods - work.keep, work.keep);
        sum += samples.z.iter().skip(1).sum::<f64>();
    }
    let seconds = clock.seconds();
    let mean = sum / f64::from(work.values * work.keep);
    let periods = work.values * work.periods;
    println!(
        r#"{{"seconds": {seconds}, "periods": {periods}, "error": {error:e}, "mean_z": {mean}}}"#
    );
}

fn read(path: &str) -> Problem {
    let text = std::fs::read_to_string(path).expect("a problem file");
    serde_json::from_str(&text).expect("a problem")
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["peak"] => println!(r#"{{"gflops": {}}}"#, peak::gflops()),
        [name, setting, label, problem, values, periods, keep] => {
            let count = |word: &str| word.parse().expect("a whole number");
            let work = Work {
                values: count(values),
                periods: count(periods),
                keep: count(keep),
            };
            let setting: f64 = setting.parse().expect("a number");
            let (label, problem) = (read(label), read(problem));
            match problem.in_plane() {
                0 => measure::<0, 10>(name, setting, &label, &problem, &work),
                12 => measure::<12, 34>(name, setting, &label, &problem, &work),
                other => panic!("{other} in-plane terms; 0 or 12 are compiled"),
            }
        }
        _ => panic!("see the top of main.rs for the arguments"),
    }
}
