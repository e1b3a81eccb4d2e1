//! Axes: from data in the user's units to pixels, with ticks a person reads without effort.
//!
//! Errors and small amplitudes span many orders of magnitude, so an axis is measured in units of its own: decades, or
//! values divided by a power of ten that the label states.

use super::lettering::printable;

/// An axis: its label, limits and whether it shows decades.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    pub(crate) label: String,
    pub(crate) range: Option<(f64, f64)>,
    pub(crate) logarithmic: bool,
}

impl Axis {
    /// An axis with a label that carries its unit, as "Velocity (m/s)"; limits follow the data. Symbols stand between
    /// two `$`, as in "Damping ratio $ζ_h$"; the unit (-) of a pure number is not shown.
    pub fn new(label: impl Into<String>) -> Self {
        let label: String = label.into();
        Self {
            label: label.strip_suffix(" (-)").unwrap_or(&label).to_owned(),
            range: None,
            logarithmic: false,
        }
    }

    /// Fixed limits; data outside is not drawn. Limits that are not finite are ignored.
    #[must_use]
    pub fn range(mut self, low: f64, high: f64) -> Self {
        self.range =
            (low.is_finite() && high.is_finite()).then_some((low.min(high), low.max(high)));
        self
    }

    /// Whether the axis has a place for `value`.
    pub(crate) fn admits(&self, value: f64) -> bool {
        value.is_finite() && (!self.logarithmic || value > 0.0)
    }

    /// Decades at equal distances; values at or below zero are not drawn.
    #[must_use]
    pub fn logarithmic(mut self) -> Self {
        self.logarithmic = true;
        self
    }
}

/// The finite values seen so far along one axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    low: f64,
    high: f64,
}

impl Extent {
    pub(crate) const EMPTY: Self = Self {
        low: f64::INFINITY,
        high: f64::NEG_INFINITY,
    };

    pub(crate) fn include(&mut self, axis: &Axis, value: f64) {
        if axis.admits(value) {
            self.low = self.low.min(value);
            self.high = self.high.max(value);
        }
    }

    /// The values of both.
    pub(crate) fn with(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    /// A single value where all agree to [`NOISE`]: colours from end to end would magnify rounding.
    pub(crate) fn unless_noise(self) -> Self {
        let middle = f64::midpoint(self.low, self.high);
        if self.high - self.low > NOISE * middle.abs() {
            return self;
        }
        Self {
            low: middle,
            high: middle,
        }
    }

    /// The least and the largest value; `None` if there were none.
    pub(crate) fn limits(self) -> Option<(f64, f64)> {
        (self.low <= self.high).then_some((self.low, self.high))
    }
}

/// A tick: its number in multiples of the step, its place and its text.
#[derive(Clone, Debug)]
pub(crate) struct Tick {
    pub(crate) number: i64,
    pub(crate) pixel: f64,
    pub(crate) text: String,
}

/// A resolved axis: data to axis units (decades, or multiples of `unit`) to pixels.
#[derive(Clone, Debug)]
pub(crate) struct Scale {
    /// Lower limit in axis units.
    pub(crate) low: f64,
    /// Upper limit in axis units.
    pub(crate) high: f64,
    /// Distance of ticks in axis units.
    pub(crate) step: f64,
    /// Power of ten that one axis unit stands for; 0 on a logarithmic axis.
    exponent: i32,
    logarithmic: bool,
    /// Pixel of `low`, and pixels per axis unit.
    origin: f64,
    slope: f64,
}

/// Relative difference of values that a map shows as equal.
const NOISE: f64 = 1e-5;
/// Largest magnitude drawn; beyond it differences overflow.
const LARGEST: f64 = 1e300;
/// Magnitudes below this are drawn as zero: their differences are subnormal.
const SMALLEST: f64 = 1e-290;

impl Scale {
    /// Limits from the axis or else from `extents` widened by the fraction `pad`; about `ticks` ticks.
    pub(crate) fn resolve(axis: &Axis, mut extent: Extent, pad: f64, ticks: usize) -> Self {
        if let Some((low, high)) = axis.range {
            extent = Extent { low, high };
        }
        let pad = if axis.range.is_some() { 0.0 } else { pad };
        let mut scale = if axis.logarithmic {
            Self::decades(extent, pad)
        } else {
            Self::linear(extent, pad)
        };
        scale.step = if axis.logarithmic {
            ((scale.high - scale.low) / 8.0).ceil().max(1.0)
        } else {
            tick_step((scale.high - scale.low) / ticks.max(2) as f64)
        };
        scale
    }

