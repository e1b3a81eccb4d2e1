//! `[sweep]`: one parameter, its values, and how the state goes from one to the next.

use super::AxisTable;
use super::axis::either_way;
use crate::range::{finite, finite_if_given};
use garde::Validate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What `saltus sweep` runs. Give from, to and count for equal distances, or the values themselves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = either_way()))]
pub struct SweepTable {
    /// The key that changes (a word), such as "jumper.damping_ratio" for every jumper,
    /// "jumper.0.mass" for one, or "base.frequency_ratio".
    #[garde(skip)]
    pub parameter: String,
    /// First value (in the unit of the parameter), such as 0.1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[garde(range(min = -1e13, max = 1e13), custom(finite_if_given))]
    #[schemars(with = "f64", range(min = -1e13, max = 1e13))]
    pub from: Option<f64>,
    /// Last value (in the unit of the parameter), such as 0.5.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[garde(range(min = -1e13, max = 1e13), custom(finite_if_given))]
    #[schemars(with = "f64", range(min = -1e13, max = 1e13))]
    pub to: Option<f64>,
    /// Number of values, both ends included (-, a whole number), such as 401.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[garde(range(min = 2, max = 10_000_000))]
    #[schemars(with = "u32", range(min = 2, max = 10_000_000))]
    pub count: Option<u32>,
    /// The values one by one (in the unit of the parameter), ascending or descending, such as [0.1, 0.15, 0.3];
    /// instead of `from`, `to` and `count`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    // a longer list would not fit in a study file
    #[garde(length(min = 2, max = 100_000), inner(inner(range(min = -1e13, max = 1e13), custom(finite))))]
    #[schemars(with = "Vec<f64>", length(min = 2, max = 100_000), inner(range(min = -1e13, max = 1e13)))]
    pub values: Option<Vec<f64>>,
    /// How the state is carried on (a word): "up", "down", "both" or "restarts".
    #[serde(default)]
    #[garde(skip)]
    pub direction: Direction,
    /// Forcing periods left out at each value (-, a whole number), such as 300.
    #[serde(default = "default_transient")]
    #[garde(range(min = 0, max = 10_000_000))]
    pub transient: u32,
    /// Forcing periods recorded at each value (-, a whole number), such as 100.
    #[serde(default = "default_record")]
    #[garde(range(min = 1, max = 10_000_000))]
    pub record: u32,
    /// How many of the largest Lyapunov exponents to follow at each value, once the motion has its label (-, a whole
    /// number), such as 2; 0: only where the label of the motion needs one.
    #[serde(default)]
    #[garde(range(min = 0, max = 100_000))]
    pub exponents: u32,
    /// Forcing periods over which they are followed (-, a whole number), such as 400.
    #[serde(default = "default_exponent_periods")]
    #[garde(range(min = 1, max = 10_000_000))]
    pub exponent_periods: u32,
    /// Initial conditions [z/η, z'/(η ω_h)] of every jumper for "restarts" (-), such as [[3.0, 2.0], [-1.0, 0.0]].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[garde(skip)]
    pub starts: Vec<[f64; 2]>,
}

fn default_transient() -> u32 {
    300
}

fn default_record() -> u32 {
    100
}

/// In chaos the largest exponent is then known to some 0.03, as a standard error.
fn default_exponent_periods() -> u32 {
    400
}

impl SweepTable {
    /// DP Fig. 2b.
    pub(super) fn paper() -> Self {
        Self {
            parameter: "jumper.damping_ratio".to_owned(),
            from: Some(0.1),
            to: Some(0.5),
            count: Some(81),
            values: None,
            direction: Direction::Both,
            transient: default_transient(),
            record: default_record(),
            exponents: 0,
            exponent_periods: default_exponent_periods(),
            starts: vec![[3.0, 2.0], [-1.0, 0.0], [5.0, -2.0]],
        }
    }

    /// The parameter and its values.
    pub fn axis(&self) -> AxisTable {
        AxisTable {
            parameter: self.parameter.clone(),
            from: self.from,
            to: self.to,
            count: self.count,
            values: self.values.clone(),
        }
    }

    /// The values in the order of the file, as [`AxisTable::values`].
    pub fn values(&self) -> Vec<f64> {
        self.axis().values()
    }
}

/// How the state goes from one value to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Direction {
    /// From `from` to `to`, the last state of each value starting the next.
    #[default]
    Up,
    /// From `to` to `from`, the last state of each value starting the next.
    Down,
    /// One sweep each way.
    Both,
    /// Every value anew from each of `starts`.
    Restarts,
}
