//! From a special point to the other branches that meet there.

use crate::continuation::Point;
use crate::linear::{self, dot, plus, scaled, unit};
use crate::path::Path;
use crate::shooting::Guess;
use crate::{Family, Orbit, Special};

impl<F: Family + ?Sized> Path<'_, F> {
    /// Where the branch of twice the period begins: the orbit taken twice, with the tangent (v, -v) in its two
    /// halves, where v is the eigenvector of the multiplier -1.
    pub(crate) fn doubled(&self, special: &Special) -> Option<Point> {
        let mut tangent = linear::eigenvector(&special.orbit.monodromy, -1.0)?;
        tangent.push(0.0);
        let mut guess = special.orbit.guess();
        guess.places.extend_from_within(..);
        self.birth(&guess, |_| Some(tangent))
    }

    /// Where the other branch through a branch point begins: of the plane of directions in which the equations
    /// hold to first order, that one normal to the branch at hand. The other branch has a part of it, and the
    /// corrector finds the rest.
    pub(crate) fn crossed(&self, special: &Special) -> Option<Point> {
        self.birth(&special.orbit.guess(), |equations| {
            let plane = linear::null_space(equations, 2)?;
            let [a, b] = [&plane[0], &plane[1]].map(|v| dot(v, &special.tangent));
            Some(unit(&plus(&scaled(&plane[0], b), -a, &plane[1])))
        })
    }

    /// The first point of a branch, at an orbit that is known to be one.
    fn birth(
        &self,
        guess: &Guess,
        tangent: impl FnOnce(&crate::Matrix) -> Option<Vec<f64>>,
    ) -> Option<Point> {
        let pass = self.shooting().pass(guess).ok()?;
        let orbit = Orbit::of(&pass).ok()?;
        let tangent = tangent(&pass.equations()?)?;
        Some(Point {
            parameter: orbit.parameters[self.free[0].index],
            stable: orbit.stable(),
            outside: orbit.outside(),
            spread: pass.spread(&tangent)?,
            side: 0.0,
            tangent,
            orbit,
        })
    }
}
