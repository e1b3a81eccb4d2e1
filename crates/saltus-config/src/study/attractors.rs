//! `[attractors]`: all long-term motions that many initial conditions lead to.

use super::AxisTable;
use crate::range::{finite, finite_if_given};
use garde::Validate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What `saltus attractors` runs: the attractors reached from quasi-random initial conditions, at the study's own
/// parameters or at each value of one: give parameter with from, to and count, or with values, or none of them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields, default)]
pub struct AttractorsTable {
    /// Lowest and highest initial height z/η of every jumper (-), such as [-2.0, 6.0].
    #[garde(inner(range(min = -1e6, max = 1e6), custom(finite)))]
    pub z: [f64; 2],
    /// Lowest and highest initial velocity z'/(η ω_h) of every jumper (-), such as [-4.0, 4.0].
    #[garde(inner(range(min = -1e6, max = 1e6), custom(finite)))]
    pub v: [f64; 2],
    /// Largest first amplitude |w_j|/h of each transverse term of the plate (-), such as 0.1; 0: it starts at
    /// rest.
    #[garde(range(min = 0.0, max = 1e3), custom(finite))]
    pub plate: f64,
    /// Number of initial conditions (-, a whole number), such as 128.
    #[garde(range(min = 1, max = 10_000_000))]
    pub starts: u32,
    /// Forcing periods left out from each initial condition, at most (-, a whole number), such as 400; fewer are run
    /// once the motion has surely settled.
    #[garde(range(min = 0, max = 10_000_000))]
    pub transient: u32,
    /// Forcing periods recorded where the motion has not surely settled before (-, a whole number), such as 64.
    #[garde(range(min = 1, max = 100_000))]
    pub record: u32,
    /// The key that changes (a word), such as "jumper.damping_ratio" or "base.frequency_ratio".
    #[serde(skip_serializing_if = "Option::is_none")]
    #[garde(skip)]
    #[schemars(with = "String")]
    pub parameter: Option<String>,
    /// First value (in the unit of the parameter), such as 0.1.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[garde(range(min = -1e13, max = 1e13), custom(finite_if_given))]
    #[schemars(with = "f64", range(min = -1e13, max = 1e13))]
    pub from: Option<f64>,
    /// Last value (in the unit of the parameter), such as 0.5.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[garde(range(min = -1e13, max = 1e13), custom(finite_if_given))]
    #[schemars(with = "f64", range(min = -1e13, max = 1e13))]
    pub to: Option<f64>,
    /// Number of values, both ends included (-, a whole number), such as 41.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[garde(range(min = 2, max = 10_000))]
    #[schemars(with = "u32", range(min = 2, max = 10_000))]
    pub count: Option<u32>,
    /// The values one by one (in the unit of the parameter), ascending or descending, such as [0.1, 0.15, 0.3];
    /// instead of `from`, `to` and `count`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[garde(length(min = 2, max = 10_000), inner(inner(range(min = -1e13, max = 1e13), custom(finite))))]
    #[schemars(with = "Vec<f64>", length(min = 2, max = 10_000), inner(range(min = -1e13, max = 1e13)))]
    pub values: Option<Vec<f64>>,
}

impl Default for AttractorsTable {
    /// Jumpers who start anywhere from the floor to a good height, on a plate at rest.
    fn default() -> Self {
        Self {
            z: [-2.0, 6.0],
            v: [-4.0, 4.0],
            plate: 0.0,
            starts: 128,
            transient: 400,
            record: 64,
            parameter: None,
            from: None,
            to: None,
            count: None,
            values: None,
        }
    }
}

impl AttractorsTable {
    /// Over the damping ratios of DP Fig. 2.
    pub(super) fn paper() -> Self {
        Self {
            parameter: Some("jumper.damping_ratio".to_owned()),
            from: Some(0.1),
            to: Some(0.5),
            count: Some(41),
            ..Self::default()
        }
    }

    /// The parameter and its values, if one is swept.
    pub fn sweep(&self) -> Option<AxisTable> {
        self.parameter.is_some().then(|| self.axis())
    }

    /// The keys of a sweep, given or not.
    pub(crate) fn axis(&self) -> AxisTable {
        AxisTable {
            parameter: self.parameter.clone().unwrap_or_default(),
            from: self.from,
            to: self.to,
            count: self.count,
            values: self.values.clone(),
        }
    }
}
