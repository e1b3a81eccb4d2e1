//! The surface that orbits form over two parameters, and a function on it that is zero on a curve.

use crate::continuation::ContinuationOptions;
use crate::differences::Free;
use crate::linear::{self, dot, norm, plus, scaled};
use crate::shooting::{Change, Pass, Shooting};
use crate::{Multiplier, NotFound, Orbit, ParametricMap, SpecialKind, events};

/// Grazing is approached to this value of the guard, since there is no value beyond zero.
const TOUCHING: f64 = 1e-9;

/// Offset of the differences for the gradient: residuals of 1e-11 leave errors of 1e-6.
const DIFFERENCE: f64 = 1e-5;

pub(crate) struct Surface<'a, F: ?Sized> {
    pub(crate) family: &'a F,
    pub(crate) free: [Free; 2],
    pub(crate) ranges: [[f64; 2]; 2],
    pub(crate) options: &'a ContinuationOptions,
    pub(crate) kind: SpecialKind,
}

/// A point of the surface with its psi, if it has one.
#[derive(Clone)]
pub(crate) struct Spot {
    pub(crate) pass: Pass,
    pub(crate) orbit: Orbit,
    pub(crate) pair: Option<Multiplier>,
    pub(crate) psi: Option<f64>,
}

/// A point of the curve with its frame: direction of the curve and normal, in which psi grows.
#[derive(Clone)]
pub(crate) struct Station {
    pub(crate) spot: Spot,
    pub(crate) frame: [Vec<f64>; 2],
    pub(crate) slope: f64,
}

impl Station {
    pub(crate) fn turned(mut self) -> Self {
        self.frame[0] = scaled(&self.frame[0], -1.0);
        self
    }
}

impl<F: ParametricMap + ?Sized> Surface<'_, F> {
    pub(crate) fn coordinates(&self, orbit: &Orbit) -> Vec<f64> {
        let mut u = orbit.places[0].x.clone();
        let free = self.free.iter();
        u.extend(free.map(|free| orbit.parameters[free.index] / free.unit));
        u
    }

    pub(crate) fn shooting(&self) -> Shooting<'_, F> {
        Shooting {
            family: self.family,
            free: &self.free,
            newton: &self.options.newton,
            keep_switches: false,
            kept: &[],
        }
    }

    /// psi, and the pair of multipliers it belongs to: the one nearest to `before`.
    pub(crate) fn spot(&self, pass: Pass, before: Option<Multiplier>) -> Result<Spot, NotFound> {
        let orbit = Orbit::of(&pass, self.options.newton.tolerance)?;
        let off = |mu: &Multiplier| before.map_or(0.0, |b| (mu.re - b.re).hypot(mu.im - b.im));
        let upper = orbit.multipliers.iter().filter(|mu| mu.im > 0.0).copied();
        let pair = upper.min_by(|a, b| off(a).total_cmp(&off(b)));
        let determinant = |mu| linear::shifted(&orbit.monodromy, mu).determinant();
        let psi = match self.kind {
            SpecialKind::Fold => Some(determinant(1.0)),
            SpecialKind::PeriodDoubling => Some(determinant(-1.0)),
            SpecialKind::NeimarkSacker { .. } => pair.map(|mu| mu.modulus() - 1.0),
            SpecialKind::Grazing { unit } => {
                let touch = orbit.nearest_touch(|_, touch| touch.unit == unit);
                touch.map(|(_, touch)| touch.value - TOUCHING)
            }
            _ => None,
        };
        let psi = psi.filter(|psi| psi.is_finite());
        Ok(Spot {
            pass,
            orbit,
            pair,
            psi,
        })
    }

    /// The point of the surface at offsets from a spot along two tangents.
    pub(crate) fn lifted(
        &self,
        base: &Spot,
        along: &[Vec<f64>; 2],
        offsets: [f64; 2],
    ) -> Result<Spot, NotFound> {
        let way = plus(&scaled(&along[0], offsets[0]), offsets[1], &along[1]);
        let change: Change = base.pass.spread(&way).ok_or_else(|| NotFound::Singular {
            residual: base.pass.residual,
            places: base.orbit.places.clone(),
        })?;
        let guess = base.orbit.guess().moved(&self.free, 1.0, &change);
        let mut spot = self.spot(self.shooting().correct(&guess, along)?, base.pair)?;
        let [here, there] = [&base.orbit, &spot.orbit].map(Orbit::switches);
        // Other switches mean that another guard, or another of its minima, is nearest.
        if self.has_sides() && !events::same(&here, &there) {
            spot.psi = None;
        }
        Ok(spot)
    }

    /// Whether psi exists on one side of the curve only.
    pub(crate) fn has_sides(&self) -> bool {
        matches!(self.kind, SpecialKind::Grazing { .. })
    }

    /// The frame at a point of the curve, oriented along `ahead`.
    pub(crate) fn station(&self, spot: Spot, ahead: Option<&[f64]>) -> Option<Station> {
        let plane = linear::null_space(&spot.pass.equations()?, 2)?;
        let plane: [Vec<f64>; 2] = plane.try_into().ok()?;
        let here = spot.psi?;
        let slope = |offset: [f64; 2]| {
            let sides = [DIFFERENCE, -DIFFERENCE].into_iter();
            // A touch has a value on one side only.
            sides
                .filter_map(|h| {
                    let there = self.lifted(&spot, &plane, offset.map(|o| h * o)).ok()?;
                    Some((there.psi? - here) / h)
                })
                .next()
        };
        let gradient = [slope([1.0, 0.0])?, slope([0.0, 1.0])?];
        let steep = norm(&gradient);
        let mix = |a: f64, b: f64| plus(&scaled(&plane[0], a / steep), b / steep, &plane[1]);
        let mut along = mix(-gradient[1], gradient[0]);
        if ahead.is_some_and(|ahead| dot(ahead, &along) < 0.0) {
            along = scaled(&along, -1.0);
        }
        let frame = [along, mix(gradient[0], gradient[1])];
        (steep > 0.0 && steep.is_finite()).then_some(Station {
            spot,
            frame,
            slope: steep,
        })
    }
}
