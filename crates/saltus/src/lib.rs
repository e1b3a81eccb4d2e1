//! People who jump on a vibrating von Karman plate: physics, equations of motion, long-term motion.
//!
//! Three layers, each knowing only those above it in this list:
//! - [`physics`] holds SI records and formulas, and integrates nothing;
//! - [`model`] makes them nondimensional equations of motion for the engine, [`hybrid`];
//! - [`study`] asks them questions: trajectories, sweeps, the paper.

pub mod model;
pub mod physics;
pub mod study;

/// The engine, re-exported.
pub use saltus_hybrid as hybrid;