    fn linear(extent: Extent, pad: f64) -> Self {
        let (low, high) = sensible(extent);
        let widen = pad * (high - low);
        let (low, high) = (low - widen, high + widen);
        let exponent = shown_exponent(low.abs().max(high.abs()));
        let unit = 10f64.powi(exponent);
        Self::new(low / unit, high / unit, exponent, false)
    }

    fn decades(extent: Extent, pad: f64) -> Self {
        let usable = extent.low > 0.0 && extent.high >= extent.low;
        let (low, high) = if usable {
            (extent.low.log10(), extent.high.log10())
        } else {
            (-1.0, 0.0)
        };
        let widen = pad * (high - low);
        let (mut low, mut high) = (low - widen, high + widen);
        // Ticks stand at whole decades: fewer than two of them say nothing.
        if high.floor() - low.ceil() < 1.0 {
            (low, high) = (low.floor(), high.ceil().max(low.floor() + 1.0));
        }
        Self::new(low, high, 0, true)
    }

    fn new(low: f64, high: f64, exponent: i32, logarithmic: bool) -> Self {
        Self {
            low,
            high,
            step: 1.0,
            exponent,
            logarithmic,
            origin: 0.0,
            slope: 1.0,
        }
    }

    /// The plain scale from 0 to 1.
    pub(crate) fn of_unit() -> Self {
        Self::new(0.0, 1.0, 0, false)
    }

    /// Ties `low` and `high` to two pixels.
    pub(crate) fn between(mut self, low_px: f64, high_px: f64) -> Self {
        self.slope = (high_px - low_px) / (self.high - self.low);
        self.origin = low_px;
        self
    }

    /// Value to axis units; `None` where the axis has no place for it.
    fn units(&self, value: f64) -> Option<f64> {
        let units = if self.logarithmic {
            value.log10()
        } else {
            value / 10f64.powi(self.exponent)
        };
        (value.is_finite() && units.is_finite()).then_some(units)
    }

    /// Value to pixel; `None` for a value that is not finite or has no logarithm.
    pub(crate) fn pixel(&self, value: f64) -> Option<f64> {
        self.units(value)
            .map(|units| self.at(units))
            .filter(|pixel| pixel.is_finite())
    }

    /// The label, with the power of ten that the ticks leave out.
    pub(crate) fn label(&self, axis: &Axis) -> String {
        let label = printable(&axis.label);
        if self.exponent == 0 {
            return label;
        }
        let power = power(self.exponent);
        match label
            .strip_suffix(')')
            .and_then(|label| label.rsplit_once('('))
        {
            Some((quantity, unit)) => format!("{quantity}({power} {unit})"),
            None => format!("{label} ({power})"),
        }
    }

    /// The ticks within the limits.
    pub(crate) fn ticks(&self) -> Vec<Tick> {
        // A tick at a limit must not be lost to rounding.
        let hair = 1e-9 * (self.high - self.low) / self.step;
        let first = (self.low / self.step - hair).ceil() as i64;
        let last = (self.high / self.step + hair).floor() as i64;
        let tick = |number: i64| {
            let units = number as f64 * self.step;
            Tick {
                number,
                pixel: self.at(units),
                text: self.tick(units),
            }
        };
        (first..=last.min(first + 50)).map(tick).collect()
    }

    /// Pixels of the ticks without numbers: two to nine times each power of ten.
    pub(crate) fn minor(&self) -> Vec<f64> {
        if !self.logarithmic || self.step > 1.0 {
            return Vec::new();
        }
        let decades = self.low.floor() as i32..=self.high.ceil() as i32;
        let between = |decade: i32| (2..10).map(move |n| f64::from(decade) + f64::from(n).log10());
        let inside = |units: &f64| (self.low..=self.high).contains(units);
        let units = decades.flat_map(between).filter(inside);
        units.map(|units| self.at(units)).collect()
    }

    /// Axis units to pixel.
    fn at(&self, units: f64) -> f64 {
        self.origin + (units - self.low) * self.slope
    }

    /// The text at a tick: all with the same number of decimals, or as powers of ten.
    fn tick(&self, units: f64) -> String {
        if self.logarithmic {
            return power(units.round() as i32);
        }
        let decimals = decimals(self.step);
        let text = format!("{units:.decimals$}");
        // A true minus sign is as wide as a plus and does not read as a hyphen; zero has none.
        match text.strip_prefix('-') {
            Some(rest) if rest.chars().all(|c| "0.".contains(c)) => rest.to_owned(),
            Some(rest) => format!("\u{2212}{rest}"),
            None => text,
        }
    }

