//! The resonance of Duffing's oscillator x'' + d x' + x + x^3 = f cos(omega t): its branch of periodic orbits over omega, with
//! the folds between which two stable motions coexist.
//!
//! `cargo run --release -p saltus-orbits --example duffing_branch`

use std::io::Write as _;
use std::sync::atomic::AtomicBool;

use saltus_hybrid::{Options, System, SystemBuilder};
use saltus_orbits::{
    ContinuationOptions, MapPoint, NewtonOptions, ParameterRange, Stroboscopic, find_orbit,
    follow_both,
};

const DAMPING: f64 = 0.1;
const FORCE: f64 = 0.3;

fn duffing(omega: f64) -> Result<System, String> {
    let mut b = SystemBuilder::new(2);
    let (x, v) = (b.state(0), b.state(1));
    let (cos, _) = b.drive(omega);
    let square = b.squares(&[x])[0];
    let cube = b.products(&[(square, x)])[0];
    let force = b.linear(0.0, &[(-1.0, x), (-DAMPING, v), (-1.0, cube), (FORCE, cos)]);
    b.derivative(0, v);
    b.derivative(1, force);
    b.build(0.0).map_err(|error| error.to_string())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let stop = AtomicBool::new(false);
    let map = Stroboscopic::new(|p: &[f64]| duffing(p[0]), 2, Options::default(), 0, &stop);
    // Far below resonance the motion follows the force.
    let guess = MapPoint {
        modes: Vec::new(),
        x: vec![FORCE, 0.0],
    };
    let start = find_orbit(&map, &[0.3], &[guess], &NewtonOptions::default())?;
    let along = ParameterRange {
        parameter: 0,
        from: 0.2,
        to: 3.0,
    };
    let options = ContinuationOptions::default();
    let branch = follow_both(&map, &start, &along, &options, &mut |_| true)?;

    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "{} orbits, ends: {:?}",
        branch.points.len(),
        branch.ends
    )?;
    for special in &branch.specials {
        let x = &special.orbit.places[0].x;
        writeln!(
            out,
            "{:<4} {} at omega = {:.9}, x = {:.9}",
            special.label,
            special.kind.short(),
            special.parameter,
            x[0]
        )?;
    }
    Ok(())
}
