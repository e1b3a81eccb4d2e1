//! One measurement of saltus for `scripts/compare-peers`, as a line of JSON (one thread).
//!
//! ```text
//! cargo bench -p saltus --bench peers -- INERTIA TOLERANCE ORDER VALUES PERIODS KEEP [END]
//! ```
//! Rate: a bifurcation diagram at Omega = 1.1, VALUES values of zeta in 0.1..0.5, PERIODS periods each,
//! samples kept for the last KEEP. Error: zeta 0.45, Omega 0.9, 20 periods, against END, the ten numbers
//! r/h (4), r'/(h Omega) (4), z/eta, z'/(eta Omega) separated by commas; without it against a far
//! tighter run. Both start at rest with z = 3 eta and z' = 2 eta omega_h.

use std::io::Write;
use std::time::Instant;

use saltus::hybrid::{Method, Options, Segment, record};
use saltus::model::{Inertia, Model, PreparedPlate, Setup};
use saltus::study::{Bodies, Control, Pass, Sweep, linspace, sweep};

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// Values of INERTIA, by name.
const INERTIAS: [Inertia; 3] = [Inertia::Full, Inertia::SlowManifold, Inertia::Condensed];
const START: (f64, f64) = (3.0, 2.0);
const LABEL: (f64, f64, u64) = (0.45, 0.9, 20);

/// Processor seconds of this thread where Linux tells, wall seconds elsewhere. Linux counts when the
/// thread is rescheduled; yielding asks for that.
fn seconds(wall: Instant) -> f64 {
    std::thread::yield_now();
    std::fs::read_to_string("/proc/thread-self/schedstat")
        .ok()
        .and_then(|line| line.split_whitespace().next()?.parse::<f64>().ok())
        .map_or_else(
            || wall.elapsed().as_secs_f64(),
            |nanoseconds| nanoseconds * 1e-9,
        )
}

/// The last ten free states, r, r', z, z', with the body in units of eta.
fn observed(model: &Model, x: &[f64]) -> Vec<f64> {
    let end = model.free_states();
    let mut out = x[end - 10..end].to_vec();
    out[8] = model.z(0, x);
    out[9] = out[9] / x[end - 2] * out[8];
    out
}

/// The end of the label run, and its steps per period.
fn label(inertia: Inertia, method: Method) -> Outcome<(Vec<f64>, f64)> {
    let (zeta, ratio, periods) = LABEL;
    let mut setup = Setup::dias_del_prado(zeta, ratio);
    setup.inertia = inertia;
    let model = setup.model()?;
    let segment = Segment {
        system: model.system().clone(),
        start: model.start(START.0, START.1),
        periods,
    };
    let options = Options {
        method,
        ..Options::default()
    };
    let end = record(&segment, &options)?.end;
    let steps = end.steps as f64 / periods as f64;
    Ok((observed(&model, &end.point.x), steps))
}

fn main() -> Outcome<()> {
    let given: Vec<String> = std::env::args()
        .skip(1)
        .filter(|word| word != "--bench")
        .collect();
    let defaults = ["condensed", "1e-9", "14", "256", "400", "100"];
    let word = |i: usize| given.get(i).map_or(defaults[i], String::as_str);
    let inertia = INERTIAS
        .into_iter()
        .find(|inertia| inertia.name() == word(0))
        .ok_or_else(|| format!("no inertia {}", word(0)))?;
    let method = Method::Taylor {
        tolerance: word(1).parse()?,
        order: word(2).parse()?,
    };
    let (periods, keep): (u64, u64) = (word(4).parse()?, word(5).parse()?);

    let known: Vec<f64> = match given.get(6) {
        Some(end) => end.split(',').map(str::parse).collect::<Result<_, _>>()?,
        None => {
            let (tolerance, order) = (1e-16, 24);
            label(inertia, Method::Taylor { tolerance, order })?.0
        }
    };
    let (end, steps) = label(inertia, method)?;
    let error = end
        .iter()
        .zip(&known)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max);

    let mut setup = Setup::dias_del_prado(LABEL.0, 1.1);
    setup.inertia = inertia;
    let plate = PreparedPlate::new(&setup.plate)?;
    let at = |zeta: f64| {
        let mut setup = setup.clone();
        setup.jumpers[0].damping_ratio = zeta;
        setup.model_on(&plate)
    };
    let diagram = Sweep {
        values: linspace(0.1, 0.5, word(3).parse()?),
        passes: vec![Pass::Start((START.0, START.1))],
        start: START,
        transient: periods - keep,
        record: keep,
    };
    let control = Control {
        options: Options {
            method,
            ..Options::default()
        },
        threads: 1,
        ..Control::default()
    };
    let wall = Instant::now();
    let begun = seconds(wall);
    let rows = sweep(&diagram, at, &control)?;
    let spent = seconds(wall) - begun;
    let samples: Vec<f64> = rows.iter().flat_map(|row| row.z()[0].clone()).collect();
    let mean = samples.iter().sum::<f64>() / samples.len() as f64;
    let json = format!(
        r#"{{"seconds": {spent}, "periods": {}, "error": {error:e}, "mean_z": {mean}, "steps_per_period": {steps}}}"#,
        diagram.periods()
    );
    writeln!(std::io::stdout(), "{json}")?;
    Ok(())
}
