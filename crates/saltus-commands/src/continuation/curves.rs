//! Curves of special points over two parameters.

use super::question::Question;
use crate::kinds;
use saltus::orbits::{BranchWithOrigin, Curve, CurvePoint, ParametricMap, Special, follow_curve};

/// A curve that was asked for, or the reason why there is none.
pub(super) struct Followed {
    /// Label of the special point, or the word that means none.
    pub(super) label: String,
    /// The special point.
    pub(super) special: Option<Special>,
    /// The curve, or why there is none.
    pub(super) outcome: Result<Curve, String>,
}

impl Followed {
    /// The points of the curve; none if there is no curve.
    pub(super) fn points(&self) -> &[CurvePoint] {
        self.outcome.as_ref().map_or(&[], |curve| &curve.points)
    }

    /// Kind of the special point, in short; empty if there is none.
    pub(super) fn kind(&self) -> &str {
        self.special
            .as_ref()
            .map_or("", |special| special.kind.short())
    }
}

/// Follows the curves asked for, each until `go_on` says no.
pub(super) fn follow(
    family: &impl ParametricMap,
    question: &Question,
    limbs: &[BranchWithOrigin],
    go_on: &mut dyn FnMut() -> bool,
) -> Vec<Followed> {
    let (Some(across), Some((table, _))) = (question.across(), &question.second) else {
        return Vec::new();
    };
    let (words, along) = (&table.curves, question.along());
    let specials = || limbs.iter().flat_map(|limb| &limb.branch.specials);
    let meant =
        |word: &String, special: &Special| kinds::means(word, &special.label, &special.kind);
    let chosen = specials().filter(|special| match words.as_slice() {
        [] => kinds::has_curve(&special.kind),
        words => words.iter().any(|word| meant(word, special)),
    });
    let options = question.options().continuation;
    let curve = |special: &Special| Followed {
        label: special.label.clone(),
        special: Some(special.clone()),
        outcome: follow_curve(family, special, [&along, &across], &options, &mut |_| {
            go_on()
        })
        .map_err(|error| error.to_string()),
    };
    let mut curves: Vec<Followed> = chosen.map(curve).collect();
    let nothing = words
        .iter()
        .filter(|word| !specials().any(|s| meant(word, s)));
    curves.extend(nothing.map(|word| Followed {
        label: word.clone(),
        special: None,
        outcome: Err("no such special point was found on the branches".to_owned()),
    }));
    curves
}
