//! `[solver]` and `[simulate]`: how the motion is integrated, and for how long.

use crate::range::finite;
use garde::Validate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the motion is integrated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields, default)]
pub struct SolverTable {
    /// Method (a word): "taylor" or "rk4".
    #[garde(skip)]
    pub method: Method,
    /// Error allowed per step by "taylor", in plate thicknesses (-), such as 1e-10; relative to the largest
    /// state once that exceeds one.
    #[garde(range(min = 1e-15, max = 1e-3), custom(finite))]
    #[schemars(extend("x-symbol" = "tol", "x-unit" = "-", "x-label" = "tolerance"))]
    pub tolerance: f64,
    /// Steps per forcing period of "rk4" (-, a whole number), such as 2000.
    #[garde(range(min = 4, max = 10_000_000))]
    pub steps_per_period: u32,
    /// Take-offs and touch-downs allowed per forcing period and jumper (-, a whole number), such as 100;
    /// more is reported as chattering.
    #[garde(range(min = 1, max = 1_000_000))]
    pub max_switches: u32,
}

impl Default for SolverTable {
    /// A tolerance well below what a figure shows; steps above what the paper's highest in-plane mode
    /// (1344 Hz) needs for stability, about 1200 per period.
    fn default() -> Self {
        Self {
            method: Method::Taylor,
            tolerance: 1e-10,
            steps_per_period: 2000,
            max_switches: 100,
        }
    }
}

/// Integration method.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Taylor series of high order with steps chosen from `tolerance`.
    #[default]
    Taylor,
    /// The classical fourth-order Runge-Kutta method with fixed steps (the paper).
    Rk4,
}

/// What `saltus simulate` runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields, default)]
pub struct SimulateTable {
    /// Forcing periods integrated (-, a whole number), such as 100.
    #[garde(range(min = 1, max = 10_000_000))]
    pub periods: u32,
    /// Of these, first periods left out of figures (-, a whole number), such as 0.
    #[garde(range(min = 0, max = 10_000_000))]
    pub transient: u32,
    /// Last periods that the time history covers (-, a whole number), such as 20; at most those that are not left out.
    #[garde(range(min = 1, max = 100_000))]
    pub history: u32,
    /// Points of the time history in each period, at equal times (-, a whole number), such as 400.
    #[garde(range(min = 1, max = 1_000_000))]
    pub samples_per_period: u32,
    /// Times of the time history since the start (s), ascending, such as [0.0, 0.05, 0.1]; instead of `history` and
    /// `samples_per_period`.
    #[serde(skip_serializing_if = "Option::is_none")]
    // a longer list would not fit in a study file
    #[garde(
        length(min = 1, max = 100_000),
        inner(inner(range(min = 0.0, max = 1e13), custom(finite)))
    )]
    #[schemars(
        with = "Vec<f64>",
        length(min = 1, max = 100_000),
        inner(range(min = 0.0, max = 1e13))
    )]
    pub times: Option<Vec<f64>>,
}

impl Default for SimulateTable {
    /// All of a run that is long enough to settle, and of its history what a figure can show.
    fn default() -> Self {
        Self {
            periods: 100,
            transient: 0,
            history: 20,
            samples_per_period: 400,
            times: None,
        }
    }
}
