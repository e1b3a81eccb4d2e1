//! Kinds of special points in words and symbols.

use saltus::orbits::SpecialKind;
use saltus_results::Bifurcation;

/// The name in a sentence.
pub(crate) fn name(kind: &SpecialKind) -> &'static str {
    match kind {
        SpecialKind::Fold => "fold",
        SpecialKind::BranchPoint => "branch point",
        SpecialKind::Halving => "period halving",
        SpecialKind::PeriodDoubling => "period doubling",
        SpecialKind::NeimarkSacker { .. } => "Neimark-Sacker",
        SpecialKind::Grazing { .. } => "grazing",
        _ => "order of switches",
    }
}

/// The symbol in figures; a halving is a doubling seen from the other branch.
pub(crate) fn symbol(kind: &SpecialKind) -> Bifurcation {
    match kind {
        SpecialKind::Fold => Bifurcation::Fold,
        SpecialKind::BranchPoint => Bifurcation::BranchPoint,
        SpecialKind::Halving | SpecialKind::PeriodDoubling => Bifurcation::PeriodDoubling,
        SpecialKind::NeimarkSacker { .. } => Bifurcation::NeimarkSacker,
        SpecialKind::Grazing { .. } => Bifurcation::Grazing,
        _ => Bifurcation::SwitchOrder,
    }
}

/// Whether a curve over two parameters goes through such a point.
pub(crate) fn has_curve(kind: &SpecialKind) -> bool {
    matches!(kind.short(), "LP" | "PD" | "NS" | "GR")
}

/// Angle of the multiplier on the unit circle (rad), where one turns round it.
pub(crate) fn angle(kind: &SpecialKind) -> Option<f64> {
    match kind {
        SpecialKind::NeimarkSacker { angle } => Some(*angle),
        _ => None,
    }
}

/// Whether a word of `continue.second.curves` means a point: its label, or its kind.
pub(crate) fn means(word: &str, label: &str, kind: &SpecialKind) -> bool {
    let same = |other: &str| word.eq_ignore_ascii_case(other);
    same(label) || same(kind.short()) || same(name(kind))
}
