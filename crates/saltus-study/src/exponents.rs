//! Lyapunov exponents of long-term motions, by the tangent flow.

use saltus_hybrid::{Point, Sample, Status};
use saltus_orbits::{Ascent, Exponent, MapPoint, Orbit, Spectrum, Start, climb, settled};

use crate::orbits::stroboscopic;
use crate::subject::Subject;
use crate::{Control, Outcome, settle};

/// Periods in which the columns turn into their directions, before anything is recorded. Where amplitudes lose
/// a tenth per period, what is left of a wrong direction is 1e-5.
const ALIGNMENT: u64 = 100;

/// The exponents along a motion, per forcing period.
#[derive(Clone, Debug, PartialEq)]
pub struct LyapunovRun {
    /// The record of growth.
    pub spectrum: Spectrum,
    /// Time integral of the divergence over each recorded period: see [`Subject::divergence`].
    pub divergences: Vec<f64>,
    /// Status at the end; the record goes as far as the run.
    pub status: Status,
    /// Last state.
    pub end: Point,
    /// The cycle that the motion has come to; `None` for other motions, or if it was not sought.
    pub cycle: Option<Orbit>,
}

/// The `columns` largest exponents over `periods` periods from each start, which is best on an attractor
/// already. Models of the same program share the lanes.
///
/// # Errors
/// [`StudyError`](crate::StudyError) for options out of range, more columns than states, or when stopped.
pub fn lyapunov_of_states<S: Subject>(
    starts: &[(S, Point)],
    columns: usize,
    periods: u64,
    control: &Control,
) -> Outcome<Vec<LyapunovRun>, S> {
    let mut divergences = vec![Vec::new(); starts.len()];
    let watched = starts.iter().zip(&mut divergences);
    let climbs = watched.map(|((model, point), divergences)| Start {
        system: model.system().clone(),
        point: point.clone(),
        watch: move |sample: &Sample<'_>| {
            control.count_period();
            if sample.period <= ALIGNMENT + 1 {
                divergences.clear();
            }
            divergences.push(model.divergence(sample.dwell));
        },
    });
    let how = Ascent {
        columns,
        transient: ALIGNMENT,
        periods,
    };
    let (options, threads) = (&control.options, control.threads);
    let climbed = climb(climbs.collect(), &how, options, threads, &control.stop)?;
    let told = |(climbed, divergences): (saltus_orbits::Climbed, Vec<f64>)| {
        let recorded = climbed.spectrum.iterates();
        let left_out = divergences.len().saturating_sub(recorded);
        LyapunovRun {
            spectrum: climbed.spectrum,
            divergences: divergences[left_out..].to_vec(),
            status: climbed.end.status,
            end: climbed.end.point,
            cycle: None,
        }
    };
    Ok(climbed.into_iter().zip(divergences).map(told).collect())
}

/// Lengths of a measurement of the exponents of one motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement {
    /// Number of exponents, the largest first.
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
        self.transient + (replicas - 1) * self.periods + replicas * (ALIGNMENT + self.periods)
    }
}

/// The exponents of the motion that `start` leads to, from replicas: pieces of it, one after the other, whose tangents
/// are followed side by side. No two of them have periods in common, and all are on one attractor whatever others there
/// are. Together they are one long record, which tells what changes more slowly than one piece is long.
///
/// If the motion has come to a cycle, [`LyapunovRun::cycle`] is that.
///
/// # Errors
/// As [`lyapunov_of_states`].
pub fn lyapunov<S: Subject>(
    model: &S,
    start: &Point,
    how: &Measurement,
    control: &Control,
) -> Outcome<LyapunovRun, S> {
    let (mut starts, mut at) = (Vec::new(), start.clone());
    for replica in 0..how.replicas.max(1) {
        // The columns take as long to turn into their directions in each piece, so records follow each other.
        let periods = if replica == 0 {
            how.transient
        } else {
            how.periods
        };
        for settled in settle(&[(model.clone(), at.clone())], periods, 0, control)? {
            if settled.status != Status::Completed {
                return Ok(LyapunovRun {
                    spectrum: Spectrum::new(model.free_states(), how.exponents)?,
                    divergences: Vec::new(),
                    status: settled.status,
                    end: settled.end,
                    cycle: None,
                });
            }
            at = settled.end;
        }
        starts.push((model.clone(), at.clone()));
    }
    let mut pieces = lyapunov_of_states(&starts, how.exponents, how.periods, control)?;
    let Some(mut all) = pieces.pop() else {
        return Err(saltus_hybrid::IntegrateError::Interrupted.into());
    };
    let mut divergences = Vec::new();
    for piece in pieces {
        all.spectrum.merge(&piece.spectrum)?;
        divergences.extend(piece.divergences);
        if piece.status != Status::Completed {
            all.status = piece.status;
        }
    }
    divergences.append(&mut all.divergences);
    all.divergences = divergences;
    if all.status == Status::Completed && all.spectrum.estimate()[0].per_iterate < 0.0 {
        all.cycle = cycle(model, &all.end, control);
    }
    Ok(all)
}

/// The cycle that a motion is on at a point.
fn cycle<S: Subject>(model: &S, point: &Point, control: &Control) -> Option<Orbit> {
    let family = stroboscopic(model, |_: &[f64]| Ok(model.clone()), control);
    let place = MapPoint {
        modes: point.modes.clone(),
        x: point.x[..model.free_states()].to_vec(),
    };
    settled(&family, &[], &place)
}

impl LyapunovRun {
    /// The exponents: of the cycle, where the motion has come to one, else of the record.
    pub fn exponents(&self) -> Vec<Exponent> {
        match &self.cycle {
            Some(orbit) => self.spectrum.on_cycle(orbit),
            None => self.spectrum.estimate(),
        }
    }

    /// Their sum, with its error.
    pub fn sum(&self) -> Exponent {
        let Some(orbit) = &self.cycle else {
            return self.spectrum.sum();
        };
        let errors = self.exponents().into_iter().map(|e| e.standard_error);
        Exponent {
            per_iterate: self.spectrum.sum_of_last(orbit.period()),
            standard_error: errors.sum(),
            batches: 0,
            batch_length: 0,
        }
    }

    /// Mean divergence over a period: of the cycle once around, else of the record.
    pub fn divergence(&self) -> f64 {
        let all = self.divergences.as_slice();
        let last = self.cycle.as_ref().map_or(all.len(), Orbit::period);
        let whole = &all[all.len().saturating_sub(last)..];
        whole.iter().sum::<f64>() / whole.len().max(1) as f64
    }

    /// The largest exponent.
    pub fn largest(&self) -> Option<Exponent> {
        self.exponents().into_iter().next()
    }
}
