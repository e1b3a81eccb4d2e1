//! The nature of a motion, from its exponents and from whether it recurs; and the confidence of that.
//!
//! The name rests on tests, not on an exponent being above some number:
//!
//! - **chaotic**: it does not recur; the largest exponent is positive by Student's t, one-sided, with the
//!   confidence asked for; and over the record a small deviation grows by more than 1/eps. A motion that
//!   leaves an unstable cycle or torus does not show that: it starts a rounding error away at the nearest and has grown
//!   by 1/eps when it is somewhere else. On a torus, growth is bounded; near a bifurcation it is slower than
//!   any exponential. A chaotic transient that ends within the record makes batches unlike their neighbours,
//!   and the error large.
//! - **quasi-periodic**: it does not recur; and the weighted Birkhoff averages of the growth over both halves
//!   agree, and that over the whole is zero, far more closely than chance allows. With standard error s of the
//!   plain mean, the average over the whole would in chaos be normal with standard deviation s or more, and the
//!   difference of the halves with 2 s or more (each has half of the iterates, and weights only add); and since one is even
//!   in time and the other odd, they are independent. A normal number is within d of anything with a probability
//!   of at most d sqrt(2/pi) over its deviation. The product of both must be below one minus the confidence, and each alone
//!   below a twentieth: chaos that is so weak that its average is small has two chances, not one.
//! - **periodic**: it recurs, and the largest exponent is negative with the confidence asked for.
//!
//! Everything else is undecided, with the reason. So is a slow transient near a bifurcation: its exponent
//! tends to zero from below, and its averages creep instead of converging.
//!
//! No finite record excludes chaos that ends after it. In narrow windows of the logistic map such transients
//! last for thousands of iterates, so a run that stops early should discard as many before.
//!
//! A test that is repeated as the record grows errs more often than a single one, at most by the number of
//! repetitions; to double the record before each keeps that number, and the work, small.

use crate::{Exponent, Spectrum, Weighted};

/// Whether a motion comes back, judged by its places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Recurrence {
    /// It comes back to its place `period` iterates before, and `period` is the shortest such.
    Recurs {
        /// Iterates.
        period: u32,
        /// Bound on the rest of the transient, in the units of [`Criteria::rest`].
        rest: f64,
    },
    /// It visibly comes closer to a cycle, or leaves one.
    Drifting,
    /// Neither.
    Open,
}

/// The kind of a motion in the long run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Nature {
    /// A stable cycle, with its number of iterates.
    Periodic(u32),
    /// A torus.
    QuasiPeriodic,
    /// Small deviations grow, again and again.
    Chaotic,
    /// Not known, with the reason.
    Undecided(Doubt),
}

/// Reason why the nature of a motion is not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Doubt {
    /// Too few iterates for any error, or the sign of the exponent drowns in it.
    Sign,
    /// The exponent is positive, but the growth is not yet more than leaving an unstable cycle may show.
    Growth,
    /// It is still coming to a cycle, or leaving one.
    Drift,
    /// The exponent is negative, but no period is known: a transient, or a cycle longer than was looked for.
    NoPeriod,
    /// It recurs while deviations grow: it sits on an unstable cycle, or the record holds a chaotic transient.
    UnstableCycle,
}

/// A nature and how sure it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    /// Kind of the motion.
    pub nature: Nature,
    /// Probability that the test behind the name did not come out by chance; where the nature is undecided,
    /// that the largest exponent has the sign it shows.
    pub confidence: f64,
    /// The largest exponent.
    pub exponent: Exponent,
}

/// Thresholds of the tests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Criteria {
    /// Confidence of each test. 0.999: of a thousand pixels of a map, one may be wrong.
    pub confidence: f64,
    /// ln of the growth that a motion leaving an unstable one can show. ln(1/eps) = 36.04.
    pub growth: f64,
    /// Error of the growth that no record shows (1 / iterate): that of the derivatives. 1e-12 for formulas; for a
    /// flow it follows from its tolerance.
    pub noise: f64,
    /// Largest rest of a transient with which a cycle is called one. 1e-3, in the units of the samples.
    pub rest: f64,
}

