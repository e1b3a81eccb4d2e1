//! `[[jumper]]`, `[contact]` and `[start]`: the people, their feet, and how they begin.

use crate::range::finite;
use garde::Validate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A person with one vertical degree of freedom at a point of the plate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields)]
pub struct JumperTable {
    /// Position x_I along the plate's length (m), such as 7.0; inside the plate.
    #[garde(range(min = 0.0, max = 1e4), custom(finite))]
    #[schemars(extend("x-symbol" = "x_I", "x-unit" = "m", "x-label" = "position"))]
    pub x: f64,
    /// Position y_I along the plate's width (m), such as 5.0; inside the plate.
    #[garde(range(min = 0.0, max = 1e4), custom(finite))]
    #[schemars(extend("x-symbol" = "y_I", "x-unit" = "m", "x-label" = "position"))]
    pub y: f64,
    /// Body mass m_h (kg), such as 76.64.
    #[garde(range(min = 1e-6, max = 1e7), custom(finite))]
    #[schemars(extend("x-symbol" = "m_h", "x-unit" = "kg", "x-label" = "body mass"))]
    pub mass: f64,
    /// Leg stiffness k_h (N/m), such as 18600.0.
    #[garde(range(min = 1e-6, max = 1e12), custom(finite))]
    #[schemars(extend("x-symbol" = "k_h", "x-unit" = "N/m", "x-label" = "leg stiffness"))]
    pub stiffness: f64,
    /// Leg damping ratio ζ_h (-), such as 0.3; the damper is c_h = 2 ζ_h √(k_h m_h).
    #[garde(range(min = 0.0, max = 10.0), custom(finite))]
    #[schemars(extend("x-symbol" = "ζ_h", "x-unit" = "-", "x-label" = "damping ratio"))]
    pub damping_ratio: f64,
}

impl JumperTable {
    /// Most people, as the physics has it.
    pub(crate) const MOST: usize = 400;

    pub(super) fn paper() -> Self {
        Self {
            x: 7.0,
            y: 5.0,
            mass: 76.64,
            stiffness: 18_600.0,
            damping_ratio: 0.3,
        }
    }
}

/// When feet leave the floor and come back.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields, default)]
pub struct ContactTable {
    /// Contact law (a word): "reaction-force" (the paper), "gap" or "relaxing-leg".
    #[garde(skip)]
    pub law: Law,
}

/// The law that decides between contact and flight.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Law {
    /// Contact while the force of the leg is positive, both ways (the paper).
    #[default]
    ReactionForce,
    /// In flight the leg has its natural length; touch-down when the gap closes.
    Gap,
    /// In flight the compression of a massless leg relaxes; needs a damping ratio above 0.
    RelaxingLeg,
}

/// The initial condition of every jumper, at a time when cos(Ω t) = 1; the plate is at rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields, default)]
pub struct StartTable {
    /// Initial height z/η (-), upwards from the floor at rest, such as 3.0; η = g/ω_h² (m).
    #[garde(range(min = -1e6, max = 1e6), custom(finite))]
    #[schemars(extend("x-symbol" = "z(0)/η", "x-unit" = "-", "x-label" = "initial height"))]
    pub z: f64,
    /// Initial velocity z'/(η ω_h) (-), upwards, such as 2.0.
    #[garde(range(min = -1e6, max = 1e6), custom(finite))]
    #[schemars(extend("x-symbol" = "z'(0)/(η ω_h)", "x-unit" = "-", "x-label" = "initial velocity"))]
    pub v: f64,
}

impl Default for StartTable {
    /// In the air and rising: a jumper at rest may stay there for many periods before it first lifts off.
    fn default() -> Self {
        Self { z: 3.0, v: 2.0 }
    }
}
