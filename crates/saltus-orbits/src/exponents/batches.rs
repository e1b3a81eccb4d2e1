//! The mean of a correlated series, with an error that includes the correlation.

use super::student::{quantile, student};

/// Batches of a series, or a few more of a short one: few and long. Ten to thirty are enough for an interval
/// [Schmeiser 1982], and longer ones average over slower changes.
const BATCHES: usize = 20;

/// Parts of each batch: their own spread shows how fast the error still grows with the length of a batch.
const PARTS: usize = 3;

/// Correlation that is made up for at most: beyond it the record is too short for any error.
const LARGEST: f64 = 0.8;

/// A Lyapunov exponent, or a sum of some, from a finite record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponent {
    /// Mean growth (1 / iterate, natural logarithm); -inf if a direction was ever lost (superstable), 0
    /// before the first iterate.
    pub per_iterate: f64,
    /// Standard error of that (1 / iterate), what rounding does included: infinite if there are fewer than 20
    /// iterates, 0 for -inf.
    pub standard_error: f64,
    /// Number of batches of the error, which has one degree of freedom less; 0 without an error, or if it is none
    /// of chance (from an orbit).
    pub batches: usize,
    /// Iterates in each.
    pub batch_length: usize,
}

impl Exponent {
    /// Probability that the true value is positive, by Student's t with one degree of freedom less
    /// than there are batches. `noise` is the error of the growth itself (1 / iterate), which no record sees.
    pub fn positive(&self, noise: f64) -> f64 {
        if self.per_iterate == f64::NEG_INFINITY {
            return 0.0;
        }
        let error = self.standard_error.hypot(noise);
        let ratio = self.per_iterate / error;
        student(if ratio.is_nan() { 0.0 } else { ratio }, self.freedom())
    }

    /// The interval that holds the true value with a probability of 0.95, by Student's t.
    ///
    /// It does if the record is longer than some tens of times in which the motion forgets where it was;
    /// a slower change is beyond any record.
    pub fn interval(&self) -> [f64; 2] {
        let half = quantile(0.975, self.freedom()) * self.standard_error;
        [self.per_iterate - half, self.per_iterate + half]
    }

    /// Degrees of freedom of its error; as many as matter where chance plays no part.
    fn freedom(&self) -> usize {
        match self.batches {
            0 | 1 => 1000,
            batches => batches - 1,
        }
    }
}

/// The mean of series that belong together, such as pieces of one long trajectory in their order, with its standard
/// error. `noise` is the error of the values themselves.
///
/// All are taken as one series, which is cut into 20 batches; the spread of their means is the error [Flegal & Jones
/// 2010, Annals of Statistics 38, 1034]. What is left of correlations is made up for twice. The variance from
/// batches of a third of the length is the smaller one by what a batch misses, so twice the variance from whole ones
/// less that from thirds misses it no longer [Vats & Flegal 2022, Biometrika 109, 735]. And where neighbouring batches
/// are correlated by r, the error grows by sqrt((1 + r)/(1 - r)), right for a correlation that decays geometrically.
/// The error is too large if growth now makes up for growth before, as on a torus.
pub(super) fn mean(series: &[Vec<f64>], noise: f64) -> Exponent {
    let count: usize = series.iter().map(Vec::len).sum();
    let sum: f64 = series.iter().map(|one| sum(one)).sum();
    let unknown = Exponent {
        per_iterate: if count == 0 { 0.0 } else { sum / count as f64 },
        standard_error: f64::INFINITY,
        batches: 0,
        batch_length: 0,
    };
    if unknown.per_iterate == f64::NEG_INFINITY {
        // lost to rounding it is unknown, else certain
        let standard_error = if noise.is_finite() { 0.0 } else { noise };
        return Exponent {
            standard_error,
            ..unknown
        };
    }
    if count < BATCHES {
        return unknown;
    }
    let parts = if count < PARTS * BATCHES { 1 } else { PARTS };
    let length = count / (parts * BATCHES);
    let means = means(series, length);
    let (thirds, batches) = (Spread::of(&means, 1), Spread::of(&means, parts));
    let variance = (2.0 * batches.variance - thirds.variance).max(batches.variance);
    let chance = variance * batches.for_correlation();
    Exponent {
        standard_error: chance.sqrt().hypot(noise),
        batches: batches.count,
        batch_length: parts * length,
        ..unknown
    }
}

/// The sum in two stages: rounding errors of one long sum of equal terms would add up.
fn sum(series: &[f64]) -> f64 {
    let parts = series.chunks(256).map(|part| part.iter().sum::<f64>());
    parts.sum()
}

/// Means over `length` values each, across the seams of the series; what is left over is left out.
fn means(series: &[Vec<f64>], length: usize) -> Vec<f64> {
    let (mut means, mut sum, mut taken) = (Vec::new(), 0.0, 0);
    for value in series.iter().flatten() {
        sum += value;
        taken += 1;
        if taken == length {
            means.push(sum / length as f64);
            (sum, taken) = (0.0, 0);
        }
    }
    means
}

/// Spread of the means of batches.
struct Spread {
    /// Variance of the mean of all of them, if they were independent.
    variance: f64,
    /// Correlation of neighbours, relative to their variance.
    correlation: f64,
    count: usize,
}

impl Spread {
    /// The spread of batches of `parts` means each.
    fn of(means: &[f64], parts: usize) -> Self {
        let whole = means.chunks_exact(parts);
        let mut means: Vec<f64> = whole
            .map(|one| one.iter().sum::<f64>() / parts as f64)
            .collect();
        let count = means.len();
        let centre = means.iter().sum::<f64>() / count as f64;
        means.iter_mut().for_each(|mean| *mean -= centre);
        let squares: f64 = means.iter().map(|mean| mean * mean).sum();
        let products: f64 = means.windows(2).map(|two| two[0] * two[1]).sum();
        Self {
            variance: squares / (count * (count - 1)) as f64,
            correlation: if squares > 0.0 {
                products / squares
            } else {
                0.0
            },
            count,
        }
    }

    /// Factor by which the correlation of neighbours makes the variance larger, if it is more than half of what chance
    /// makes of none (a standard deviation of 1/sqrt(batches)).
    fn for_correlation(&self) -> f64 {
        let r = self.correlation.min(LARGEST);
        if r > 0.5 / (self.count as f64).sqrt() {
            (1.0 + r) / (1.0 - r)
        } else {
            1.0
        }
    }
}
