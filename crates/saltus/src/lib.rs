//! People who jump on a vibrating von Karman plate: physics, equations of motion, long-term motion.
//!
//! Three layers, each knowing only those above it in this list:
//! - [`physics`] holds SI records and formulas, and integrates nothing;
//! - [`model`] makes them nondimensional equations of motion for the engine, [`hybrid`];
//! - [`study`] asks them questions: trajectories, sweeps, attractors, orbits, exponents.
//!
//! ```
//! use saltus::model::Setup;
//! use saltus::study::{Control, simulate};
//!
//! // Fig. 3e of the paper: zeta_h = 0.28 at Omega = 1.0 omega_h, 400 forcing periods.
//! let model = Setup::dias_del_prado(0.28, 1.0).model()?;
//! let start = model.start(3.0, 2.0);
//! let run = simulate(&model, &start, 400, 0, 1, &Control::default())?;
//! // The motion repeats after every second forcing period.
//! let z: Vec<f64> = run.section.iter().map(|s| s.z[0]).collect();
//! assert!((z[399] - z[397]).abs() < 1e-6 && (z[399] - z[398]).abs() > 0.1);
//! # Ok::<(), saltus::study::StudyError>(())
//! ```

#[cfg(test)]
#[path = "../tests/main/quadrature.rs"]
mod quadrature;

pub mod model;
pub mod physics;
pub mod study;

/// The engine, re-exported.
pub use saltus_hybrid as hybrid;

/// Orbits and exponents of any map, re-exported.
pub use saltus_orbits as orbits;
