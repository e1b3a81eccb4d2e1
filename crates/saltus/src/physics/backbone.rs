//! The backbone of a plate in one mode: how its free frequency grows with amplitude.
//!
//! With x = r/h and the in-plane terms following statically, M r'' + K_b r + 4 Q_eff r^3 = 0 is
//! x'' + omega^2 (x + eps x^3) = 0, Duffing's equation.

use super::{ModeSet, PhysicsError, Plate};

/// x'' + omega^2 (x + eps x^3) = 0 with x = r/h.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OneMode {
    /// Linear frequency omega (rad/s).
    pub omega: f64,
    /// eps = 4 Q_eff h^2/K_b (-).
    pub cubic: f64,
}

impl Plate {
    /// The first term of the list w alone, with all in-plane terms.
    ///
    /// # Errors
    /// Those of [`Plate::elasticity`].
    pub fn one_mode(&self) -> Result<OneMode, PhysicsError> {
        let w = self.modes.w.first().copied().into_iter().collect();
        let plate = Self {
            modes: ModeSet {
                w,
                ..self.modes.clone()
            },
            ..self.clone()
        };
        let elasticity = plate.elasticity()?;
        // Q_eff r^4 at r = 1 m
        let quartic = elasticity.condensed_stretching(&[1.0]);
        let bending = elasticity.bending[0];
        Ok(OneMode {
            omega: (bending / elasticity.transverse_mass).sqrt(),
            cubic: 4.0 * quartic * self.thickness.powi(2) / bending,
        })
    }
}

impl OneMode {
    /// omega(A)/omega by harmonic balance, sqrt(1 + 3/4 eps A^2); `amplitude` A is in thicknesses.
    pub fn harmonic_balance_ratio(&self, amplitude: f64) -> f64 {
        (1.0 + 0.75 * self.cubic * amplitude.powi(2)).sqrt()
    }

    /// omega(A)/omega, exact; `amplitude` A is in thicknesses.
    ///
    /// The period is 4 K(m)/sqrt(1 + eps A^2) with m = eps A^2/(2 (1 + eps A^2)), and
    /// K(m) = pi/(2 agm(1, sqrt(1 - m))) (Abramowitz & Stegun 17.6.3), so the ratio is
    /// agm(sqrt(1 + eps A^2), sqrt(1 + eps A^2/2)).
    pub fn exact_ratio(&self, amplitude: f64) -> f64 {
        let stiffening = self.cubic * amplitude.powi(2);
        arithmetic_geometric_mean((1.0 + stiffening).sqrt(), (1.0 + stiffening / 2.0).sqrt())
    }
}

/// agm(a, b) of two positive numbers whose ratio is at most sqrt(2): the error squares in every
/// round, so five are more than rounding needs.
fn arithmetic_geometric_mean(mut a: f64, mut b: f64) -> f64 {
    for _ in 0..5 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};

    #[test]
    fn mean_of_one_and_root_two_is_gauss_constant() {
        // Gauss's constant 1/agm(1, sqrt 2), OEIS A014549
        let gauss = 0.834_626_841_674_073_2;
        assert!((1.0 / arithmetic_geometric_mean(1.0, SQRT_2) - gauss).abs() < 2e-16);
    }

    #[test]
    fn exact_ratio_is_the_period_integral() {
        // quarter period ∫_0^(pi/2) dθ/sqrt(1 + eps A^2 (1 + sin^2 θ)/2), from energy conservation
        // with x = A sin θ; the midpoint rule converges geometrically on a periodic integrand
        for stiffening in [0.0_f64, 0.1, 1.31625, 40.0] {
            let points = 200;
            let sum: f64 = (0..points)
                .map(|i| FRAC_PI_2 * (f64::from(i) + 0.5) / f64::from(points))
                .map(|angle| 1.0 / (1.0 + stiffening * (1.0 + angle.sin().powi(2)) / 2.0).sqrt())
                .sum();
            let quarter = FRAC_PI_2 * sum / f64::from(points);
            let one = OneMode {
                omega: 1.0,
                cubic: stiffening,
            };
            assert!(
                (one.exact_ratio(1.0) - PI / (2.0 * quarter)).abs() < 1e-14 * (1.0 + stiffening)
            );
        }
    }

    #[test]
    fn both_backbones_agree_for_small_amplitudes() {
        let one = OneMode {
            omega: 1.0,
            cubic: 1.3,
        };
        // they differ from the second power of eps A^2 on: 1.3^2/128 A^4 and less
        for amplitude in [0.0, 0.01, 0.1] {
            let difference = one.exact_ratio(amplitude) - one.harmonic_balance_ratio(amplitude);
            assert!(difference.abs() <= 0.02 * amplitude.powi(4) + 1e-16);
        }
    }
}
