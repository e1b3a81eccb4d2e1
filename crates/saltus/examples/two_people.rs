//! Two people on one plate, who end up jumping together, each alone, or without a period.
//!
//! `cargo run --release -p saltus --example two_people`

use std::io::Write as _;

use saltus::model::Setup;
use saltus::physics::Jumper;
use saltus::study::{Control, recurrence, simulate};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut out = std::io::stdout().lock();
    for damping_ratio in [0.2, 0.3, 0.4] {
        // The paper's person, and a lighter one a quarter of the way along the plate.
        let mut setup = Setup::dias_del_prado(damping_ratio, 1.0);
        let first = setup.jumpers[0];
        setup.jumpers.push(Jumper {
            x: setup.plate.length / 4.0,
            mass: 60.0,
            ..first
        });
        let model = setup.model()?;
        let run = simulate(
            &model,
            &model.start_each(&[1.0, 1.0], &[0.5, 0.5]),
            600,
            0,
            1,
            &Control::default(),
        )?;
        let last = &run.section[500..];
        for person in 0..2 {
            let z: Vec<f64> = last.iter().map(|s| s.z[person]).collect();
            let v: Vec<f64> = last.iter().map(|s| s.v[person]).collect();
            let motion = recurrence(&z, &v, 1e-4).map_or("no period".into(), |n| format!("{n}T"));
            let on_floor: f64 = run.contact_ratio[500..]
                .iter()
                .map(|r| r[person])
                .sum::<f64>()
                / 100.0;
            writeln!(
                out,
                "zeta_h {damping_ratio:.1}, person {person}: {motion}, on the floor {:.0} % of the time",
                100.0 * on_floor
            )?;
        }
    }
    Ok(())
}
