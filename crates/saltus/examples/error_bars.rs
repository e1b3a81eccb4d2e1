//! Coverage of intervals of 95 % for the largest exponent of the paper's person, printed as a table for
//! docs/numerics.md.
//!
//! Of each case 50 measurements of 8 x 500 periods are made from starts of their own, as `saltus lyapunov` makes them.
//! The long-run value is the mean of eight records of 12 000 periods each after 4000 others, with the standard error
//! of their scatter; an interval that misses it by no more than that counts as holding it.
//!
//! ```sh
//! cargo run --release -p saltus --example error_bars
//! ```

#![allow(clippy::print_stdout)]

use saltus::model::Setup;
use saltus::orbits::Exponent;
use saltus::study::{Control, Measurement, StudyError, lyapunov, lyapunov_of_states, settle};

/// Omega/omega_h, zeta_h and z/eta at the start: bands that mix slowly, bands that do not, and one band.
const CASES: [(f64, f64, f64); 6] = [
    (1.1, 0.32, 3.548),
    (1.1, 0.3315, 3.0),
    (1.1, 0.3328, 3.0),
    (1.1, 0.25, 3.0),
    (1.0, 0.12, 3.0),
    (1.0, 0.14, 3.0),
];
const REPEATS: usize = 50;
const HOW: Measurement = Measurement {
    exponents: 1,
    transient: 400,
    periods: 500,
    replicas: 8,
};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("| $\\Omega/\\omega_h$ | $\\zeta_h$ | long run | hold it | scatter | stated |");
    println!("|---|---|---|---|---|---|");
    let mut all = 0;
    for (ratio, zeta, z) in CASES {
        let setup = Setup::dias_del_prado(zeta, ratio);
        let (mean, error) = long_run(&setup, z)?;
        let found = (0..REPEATS)
            .map(|repeat| measured(&setup, z + 1e-3 * repeat as f64))
            .collect::<Result<Vec<_>, _>>()?;
        let holds = |one: &&Exponent| {
            let [low, high] = one.interval();
            low - error <= mean && mean <= high + error
        };
        let held = found.iter().filter(holds).count();
        all += held;
        let root = |sum: f64| (sum / REPEATS as f64).sqrt();
        let scatter = found.iter().map(|e| (e.per_iterate - mean).powi(2)).sum();
        let stated = found.iter().map(|e| e.standard_error.powi(2)).sum();
        println!(
            "| {ratio} | {zeta} | {mean:.4} ± {error:.4} | {held} of {REPEATS} | {:.4} | {:.4} |",
            root(scatter),
            root(stated)
        );
    }
    let share = 100.0 * all as f64 / (REPEATS * CASES.len()) as f64;
    println!("\nall: {share:.1} %");
    Ok(())
}

fn measured(setup: &Setup, z: f64) -> Result<Exponent, StudyError> {
    let model = setup.model()?;
    let found = lyapunov(&model, &model.start(z, 2.0), &HOW, &Control::default())?;
    Ok(found.exponents().remove(0))
}

/// Mean and standard error.
fn long_run(setup: &Setup, z: f64) -> Result<(f64, f64), StudyError> {
    let control = Control::default();
    let model = setup.model()?;
    let starts: Vec<_> = (0..8)
        .map(|i| (model.clone(), model.start(z + 0.005 * f64::from(i), 2.0)))
        .collect();
    let settled = settle(&starts, 4000, 0, &control)?;
    let on: Vec<_> = settled
        .into_iter()
        .map(|s| (model.clone(), s.end))
        .collect();
    let found = lyapunov_of_states(&on, 1, 12_000, &control)?;
    let values: Vec<f64> = found
        .iter()
        .map(|one| one.spectrum.estimate()[0].per_iterate)
        .collect();
    let mean = values.iter().sum::<f64>() / 8.0;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    Ok((mean, (squares / 56.0).sqrt()))
}
