//! Branches from an orbit, one way or both.

use crate::continuation::{
    Branch, ContinuationError, ContinuationOptions, End, ParameterRange, Point,
};
use crate::path::Path;
use crate::{Orbit, ParametricMap, Special};

/// Follows a branch from `start`, at first towards growing parameter or falling.
///
/// `keep_going` sees each point; `false` ends the branch. The end before the first point is
/// [`End::Start`].
///
/// # Errors
/// If the question makes no sense or `start` is no orbit. An end of the branch is an answer.
pub fn follow<F: ParametricMap + ?Sized>(
    family: &F,
    start: &Orbit,
    along: &ParameterRange,
    growing: bool,
    options: &ContinuationOptions,
    keep_going: &mut dyn FnMut(&Point) -> bool,
) -> Result<Branch, ContinuationError> {
    let path = Path::new(family, start, along, options)?;
    let mut branch = path.walk(path.seed(start, growing)?, None, keep_going);
    Labels::default().name(&mut branch);
    Ok(branch)
}

/// Follows a branch from `start` both ways. Its points are in the order of a walk through `start` towards
/// growing parameter.
///
/// # Errors
/// As [`follow`].
pub fn follow_both<F: ParametricMap + ?Sized>(
    family: &F,
    start: &Orbit,
    along: &ParameterRange,
    options: &ContinuationOptions,
    keep_going: &mut dyn FnMut(&Point) -> bool,
) -> Result<Branch, ContinuationError> {
    let path = Path::new(family, start, along, options)?;
    let mut branch = path.walk_both(path.seed(start, true)?, None, keep_going);
    Labels::default().name(&mut branch);
    Ok(branch)
}

/// Numbers each kind of special point on its own.
#[derive(Default)]
pub(crate) struct Labels(Vec<&'static str>);

impl Labels {
    /// Labels in the order of the branch.
    pub(crate) fn name(&mut self, branch: &mut Branch) {
        for special in &mut branch.specials {
            let short = special.kind.short();
            self.0.push(short);
            let number = self.0.iter().filter(|known| **known == short).count();
            special.label = format!("{short}{number}");
        }
    }
}

impl Branch {
    /// This branch, walked away from its start, continued before its start by another walk.
    fn after(self, back: Branch) -> Self {
        let shift = back.points.len() - 1;
        let turned = |mut special: Special| {
            // the point before it is now the one after it
            special.near = (shift - special.near).saturating_sub(1);
            special.outside.reverse();
            special.tangent.iter_mut().for_each(|t| *t = -*t);
            special
        };
        let mut points: Vec<Point> = back.points.into_iter().map(Point::reversed).collect();
        points.reverse();
        points.extend(self.points.into_iter().skip(1));
        let mut specials: Vec<Special> = back.specials.into_iter().map(turned).collect();
        specials.reverse();
        specials.extend(self.specials.into_iter().map(|mut special| {
            special.near += shift;
            special
        }));
        let [_, first] = back.ends;
        let [_, last] = self.ends;
        Self {
            points,
            specials,
            ends: [first, last],
        }
    }
}

impl<F: ParametricMap + ?Sized> Path<'_, F> {
    /// Walks both ways from a point, unless the first way closes or is stopped. `origin` as in [`Self::walk`].
    pub(crate) fn walk_both(
        &self,
        seed: Point,
        origin: Option<&Special>,
        keep_going: &mut dyn FnMut(&Point) -> bool,
    ) -> Branch {
        let forth = self.walk(seed.clone(), origin, keep_going);
        if matches!(forth.ends[1], End::Closed | End::Interrupted) {
            return forth;
        }
        let mut first = true;
        let back = self.walk(seed.reversed(), origin, &mut |point| {
            std::mem::take(&mut first) || keep_going(point)
        });
        forth.after(back)
    }
}
