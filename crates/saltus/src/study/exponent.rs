//! The largest Lyapunov exponent of a long-term motion, by two trajectories.
//!
//! A neighbour at distance 1e-7 is run beside the trajectory and drawn back to that distance after
//! each period (Benettin et al., Meccanica 15 (1980)). No derivative is needed, so every contact law
//! is treated alike; the price is an error of about the distance itself.

use saltus_hybrid::{End, Leg, Options, Point, Sample, Status, Task, integrate_all};

use super::{Control, StudyError};
use crate::model::Model;

/// A rate with its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponent {
    /// Mean growth rate per forcing period (-): positive for chaos, zero for a torus or at a
    /// bifurcation, negative for a periodic orbit.
    pub per_period: f64,
    /// Standard error of the mean over twenty batches.
    pub standard_error: f64,
}

impl Exponent {
    /// Whether it is positive, negative, or neither with three standard errors to spare.
    pub fn sign(&self) -> std::cmp::Ordering {
        if self.per_period.abs() <= 3.0 * self.standard_error {
            std::cmp::Ordering::Equal
        } else {
            self.per_period.total_cmp(&0.0)
        }
    }
}

/// Distance of the neighbour, in the model's units (of order 1 for the motion itself).
const DISTANCE: f64 = 1e-7;
const BATCHES: usize = 20;

/// The exponent over `periods` periods for each (model, start), after `transient` periods. `None`
/// where the trajectory ended early.
///
/// # Errors
/// [`StudyError::Integrate`] for options out of range or when stopped.
pub fn largest_exponents(
    starts: &[(Model, Point)],
    transient: u64,
    periods: u64,
    control: &Control,
) -> Result<Vec<Option<Exponent>>, StudyError> {
    // The neighbour's distance must stand well above the integration error.
    let options = Options {
        method: saltus_hybrid::Method::taylor(1e-13),
        ..control.options
    };
    let tasks = starts.iter().map(|(model, start)| Pair {
        model,
        control,
        transient,
        periods,
        point: start.clone(),
        ahead: None,
        direction: Vec::new(),
        growth: Vec::new(),
        stage: Stage::Transient,
    });
    let ended = integrate_all(&options, tasks.collect(), control.threads, &control.stop)?;
    Ok(ended
        .into_iter()
        .map(|pair| mean(&pair.growth, periods))
        .collect())
}

fn mean(growth: &[f64], periods: u64) -> Option<Exponent> {
    if growth.is_empty() || (growth.len() as u64) < periods {
        return None;
    }
    let average = |g: &[f64]| g.iter().sum::<f64>() / g.len() as f64;
    let per_period = average(growth);
    let batches: Vec<f64> = growth
        .chunks(growth.len().div_ceil(BATCHES))
        .map(average)
        .collect();
    let spread: f64 = batches.iter().map(|b| (b - per_period).powi(2)).sum();
    let n = batches.len() as f64;
    Some(Exponent {
        per_period,
        standard_error: (spread / (n * (n - 1.0).max(1.0))).sqrt(),
    })
}

enum Stage {
    Transient,
    Reference,
    Neighbour,
}

/// One trajectory and its neighbour, run in turn, one period each.
struct Pair<'a> {
    model: &'a Model,
    control: &'a Control,
    transient: u64,
    periods: u64,
    point: Point,
    ahead: Option<Point>,
    direction: Vec<f64>,
    growth: Vec<f64>,
    stage: Stage,
}

impl Pair<'_> {
    fn leg(&self, start: Point, periods: u64) -> Option<Leg> {
        Some(Leg {
            system: self.model.system().clone(),
            start,
            periods,
        })
    }

    fn neighbour(&self) -> Point {
        let mut point = self.point.clone();
        for (x, d) in point.x.iter_mut().zip(&self.direction) {
            *x += DISTANCE * d;
        }
        point
    }
}

impl Task for Pair<'_> {
    fn begin(&mut self) -> Option<Leg> {
        // Any direction will turn into the fastest growing one; the drive's two states stay exact.
        let free = self.model.free_states();
        self.direction = vec![0.0; self.point.x.len()];
        self.direction[..free].fill(1.0 / (free as f64).sqrt());
        self.leg(self.point.clone(), self.transient)
    }

    fn sample(&mut self, _: &Sample<'_>) -> bool {
        self.control.count_period();
        true
    }

    fn end(&mut self, end: End) -> Option<Leg> {
        if end.status != Status::Completed {
            self.growth.clear();
            return None;
        }
        match self.stage {
            Stage::Transient => {
                self.point = end.point;
                self.stage = Stage::Reference;
                self.leg(self.point.clone(), 1)
            }
            Stage::Reference => {
                self.ahead = Some(end.point);
                self.stage = Stage::Neighbour;
                self.leg(self.neighbour(), 1)
            }
            Stage::Neighbour => {
                let ahead = self.ahead.take()?;
                let free = self.model.free_states();
                for (d, (n, r)) in self.direction[..free]
                    .iter_mut()
                    .zip(end.point.x.iter().zip(&ahead.x))
                {
                    *d = (n - r) / DISTANCE;
                }
                let stretch = self.direction[..free]
                    .iter()
                    .map(|d| d * d)
                    .sum::<f64>()
                    .sqrt();
                if !(stretch > 0.0 && stretch.is_finite()) {
                    self.growth.clear();
                    return None;
                }
                self.direction[..free]
                    .iter_mut()
                    .for_each(|d| *d /= stretch);
                self.growth.push(stretch.ln());
                self.point = ahead;
                self.stage = Stage::Reference;
                let more = (self.growth.len() as u64) < self.periods;
                more.then(|| self.leg(self.point.clone(), 1)).flatten()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Setup;

    #[test]
    fn a_periodic_orbit_has_a_negative_exponent_and_chaos_a_positive_one() {
        // zeta_h 0.35 at 0.9 is 1T (DP Fig. 3b), 0.12 at 1.0 is chaotic (DP Fig. 2b).
        let starts = [(0.35, 0.9), (0.12, 1.0)].map(|(zeta, ratio)| {
            let model = Setup::dias_del_prado(zeta, ratio)
                .model()
                .expect("the paper's case");
            let start = model.start(3.0, 2.0);
            (model, start)
        });
        let found = largest_exponents(&starts, 200, 300, &Control::default()).expect("runs");
        let [periodic, chaotic] = found[..] else {
            panic!("{found:?}")
        };
        assert_eq!(periodic.expect("ends").sign(), std::cmp::Ordering::Less);
        assert_eq!(chaotic.expect("ends").sign(), std::cmp::Ordering::Greater);
    }
}