    /// Position of `value` between the limits, as a share: 0 is `low`, 1 is `high`.
    pub(crate) fn share(&self, value: f64) -> Option<f64> {
        self.units(value)
            .map(|units| (units - self.low) / (self.high - self.low))
    }
}

/// Limits that can carry an axis, also for no data, constant data and absurdly large data.
fn sensible(extent: Extent) -> (f64, f64) {
    if extent.low > extent.high {
        return (0.0, 1.0);
    }
    let (low, high) = (
        extent.low.clamp(-LARGEST, LARGEST),
        extent.high.clamp(-LARGEST, LARGEST),
    );
    let size = low.abs().max(high.abs());
    // A span at the level of rounding is noise on a constant, not a range.
    if high - low > 1e-11 * size && size >= SMALLEST {
        return (low, high);
    }
    let half = if size < SMALLEST { 1.0 } else { 0.1 * size };
    (low - half, high + half)
}

/// Power of ten to take out of the tick labels: none between 0.01 and 100 000, else a multiple of 3.
fn shown_exponent(size: f64) -> i32 {
    if size == 0.0 || (1e-2..1e5).contains(&size) {
        return 0;
    }
    (size.log10() / 3.0).floor() as i32 * 3
}

/// Decimals that write multiples of `step` without loss.
fn decimals(step: f64) -> usize {
    (0..12)
        .find(|&d| {
            let scaled = step * 10f64.powi(d as i32);
            scaled >= 0.5 && (scaled - scaled.round()).abs() < 1e-6
        })
        .unwrap_or(12)
}

/// A power of ten with its exponent raised.
fn power(exponent: i32) -> String {
    let sign = if exponent < 0 { "\u{2212}" } else { "" };
    format!("$10^{{{sign}{}}}$", exponent.unsigned_abs())
}

/// The distance of ticks nearest to `rough` that reads well: 1, 2 or 5 times a power of ten.
fn tick_step(rough: f64) -> f64 {
    let decade = 10f64.powi(rough.log10().floor() as i32);
    let nearest = match rough / decade {
        share if share < 1.5 => 1.0,
        share if share < 3.5 => 2.0,
        share if share < 7.5 => 5.0,
        _ => 10.0,
    };
    nearest * decade
}

#[cfg(test)]
mod tests {
    use super::*;

    fn resolved(axis: &Axis, values: &[f64]) -> Scale {
        let mut extent = Extent::EMPTY;
        values.iter().for_each(|&value| extent.include(axis, value));
        Scale::resolve(axis, extent, 0.05, 5).between(0.0, 100.0)
    }

    #[test]
    fn nothing_constant_and_huge_data_get_a_range() {
        let axis = Axis::new("x");
        let cases: [&[f64]; 6] = [
            &[],
            &[f64::NAN, f64::INFINITY],
            &[3.0, 3.0],
            &[0.0],
            &[-1.7e308, 1.7e308],
            &[4e-320],
        ];
        for values in cases {
            let scale = resolved(&axis, values);
            assert!(
                scale.low < scale.high && scale.step > 0.0,
                "{values:?}: {scale:?}"
            );
            assert!((scale.high - scale.low).is_finite());
        }
    }

    #[test]
    fn tiny_data_keep_their_shape_and_the_label_says_the_unit() {
        let axis = Axis::new("w (m)");
        let scale = resolved(&axis, &[1e-20, 9e-20]);
        let middle = scale.pixel(5e-20).expect("finite");
        assert!((middle - 50.0).abs() < 1e-6, "{middle}");
        assert_eq!(scale.label(&axis), "w ($10^{\u{2212}21}$ m)");
    }

    #[test]
    fn a_logarithmic_axis_reaches_below_1e_10() {
        let axis = Axis::new("error").logarithmic();
        let scale = resolved(&axis, &[1e-15, 1.0, -1.0, 0.0]);
        let at = |value| scale.pixel(value).expect("positive");
        assert!(((at(1e-12) - at(1e-15)) / (at(1.0) - at(1e-15)) - 0.2).abs() < 1e-12);
        assert_eq!((scale.pixel(-1.0), scale.pixel(0.0)), (None, None));
    }

    #[test]
    fn ticks_share_their_decimals() {
        assert_eq!(decimals(0.25), 2);
        assert_eq!(decimals(5.0), 0);
        assert_eq!(decimals(0.001), 3);
        assert_eq!(power(-12), "$10^{\u{2212}12}$");
        assert_eq!([0.11, 0.24, 0.4, 8.0].map(tick_step), [0.1, 0.2, 0.5, 10.0]);
    }
}
