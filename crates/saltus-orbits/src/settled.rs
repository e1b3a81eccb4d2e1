//! The orbit that a motion has come to.

use crate::linear::{minus, size};
use crate::{
    MAX_PERIOD, MapPoint, MapRequest, NewtonOptions, Orbit, ParametricMap, Stability, find_orbit,
};

/// A motion that comes back nearer than this, relative to the largest state or 1, has come to a cycle or is on its last
/// way to one: the multipliers alone decide how it gets there.
const NEAR: f64 = 1e-5;

/// The orbit of up to [`MAX_PERIOD`] iterates that the motion is on at `place`, if it is on one that is not unstable.
///
/// Ask when deviations have been seen to die out: on a chaotic attractor it takes all these iterates to find none.
pub fn settled<F: ParametricMap + ?Sized>(
    family: &F,
    parameters: &[f64],
    place: &MapPoint,
) -> Option<Orbit> {
    let mut places = vec![place.clone()];
    for _ in 0..MAX_PERIOD {
        let shot = MapRequest {
            parameters,
            start: places.last()?,
            derivative: false,
        };
        let next = family.images(&[shot]).pop()?.ok()?.place;
        let scale = size(&next.x).max(1.0);
        if next.modes == place.modes && size(&minus(&next.x, &place.x)) <= NEAR * scale {
            let orbit = find_orbit(family, parameters, &places, &NewtonOptions::default()).ok()?;
            let off = size(&minus(&orbit.places[0].x, &place.x));
            let here = off <= 100.0 * NEAR * scale && orbit.stability() != Stability::Unstable;
            return here.then_some(orbit);
        }
        places.push(next);
    }
    None
}
