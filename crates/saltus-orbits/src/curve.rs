//! Curves of folds, period doublings, Neimark-Sacker points and grazings over two parameters.
//!
//! The orbits themselves form a smooth surface in (x_1, p, q), folds included. On it a test function psi is
//! one more number: det(M - I) for folds, det(M + I) for doublings, |mu| - 1 of one pair of multipliers, or the
//! value of a guard where it touches. From a point of psi = 0 its gradient in the tangent plane gives the
//! direction d of the curve and the normal n; the next point is h d + b n, with b found by the secant
//! method, lifted to the surface by the corrector.

use crate::continuation::{ContinuationError, ContinuationOptions, End, ParameterRange};
use crate::detect::critical_pair;
use crate::differences::Free;
use crate::linear::{dot, minus, norm, unit};
use crate::path::Path;
use crate::surface::{Spot, Station, Surface};
use crate::{Multiplier, NotFound, Orbit, ParametricMap, Special, SpecialKind};

/// psi, or the last change of b, at which a point lies on the curve.
const ZERO: f64 = 1e-11;

/// Evaluations for one point at most; the secant method takes 3 to 5.
const ROUNDS: usize = 30;

/// Newton steps per point of a curve that let the step grow.
const EASY: usize = 5;

/// Points before a curve may close, and the distance from the start at which the closing step may pass.
const ROUND: usize = 5;
const BESIDE: f64 = 0.1;

/// A point of a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvePoint {
    /// Values of the two parameters.
    pub parameters: [f64; 2],
    /// The orbit.
    pub orbit: Orbit,
    /// The pair of multipliers on the unit circle, by the one in the upper half plane, for Neimark-Sacker points.
    pub pair: Option<Multiplier>,
}

/// A curve of special points over two parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Its points in their order along the curve.
    pub points: Vec<CurvePoint>,
    /// Its ends, before the first point and after the last.
    pub ends: [End; 2],
}

/// Follows the curve of a special point both ways over two parameters. Steps are lengths in (x_1, first, second
/// parameter).
///
/// A grazing is followed at a distance of 1e-9 of its guard from zero, on the side without the switch.
///
/// # Errors
/// If the question makes no sense, or the special point is of a kind that has no such curve. How the curve ends
/// is an answer.
pub fn follow_curve<F: ParametricMap + ?Sized>(
    family: &F,
    start: &Special,
    over: [&ParameterRange; 2],
    options: &ContinuationOptions,
    keep_going: &mut dyn FnMut(&CurvePoint) -> bool,
) -> Result<Curve, ContinuationError> {
    for along in over {
        Path::new(family, &start.orbit, along, options)?;
    }
    let surface = Surface {
        family,
        free: over.map(|along| Free {
            index: along.parameter,
            unit: (along.to - along.from).abs() / options.weight,
        }),
        ranges: over.map(|along| [along.from.min(along.to), along.from.max(along.to)]),
        options,
        kind: start.kind.clone(),
    };
    let short = start.kind.short();
    let has_curve = matches!(short, "LP" | "PD" | "NS" | "GR");
    if over[0].parameter == over[1].parameter || !has_curve {
        return Err(ContinuationError::NoCurve { short });
    }
    let pass = surface.shooting().pass(&start.orbit.guess());
    let pass = pass.map_err(|reason| NotFound::NoImage {
        reason,
        residual: f64::INFINITY,
        places: start.orbit.places.clone(),
    })?;
    let spot = surface.spot(pass, critical_pair(&start.orbit))?;
    let first = surface.station(spot, None);
    let first = first.ok_or(ContinuationError::NoDirection { short })?;
    let forth = surface.walk(&first, keep_going);
    if matches!(forth.ends[1], End::Closed | End::Interrupted) {
        return Ok(forth);
    }
    let mut begun = false;
    let back = surface.walk(&first.clone().turned(), &mut |point| {
        !std::mem::replace(&mut begun, true) || keep_going(point)
    });
    let mut points = back.points;
    points.reverse();
    points.extend(forth.points.into_iter().skip(1));
    let ([_, before], [_, behind]) = (back.ends, forth.ends);
    Ok(Curve {
        points,
        ends: [before, behind],
    })
}

