//! A branch with those that grow from it: period-doubling cascades and crossing branches.

use crate::continuation::{
    Branch, ContinuationError, ContinuationOptions, End, ParameterRange, Point,
};
use crate::follow::Labels;
use crate::linear::{dot, minus, size};
use crate::path::Path;
use crate::{Orbit, ParametricMap, Special, SpecialKind};

/// Distances of special points at the same place, as parts of the range and of the state: several times the accuracy
/// of their location, and far below the distance of different ones.
const SAME_PARAMETER: f64 = 1e-7;
const SAME_STATE: f64 = 1e-4;

/// Two tangents at a special point with a larger cosine are those of one branch: they are known to far less.
const SAME_WAY: f64 = 1.0 - 1e-6;

/// Points with unstable orbits that end a branch which is followed for its stable part.
const BEYOND: usize = 1;

/// Settings for a tree of branches.
#[derive(Clone, Debug, PartialEq)]
pub struct BranchesOptions {
    /// Settings for each branch.
    pub continuation: ContinuationOptions,
    /// Doublings of the period in a row at most; with 6 the ratio of their distances is Feigenbaum's to 1e-3.
    pub doublings: usize,
    /// Doublings in a row whose branches are followed to their ends. Those of later ones begin at doublings of
    /// stable orbits only and end soon after their stable part, since they grow ever longer.
    pub entire: usize,
    /// Longest period of a branch that begins at a period doubling.
    pub longest: usize,
    /// A doubling nearer than this to the one before, in the parameter, is the last of its cascade.
    pub closest: f64,
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
            entire: usize::MAX,
            longest: usize::MAX,
            closest: 0.0,
            crossings: true,
            branches: 24,
        }
    }
}

/// One of several branches that grow from each other.
#[derive(Clone, Debug, PartialEq)]
pub struct BranchWithOrigin {
    /// Label of the special point where it begins; `None` for the first branch.
    pub origin: Option<String>,
    /// Doublings of the period since the first branch, or since that of half its period.
    pub doublings: usize,
    /// The branch.
    pub branch: Branch,
}

/// Follows a branch from `start` both ways, then the branches of twice the period from its period doublings, those
/// that cross it and that of half its period where it ends, and so on. No branch is followed twice. Labels are
/// unique among all branches.
///
/// A doubled branch is followed one way: the other way the same orbits come half a period later.
/// `keep_going` sees each point; `false` ends the work.
///
/// # Errors
/// As [`crate::follow`].
pub fn branches<F: ParametricMap + ?Sized>(
    family: &F,
    start: &Orbit,
    along: &ParameterRange,
    options: &BranchesOptions,
    keep_going: &mut dyn FnMut(&Point) -> bool,
) -> Result<Vec<BranchWithOrigin>, ContinuationError> {
    let brief = ContinuationOptions {
        unstable: options.continuation.unstable.min(BEYOND),
        ..options.continuation.clone()
    };
    let mut tree = Tree {
        path: Path::new(family, start, along, &options.continuation)?,
        brief: Path::new(family, start, along, &brief)?,
        options,
        labels: Labels::default(),
        limbs: Vec::new(),
        visited: Vec::new(),
    };
    let path = &tree.path;
    let first = path.walk_both(path.seed(start, true)?, None, keep_going);
    tree.add(None, 0, first);
    let mut mother = 0;
    while let Some(limb) = tree.limbs.get(mother) {
        for special in limb.branch.specials.clone() {
            let ends = tree.limbs.iter().flat_map(|limb| &limb.branch.ends);
            let stopped = ends.into_iter().any(|end| *end == End::Interrupted);
            if stopped || tree.limbs.len() >= options.branches {
                return Ok(tree.limbs);
            }
            if !tree.is_followed(&special) {
                tree.follow(mother, special, keep_going);
            }
        }
        mother += 1;
    }
    Ok(tree.limbs)
}

/// Branches that grow from each other, under way.
struct Tree<'a, F: ?Sized> {
    path: Path<'a, F>,
    /// The same path for branches that end soon after their stable part.
    brief: Path<'a, F>,
    options: &'a BranchesOptions,
    labels: Labels,
    limbs: Vec<BranchWithOrigin>,
    /// Special points from which a branch was begun, or could not be.
    visited: Vec<Special>,
}

impl<F: ParametricMap + ?Sized> Tree<'_, F> {
    fn add(&mut self, origin: Option<String>, doublings: usize, mut branch: Branch) {
        self.labels.name(&mut branch);
        self.limbs.push(BranchWithOrigin {
            origin,
            doublings,
            branch,
        });
    }

    fn specials(&self) -> impl Iterator<Item = &Special> {
        self.limbs.iter().flat_map(|limb| &limb.branch.specials)
    }

    /// Whether the other branch through a special point is known.
    fn is_followed(&self, special: &Special) -> bool {
        let seen = |known: &Special| self.path.same(known, special);
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
        let mut followed = self.specials().filter(|s| s.kind == twin || crosses(s));
        self.visited.iter().any(seen) || followed.any(seen)
    }

    /// Whether a doubling of limb `mother` is to be followed.
    fn doubles(&self, mother: &BranchWithOrigin, special: &Special) -> bool {
        let before = mother.origin.as_ref();
        let before = before.and_then(|label| self.specials().find(|s| s.label == *label));
        let far = |s: &Special| (s.parameter - special.parameter).abs() >= self.options.closest;
        let begins_stable = special.outside.contains(&0);
        mother.doublings < self.options.doublings
            && 2 * special.orbit.period() <= self.options.longest
            && (mother.doublings < self.options.entire || begins_stable)
            && before.is_none_or(far)
    }

    /// Follows the other branch through a special point of limb `mother`.
    fn follow(
        &mut self,
        mother: usize,
        special: Special,
        keep_going: &mut dyn FnMut(&Point) -> bool,
    ) {
        let limb = &self.limbs[mother];
        let depth = limb.doublings;
        let crossings = self.options.crossings;
        let (branch, doublings) = match special.kind {
            SpecialKind::PeriodDoubling if self.doubles(limb, &special) => {
                let path = match depth < self.options.entire {
                    true => &self.path,
                    false => &self.brief,
                };
                let birth = path.doubled(&special);
                let branch = birth.map(|seed| path.walk(seed, Some(&special), keep_going));
                (branch, depth + 1)
            }
            SpecialKind::BranchPoint if crossings => {
                let birth = self.path.crossed(&special);
                let walk = |seed| self.path.walk_both(seed, Some(&special), keep_going);
                (birth.map(walk), depth)
            }
            SpecialKind::Halving if crossings => {
                let mother = self.path.half(&special);
                let branch = mother.map(|seed| self.path.walk_both(seed, None, keep_going));
                (branch, depth.saturating_sub(1))
            }
            _ => return,
        };
        let origin = Some(special.label.clone());
        self.visited.push(special);
        if let Some(branch) = branch {
            self.add(origin, doublings, branch);
        }
    }
}

impl<F: ParametricMap + ?Sized> Path<'_, F> {
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
