//! `[orbit]` and `[lyapunov]`: one periodic orbit, and how fast neighbours part.

use garde::Validate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What `saltus orbit` seeks: a periodic orbit, by Newton's method from the motion that the initial condition leads to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields, default)]
pub struct OrbitTable {
    /// Forcing periods after which the orbit closes (-, a whole number), such as 2; 0: those of the
    /// long-term motion.
    #[garde(range(min = 0, max = 64))]
    pub period: u32,
    /// Forcing periods run before Newton's method begins (-, a whole number), such as 200; 0: it begins at
    /// the initial condition.
    #[garde(range(min = 0, max = 10_000_000))]
    pub transient: u32,
    /// Pieces whose ends Newton's method joins (-, a whole number), at most one per period; 0: one per period.
    #[garde(range(min = 0, max = 64))]
    pub segments: u32,
}

impl Default for OrbitTable {
    /// Whatever the motion settles to: 200 periods bring Newton's method near enough, not to rest.
    fn default() -> Self {
        Self {
            period: 0,
            transient: 200,
            segments: 0,
        }
    }
}

/// What `saltus lyapunov` runs: the exponents of the motion that the initial condition leads to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields, default)]
pub struct LyapunovTable {
    /// How many exponents, the largest first (-, a whole number), such as 2; 0: all, one per state.
    #[garde(range(min = 0, max = 100_000))]
    pub exponents: u32,
    /// Forcing periods left out before each replica is measured (-, a whole number), such as 400.
    #[garde(range(min = 0, max = 10_000_000))]
    pub transient: u32,
    /// Forcing periods measured in each replica (-, a whole number), such as 2000.
    #[garde(range(min = 1, max = 10_000_000))]
    pub periods: u32,
    /// Independent pieces of the same attractor that are run side by side (-, a whole number), such as 8; their
    /// scatter says how sure the exponents are.
    #[garde(range(min = 1, max = 10_000))]
    pub replicas: u32,
}

impl Default for LyapunovTable {
    /// All exponents; eight replicas fill the lanes of one thread.
    fn default() -> Self {
        Self {
            exponents: 0,
            transient: 400,
            periods: 2000,
            replicas: 8,
        }
    }
}
