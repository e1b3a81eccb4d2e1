//! Writes the engine's straight-line code for the programs that occur most: run it after a change of the
//! equations of motion, from the root of the repository.

use saltus::model::{Inertia, Setup};
use saltus::physics::ContactLaw;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let paper = (Inertia::Condensed, ContactLaw::ReactionForce);
    for (name, (inertia, contact), tangents) in [
        ("condensed_4_1", paper, 0),
        ("condensed_4_1_gap", (paper.0, ContactLaw::Gap), 0),
        (
            "condensed_4_1_relaxing",
            (paper.0, ContactLaw::RelaxingLeg),
            0,
        ),
        ("condensed_4_1_tangent", paper, 1),
        ("slow_manifold_4_1", (Inertia::SlowManifold, paper.1), 0),
    ] {
        let setup = Setup {
            inertia,
            contact,
            ..Setup::dias_del_prado(0.3, 1.0)
        };
        let mut system = setup.model()?.system().clone();
        if tangents > 0 {
            system = system.with_tangents(tangents)?;
        }
        let source = system.source().ok_or("not all of it can be written out")?;
        let path = format!("crates/saltus-hybrid/src/special/{name}.rs");
        std::fs::write(&path, source)?;
        eprintln!("{path}");
    }
    Ok(())
}
