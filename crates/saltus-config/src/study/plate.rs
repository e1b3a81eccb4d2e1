//! `[plate]`: geometry, material, terms of the displacement fields.

use super::Modes;
use crate::range::{finite, poisson};
use garde::Validate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A simply supported rectangular plate whose edges are held in their plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields)]
pub struct PlateTable {
    /// Length a along x (m), such as 14.0.
    #[garde(range(min = 1e-3, max = 1e4), custom(finite))]
    #[schemars(extend("x-symbol" = "a", "x-unit" = "m", "x-label" = "plate length"))]
    pub length: f64,
    /// Width b along y (m), such as 10.0.
    #[garde(range(min = 1e-3, max = 1e4), custom(finite))]
    #[schemars(extend("x-symbol" = "b", "x-unit" = "m", "x-label" = "plate width"))]
    pub width: f64,
    /// Thickness h (m), such as 0.10.
    #[garde(range(min = 1e-6, max = 1e2), custom(finite))]
    #[schemars(extend("x-symbol" = "h", "x-unit" = "m", "x-label" = "plate thickness"))]
    pub thickness: f64,
    /// Young's modulus E (Pa), such as 27e9.
    #[garde(range(min = 1.0, max = 1e13), custom(finite))]
    #[schemars(extend("x-symbol" = "E", "x-unit" = "Pa", "x-label" = "Young's modulus"))]
    pub youngs_modulus: f64,
    /// Mass density ρ (kg/m³), such as 2500.0.
    #[garde(range(min = 1e-3, max = 1e6), custom(finite))]
    #[schemars(extend("x-symbol" = "ρ", "x-unit" = "kg/m³", "x-label" = "plate density"))]
    pub density: f64,
    /// Poisson's ratio ν (-), such as 0.2.
    #[garde(custom(poisson))]
    #[schemars(extend("x-symbol" = "ν", "x-unit" = "-", "x-label" = "Poisson's ratio"))]
    #[schemars(extend("exclusiveMinimum" = -1.0, "exclusiveMaximum" = 0.5))]
    pub poisson_ratio: f64,
    /// Damping ratio ζ_p of the first mode (-), such as 0.02; damping is mass-proportional, c = 2 ζ_p ω₁₁.
    #[garde(range(min = 0.0, max = 10.0), custom(finite))]
    #[schemars(extend("x-symbol" = "ζ_p", "x-unit" = "-", "x-label" = "plate damping ratio"))]
    pub damping_ratio: f64,
    /// Terms of the displacement fields (half-wave numbers, -): "paper" (the 16 terms of Dias & Del Prado),
    /// a complete set such as "3x3", or lists such as { u = [[2, 1]], v = [[1, 2]], w = [[1, 1]] }.
    #[garde(skip)]
    pub modes: Modes,
    /// Shape of the in-plane terms (a word): "fixed" or "shear-free".
    #[serde(default)]
    #[garde(skip)]
    pub basis: Basis,
    /// Whether in-plane motion keeps its inertia (a word): "full", "slow-manifold" or "condensed".
    #[serde(default)]
    #[garde(skip)]
    pub inertia: Inertia,
}

impl PlateTable {
    pub(super) fn paper() -> Self {
        Self {
            length: 14.0,
            width: 10.0,
            thickness: 0.10,
            youngs_modulus: 27e9,
            density: 2500.0,
            poisson_ratio: 0.2,
            damping_ratio: 0.02,
            modes: Modes::Paper,
            basis: Basis::Fixed,
            inertia: Inertia::SlowManifold,
        }
    }
}

/// Shape of the in-plane terms.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Basis {
    /// u and v both sin-sin: every in-plane displacement vanishes on every edge (the paper).
    #[default]
    Fixed,
    /// u sin-cos, v cos-sin: normal displacement and shear vanish on the edges (Levy; Chu & Herrmann).
    ShearFree,
}

/// What becomes of the in-plane degrees of freedom.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Inertia {
    /// They move with their own inertia (the paper); slower to integrate.
    #[default]
    Full,
    /// They follow the transverse motion as fast oscillators do, with two terms of their inertia: in the paper's
    /// case within 2e-9 h of "full" after 20 periods and some 25 times faster; at most 9 w terms.
    SlowManifold,
    /// They follow the transverse motion statically, so that only transverse amplitudes and people remain: in the
    /// paper's case within 7e-4 h of "full" after 20 periods and some 100 times faster.
    Condensed,
}
