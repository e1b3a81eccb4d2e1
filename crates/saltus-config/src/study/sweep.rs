//! `[sweep]`: one parameter, its values, and how the state goes from one to the next.

use crate::validate::finite;
use garde::Validate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What `saltus sweep` runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields)]
pub struct SweepTable {
    /// The key that changes (a word), such as "jumper.damping_ratio" for every jumper,
    /// "jumper.0.mass" for one, or "base.frequency_ratio".
    #[garde(skip)]
    pub parameter: String,
    /// First value (in the unit of the parameter), such as 0.1.
    #[garde(range(min = -1e13, max = 1e13), custom(finite))]
    pub from: f64,
    /// Last value (in the unit of the parameter), such as 0.5.
    #[garde(range(min = -1e13, max = 1e13), custom(finite))]
    pub to: f64,
    /// Number of values, both ends included (-, a whole number), such as 401.
    #[garde(range(min = 2, max = 10_000_000))]
    pub count: u32,
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
    /// First states [z/η, z'/(η ω_h)] of every jumper for "restarts" (-), such as [[3.0, 2.0], [-1.0, 0.0]].
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
            from: 0.1,
            to: 0.5,
            count: 81,
            direction: Direction::Both,
            transient: default_transient(),
            record: default_record(),
            exponents: 0,
            exponent_periods: default_exponent_periods(),
            starts: vec![[3.0, 2.0], [-1.0, 0.0], [5.0, -2.0]],
        }
    }

    /// The values in ascending order of index, `from` first and `to` last, both exact.
    pub fn values(&self) -> Vec<f64> {
        linear(self.from, self.to, self.count)
    }
}

/// Equally spaced values, both ends exact.
pub(super) fn linear(from: f64, to: f64, count: u32) -> Vec<f64> {
    let last = count.saturating_sub(1);
    let at = |i: u32| match i {
        0 => from,
        i if i == last => to,
        i => from + (to - from) * f64::from(i) / f64::from(last),
    };
    (0..count).map(at).collect()
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
