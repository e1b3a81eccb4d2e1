//! A share of starts, and how well it is known.

use crate::Range;

/// `count` of `of` starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BasinFraction {
    /// Number of starts that did.
    pub count: u64,
    /// Number of all starts.
    pub of: u64,
}

/// Quantile of the normal distribution for 95 % between both tails.
const QUANTILE: f64 = 1.959_963_984_540_054;

impl BasinFraction {
    /// The share; 0 of none.
    pub fn value(self) -> f64 {
        self.count as f64 / self.of.max(1) as f64
    }

    /// 95 % confidence interval of the probability behind it: Wilson's score interval [Wilson 1927], which, unlike
    /// the share plus or minus its deviation, is of use near 0 and 1 too. It holds for independent starts. Starts
    /// spread evenly ([`Starts`](crate::Starts)) give shares that are closer as a rule, so it is conservative.
    pub fn interval(self) -> Range {
        if self.of == 0 {
            return [0.0, 1.0];
        }
        let (n, p) = (self.of as f64, self.value());
        let widening = QUANTILE * QUANTILE / n;
        let centre = p + widening / 2.0;
        let half = (widening * (p * (1.0 - p) + widening / 4.0)).sqrt();
        [centre - half, centre + half].map(|end| (end / (1.0 + widening)).clamp(0.0, 1.0))
    }

    /// The largest probability that `of` independent starts miss with more than 5 %: 3/`of`, the "rule of
    /// three" [Hanley & Lippman-Hand 1983]. An attractor that no start met has, with 95 % confidence, a basin
    /// with a smaller part of the box.
    pub fn unseen(of: u64) -> f64 {
        (3.0 / of as f64).min(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_solves_wilsons_equation() {
        for (count, of) in [(81, 263), (15, 148), (0, 20), (1, 29), (29, 29)] {
            let share = BasinFraction { count, of };
            for end in share.interval() {
                // (p - end)^2 = z^2 end (1 - end) / n, with p and end between 0 and 1
                let left = (share.value() - end).powi(2);
                let right = QUANTILE.powi(2) * end * (1.0 - end) / of as f64;
                assert!((left - right).abs() < 1e-15, "{count} of {of}");
            }
        }
    }

    #[test]
    fn the_interval_is_the_published_one() {
        // Newcombe 1998, Table I, method 3: 81 of 263 and 15 of 148, to its four digits
        for ((count, of), ends) in [((81, 263), [0.2553, 0.3662]), ((15, 148), [0.0624, 0.1605])] {
            let found = BasinFraction { count, of }.interval();
            for (found, end) in found.iter().zip(ends) {
                assert!((found - end).abs() < 5e-5, "{count} of {of}: {found}");
            }
        }
    }

    #[test]
    fn no_starts_say_nothing() {
        let none = BasinFraction { count: 0, of: 0 };
        assert_eq!((none.value(), none.interval()), (0.0, [0.0, 1.0]));
        assert_eq!(BasinFraction::unseen(0), 1.0);
    }

    #[test]
    fn three_in_n_is_missed_by_one_run_in_twenty() {
        for of in [30_u64, 300, 3000] {
            let missed = (1.0 - BasinFraction::unseen(of)).powi(of as i32);
            // e^-3 is 0.0498, and (1 - x)^n stays below e^(-xn)
            assert!((0.04..0.05).contains(&missed), "{of}: {missed}");
        }
    }
}
