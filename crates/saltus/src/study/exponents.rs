//! Lyapunov exponents of long-term motions, by the tangent flow.

use saltus_hybrid::{End, Leg, Point, Sample, Status, System, Task, integrate_groups};
use saltus_orbits::{Exponent, Spectrum};

use super::{Control, StudyError, settle};
use crate::model::{Model, ModelError};

/// Periods in which the columns turn into their directions, before anything is recorded. Plate modes lose
/// a tenth of their amplitude per period, so what is left of a wrong direction is 1e-5.
const ALIGNMENT: u64 = 100;

/// The exponents along a motion, per forcing period.
#[derive(Clone, Debug, PartialEq)]
pub struct Growth {
    /// The record; [`Spectrum::estimate`] gives the exponents.
    pub spectrum: Spectrum,
    /// Time integral of the divergence over a period, on average: see [`Model::divergence`].
    pub divergence: f64,
    /// How the run ended; the record goes as far as the run.
    pub status: Status,
}

/// The `columns` largest exponents over `periods` periods from each start, which is best on an attractor
/// already. Models of the same program share the lanes.
///
/// # Errors
/// [`StudyError`] for options out of range, more columns than states, or when stopped.
pub fn growth(
    starts: &[(Model, Point)],
    columns: usize,
    periods: u64,
    control: &Control,
) -> Result<Vec<Growth>, StudyError> {
    let mut groups: Vec<Vec<Climb>> = Vec::new();
    for (number, (model, point)) in starts.iter().enumerate() {
        let spectrum = Spectrum::new(model.free_states(), columns)?;
        let system = model
            .system()
            .with_tangents(columns)
            .map_err(ModelError::from)?;
        let mut start = system.point(&point.modes, &point.x[..model.free_states()]);
        let first = spectrum.start_columns();
        system.columns_mut(&mut start.x).copy_from_slice(&first);
        let group = groups
            .iter_mut()
            .find(|group| system.same_structure(&group[0].system));
        let climb = Climb {
            number,
            model,
            control,
            system,
            start: Some(start),
            periods: ALIGNMENT + periods,
            out: Growth {
                spectrum,
                divergence: 0.0,
                status: Status::Completed,
            },
            failed: false,
        };
        match group {
            Some(group) => group.push(climb.sharing(&group[0])),
            None => groups.push(vec![climb]),
        }
    }
    let ended = integrate_groups(&control.options, groups, control.threads, &control.stop)?;
    let mut ended: Vec<Climb> = ended.into_iter().flatten().collect();
    ended.sort_by_key(|climb| climb.number);
    Ok(ended.into_iter().map(Climb::result).collect())
}

/// One trajectory with its columns.
struct Climb<'a> {
    number: usize,
    model: &'a Model,
    control: &'a Control,
    system: System,
    start: Option<Point>,
    periods: u64,
    out: Growth,
    failed: bool,
}

impl Climb<'_> {
    /// With the structure object of another, which makes later comparisons cheap.
    fn sharing(mut self, other: &Self) -> Self {
        self.system = self.system.sharing(&other.system);
        self
    }

    fn result(mut self) -> Growth {
        self.out.divergence /= self.out.spectrum.iterates().max(1) as f64;
        self.out
    }
}

impl Task for Climb<'_> {
    fn begin(&mut self) -> Option<Leg> {
        Some(Leg {
            system: self.system.clone(),
            start: self.start.take()?,
            periods: self.periods,
        })
    }

    fn sample(&mut self, sample: &Sample<'_>) -> bool {
        self.control.count_period();
        // The columns of this period come after this call.
        if sample.period <= ALIGNMENT + 1 {
            self.out.spectrum.forget();
        }
        if sample.period > ALIGNMENT {
            self.out.divergence += self.model.divergence(sample.dwell);
        }
        !self.failed
    }

    fn tangents(&mut self, columns: &mut [f64]) {
        self.failed |= self.out.spectrum.feed(columns).is_err();
    }

    fn end(&mut self, end: End) -> Option<Leg> {
        self.out.status = end.status;
        None
    }
}

