//! A ball that is dropped on a table that vibrates: every impact, exactly where it is.
//!
//! `cargo run -p saltus-hybrid --example bouncing_ball`

use std::io::Write as _;

use saltus_hybrid::{Options, Segment, SwitchKind, SystemBuilder, Transition, record};

/// Height of the table is a cos t, gravity is 1.
const AMPLITUDE: f64 = 0.1;
const RESTITUTION: f64 = 0.8;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut b = SystemBuilder::new(2);
    let (height, velocity) = (b.state(0), b.state(1));
    let (cos, sin) = b.drive(1.0);
    let gap = b.linear(0.0, &[(1.0, height), (-AMPLITUDE, cos)]);
    // The velocity relative to the table, -a sin t, turns round and loses a fifth.
    let rebound = b.linear(
        0.0,
        &[
            (-RESTITUTION, velocity),
            (-AMPLITUDE * (1.0 + RESTITUTION), sin),
        ],
    );
    let gravity = b.linear(-1.0, &[]);
    b.derivative(0, velocity);
    b.derivative(1, gravity);
    b.unit(vec![vec![Transition::falling(gap, 0).reset(1, rebound)]]);
    let system = b.build(0.0)?;

    let start = system.point(&[0], &[1.5, 0.0]);
    let segment = Segment {
        system,
        start,
        periods: 3,
    };
    let run = record(&segment, &Options::default())?;
    let mut out = std::io::stdout().lock();
    for switch in &run.switches {
        if let SwitchKind::Mode { .. } = switch.kind {
            writeln!(out, "impact at t = {:.12}", switch.time)?;
        }
    }
    for (period, sample) in (1..).zip(&run.samples) {
        let [height, velocity] = [sample.x[0], sample.x[1]];
        writeln!(
            out,
            "after {period} periods: height {height:.12}, velocity {velocity:.12}"
        )?;
    }
    Ok(())
}
