//! Special points of a branch, and what tells that there is one between two of its points.

use crate::continuation::Point;
use crate::{Multiplier, Orbit, events};

/// What happens at a special point.
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
    /// What it is.
    pub kind: SpecialKind,
    /// Value of the parameter.
    pub parameter: f64,
    /// The orbit there, or next to it where there is none: the last one before a grazing.
    pub orbit: Orbit,
    /// The point of the branch before it, or the one behind it where there is none before.
    pub near: usize,
    /// Number of multipliers outside the unit circle before and after.
    pub outside: [usize; 2],
    /// What else is to be said, in words.
    pub remark: Option<String>,
    /// Unit tangent of the branch there: first place, then the parameter.
    pub(crate) tangent: Vec<f64>,
}

/// What may differ between two points of a branch, the more telling first: at a grazing multipliers may
/// jump, and where a branch meets another one from the side it turns too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Test {
    Events,
    BranchPoint,
    PeriodDoubling,
    Fold,
    NeimarkSacker,
}

/// Pairs this near to the unit circle may be on it: many times the rounding of multipliers. Without damping all
/// pairs are, and none of them passes it.
const ON_CIRCLE: f64 = 1e-8;

/// Whether a pair of multipliers passes the unit circle between two points beyond doubt: more of them lie clearly
/// outside at one than lie not clearly inside at the other.
pub(crate) fn pair_passes(a: &Point, b: &Point) -> bool {
    let beyond = |point: &Point, radius: f64| {
        let all = point.orbit.multipliers.iter();
        all.filter(|mu| mu.modulus() > radius).count()
    };
    let gains = |a, b| beyond(b, 1.0 + ON_CIRCLE) >= beyond(a, 1.0 - ON_CIRCLE) + 2;
    gains(a, b) || gains(b, a)
}

/// What changes between two points; pairs of multipliers are looked at if `pairs`.
pub(crate) fn changes(a: &Point, b: &Point, pairs: bool) -> Vec<Test> {
    let flips = |a: &Point| real(&a.orbit).filter(|mu| *mu < -1.0).count();
    let events = !events::same(&events::sequence(&a.orbit), &events::sequence(&b.orbit));
    let mut all = Vec::new();
    let mut put = |test, there| {
        if there {
            all.push(test);
        }
    };
    put(Test::Events, events);
    put(Test::BranchPoint, (a.side < 0.0) != (b.side < 0.0));
    put(Test::PeriodDoubling, flips(a) % 2 != flips(b) % 2);
    put(Test::Fold, (a.pace() < 0.0) != (b.pace() < 0.0));
    // The others take one multiplier each through the circle.
    if pairs && a.outside.abs_diff(b.outside) >= 2 + all.len() {
        all.push(Test::NeimarkSacker);
    }
    all
}

impl Test {
    /// A number that passes zero, smoothly, where this happens.
    pub(crate) fn value(self, point: &Point) -> Option<f64> {
        match self {
            Self::Events => None,
            Self::BranchPoint => Some(point.side),
            Self::PeriodDoubling => flip(&point.orbit),
            Self::Fold => Some(point.pace()),
            Self::NeimarkSacker => Some(critical_pair(&point.orbit)?.modulus() - 1.0),
        }
    }

    /// What was found between two points that are next to each other, the first of which is at hand.
    pub(crate) fn kind(self, a: &Orbit, b: &Orbit) -> Option<SpecialKind> {
        Some(match self {
            Self::BranchPoint => SpecialKind::BranchPoint,
            Self::PeriodDoubling => SpecialKind::PeriodDoubling,
            Self::Fold => SpecialKind::Fold,
            Self::NeimarkSacker => SpecialKind::NeimarkSacker {
                angle: critical_pair(a)?.argument(),
            },
            Self::Events => {
                let units = events::units_apart(&events::sequence(a), &events::sequence(b));
                match units.first() {
                    Some(&unit) => SpecialKind::Grazing { unit },
                    None => SpecialKind::Reordering,
                }
            }
        })
    }
}

/// The real multiplier nearest to -1, plus 1.
pub(crate) fn flip(orbit: &Orbit) -> Option<f64> {
    let above = real(orbit).map(|mu| mu + 1.0);
    above.min_by(|a, b| a.abs().total_cmp(&b.abs()))
}

fn real(orbit: &Orbit) -> impl Iterator<Item = f64> {
    let real = orbit.multipliers.iter().filter(|mu| mu.im == 0.0);
    real.map(|mu| mu.re)
}

/// The multiplier of the upper half plane that is nearest to the unit circle.
pub(crate) fn critical_pair(orbit: &Orbit) -> Option<Multiplier> {
    let off = |mu: &Multiplier| (mu.modulus() - 1.0).abs();
    let upper = orbit.multipliers.iter().filter(|mu| mu.im > 0.0).copied();
    upper.min_by(|a, b| off(a).total_cmp(&off(b)))
}
