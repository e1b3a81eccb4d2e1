//! Exact integrals over [0, 1] of products of sin(k pi x) and cos(k pi x) with whole k.
//!
//! Product-to-sum: a product of N factors is the mean, over the 2^(N-1) choices of the signs of
//! all wave numbers but the first, of ± cos(K pi x) (even number of sines) or ± sin(K pi x) (odd),
//! with K the signed sum of the wave numbers. Then
//! ∫ cos(K pi x) = 1 if K = 0 else 0, and ∫ sin(K pi x) = 2/(K pi) for odd K else 0.

use std::f64::consts::PI;

/// One factor, with its number of half-waves over [0, 1].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Trig {
    /// sin(k pi x)
    Sin(u32),
    /// cos(k pi x)
    Cos(u32),
}

impl Trig {
    /// Number of half-waves.
    pub(super) fn wave_number(self) -> u32 {
        match self {
            Self::Sin(k) | Self::Cos(k) => k,
        }
    }

    /// The other one: d/dx sin(k pi x) = k pi cos(k pi x), d/dx cos(k pi x) = -k pi sin(k pi x).
    pub(super) fn derivative(self) -> (f64, Self) {
        match self {
            Self::Sin(k) => (PI * f64::from(k), Self::Cos(k)),
            Self::Cos(k) => (-PI * f64::from(k), Self::Sin(k)),
        }
    }
}

/// ∫_0^1 of the product of all `factors`; exactly 0.0 where it vanishes by orthogonality.
pub(super) fn integral(factors: &[Trig]) -> f64 {
    let sines = factors.iter().filter(|f| matches!(f, Trig::Sin(_))).count();
    let waves: u64 = factors.iter().map(|f| u64::from(f.wave_number())).sum();
    // every K has the parity of the sum of the wave numbers
    if waves % 2 != sines as u64 % 2 {
        return 0.0;
    }
    let choices = 1_u64 << factors.len().saturating_sub(1);
    // i^-s from the s sines: cos, sin, -cos, -sin, cos, ...
    let sign = if sines / 2 % 2 == 0 { 1.0 } else { -1.0 };
    let sum = if sines % 2 == 0 {
        cosine_sum(factors, choices)
    } else {
        sine_sum(factors, choices)
    };
    sign * sum / choices as f64
}

/// Signed wave number K and the product of the signs of the sines, for one choice of signs.
fn signed_sum(factors: &[Trig], choice: u64) -> (i64, i64) {
    let (mut wave, mut sign) = (0, 1);
    for (position, factor) in factors.iter().enumerate() {
        let k = i64::from(factor.wave_number());
        // choice << 1: the first factor keeps its sign
        if (choice << 1) >> position & 1 == 0 {
            wave += k;
        } else {
            wave -= k;
            if matches!(factor, Trig::Sin(_)) {
                sign = -sign;
            }
        }
    }
    (wave, sign)
}

fn cosine_sum(factors: &[Trig], choices: u64) -> f64 {
    let sum: i64 = (0..choices)
        .map(|choice| signed_sum(factors, choice))
        .filter(|&(wave, _)| wave == 0)
        .map(|(_, sign)| sign)
        .sum();
    sum as f64
}

fn sine_sum(factors: &[Trig], choices: u64) -> f64 {
    // equal |K| are counted before anything is divided, so that they cancel exactly
    let mut counts: Vec<(i64, i64)> = Vec::with_capacity(choices as usize);
    for choice in 0..choices {
        let (wave, sign) = signed_sum(factors, choice);
        let (wave, sign) = (wave.abs(), sign * wave.signum());
        match counts.iter_mut().find(|(known, _)| *known == wave) {
            Some((_, count)) => *count += sign,
            None => counts.push((wave, sign)),
        }
    }
    counts
        .iter()
        .filter(|&&(_, count)| count != 0)
        .map(|&(wave, count)| 2.0 * count as f64 / (PI * wave as f64))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::{Trig, Trig::Cos, Trig::Sin, integral};
    use crate::quadrature::GaussLegendre;
    use proptest::prelude::*;
    use std::f64::consts::PI;

    #[test]
    fn textbook_integrals() {
        assert_eq!(integral(&[]), 1.0);
        assert_eq!(integral(&[Cos(0)]), 1.0);
        assert_eq!(integral(&[Sin(0)]), 0.0);
        assert_eq!(integral(&[Sin(3), Sin(3)]), 0.5);
        assert_eq!(integral(&[Cos(0), Cos(0)]), 1.0);
        assert_eq!(integral(&[Sin(2), Cos(2)]), 0.0);
        assert_eq!(integral(&[Sin(1); 4]), 0.375);
        assert_eq!(integral(&[Cos(1), Cos(1), Sin(1), Sin(1)]), 0.125);
        assert!((integral(&[Sin(1); 3]) - 4.0 / (3.0 * PI)).abs() < 1e-16);
    }

    #[test]
    fn sine_times_cosine_of_the_same_wave_under_a_sine_cancels_exactly() {
        // sin a cos b with a = b contains K = 0, which must not be divided by
        assert_eq!(integral(&[Sin(1), Cos(1), Cos(2)]), 0.0);
        assert_eq!(integral(&[Sin(0), Cos(5)]), 0.0);
    }

    fn value(factor: Trig, x: f64) -> f64 {
        match factor {
            Sin(k) => (PI * f64::from(k) * x).sin(),
            Cos(k) => (PI * f64::from(k) * x).cos(),
        }
    }

    /// Up to five factors.
    fn products() -> impl Strategy<Value = Vec<Trig>> {
        proptest::collection::vec(factor(), 0..6)
    }

    fn factor() -> impl Strategy<Value = Trig> {
        (0_u32..9, any::<bool>()).prop_map(|(k, sine)| if sine { Sin(k) } else { Cos(k) })
    }

    proptest! {
        #[test]
        fn any_product_agrees_with_quadrature(factors in products()) {
            // 64 nodes resolve 45 half-waves to rounding
            let rule = GaussLegendre::new(64);
            let expected =
                rule.integrate(0.0, 1.0, |x| factors.iter().map(|&f| value(f, x)).product::<f64>());
            prop_assert!((integral(&factors) - expected).abs() < 2e-14);
        }
    }
}