/// How to measure the exponents of one motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement {
    /// How many exponents, the largest first.
    pub exponents: usize,
    /// Forcing periods left out before the first replica.
    pub transient: u64,
    /// Forcing periods measured in each replica.
    pub periods: u64,
    /// Pieces of the same attractor, run side by side.
    pub replicas: usize,
}

impl Measurement {
    /// Periods to run in all, for a progress display.
    pub fn work(&self) -> u64 {
        let replicas = self.replicas.max(1) as u64;
        self.transient + (replicas - 1) * APART + replicas * (ALIGNMENT + self.periods)
    }
}

/// Periods from one replica's start to that of the next.
const APART: u64 = 40;

/// The exponents of the motion that `start` leads to, from replicas that begin at places along it. They are on one
/// attractor whatever others there are, and their scatter is in the standard errors.
///
/// # Errors
/// As [`growth`].
pub fn lyapunov(
    model: &Model,
    start: &Point,
    how: &Measurement,
    control: &Control,
) -> Result<Growth, StudyError> {
    let (mut starts, mut at) = (Vec::new(), start.clone());
    for replica in 0..how.replicas.max(1) {
        let periods = if replica == 0 { how.transient } else { APART };
        for settled in settle(&[(model.clone(), at.clone())], periods, 0, control)? {
            if settled.status != Status::Completed {
                return Ok(Growth {
                    spectrum: Spectrum::new(model.free_states(), how.exponents)?,
                    divergence: 0.0,
                    status: settled.status,
                });
            }
            at = settled.end;
        }
        starts.push((model.clone(), at.clone()));
    }
    let mut parts = growth(&starts, how.exponents, how.periods, control)?.into_iter();
    let Some(mut all) = parts.next() else {
        return Err(saltus_hybrid::IntegrateError::Interrupted.into());
    };
    for part in parts {
        all.spectrum.merge(&part.spectrum)?;
        all.divergence += part.divergence;
        if part.status != Status::Completed {
            all.status = part.status;
        }
    }
    all.divergence /= starts.len() as f64;
    Ok(all)
}

impl Growth {
    /// The largest exponent.
    pub fn largest(&self) -> Option<Exponent> {
        self.spectrum.estimate().into_iter().next()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Setup;
    use crate::physics::ContactLaw;

    fn measured(setup: &Setup, exponents: usize, periods: u64) -> Growth {
        let model = setup.model().expect("the paper's case");
        let how = Measurement {
            exponents,
            transient: 300,
            periods,
            replicas: 8,
        };
        lyapunov(&model, &model.start(3.0, 2.0), &how, &Control::default()).expect("runs")
    }

    #[test]
    fn a_periodic_orbit_has_a_negative_exponent_and_chaos_a_positive_one() {
        // zeta_h 0.35 at 0.9 is 1T (DP Fig. 3b), 0.12 at 1.0 is chaotic (DP Fig. 2b).
        let periodic = measured(&Setup::dias_del_prado(0.35, 0.9), 1, 100);
        let chaotic = measured(&Setup::dias_del_prado(0.12, 1.0), 1, 400);
        let (periodic, chaotic) = (periodic.largest(), chaotic.largest());
        assert!(periodic.expect("recorded").per_iterate < -0.05);
        let chaotic = chaotic.expect("recorded");
        assert!(
            chaotic.per_iterate > 5.0 * chaotic.standard_error,
            "{chaotic:?}"
        );
    }

    #[test]
    fn the_sum_of_all_exponents_is_the_mean_divergence() {
        // By Liouville's formula, period by period: no statistics are involved.
        for contact in [ContactLaw::ReactionForce, ContactLaw::Gap] {
            let setup = Setup {
                contact,
                ..Setup::dias_del_prado(0.12, 1.0)
            };
            let all = measured(&setup, 10, 60);
            let sum = all.spectrum.sum().per_iterate;
            assert!(
                (sum - all.divergence).abs() < 1e-7,
                "{sum} {}",
                all.divergence
            );
        }
    }
}
