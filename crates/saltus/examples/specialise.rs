//! Writes the engine's straight-line code for the programs that occur most: run it after a change of the
//! equations of motion, from the root of the repository.

use saltus::model::{Inertia, Setup};
use saltus::physics::ContactLaw;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let paper = (Inertia::Condensed, ContactLaw::ReactionForce);
    for (name, (inertia, contact)) in [
        ("condensed_4_1", paper),
        ("condensed_4_1_gap", (paper.0, ContactLaw::Gap)),
        ("condensed_4_1_relaxing", (paper.0, ContactLaw::RelaxingLeg)),
        ("slow_manifold_4_1", (Inertia::SlowManifold, paper.1)),
    ] {
        let setup = Setup {
            inertia,
            contact,
            ..Setup::dias_del_prado(0.3, 1.0)
        };
        let model = setup.model()?;
        let source = model
            .system()
            .source()
            .ok_or("not all of it can be written out")?;
        let path = format!("crates/saltus-hybrid/src/special/{name}.rs");
        std::fs::write(&path, source)?;
        eprintln!("{path}");
    }
    Ok(())
}
