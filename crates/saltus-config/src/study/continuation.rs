//! `[continue]`: branches of periodic orbits over a parameter, and curves of their special points over two.

use crate::range::finite;
use garde::Validate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What `saltus continue` runs: the branch of periodic orbits through the first one, from end to end of a range.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields)]
pub struct ContinueTable {
    /// The key that changes (a word), such as "jumper.damping_ratio" or "base.frequency_ratio". The first orbit
    /// is sought at the study's own value of it, which lies between `from` and `to`.
    #[garde(skip)]
    pub parameter: String,
    /// One end of the range (in the unit of the parameter), such as 0.1.
    #[garde(range(min = -1e13, max = 1e13), custom(finite))]
    pub from: f64,
    /// The other end of the range (in the unit of the parameter), such as 0.5.
    #[garde(range(min = -1e13, max = 1e13), custom(finite))]
    pub to: f64,
    /// Forcing periods after which the first orbit closes (-, a whole number), such as 2; 0: those of the
    /// long-term motion.
    #[serde(default)]
    #[garde(range(min = 0, max = 64))]
    pub period: u32,
    /// Forcing periods run before the first orbit is sought (-, a whole number), such as 200; 0: the search
    /// begins at the initial condition.
    #[serde(default = "default_transient")]
    #[garde(range(min = 0, max = 10_000_000))]
    pub transient: u32,
    /// Largest step along a branch, as a part of the range (-), such as 0.02.
    #[serde(default = "default_step")]
    #[garde(range(min = 1e-6, max = 1.0), custom(finite))]
    pub step: f64,
    /// Points at which a branch is given up (-, a whole number), such as 2000.
    #[serde(default = "default_points")]
    #[garde(range(min = 2, max = 1_000_000))]
    pub points: u32,
    /// Period doublings that are followed, each from the branch before, to the doubled orbits (-, a whole
    /// number), such as 4; 0: none.
    #[serde(default = "default_doublings")]
    #[garde(range(min = 0, max = 16))]
    pub doublings: u32,
    /// Values of the parameter at which the long-term motion is run, as a cloud behind the branches of the
    /// figure (-, a whole number), such as 200; 0: none.
    #[serde(default = "default_cloud")]
    #[garde(range(min = 0, max = 100_000))]
    pub cloud: u32,
    /// A second parameter: special points of the branches become curves over both.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "SecondTable")]
    #[garde(dive)]
    pub second: Option<SecondTable>,
}

/// The second parameter of curves of special points, such as period doublings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields)]
pub struct SecondTable {
    /// The other key that changes (a word), such as "base.frequency_ratio". Curves begin at the study's own
    /// value of it, which lies between `from` and `to`.
    #[garde(skip)]
    pub parameter: String,
    /// One end of its range (in the unit of the parameter), such as 0.85.
    #[garde(range(min = -1e13, max = 1e13), custom(finite))]
    pub from: f64,
    /// The other end of its range (in the unit of the parameter), such as 1.15.
    #[garde(range(min = -1e13, max = 1e13), custom(finite))]
    pub to: f64,
    /// The special points to follow (words): labels such as ["PD1"], kinds such as ["PD"], or [] for every one
    /// found.
    #[serde(default)]
    #[garde(skip)]
    pub curves: Vec<String>,
}

fn default_transient() -> u32 {
    200
}

fn default_step() -> f64 {
    0.02
}

fn default_points() -> u32 {
    2000
}

fn default_doublings() -> u32 {
    4
}

fn default_cloud() -> u32 {
    200
}

impl ContinueTable {
    /// The branches behind DP Fig. 2b, and their special points over the plane of [`MapTable`](super::MapTable).
    pub(super) fn paper() -> Self {
        Self {
            parameter: "jumper.damping_ratio".to_owned(),
            from: 0.1,
            to: 0.5,
            period: 0,
            transient: default_transient(),
            step: default_step(),
            points: default_points(),
            doublings: 2,
            cloud: default_cloud(),
            second: Some(SecondTable {
                parameter: "base.frequency_ratio".to_owned(),
                from: 0.85,
                to: 1.15,
                // each takes some ten seconds
                curves: ["LP1", "PD1"].map(str::to_owned).to_vec(),
            }),
        }
    }
}
