//! Special points of a branch.

use crate::orbit::Orbit;

/// Kind of a special point.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum SpecialKind {
    /// The branch turns back in the parameter: a multiplier is +1.
    Fold,
    /// Another branch of the same period crosses: a multiplier is +1.
    BranchPoint,
    /// The branch meets that of half its period, at a period doubling of the latter, and ends there.
    Halving,
    /// A branch of twice the period begins: a multiplier is -1.
    PeriodDoubling,
    /// A pair of complex multipliers passes the unit circle, and an invariant curve begins.
    NeimarkSacker {
        /// Angle of the multiplier in the upper half plane (rad).
        angle: f64,
    },
    /// Switches appear or vanish: a guard touches zero. Multipliers may jump there.
    Grazing {
        /// The unit that switches.
        unit: usize,
    },
    /// The same switches in another order: two units switch at once.
    Reordering,
}

impl SpecialKind {
    /// The usual short name, such as `PD`.
    pub fn short(&self) -> &'static str {
        match self {
            Self::Fold => "LP",
            Self::BranchPoint => "BP",
            Self::Halving => "HP",
            Self::PeriodDoubling => "PD",
            Self::NeimarkSacker { .. } => "NS",
            Self::Grazing { .. } => "GR",
            Self::Reordering => "SO",
        }
    }
}

/// The remark on a grazing where [`Special::outside`] changes.
pub(crate) const JUMP: &str = "stability changes here without a multiplier on the unit circle";

/// A special point of a branch.
#[derive(Clone, Debug, PartialEq)]
pub struct Special {
    /// Short name and number, such as `PD1`; the numbers follow the order in which points were found.
    pub label: String,
    /// Its kind.
    pub kind: SpecialKind,
    /// Value of the parameter.
    pub parameter: f64,
    /// The orbit there, or next to it if there is none: the last one before a grazing.
    pub orbit: Orbit,
    /// The point of the branch before it, or the one behind it if there is none before.
    pub near: usize,
    /// Number of multipliers outside the unit circle before and after.
    pub outside: [usize; 2],
    /// A remark, in words.
    pub remark: Option<String>,
    /// Unit tangent of the branch there: first place, then the parameter.
    pub(crate) tangent: Vec<f64>,
}
