//! The kind of a motion, judged by its exponents and by whether it recurs, and how sure that is.
//!
//! The name rests on tests, not on an exponent being above some number:
//!
//! - **chaotic**: it does not recur; the largest exponent is positive by Student's t, one-sided, with the
//!   confidence asked for; and over the record a small deviation grows by more than 1/eps. What leaves an
//!   unstable cycle or torus does not show that: it starts a rounding error away at the nearest and has grown
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
//! last for thousands of iterates, so whoever stops early should discard as many before.
//!
//! A test that is repeated as the record grows errs more often than a single one, at most by the number of
//! repetitions; to double the record before each keeps that number, and the work, small.

use crate::{Exponent, Spectrum, Weighted};

/// Whether a motion comes back, judged by its places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Recurrence {
    /// To where it was `period` iterates before, and `period` is the shortest such.
    Recurs {
        /// Iterates.
        period: u32,
        /// Bound on what is still to come of the transient, in the units of [`Criteria::rest`].
        rest: f64,
    },
    /// Visibly coming closer to a cycle, or leaving one.
    Drifting,
    /// Neither.
    Open,
}

/// Kinds of motion in the long run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MotionKind {
    /// On a stable cycle that repeats after this number of iterates.
    Periodic(u32),
    /// On a torus: the largest exponent is zero far more closely than chance allows.
    QuasiPeriodic,
    /// Never repeats, and small deviations grow, again and again: the largest exponent is positive.
    Chaotic,
    /// On no cycle of a length that was looked for, and no exponent was asked for that tells more.
    NotPeriodic,
    /// Not known: still on its way, on a longer cycle, or its exponent too small to tell its sign.
    Undecided,
}

impl MotionKind {
    /// The names of all kinds, each at the place of its [`Self::code`].
    pub const NAMES: [&'static str; 5] = [
        "periodic",
        "quasi-periodic",
        "chaotic",
        "not-periodic",
        "undecided",
    ];

    /// The name as results have it; that of a cycle is without its period.
    pub fn name(self) -> &'static str {
        Self::NAMES[self.code()]
    }

    /// A number for the kind, without the period of a cycle: its place among [`Self::NAMES`].
    pub fn code(self) -> usize {
        match self {
            Self::Periodic(_) => 0,
            Self::QuasiPeriodic => 1,
            Self::Chaotic => 2,
            Self::NotPeriodic => 3,
            Self::Undecided => 4,
        }
    }

    /// The period of a cycle.
    pub fn period(self) -> Option<u32> {
        match self {
            Self::Periodic(n) => Some(n),
            _ => None,
        }
    }

    /// Whether it is known not to repeat.
    pub fn never_repeats(self) -> bool {
        matches!(
            self,
            Self::QuasiPeriodic | Self::Chaotic | Self::NotPeriodic
        )
    }
}

/// Reasons why the kind of a motion is not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UndecidedReason {
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

/// A kind of motion and how sure it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    /// Kind of the motion.
    pub kind: MotionKind,
    /// Reason why it is undecided; `None` for every other kind.
    pub doubt: Option<UndecidedReason>,
    /// Probability that the test behind the name did not come out by chance; where the kind is undecided,
    /// that the largest exponent has the sign it shows.
    pub confidence: f64,
    /// The largest exponent.
    pub exponent: Exponent,
}

/// How sure is sure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Criteria {
    /// Confidence of each test. 0.999: of a thousand pixels of a map, one may be wrong.
    pub confidence: f64,
    /// ln of the growth that a motion leaving an unstable one can show. ln(1/eps) = 36.04.
    pub growth: f64,
    /// Error of the growth that no record shows (1 / iterate): that of the derivatives. 1e-12 for formulas; for a
    /// flow, what its tolerance gives.
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
        self.doubt
            .is_some_and(|doubt| doubt != UndecidedReason::UnstableCycle)
    }
}

/// The kind of a motion, from the record of its exponents and its recurrence at the end of that record.
///
/// The work is proportional to the length of the record.
pub fn judge(spectrum: &Spectrum, recurrence: Recurrence, criteria: &Criteria) -> Verdict {
    let evidence = Evidence::of(spectrum, criteria);
    let (named, confidence) = match recurrence {
        Recurrence::Recurs { period, rest } if rest <= criteria.rest => evidence.of_cycle(period),
        Recurrence::Recurs { .. } | Recurrence::Drifting => {
            evidence.undecided(UndecidedReason::Drift)
        }
        Recurrence::Open => evidence.of_open(),
    };
    Verdict {
        kind: named.unwrap_or(MotionKind::Undecided),
        doubt: named.err(),
        confidence,
        exponent: evidence.exponent,
    }
}

struct Evidence<'a> {
    criteria: &'a Criteria,
    exponent: Exponent,
    /// Probability that the exponent is positive.
    positive: f64,
    /// That the weighted averages come out as they do by chance.
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

    fn of_cycle(&self, period: u32) -> (Result<MotionKind, UndecidedReason>, f64) {
        if 1.0 - self.positive >= self.criteria.confidence {
            (Ok(MotionKind::Periodic(period)), 1.0 - self.positive)
        } else if self.positive >= self.criteria.confidence {
            self.undecided(UndecidedReason::UnstableCycle)
        } else {
            self.undecided(UndecidedReason::Sign)
        }
    }

    fn of_open(&self) -> (Result<MotionKind, UndecidedReason>, f64) {
        let sure = |probability: f64| probability >= self.criteria.confidence;
        if sure(1.0 - self.chance) {
            (Ok(MotionKind::QuasiPeriodic), 1.0 - self.chance)
        } else if sure(self.positive) && self.growth > self.criteria.growth {
            (Ok(MotionKind::Chaotic), self.positive)
        } else if sure(self.positive) {
            self.undecided(UndecidedReason::Growth)
        } else if sure(1.0 - self.positive) {
            self.undecided(UndecidedReason::NoPeriod)
        } else {
            self.undecided(UndecidedReason::Sign)
        }
    }

    fn undecided(&self, doubt: UndecidedReason) -> (Result<MotionKind, UndecidedReason>, f64) {
        let sign = self.positive.max(1.0 - self.positive);
        (Err(doubt), sign)
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
