//! A system of one's own, asked everything: Duffing's oscillator between two wells,
//! x'' + 0.15 x' - x + x^3 = f cos t.
//!
//! `cargo run --release -p saltus-study --example double_well`

#![allow(clippy::print_stdout)]

use saltus_hybrid::{BuildError, SystemBuilder};
use saltus_study::{
    Control, Flow, Measurement, Region, Search, StudyError, Subject, follow, linspace, lyapunov,
};

/// The oscillator under a force.
fn double_well(force: f64) -> Result<Flow, BuildError> {
    let mut b = SystemBuilder::new(2);
    let (x, v) = (b.state(0), b.state(1));
    let (cos, _) = b.drive(1.0);
    let square = b.squares(&[x])[0];
    let cube = b.products(&[(square, x)])[0];
    let pull = b.linear(0.0, &[(1.0, x), (-1.0, cube), (-0.15, v), (force, cos)]);
    b.derivative(0, v);
    b.derivative(1, pull);
    Ok(Flow::new(b.build(0.0)?))
}

fn main() -> Result<(), StudyError<BuildError>> {
    let (search, control) = (Search::default(), Control::default());
    // every attractor that initial conditions from a box lead to, along the force
    let region = Region {
        count: 64,
        ranges: vec![[-2.0, 2.0], [-1.5, 1.5]],
    };
    let found = follow(
        &linspace(0.05, 0.3, 6),
        double_well,
        &region,
        &search,
        &control,
    )?;
    for row in &found.rows {
        for one in row.attractors() {
            let kind = one.entry.attractor.kind;
            let share = 100.0 * one.fraction.value();
            let x = one.arrival.section[0].first().copied().unwrap_or(f64::NAN);
            println!(
                "f = {:.2}: attractor {} draws {share:3.0} % of the box: {kind:?}, x = {x:+.4} at a sample",
                row.value,
                one.identity + 1
            );
        }
    }
    // exponents of the motion at the strongest force
    let flow = double_well(0.3).map_err(StudyError::Model)?;
    let how = Measurement {
        exponents: 2,
        transient: 200,
        periods: 1000,
        replicas: 8,
    };
    let start = flow.start(&vec![0.0, 0.0]);
    for exponent in lyapunov(&flow, &start, &how, &control)?.exponents() {
        println!(
            "exponent {:+.4} +- {:.4} per period",
            exponent.per_iterate, exponent.standard_error
        );
    }
    Ok(())
}
