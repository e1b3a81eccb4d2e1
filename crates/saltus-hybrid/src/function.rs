//! Elementary functions of one number, and where they are defined.
//!
//! Values come from `libm`, which is Rust throughout: a lane has the bits of a single trajectory, on every machine.

/// Negative numbers down to this are zero to a power that is no whole number: a switch at zero leaves one by rounding.
const ROUNDING: f64 = 1e-9;

/// The least number that such a power is taken of.
const LEAST: f64 = 1e-24;

/// Time that a base must be away from zero by its own rate for its power to have a series: at zero there is none. Until
/// then the power is zero to rounding.
const SHORTLY: f64 = 1e-10;

/// A function y = F(u) that a series follows by y' = g u', g being a quantity of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Function {
    Exp,
    Log,
    Sin,
    Cos,
    Tan,
    Sinh,
    Cosh,
    Tanh,
    Asin,
    Atan,
}

impl Function {
    /// F(u).
    #[inline(never)]
    pub(crate) fn of(self, u: f64) -> f64 {
        match self {
            Self::Exp => libm::exp(u),
            Self::Log => libm::log(u),
            Self::Sin => libm::sin(u),
            Self::Cos => libm::cos(u),
            Self::Tan => libm::tan(u),
            Self::Sinh => libm::sinh(u),
            Self::Cosh => libm::cosh(u),
            Self::Tanh => libm::tanh(u),
            Self::Asin => libm::asin(u),
            Self::Atan => libm::atan(u),
        }
    }

    /// F'(u).
    pub(crate) fn slope(self, u: f64) -> f64 {
        match self {
            Self::Exp => libm::exp(u),
            Self::Log => 1.0 / u,
            Self::Sin => libm::cos(u),
            Self::Cos => -libm::sin(u),
            Self::Tan => 1.0 + libm::tan(u).powi(2),
            Self::Sinh => libm::cosh(u),
            Self::Cosh => libm::sinh(u),
            Self::Tanh => 1.0 - libm::tanh(u).powi(2),
            Self::Asin => 1.0 / (1.0 - u * u).sqrt(),
            Self::Atan => 1.0 / (1.0 + u * u),
        }
    }

    /// Room of `u` before it leaves the domain, and what it is then asked for.
    pub(crate) fn room(self, u: f64) -> Option<(f64, &'static str)> {
        match self {
            Self::Log => Some((u, "the logarithm of")),
            Self::Asin => Some((1.0 - u.abs(), "the inverse sine of")),
            _ => None,
        }
    }
}

/// The base of a power that is no whole number, as its series takes it, from the first two terms of its own: positive,
/// or NaN for a negative one.
pub(crate) fn positive(base: f64, rate: f64) -> f64 {
    if base >= -ROUNDING {
        base.max(LEAST).max(SHORTLY * rate.abs())
    } else {
        f64::NAN
    }
}

/// A power of a base that is [`positive`].
#[inline(never)]
pub(crate) fn power(base: f64, exponent: f64) -> f64 {
    if exponent == 0.5 {
        libm::sqrt(base)
    } else {
        libm::pow(base, exponent)
    }
}

/// Room of a base before it leaves the domain.
pub(crate) fn room_of_base(base: f64, exponent: f64) -> f64 {
    if exponent < 0.0 {
        base
    } else {
        base + ROUNDING
    }
}
