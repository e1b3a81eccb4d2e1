//! Rate of the ensemble engine on a brute-force bifurcation diagram of the paper's case (one thread):
//! trajectory-periods per second, and the accuracy they were bought with.

use std::time::Instant;

use saltus::hybrid::{Method, Options, Segment, record};
use saltus::model::{Model, ModelError, PreparedPlate, Setup};
use saltus::study::{Control, Pass, Sweep, linspace, sweep};

/// Seconds that the diagram takes.
fn time<F>(
    diagram: &Sweep,
    at: F,
    method: Method,
    threads: usize,
) -> Result<f64, Box<dyn std::error::Error>>
where
    F: Fn(f64) -> Result<Model, ModelError> + Sync,
{
    let options = Options {
        method,
        ..Options::default()
    };
    let control = Control {
        options,
        threads,
        ..Control::default()
    };
    let clock = Instant::now();
    sweep(diagram, at, &control)?;
    Ok(clock.elapsed().as_secs_f64())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let setup = Setup::dias_del_prado(0.3, 1.1);
    let plate = PreparedPlate::new(&setup.plate)?;
    let at = &|zeta: f64| {
        let mut setup = setup.clone();
        setup.jumpers[0].damping_ratio = zeta;
        setup.model_on(&plate)
    };
    let diagram = Sweep {
        values: linspace(0.1, 0.5, 256),
        passes: vec![Pass::Start((3.0, 2.0))],
        start: (3.0, 2.0),
        transient: 300,
        record: 100,
    };
    // Accuracy: 20 periods at zeta 0.45, Omega 0.9, against a far tighter run.
    let precise = Setup::dias_del_prado(0.45, 0.9).model()?;
    let segment = Segment {
        system: precise.system().clone(),
        start: precise.start(3.0, 2.0),
        periods: 20,
    };
    let run = |method| {
        record(
            &segment,
            &Options {
                method,
                ..Options::default()
            },
        )
    };
    let reference = run(Method::Taylor {
        tolerance: 1e-16,
        order: 24,
    })?;
    let rk4 = run(Method::Rk4 {
        steps_per_period: 20_000,
    })?;
    let error = |x: &[f64]| {
        x.iter()
            .zip(&reference.end.point.x)
            .fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()))
    };
    eprintln!("RK4, 20000 steps: {:.1e}", error(&rk4.end.point.x));
    for (tolerance, order) in [
        (1e-6, 10),
        (1e-7, 12),
        (1e-8, 12),
        (1e-9, 12),
        (1e-9, 14),
        (1e-10, 14),
        (1e-10, 16),
        (1e-12, 16),
    ] {
        let method = Method::Taylor { tolerance, order };
        let accuracy = error(&run(method)?.end.point.x);
        let seconds = time(&diagram, at, method, 1)?;
        eprintln!(
            "tolerance {tolerance:.0e}, order {order}: {:.0} k trajectory-periods/s, error {accuracy:.1e}",
            diagram.periods() as f64 / seconds / 1e3,
        );
    }
    let method = Method::Taylor {
        tolerance: 1e-9,
        order: 14,
    };
    let mut best = [f64::INFINITY; 2];
    for _ in 0..5 {
        for (threads, best) in (1..).zip(&mut best) {
            *best = best.min(time(&diagram, at, method, threads)?);
        }
    }
    eprintln!("two threads: {:.2} times one", best[0] / best[1]);
    Ok(())
}
