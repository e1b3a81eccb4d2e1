//! Changes between two points of a branch that tell of a special point in between.

use crate::continuation::Point;
use crate::events;
use crate::orbit::{Multiplier, Orbit};
use crate::special::SpecialKind;

/// Possible changes between two points of a branch, the more telling first: at a grazing multipliers may
/// jump, and a branch that meets another one from the side turns too.
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

/// Changes between two points; pairs of multipliers are looked at if `pairs`.
pub(crate) fn changes(a: &Point, b: &Point, pairs: bool) -> Vec<Test> {
    let flips = |a: &Point| real(&a.orbit).filter(|mu| *mu < -1.0).count();
    let events = !events::same(&a.orbit.switches(), &b.orbit.switches());
    let mut all = Vec::new();
    let mut put = |test, there| {
        if there {
            all.push(test);
        }
    };
    put(Test::Events, events);
    put(
        Test::BranchPoint,
        (a.branch_test < 0.0) != (b.branch_test < 0.0),
    );
    put(Test::PeriodDoubling, flips(a) % 2 != flips(b) % 2);
    put(
        Test::Fold,
        (a.parameter_rate() < 0.0) != (b.parameter_rate() < 0.0),
    );
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
            Self::BranchPoint => Some(point.branch_test),
            Self::PeriodDoubling => flip(&point.orbit),
            Self::Fold => Some(point.parameter_rate()),
            Self::NeimarkSacker => Some(critical_pair(&point.orbit)?.modulus() - 1.0),
        }
    }

    /// Kind of the special point between two points that are next to each other, the first of which is at hand.
    pub(crate) fn kind(self, a: &Orbit, b: &Orbit) -> Option<SpecialKind> {
        Some(match self {
            Self::BranchPoint => SpecialKind::BranchPoint,
            Self::PeriodDoubling => SpecialKind::PeriodDoubling,
            Self::Fold => SpecialKind::Fold,
            Self::NeimarkSacker => SpecialKind::NeimarkSacker {
                angle: critical_pair(a)?.argument(),
            },
            Self::Events => {
                let units = events::units_apart(&a.switches(), &b.switches());
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
