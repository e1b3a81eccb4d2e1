//! A branch with those that grow from it: period-doubling cascades and crossing branches.

use crate::continuation::{Along, Branch, ContinuationError, ContinuationOptions, End, Point};
use crate::follow::Labels;
use crate::linear::{dot, minus, size};
use crate::path::Path;
use crate::{Family, Orbit, Special, SpecialKind};

/// Two special points at the same place, as parts of the range and of the state: several times what they are
/// located to, and far less than what lies between different ones.
const SAME_PARAMETER: f64 = 1e-7;
const SAME_STATE: f64 = 1e-4;

/// Two tangents at a special point with a larger cosine are those of one branch: they are known to far less.
const SAME_WAY: f64 = 1.0 - 1e-6;

/// Which branches are followed, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct BranchesOptions {
    /// How each branch is followed.
    pub continuation: ContinuationOptions,
    /// Doublings of the period in a row at most; with 6 the ratio of their distances is Feigenbaum's to 1e-3.
    pub doublings: usize,
    /// Whether branches that cross at branch points, and those of half the period where one ends, are followed too.
    pub crossings: bool,
    /// Branches at most.
    pub branches: usize,
}

impl Default for BranchesOptions {
    fn default() -> Self {
        Self {
            continuation: ContinuationOptions::default(),
            doublings: 6,
            crossings: true,
            branches: 24,
        }
    }
}

/// One of several branches that grow from each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Limb {
    /// Label of the special point where it begins; `None` for the first branch.
    pub origin: Option<String>,
    /// Doublings of the period since the first branch, or since that of half its period.
    pub doublings: usize,
    /// The branch.
    pub branch: Branch,
}

/// Follows a branch from `start` both ways, then the branches of twice the period from its period doublings
/// those that cross it and that of half its period where it ends, and so on. No branch is followed twice. Labels are unique among all branches.
///
/// A doubled branch is followed one way: the other way the same orbits come half a period later.
/// `keep_going` sees each point; `false` ends the work.
///
/// # Errors
/// As [`crate::follow`].
pub fn branches<F: Family + ?Sized>(
    family: &F,
    start: &Orbit,
    along: &Along,
    options: &BranchesOptions,
    keep_going: &mut dyn FnMut(&Point) -> bool,
) -> Result<Vec<Limb>, ContinuationError> {
    let path = Path::new(family, start, along, &options.continuation)?;
    let mut labels = Labels::default();
    let mut first = path.walk_both(path.seed(start, true)?, None, keep_going);
    labels.name(&mut first);
    let mut limbs = vec![Limb {
        origin: None,
        doublings: 0,
        branch: first,
    }];
    let mut visited: Vec<Special> = Vec::new();
    let mut mother = 0;
    while let Some(limb) = limbs.get(mother) {
        let depth = limb.doublings;
        for special in limb.branch.specials.clone() {
            let stopped = limbs
                .iter()
                .any(|l| l.branch.ends.contains(&End::Interrupted));
            if stopped || limbs.len() >= options.branches {
                return Ok(limbs);
            }
            let seen = |known: &Special| path.same(known, &special);
            // A halving and the period doubling that it is on the other branch: one of them will do.
            let twin = match special.kind {
                SpecialKind::Halving => SpecialKind::PeriodDoubling,
                _ => SpecialKind::Halving,
            };
            // A branch that crosses here may have been followed from elsewhere.
            let crosses = |s: &&Special| {
                let kinds = [&s.kind, &special.kind];
                kinds.iter().all(|kind| **kind == SpecialKind::BranchPoint)
                    && dot(&s.tangent, &special.tangent).abs() < SAME_WAY
            };
            let all = limbs.iter().flat_map(|limb| &limb.branch.specials);
            let mut followed = all.filter(|s| s.kind == twin || crosses(s));
            if visited.iter().any(seen) || followed.any(seen) {
                continue;
            }
            let (branch, doublings) = match special.kind {
                SpecialKind::PeriodDoubling if depth < options.doublings => {
                    let birth = path.doubled(&special);
                    (
                        birth.map(|seed| path.walk(seed, Some(&special), keep_going)),
                        depth + 1,
                    )
                }
                SpecialKind::BranchPoint if options.crossings => {
                    let birth = path.crossed(&special);
                    (
                        birth.map(|seed| path.walk_both(seed, Some(&special), keep_going)),
                        depth,
                    )
                }
                SpecialKind::Halving if options.crossings => {
                    let mother = path.half(&special);
                    (
                        mother.map(|seed| path.walk_both(seed, None, keep_going)),
                        depth.saturating_sub(1),
                    )
                }
                _ => continue,
            };
            let origin = Some(special.label.clone());
            visited.push(special);
            if let Some(mut branch) = branch {
                labels.name(&mut branch);
                limbs.push(Limb {
                    origin,
                    doublings,
                    branch,
                });
            }
        }
        mother += 1;
    }
    Ok(limbs)
}

impl<F: Family + ?Sized> Path<'_, F> {
    /// Whether two special points are one, seen from two branches or at two phases of the orbit.
    pub(crate) fn same(&self, a: &Special, b: &Special) -> bool {
        let range = self.range[1] - self.range[0];
        let here = &a.orbit.places[0].x;
        let scale = size(here).max(1.0);
        let mut places = b.orbit.places.iter();
        (a.parameter - b.parameter).abs() <= SAME_PARAMETER * range
            && places.any(|place| size(&minus(&place.x, here)) <= SAME_STATE * scale)
    }
}
