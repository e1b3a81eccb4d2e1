//! Student's distribution, for a whole number of degrees of freedom.

/// P(T <= t) with `freedom` >= 1 degrees of freedom.
///
/// The finite sums of Abramowitz & Stegun (1964), 26.7.3 and 26.7.4, in theta = atan(t / sqrt(freedom)).
pub(super) fn student(t: f64, freedom: usize) -> f64 {
    let theta = (t / (freedom as f64).sqrt()).atan();
    let square = theta.cos() * theta.cos();
    let odd = freedom % 2;
    let (mut term, mut sum) = (1.0, 0.0);
    for k in 0..freedom / 2 {
        sum += term;
        let at = (2 * k + odd) as f64;
        term *= square * (at + 1.0) / (at + 2.0);
    }
    let between = if odd == 1 {
        (theta + theta.sin() * theta.cos() * sum) * std::f64::consts::FRAC_2_PI
    } else {
        theta.sin() * sum
    };
    f64::midpoint(1.0, between).clamp(0.0, 1.0)
}

/// The t with P(T <= t) = `probability`, from 0.5 to 0.999 999, to ten digits: by halving.
pub(super) fn quantile(probability: f64, freedom: usize) -> f64 {
    let (mut low, mut high) = (0.0, 1e6);
    while high - low > 1e-10 * high {
        let middle = f64::midpoint(low, high);
        if student(middle, freedom) < probability {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::midpoint(low, high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Abramowitz & Stegun, table 26.10: P(T <= t) = 0.975 and 0.9995.
    #[test]
    fn quantiles_are_those_of_the_tables() {
        for (freedom, t, probability) in [
            (1, 12.706, 0.975),
            (2, 4.303, 0.975),
            (3, 12.924, 0.9995),
            (19, 2.093, 0.975),
            (20, 3.850, 0.9995),
            (120, 1.980, 0.975),
        ] {
            // three decimals of t
            let error = (student(t, freedom) - probability).abs();
            assert!(error < 2e-5, "{freedom}: {error}");
            let found = quantile(probability, freedom);
            assert!((found - t).abs() < 1e-3, "{freedom}: {found}");
            assert!((student(t, freedom) + student(-t, freedom) - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn the_ends_and_many_degrees_of_freedom_are_no_trouble() {
        assert_eq!(student(f64::INFINITY, 7), 1.0);
        assert_eq!(student(f64::NEG_INFINITY, 8), 0.0);
        // the normal distribution at two standard deviations; Student's differs by 0.07 / freedom or so
        assert!((student(2.0, 100_000) - 0.977_249_868).abs() < 2e-6);
    }
}