impl<F: ParametricMap + ?Sized> Surface<'_, F> {
    /// The point of the curve `step` ahead, and the Newton steps it took.
    fn next(&self, from: &Station, step: f64) -> Result<(Spot, usize), End> {
        let mut known: Option<(f64, f64)> = None;
        let (mut b, mut slope, mut effort) = (0.0, from.slope, 0);
        for _ in 0..ROUNDS {
            let spot = match self.lifted(&from.spot, &from.frame, [step, b]) {
                // Beyond a square root there may be no orbit at all.
                Err(reason) if reason.is_stop() || !self.has_sides() => return Err(reason.into()),
                spot => spot.ok(),
            };
            effort += spot.as_ref().map_or(0, |spot| spot.orbit.iterations);
            let Some((psi, spot)) = spot.and_then(|spot| Some((spot.psi?, spot))) else {
                // Beyond grazing: back to where the guard still had a value, or towards where it should.
                b = match known {
                    Some((known, _)) => f64::midpoint(known, b),
                    None if self.has_sides() => b + 0.02 * step,
                    None => return Err(End::Resonance),
                };
                continue;
            };
            if let Some((before, value)) = known {
                let secant = (psi - value) / (b - before);
                if secant.is_finite() && secant != 0.0 {
                    slope = secant;
                }
            }
            let change = -psi / slope;
            if psi.abs() <= ZERO || (change.abs() <= ZERO && known.is_some()) {
                return Ok((spot, effort));
            }
            known = Some((b, psi));
            b += change;
            if b.abs() > step {
                break;
            }
        }
        Err(End::StepTooSmall)
    }

    /// The first end of a range on the way from one orbit to another: which parameter, and its value there.
    fn crossed(&self, from: &Orbit, to: &Orbit) -> Option<(usize, f64)> {
        let ends = (0..2).filter_map(|k| {
            let [from, to] = [from, to].map(|orbit| orbit.parameters[self.free[k].index]);
            let edge = to.clamp(self.ranges[k][0], self.ranges[k][1]);
            (edge != to).then(|| ((edge - from) / (to - from), (k, edge)))
        });
        let first = ends.min_by(|a, b| a.0.total_cmp(&b.0));
        first.map(|(_, end)| end)
    }

    /// The point at the end of a range that a step crosses: false position on the step.
    fn edge(&self, from: &Station, mut step: f64, (k, edge): (usize, f64)) -> Result<Spot, End> {
        let Free { index, unit } = self.free[k];
        for _ in 0..ROUNDS {
            let (spot, _) = self.next(from, step)?;
            let [start, here] = [&from.spot, &spot].map(|s| s.orbit.parameters[index]);
            // The parameters of a point of the curve are not known better.
            if (here - edge).abs() <= 10.0 * ZERO * unit {
                return Ok(spot);
            }
            step *= (edge - start) / (here - start);
        }
        Err(End::StepTooSmall)
    }

    fn walk(&self, first: &Station, keep_going: &mut dyn FnMut(&CurvePoint) -> bool) -> Curve {
        let mut step = self.options.initial;
        let mut points = vec![self.point(&first.spot)];
        let mut go_on = keep_going(&points[0]);
        let mut station = first.clone();
        let mut end = End::Interrupted;
        while go_on {
            if points.len() >= self.options.points.max(1) {
                end = End::PointLimit;
                break;
            }
            let next = self.ahead(&station, step);
            let (next, effort, last) = match next {
                Ok(next) => next,
                Err(End::Interrupted) => break,
                Err(reason) if step / 2.0 < self.options.smallest => {
                    end = reason;
                    break;
                }
                Err(_) => {
                    step /= 2.0;
                    continue;
                }
            };
            let closed = points.len() >= ROUND && self.passes(first, &station, &next);
            points.push(self.point(&next.spot));
            go_on = keep_going(&points[points.len() - 1]);
            if last || closed {
                end = if last { End::RangeEnd } else { End::Closed };
                break;
            }
            step *= if effort <= EASY { 1.5 } else { 1.0 };
            step = step.min(self.options.largest);
            station = next;
        }
        Curve {
            points,
            ends: [End::Start, end],
        }
    }

    /// The next station, the Newton steps it took, and whether it lies at the end of a range.
    fn ahead(&self, station: &Station, step: f64) -> Result<(Station, usize, bool), End> {
        let (mut spot, effort) = self.next(station, step)?;
        let out = self.crossed(&station.spot.orbit, &spot.orbit);
        if let Some(end) = out {
            spot = self.edge(station, step, end)?;
        }
        let next = self.station(spot, Some(&station.frame[0]));
        let next = next.ok_or(End::StepTooSmall)?;
        let bend = norm(&minus(&next.frame[0], &station.frame[0]));
        if bend > self.options.angle {
            return Err(End::StepTooSmall);
        }
        Ok((next, effort, out.is_some()))
    }

    /// Whether the step between two stations passes the first one.
    fn passes(&self, first: &Station, from: &Station, to: &Station) -> bool {
        let [first_u, from_u, to_u] = [first, from, to].map(|s| self.coordinates(&s.spot.orbit));
        let (way, back) = (minus(&to_u, &from_u), minus(&first_u, &from_u));
        let along = dot(&back, &unit(&way));
        let beside = (dot(&back, &back) - along * along).max(0.0).sqrt();
        (0.0..=norm(&way)).contains(&along)
            && beside <= BESIDE * norm(&way)
            && dot(&first.frame[0], &to.frame[0]) > 0.0
    }

    fn point(&self, spot: &Spot) -> CurvePoint {
        let circle = matches!(self.kind, SpecialKind::NeimarkSacker { .. });
        CurvePoint {
            parameters: [0, 1].map(|i| spot.orbit.parameters[self.free[i].index]),
            orbit: spot.orbit.clone(),
            pair: spot.pair.filter(|_| circle),
        }
    }
}
