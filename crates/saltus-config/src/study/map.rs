//! `[map]` and `[basins]`: planes of pixels, and how long to look for the attractor of each.

use super::AxisTable;
use garde::Validate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What `saltus map` runs: the attractor reached from the initial condition at each pixel of a plane of two parameters.
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
    /// period (-, a whole number), such as 2000; chaos is then run on for a quarter of that, to see whether it lasts. 0: it
    /// is not asked whether that is chaos or a torus.
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

/// What `saltus basins` runs: the attractor reached from each pixel of a plane of initial conditions.
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
    /// period (-, a whole number), such as 2000; chaos is then run on for a quarter of that, to see whether it lasts. 0: it
    /// is not asked whether that is chaos or a torus.
    #[serde(default = "default_exponent")]
    #[garde(range(min = 0, max = 10_000_000))]
    pub exponent: u32,
    /// The part of the initial condition along x, left to right: "start.z" or "start.v".
    #[garde(dive)]
    pub x: AxisTable,
    /// The part of the initial condition along y, bottom to top: the other one.
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
            x: AxisTable::even("jumper.damping_ratio", 0.1, 0.5, 64),
            y: AxisTable::even("base.frequency_ratio", 0.85, 1.15, 64),
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
            x: AxisTable::even("start.z", -2.0, 6.0, 64),
            y: AxisTable::even("start.v", -4.0, 4.0, 64),
        }
    }
}
