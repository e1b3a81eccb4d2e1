//! Writes the engine's straight-line code for the programs that occur most: run it after a change of the
//! equations of motion, from the root of the repository.

use saltus::model::{Inertia, Setup};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for (name, inertia) in [
        ("condensed_4_1", Inertia::Condensed),
        ("slow_manifold_4_1", Inertia::SlowManifold),
    ] {
        let setup = Setup {
            inertia,
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
