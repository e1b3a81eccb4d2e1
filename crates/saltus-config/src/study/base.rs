//! `[base]` and `[gravity]`: what shakes the plate and what pulls the people down.

use crate::range::{finite, finite_if_given};
use garde::Validate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Harmonic vertical motion of the plate's edges, A_b cos(Ω t). Give frequency_ratio or frequency, not both.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields)]
pub struct BaseTable {
    /// Amplitude A_b (m), such as 0.013.
    #[garde(range(min = 0.0, max = 1e3), custom(finite))]
    #[schemars(extend("x-symbol" = "A_b", "x-unit" = "m", "x-label" = "base amplitude"))]
    pub amplitude: f64,
    /// Ω as a multiple of the frequency named by `reference` (-), such as 1.0; or give `frequency` instead.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[garde(range(min = 1e-6, max = 1e4), custom(finite_if_given))]
    #[schemars(with = "f64", range(min = 1e-6, max = 1e4))]
    #[schemars(extend("x-symbol" = "Ω/ω", "x-unit" = "-", "x-label" = "frequency ratio"))]
    pub frequency_ratio: Option<f64>,
    /// Frequency Ω/2π (Hz), such as 2.5; instead of `frequency_ratio`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[garde(range(min = 1e-6, max = 1e6), custom(finite_if_given))]
    #[schemars(with = "f64", range(min = 1e-6, max = 1e6))]
    #[schemars(extend("x-symbol" = "Ω/2π", "x-unit" = "Hz", "x-label" = "base frequency"))]
    pub frequency: Option<f64>,
    /// The frequency that `frequency_ratio` multiplies (a word): "occupied", "free" or "plate".
    #[serde(default)]
    #[garde(skip)]
    pub reference: Reference,
}

impl BaseTable {
    pub(super) fn paper() -> Self {
        Self {
            amplitude: 0.013,
            frequency_ratio: Some(1.0),
            frequency: None,
            reference: Reference::Occupied,
        }
    }
}

/// The frequency meant by "Ω = 0.9, 1.0, 1.1 ω_h", of which the paper does not say which it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Reference {
    /// The body's frequency on the flexible plate: agrees best with the paper.
    #[default]
    Occupied,
    /// The body's frequency on rigid ground.
    Free,
    /// The first frequency of the empty plate.
    Plate,
}

/// Gravity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields, default)]
pub struct GravityTable {
    /// Acceleration of gravity g (m/s²), such as 9.81.
    #[garde(range(min = 1e-6, max = 1e4), custom(finite))]
    #[schemars(extend("x-symbol" = "g", "x-unit" = "m/s²", "x-label" = "gravity"))]
    pub acceleration: f64,
}

impl Default for GravityTable {
    /// The paper's value.
    fn default() -> Self {
        Self { acceleration: 9.81 }
    }
}
