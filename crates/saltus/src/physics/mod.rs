//! Plate, people, contact, base: plain records in SI units and the formulas that belong to them.
//!
//! Nothing here is integrated in time. `DP` is Dias & Del Prado, *Human-Structure Interaction
//! during jumping on Rectangular Plates*.

mod algebra;
mod backbone;
mod base;
mod condensed;
mod contact;
mod elasticity;
mod error;
mod factor;
mod harmonics;
mod in_plane;
mod jumper;
mod linear;
mod lists;
mod modes;
mod plate;
#[cfg(test)]
mod reference;
mod shape;
mod statics;
mod trig;

pub use backbone::OneMode;
pub use base::{Base, BaseFrequency, FrequencyReference};
pub use contact::ContactLaw;
pub use elasticity::Elasticity;
pub use error::PhysicsError;
pub use harmonics::{Entry, Harmonics, Work};
pub use jumper::Jumper;
pub use linear::OccupiedModes;
pub use lists::{CouplingTerm, QuarticTerm};
pub use modes::{InPlaneBasis, Mode, ModeSet};
pub use plate::Plate;
pub use statics::Load;
