//! Systems written with the engine's own builder. The Python tests write the same systems as formulas, and must
//! find the samples that are kept in `python/tests/data`, to the bit.
//!
//! With `SALTUS_WRITE_SAMPLES` set the file is written instead of compared.

#![allow(clippy::unwrap_used)]
// Without fused multiply-adds the bits are those of every machine of this architecture, and of this one only.
#![cfg(target_arch = "x86_64")]

use std::fmt::Write;
use std::path::Path;

use saltus_hybrid::{
    BuildError, Instructions, Options, Segment, Status, System, SystemBuilder, Transition, record,
};

type Built = Result<System, BuildError>;

fn ueda() -> Built {
    let mut b = SystemBuilder::new(2);
    let (x, v) = (b.state(0), b.state(1));
    let (cos, _) = b.drive(1.0);
    let square = b.squares(&[x])[0];
    let cube = b.products(&[(square, x)])[0];
    let acceleration = b.linear(0.0, &[(7.5, cos), (-0.05, v), (-1.0, cube)]);
    b.derivative(0, v);
    b.derivative(1, acceleration);
    b.build(0.0)
}

/// A ball under gravity 1 on a table at -A cos t.
fn ball(a: f64, e: f64) -> Built {
    let mut b = SystemBuilder::new(2);
    let (y, v) = (b.state(0), b.state(1));
    let (cos, sin) = b.drive(1.0);
    let fall = b.linear(-1.0, &[]);
    let gap = b.linear(0.0, &[(1.0, y), (a, cos)]);
    let rebound = b.linear(0.0, &[(-e, v), ((1.0 + e) * a, sin)]);
    b.derivative(0, v);
    b.derivative(1, fall);
    b.unit(vec![vec![Transition::falling(gap, 0).reset(1, rebound)]]);
    b.build(0.0)
}

/// x'' + 0.1 x' + x + (k x where x > 0) = cos(omega t).
fn bilinear(k: f64, omega: f64) -> Built {
    let mut b = SystemBuilder::new(2);
    let (x, v) = (b.state(0), b.state(1));
    let (cos, _) = b.drive(omega);
    let side = b.reserve_unit();
    let stiff = b.gated_linear(side, &[0.0, -k], &[(1.0, x)]);
    let acceleration = b.linear(0.0, &[(1.0, cos), (-0.1, v), (-1.0, x), (1.0, stiff)]);
    b.derivative(0, v);
    b.derivative(1, acceleration);
    b.define_unit(
        side,
        vec![
            vec![Transition::rising(x, 1)],
            vec![Transition::falling(x, 0)],
        ],
    );
    b.build(0.0)
}

/// Three masses between walls, springs of stiffness 1 + e^2 at the elongation e, the first mass driven.
fn chain() -> Built {
    let mut b = SystemBuilder::new(6);
    let q: Vec<_> = (0..3).map(|i| b.state(i)).collect();
    let u: Vec<_> = (3..6).map(|i| b.state(i)).collect();
    let (cos, _) = b.drive(0.7);
    let first = b.linear(0.0, &[(-1.0, q[0]), (1.0, q[1])]);
    let second = b.linear(0.0, &[(-1.0, q[1]), (1.0, q[2])]);
    let factors = [q[0], first, second, q[2]];
    let squares = b.squares(&factors);
    let pairs: Vec<_> = squares.into_iter().zip(factors).collect();
    let cubes = b.products(&pairs);
    let within = [1, 2].map(|i| b.linear(0.0, &[(1.0, factors[i]), (1.0, cubes[i])]));
    // The walls and the drive act on one mass each, so they are part of its rate.
    let rates = [
        vec![
            (1.0, within[0]),
            (-1.0, q[0]),
            (-1.0, cubes[0]),
            (-0.05, u[0]),
            (2.0, cos),
        ],
        vec![(1.0, within[1]), (-1.0, within[0]), (-0.05, u[1])],
        vec![
            (-1.0, q[2]),
            (-1.0, cubes[3]),
            (-1.0, within[1]),
            (-0.05, u[2]),
        ],
    ];
    for (i, terms) in rates.into_iter().enumerate() {
        b.derivative(i, u[i]);
        let rate = b.linear(0.0, &terms);
        b.derivative(3 + i, rate);
    }
    b.build(0.0)
}

fn samples(name: &str, system: Built, start: &[f64]) -> String {
    let system = system.unwrap();
    let modes = vec![0; system.unit_count()];
    let segment = Segment {
        start: system.point(&modes, start),
        system,
        periods: 60,
    };
    let options = Options {
        instructions: Instructions::Baseline,
        ..Options::default()
    };
    let run = record(&segment, &options).unwrap();
    assert_eq!(run.end.status, Status::Completed);
    let mut line = name.to_owned();
    for x in run.samples.iter().flat_map(|point| &point.x[..start.len()]) {
        write!(line, " {:016x}", x.to_bits()).unwrap();
    }
    line + "\n"
}

#[test]
fn the_samples_that_python_must_find_are_those_of_the_builder() {
    let found = [
        samples("ueda", ueda(), &[2.5, 0.0]),
        samples("ball", ball(1.2, 0.8), &[3.0, 0.0]),
        samples("bilinear", bilinear(9.0, 1.3), &[0.5, 0.0]),
        samples("chain", chain(), &[0.1, 0.0, -0.2, 0.0, 0.0, 0.0]),
    ]
    .concat();
    let path = "../../python/tests/data/samples.txt";
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    if std::env::var_os("SALTUS_WRITE_SAMPLES").is_some() {
        std::fs::write(&path, &found).unwrap();
    }
    assert!(
        std::fs::read_to_string(&path).unwrap() == found,
        "{} is not what the engine gives",
        path.display()
    );
}
