//! Plate, people, contact, base: plain records in SI units and the formulas that belong to them.
//!
//! Nothing here is integrated in time. `DP` is Dias & Del Prado, *Human-Structure Interaction
//! during jumping on Rectangular Plates*.

mod algebra;
mod backbone;
mod base;
mod contact;
mod elasticity;
mod error;
mod jumper;
mod linear;
mod modes;
mod plate;
mod shape;
mod statics;
mod tensors;
mod trig;

pub use backbone::OneMode;
pub use base::{Base, BaseFrequency, FrequencyReference};
pub use contact::ContactLaw;
pub use elasticity::{CouplingTerm, Elasticity, QuarticTerm};
pub use error::PhysicsError;
pub use jumper::Jumper;
pub use linear::OccupiedModes;
pub use modes::{InPlaneBasis, Mode, ModeSet};
pub use plate::Plate;
pub use statics::Load;
