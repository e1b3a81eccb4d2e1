//! Weighted Birkhoff averages: on a torus they converge faster than any power of the number of iterates.

/// A mean with weights exp(-1/(t(1 - t))), t in (0, 1) along the record, and how far its two halves agree.
///
/// Along a smooth quasi-periodic motion the error falls faster than any power of the length, in chaos like
/// 1/sqrt(length) as for the plain mean [Das, Sander, Saiki & Yorke 2017, Nonlinearity 30, 4111]; the digits
/// in which two halves agree tell one from the other [Sander & Meiss 2020, Physica D 411, 132569].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weighted {
    /// The mean over the whole record (1 / iterate).
    pub mean: f64,
    /// Difference between the means over its first and its second half; the largest of several records.
    /// Infinite if a record has fewer than two iterates.
    pub difference: f64,
}

impl Weighted {
    /// Decimal digits behind the point in which the halves agree; at most 16, at least 0.
    pub fn digits(&self) -> f64 {
        (-self.difference.log10()).clamp(0.0, 16.0)
    }
}

/// The average over independent series: the mean of their means by their lengths.
pub(super) fn weighted(series: &[Vec<f64>]) -> Weighted {
    let count: usize = series.iter().map(Vec::len).sum();
    let parts = series.iter().map(|one| average(one) * one.len() as f64);
    let mean = parts.sum::<f64>() / count.max(1) as f64;
    let difference = series.iter().map(|one| halves(one));
    Weighted {
        mean,
        difference: difference.fold(if count == 0 { f64::INFINITY } else { 0.0 }, f64::max),
    }
}

fn halves(series: &[f64]) -> f64 {
    if series.len() < 2 {
        return f64::INFINITY;
    }
    let (first, second) = series.split_at(series.len() / 2);
    let (first, second) = (average(first), average(second));
    // two superstable halves agree
    if first == second {
        0.0
    } else {
        (first - second).abs()
    }
}

fn average(series: &[f64]) -> f64 {
    if series.contains(&f64::NEG_INFINITY) {
        return f64::NEG_INFINITY;
    }
    let (mut sum, mut weights) = (0.0, 0.0);
    for (k, value) in series.iter().enumerate() {
        let t = (k as f64 + 0.5) / series.len() as f64;
        let weight = (-1.0 / (t * (1.0 - t))).exp();
        sum += weight * value;
        weights += weight;
    }
    if series.is_empty() {
        0.0
    } else {
        sum / weights
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turning_phase_is_averaged_to_ten_digits_where_the_plain_mean_has_four() {
        let turn = |k: usize| (std::f64::consts::TAU * k as f64 * 0.618_033_988_749_895).sin();
        let series: Vec<f64> = (0..10_000).map(|k| turn(k).exp()).collect();
        // the modified Bessel function I_0(1)
        let exact = 1.266_065_877_752_008;
        let plain = series.iter().sum::<f64>() / 1e4;
        let found = weighted(&[series]);
        assert!((found.mean - exact).abs() < 1e-10, "{}", found.mean - exact);
        assert!((plain - exact).abs() > 1e-5);
        assert!(found.digits() > 10.0);
    }

    #[test]
    fn records_too_short_to_halve_agree_in_no_digit() {
        assert_eq!(weighted(&[]).digits(), 0.0);
        assert_eq!(
            weighted(&[vec![1.0]]),
            Weighted {
                mean: 1.0,
                difference: f64::INFINITY
            }
        );
        assert_eq!(weighted(&[vec![f64::NEG_INFINITY; 4]]).difference, 0.0);
    }
}
