//! The lifetime of chaos, from motions that were watched until they left it or the time was up.
//!
//! Transient chaos ends at a rate that does not depend on how long it has lasted, so in T periods of chaos, all motions
//! together, the number of those that leave it has Poisson's distribution with mean T / lifetime. The interval is the
//! exact one for that mean [Garwood 1936], and the rule of three where none left it [Hanley & Lippman-Hand 1983].

/// Motions watched in chaos.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Survival {
    /// Number of motions.
    pub motions: u32,
    /// Number of those that ended on a stable cycle.
    pub ended: u32,
    /// Forcing periods of chaos, all motions together.
    pub periods: u64,
}

/// Confidence of the interval of a lifetime.
const CONFIDENCE: f64 = 0.95;

impl Survival {
    /// The mean lifetime of the chaos (forcing periods), and its 95 % confidence interval. If no motion ended, both
    /// the lifetime and the upper end are infinite, and the lower end is one-sided: three ends would have been expected
    /// by then.
    pub fn lifetime(&self) -> [f64; 3] {
        let (periods, ended) = (self.periods as f64, self.ended);
        if ended == 0 {
            let least = -(1.0 - CONFIDENCE).ln();
            return [f64::INFINITY, periods / least, f64::INFINITY];
        }
        let tail = 0.5 * (1.0 - CONFIDENCE);
        let (most, least) = (mean(ended, tail), mean(ended - 1, 1.0 - tail));
        [periods / f64::from(ended), periods / most, periods / least]
    }
}

/// The mean at which Poisson's distribution gives `count` or less with this probability.
fn mean(count: u32, probability: f64) -> f64 {
    let below = |mean: f64| {
        let term = |term: &mut f64, k: u32| {
            *term *= if k == 0 { 1.0 } else { mean / f64::from(k) };
            Some(*term)
        };
        (0..=count).scan((-mean).exp(), term).sum::<f64>()
    };
    let (mut low, mut high) = (0.0, 4.0 * f64::from(count) + 20.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if below(middle) > probability {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_are_those_of_tables() {
        // Garwood 1936: 95 % limits of a Poisson mean for counts of 1, 4 and 8
        for (count, low, high) in [(1, 0.0253, 5.572), (4, 1.090, 10.24), (8, 3.454, 15.76)] {
            assert!((mean(count, 0.025) - high).abs() < 5e-4 * high, "{count}");
            assert!((mean(count - 1, 0.975) - low).abs() < 2e-3 * low, "{count}");
        }
    }

    #[test]
    fn no_end_in_so_many_periods_bounds_the_lifetime_from_below() {
        let watched = Survival {
            motions: 8,
            ended: 0,
            periods: 96_000,
        };
        let [mean, low, high] = watched.lifetime();
        // the rule of three: exp(-3) is 0.05
        assert!((low - 32_000.0).abs() < 100.0, "{low}");
        assert_eq!((mean, high), (f64::INFINITY, f64::INFINITY));
        let four = Survival {
            ended: 4,
            ..watched
        };
        let [mean, low, high] = four.lifetime();
        assert_eq!(mean, 24_000.0);
        assert!(low < 9_400.0 && high > 88_000.0, "{low} {high}");
    }
}