impl Default for Criteria {
    fn default() -> Self {
        Self {
            confidence: 0.999,
            growth: -f64::EPSILON.ln(),
            noise: 1e-12,
            rest: 1e-3,
        }
    }
}

impl Verdict {
    /// Whether more iterates may yet tell. Those of an orbit on an unstable cycle do not.
    pub fn needs_more(&self) -> bool {
        matches!(self.nature, Nature::Undecided(doubt) if doubt != Doubt::UnstableCycle)
    }
}

/// The nature of a motion, from the record of its exponents and its recurrence at the end of that record.
///
/// The work is proportional to the length of the record.
pub fn judge(spectrum: &Spectrum, recurrence: Recurrence, criteria: &Criteria) -> Verdict {
    let evidence = Evidence::of(spectrum, criteria);
    let (nature, confidence) = match recurrence {
        Recurrence::Recurs { period, rest } if rest <= criteria.rest => evidence.of_cycle(period),
        Recurrence::Recurs { .. } | Recurrence::Drifting => evidence.undecided(Doubt::Drift),
        Recurrence::Open => evidence.of_open(),
    };
    Verdict {
        nature,
        confidence,
        exponent: evidence.exponent,
    }
}

struct Evidence<'a> {
    criteria: &'a Criteria,
    exponent: Exponent,
    /// Probability that the exponent is positive.
    positive: f64,
    /// Probability that the weighted averages come out as they do by chance.
    chance: f64,
    /// ln of that over the record.
    growth: f64,
}

impl<'a> Evidence<'a> {
    fn of(spectrum: &Spectrum, criteria: &'a Criteria) -> Self {
        let exponent = spectrum.largest();
        Self {
            criteria,
            exponent,
            positive: exponent.positive(criteria.noise),
            chance: chance(&exponent, &spectrum.weighted_largest(), criteria.noise),
            growth: spectrum.growth(),
        }
    }

    fn of_cycle(&self, period: u32) -> (Nature, f64) {
        if 1.0 - self.positive >= self.criteria.confidence {
            (Nature::Periodic(period), 1.0 - self.positive)
        } else if self.positive >= self.criteria.confidence {
            self.undecided(Doubt::UnstableCycle)
        } else {
            self.undecided(Doubt::Sign)
        }
    }

    fn of_open(&self) -> (Nature, f64) {
        let sure = |probability: f64| probability >= self.criteria.confidence;
        if sure(1.0 - self.chance) {
            (Nature::QuasiPeriodic, 1.0 - self.chance)
        } else if sure(self.positive) && self.growth > self.criteria.growth {
            (Nature::Chaotic, self.positive)
        } else if sure(self.positive) {
            self.undecided(Doubt::Growth)
        } else if sure(1.0 - self.positive) {
            self.undecided(Doubt::NoPeriod)
        } else {
            self.undecided(Doubt::Sign)
        }
    }

    fn undecided(&self, doubt: Doubt) -> (Nature, f64) {
        let sign = self.positive.max(1.0 - self.positive);
        (Nature::Undecided(doubt), sign)
    }
}

/// Largest chance of either average alone on a torus.
const ALONE: f64 = 0.05;

/// A bound on the chance that weighted averages are so close to each other, and to zero, in chaos.
fn chance(exponent: &Exponent, weighted: &Weighted, noise: f64) -> f64 {
    if exponent.batches == 0 {
        return 1.0;
    }
    let error = exponent.standard_error.hypot(noise);
    let within = |distance: f64, deviation: f64| {
        let chance = distance / deviation * std::f64::consts::FRAC_2_PI.sqrt();
        if chance.is_nan() { 1.0 } else { chance }
    };
    let zero = within(weighted.mean.abs(), error);
    let agree = within(weighted.difference, 2.0 * error);
    if zero.max(agree) > ALONE {
        return 1.0;
    }
    zero * agree
}
