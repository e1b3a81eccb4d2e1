//! `[map.x]` and its like: a key of the study and the values it takes.

use crate::range::{finite, finite_if_given};
use garde::Validate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// One axis of a plane: a key of the study and its values. Give from, to and count for equal distances, or the
/// values themselves.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = either_way()))]
pub struct AxisTable {
    /// The key that changes (a word), such as "jumper.damping_ratio" or "base.frequency_ratio"; for
    /// the table basins "start.z" or "start.v".
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
    /// Number of values, both ends included (-, a whole number), such as 64.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[garde(range(min = 2, max = 10_000))]
    #[schemars(with = "u32", range(min = 2, max = 10_000))]
    pub count: Option<u32>,
    /// The values one by one (in the unit of the parameter), ascending or descending, such as [0.1, 0.15, 0.3];
    /// instead of `from`, `to` and `count`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[garde(length(min = 2, max = 10_000), inner(inner(range(min = -1e13, max = 1e13), custom(finite))))]
    #[schemars(with = "Vec<f64>", length(min = 2, max = 10_000), inner(range(min = -1e13, max = 1e13)))]
    pub values: Option<Vec<f64>>,
}

/// Schema of a table that must give its values in one of two ways.
pub(super) fn either_way() -> Value {
    json!([{ "required": ["from", "to", "count"] }, { "required": ["values"] }])
}

impl AxisTable {
    /// `count` values from `from` to `to`.
    pub fn even(parameter: impl Into<String>, from: f64, to: f64, count: u32) -> Self {
        Self {
            parameter: parameter.into(),
            from: Some(from),
            to: Some(to),
            count: Some(count),
            values: None,
        }
    }

    /// The values in the order of the file, both ends exact; none if the table does not say which they are,
    /// as a checked one does.
    pub fn values(&self) -> Vec<f64> {
        match (&self.values, self.from, self.to, self.count) {
            (Some(values), ..) => values.clone(),
            (None, Some(from), Some(to), Some(count)) => even(from, to, count),
            _ => Vec::new(),
        }
    }

    /// The first value (in the unit of the parameter); NaN if there is none.
    pub fn from(&self) -> f64 {
        let first = self.values.as_ref().and_then(|v| v.first().copied());
        first.or(self.from).unwrap_or(f64::NAN)
    }

    /// The last value (in the unit of the parameter); NaN if there is none.
    pub fn to(&self) -> f64 {
        let last = self.values.as_ref().and_then(|v| v.last().copied());
        last.or(self.to).unwrap_or(f64::NAN)
    }

    /// Number of values.
    pub fn count(&self) -> usize {
        let listed = self.values.as_ref().map(Vec::len);
        listed.unwrap_or(self.count.unwrap_or(0) as usize)
    }
}

/// Equally spaced values, both ends exact.
fn even(from: f64, to: f64, count: u32) -> Vec<f64> {
    let last = count.saturating_sub(1);
    let at = |i: u32| match i {
        0 => from,
        i if i == last => to,
        i => from + (to - from) * f64::from(i) / f64::from(last),
    };
    (0..count).map(at).collect()
}
