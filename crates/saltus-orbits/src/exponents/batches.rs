//! The mean of a correlated series, with an error that is honest about the correlation.

use super::student::student;

/// Batches at least: fewer say too little about their own spread.
const BATCHES: usize = 20;

/// A Lyapunov exponent, or a sum of some, from a finite record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponent {
    /// Mean growth (1 / iterate, natural logarithm); -inf if a direction was ever lost (superstable), 0
    /// before the first iterate.
    pub per_iterate: f64,
    /// Standard error of that (1 / iterate): infinite if there are fewer than 20 iterates, 0 for -inf.
    pub standard_error: f64,
    /// How many batches it is from; 0 where there is no error.
    pub batches: usize,
    /// Iterates in each.
    pub batch_length: usize,
}

impl Exponent {
    /// How probable it is that the true value is positive, by Student's t with one degree of freedom less
    /// than there are batches. `noise` is the error of the growth itself (1 / iterate), which no record sees.
    pub fn positive(&self, noise: f64) -> f64 {
        if self.batches < 2 {
            return if self.per_iterate == f64::NEG_INFINITY {
                0.0
            } else {
                0.5
            };
        }
        let error = self.standard_error.hypot(noise);
        let ratio = self.per_iterate / error;
        student(if ratio.is_nan() { 0.0 } else { ratio }, self.batches - 1)
    }
}

/// The mean of independent series with its standard error.
///
/// The series are cut into batches, each sqrt(length) long, and the spread of their means is the error
/// [Flegal & Jones 2010, Annals of Statistics 38, 1034]. Batches double as long as neighbours are correlated by more
/// than chance (one standard deviation, 1/sqrt(batches)) and 20 are left. Where correlation r stays, the error
/// grows by sqrt((1 + r)/(1 - r)), which is right for a correlation that decays geometrically. Where growth now
/// makes up for growth before, as on a torus or in the logistic map at r = 4, the error is too large.
pub(super) fn mean(series: &[Vec<f64>]) -> Exponent {
    let count: usize = series.iter().map(Vec::len).sum();
    let sum: f64 = series.iter().map(|one| sum(one)).sum();
    let unknown = Exponent {
        per_iterate: if count == 0 { 0.0 } else { sum / count as f64 },
        standard_error: f64::INFINITY,
        batches: 0,
        batch_length: 0,
    };
    if unknown.per_iterate == f64::NEG_INFINITY {
        return Exponent {
            standard_error: 0.0,
            ..unknown
        };
    }
    if count_of(series, 1) < BATCHES {
        return unknown;
    }
    let mut length = (count / series.len()).isqrt().max(1);
    while count_of(series, length) < BATCHES {
        length -= 1;
    }
    let mut spread = Spread::of(series, length);
    while spread.is_correlated() && count_of(series, 2 * length) >= BATCHES {
        length *= 2;
        spread = Spread::of(series, length);
    }
    Exponent {
        standard_error: spread.standard_error(),
        batches: spread.batches,
        batch_length: length,
        ..unknown
    }
}

/// In two stages: rounding errors of one long sum of equal terms would add up.
fn sum(series: &[f64]) -> f64 {
    let parts = series.chunks(256).map(|part| part.iter().sum::<f64>());
    parts.sum()
}

fn count_of(series: &[Vec<f64>], length: usize) -> usize {
    series.iter().map(|one| one.len() / length).sum()
}

/// How the means of batches differ.
struct Spread {
    batches: usize,
    variance: f64,
    /// Of neighbours in one series.
    correlation: f64,
}

impl Spread {
    fn of(series: &[Vec<f64>], length: usize) -> Self {
        let mean_of = |batch: &[f64]| batch.iter().sum::<f64>() / length as f64;
        let means = |one: &Vec<f64>| one.chunks_exact(length).map(mean_of).collect();
        let mut means: Vec<Vec<f64>> = series.iter().map(means).collect();
        let batches = count_of(series, length);
        let centre = means.iter().flatten().sum::<f64>() / batches as f64;
        means.iter_mut().flatten().for_each(|mean| *mean -= centre);
        let squares: f64 = means.iter().flatten().map(|mean| mean * mean).sum();
        let products = means
            .iter()
            .flat_map(|one| one.windows(2))
            .map(|two| two[0] * two[1]);
        let correlation = products.sum::<f64>() / squares;
        Self {
            batches,
            variance: squares / (batches - 1) as f64,
            correlation: if squares > 0.0 { correlation } else { 0.0 },
        }
    }

    fn is_correlated(&self) -> bool {
        self.correlation > (self.batches as f64).sqrt().recip()
    }

    fn standard_error(&self) -> f64 {
        let r = if self.is_correlated() {
            self.correlation
        } else {
            0.0
        };
        (self.variance / self.batches as f64 * (1.0 + r) / (1.0 - r)).sqrt()
    }
}
