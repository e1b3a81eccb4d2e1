//! `[map]` and `[basins]`: planes of pixels, and how long to look for the attractor of each.

use crate::validate::finite;
use garde::Validate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One axis of a plane: a key of the study and its values, equally spaced.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields)]
pub struct AxisTable {
    /// The key that changes (a word), such as "jumper.damping_ratio" or "base.frequency_ratio"; for
    /// the table basins "start.z" or "start.v".
    #[garde(skip)]
    pub parameter: String,
    /// First value (in the unit of the parameter), such as 0.1.
    #[garde(range(min = -1e13, max = 1e13), custom(finite))]
    pub from: f64,
    /// Last value (in the unit of the parameter), such as 0.5.
    #[garde(range(min = -1e13, max = 1e13), custom(finite))]
    pub to: f64,
    /// Number of values, both ends included (-, a whole number), such as 64.
    #[garde(range(min = 2, max = 10_000))]
    pub count: u32,
}

impl AxisTable {
    fn new(parameter: &str, from: f64, to: f64, count: u32) -> Self {
        Self {
            parameter: parameter.to_owned(),
            from,
            to,
            count,
        }
    }

    /// The values in the order of the pixels, `from` first and `to` last, both exact.
    pub fn values(&self) -> Vec<f64> {
        super::sweep::linear(self.from, self.to, self.count)
    }
}

/// What `saltus map` runs: the attractor reached from the first state at each pixel of a plane of two parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields)]
pub struct MapTable {
    /// Forcing periods left out at each pixel, at most (-, a whole number), such as 400; fewer are run once
    /// the motion has surely settled.
    #[serde(default = "default_transient")]
    #[garde(range(min = 0, max = 10_000_000))]
    pub transient: u32,
    /// Forcing periods recorded where the motion has not surely settled before (-, a whole number), such as 64.
    #[serde(default = "default_record")]
    #[garde(range(min = 1, max = 100_000))]
    pub record: u32,
    /// Forcing periods, at most, over which the largest Lyapunov exponent is followed where the motion has no
    /// period (-, a whole number), such as 2000; 0: it is not asked whether that is chaos or a torus.
    #[serde(default = "default_exponent")]
    #[garde(range(min = 0, max = 10_000_000))]
    pub exponent: u32,
    /// The parameter along x, left to right.
    #[garde(dive)]
    pub x: AxisTable,
    /// The parameter along y, bottom to top.
    #[garde(dive)]
    pub y: AxisTable,
}

/// What `saltus basins` runs: the attractor reached from each pixel of a plane of first states.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields)]
pub struct BasinsTable {
    /// Forcing periods left out at each pixel, at most (-, a whole number), such as 400; fewer are run once
    /// the motion has surely settled.
    #[serde(default = "default_transient")]
    #[garde(range(min = 0, max = 10_000_000))]
    pub transient: u32,
    /// Forcing periods recorded where the motion has not surely settled before (-, a whole number), such as 64.
    #[serde(default = "default_record")]
    #[garde(range(min = 1, max = 100_000))]
    pub record: u32,
    /// Forcing periods, at most, over which the largest Lyapunov exponent is followed where the motion has no
    /// period (-, a whole number), such as 2000; 0: it is not asked whether that is chaos or a torus.
    #[serde(default = "default_exponent")]
    #[garde(range(min = 0, max = 10_000_000))]
    pub exponent: u32,
    /// The part of the first state along x, left to right: "start.z" or "start.v".
    #[garde(dive)]
    pub x: AxisTable,
    /// The part of the first state along y, bottom to top: the other one.
    #[garde(dive)]
    pub y: AxisTable,
}

fn default_transient() -> u32 {
    400
}

fn default_record() -> u32 {
    64
}

fn default_exponent() -> u32 {
    2000
}

impl MapTable {
    /// The plane that DP Fig. 2 cuts at three frequencies.
    pub(super) fn paper() -> Self {
        Self {
            transient: default_transient(),
            record: default_record(),
            exponent: default_exponent(),
            x: AxisTable::new("jumper.damping_ratio", 0.1, 0.5, 64),
            y: AxisTable::new("base.frequency_ratio", 0.85, 1.15, 64),
        }
    }
}

impl BasinsTable {
    /// Jumpers who start anywhere from the floor to a good height.
    pub(super) fn paper() -> Self {
        Self {
            transient: default_transient(),
            record: default_record(),
            exponent: default_exponent(),
            x: AxisTable::new("start.z", -2.0, 6.0, 64),
            y: AxisTable::new("start.v", -4.0, 4.0, 64),
        }
    }
}
