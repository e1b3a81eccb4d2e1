//! Growth of the cost with the number of terms and of people: set-up, rate and size, one thread. The
//! output is the table of docs/benchmarks.md.

use std::time::Instant;

use saltus::hybrid::{Method, Options, Segment, record};
use saltus::model::{Inertia, PreparedPlate, Setup};
use saltus::physics::{InPlaneBasis, Jumper, ModeSet};
use saltus::study::{Control, settle};

const METHOD: Method = Method::Taylor {
    tolerance: 1e-8,
    order: 16,
};

/// Largest resident memory of this process so far (MB), where the system tells.
fn peak() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM"));
    let kilobytes = line.and_then(|line| line.split_whitespace().nth(1)?.parse::<f64>().ok());
    kilobytes.unwrap_or(f64::NAN) / 1024.0
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A process for each row, so that memory counts from nothing.
    let words: Vec<String> = std::env::args().collect();
    if let [_, flag, side, people] = &words[..]
        && flag == "row"
    {
        return row(side.parse()?, people.parse()?);
    }
    let one = |side: u32, people: usize| -> Result<(), Box<dyn std::error::Error>> {
        let mut row = std::process::Command::new(std::env::current_exe()?);
        row.args(["row", &side.to_string(), &people.to_string()]);
        if row.status()?.success() {
            Ok(())
        } else {
            Err("a row failed".into())
        }
    };
    eprintln!(
        "| w terms | in-plane | people | set-up ms | model ms | steps per period | ms per trajectory-period | MB |"
    );
    eprintln!("|---|---|---|---|---|---|---|---|");
    for side in [1, 2, 3, 4, 6, 8, 10] {
        one(side, 1)?;
    }
    for people in [2, 4, 16] {
        one(2, people)?;
    }
    Ok(())
}

/// A complete set of side x side terms with its in-plane terms, and people spread over the plate.
fn row(side: u32, people: usize) -> Result<(), Box<dyn std::error::Error>> {
    let mut setup = Setup::dias_del_prado(0.45, 0.9);
    setup.inertia = Inertia::Condensed;
    setup.plate.basis = InPlaneBasis::ShearFree;
    setup.plate.modes = ModeSet::complete(side, side, InPlaneBasis::ShearFree);
    let first = setup.jumpers[0];
    setup.jumpers = (0..people)
        .map(|i| Jumper {
            x: first.x + 0.31 * i as f64,
            y: first.y - 0.23 * i as f64,
            ..first
        })
        .collect();
    let before = peak();
    let clock = Instant::now();
    let plate = PreparedPlate::new(&setup.plate)?;
    let prepared = clock.elapsed();
    let clock = Instant::now();
    let model = setup.model_on(&plate)?;
    let built = clock.elapsed();

    // One period of one trajectory says how many the measurement takes.
    let segment = |periods| Segment {
        system: model.system().clone(),
        start: model.start(3.0, 2.0),
        periods,
    };
    let options = Options {
        method: METHOD,
        ..Options::default()
    };
    let clock = Instant::now();
    let run = record(&segment(2), &options)?;
    let alone = clock.elapsed().as_secs_f64() / 2.0;
    let steps = run.end.steps as f64 / 2.0;
    let periods = ((0.5 / alone) as u64).clamp(1, 400);
    let control = Control {
        options,
        threads: 1,
        ..Control::default()
    };
    let starts: Vec<_> = (0..16)
        .map(|_| (model.clone(), model.start(3.0, 2.0)))
        .collect();
    let clock = Instant::now();
    let ended = settle(&starts, 0, periods, &control)?;
    let each = clock.elapsed().as_secs_f64() * 1e3 / (ended.len() as u64 * periods) as f64;
    eprintln!(
        "| {} | {} | {people} | {:.2} | {:.2} | {steps:.0} | {each:.4} | {:.0} |",
        setup.plate.modes.w.len(),
        setup.plate.modes.u.len() + setup.plate.modes.v.len(),
        prepared.as_secs_f64() * 1e3,
        built.as_secs_f64() * 1e3,
        peak() - before,
    );
    Ok(())
}
