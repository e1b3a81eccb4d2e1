//! A bifurcation diagram in thirty lines: what the paper's person does at twenty damping ratios of the leg.
//!
//! `cargo run --release -p saltus --example sweep`

use std::io::Write as _;

use saltus::model::{Inertia, Setup};
use saltus::study::{Bodies, Control, Pass, Sweep, linspace, recurrence, sweep};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Omega is 1.1 times the frequency at which the body bounces on the plate.
    let model_at = |damping_ratio: f64| {
        let mut setup = Setup::dias_del_prado(damping_ratio, 1.1);
        setup.inertia = Inertia::Condensed;
        setup.model()
    };
    let question = Sweep {
        values: linspace(0.3, 0.49, 20),
        passes: vec![Pass::Down],
        start: (3.0, 2.0),
        transient: 400,
        record: 64,
    };
    let mut out = std::io::stdout().lock();
    for row in sweep(&question, model_at, &Control::default())? {
        let (z, v) = (&row.z()[0], &row.v()[0]);
        let motion = recurrence(z, v, 1e-3).map_or("no period".into(), |n| format!("{n}T"));
        let highest = z.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        writeln!(
            out,
            "zeta_h = {:.2}: {motion}, highest sample z/eta = {highest:.4}",
            row.value
        )?;
    }
    Ok(())
}
