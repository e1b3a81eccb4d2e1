//! The record of stretching factors, and the exponents that follow from it.

use super::ExponentError;
use super::batches::{self, Exponent};
use super::birkhoff::{self, Weighted};
use super::orthonormal::{longest, orthonormalise};
use crate::Orbit;

/// Points of [`Spectrum::convergence`] at most.
const POINTS: usize = 150;

/// Columns that part by more than the first in one go (ln of the ratio of what is left of them) leave too little of
/// the shorter ones. Parts of a period are cut for the second: rounding then costs some five units.
const APART: f64 = 8.0;
const AIM: f64 = 4.0;

/// An exponent known to this from a multiplier is better than one from any record, even if that claims less: a record
/// that ends within a cycle does not see it.
const RESOLVED: f64 = 1e-6;

/// Parts of a period at most: more than any step needs.
const MOST_PARTS: u32 = 1 << 16;

/// A direction that is lost in such a part of a period with a switch in it, is lost by the switch.
const SWITCH: u32 = 8;

/// Collects how tangent columns stretch along a trajectory, iterate by iterate.
///
/// It knows no map: move the columns along with the state, and feed them here after each iterate.
/// Eight bytes for each column and iterate are kept.
///
/// ```
/// # fn main() -> Result<(), saltus_orbits::ExponentError> {
/// // x -> x / 2, y -> 3 y
/// let mut spectrum = saltus_orbits::Spectrum::new(2, 2)?;
/// let mut columns = spectrum.start_columns();
/// for iterate in 0..140 {
///     for column in columns.chunks_exact_mut(2) {
///         column[0] *= 0.5;
///         column[1] *= 3.0;
///     }
///     spectrum.feed(&mut columns)?;
///     if iterate < 40 {
///         spectrum.forget(); // the columns are still turning
///     }
/// }
/// let exponents = spectrum.estimate();
/// assert!((exponents[0].per_iterate - 3_f64.ln()).abs() < 1e-12);
/// assert!((exponents[1].per_iterate + 2_f64.ln()).abs() < 1e-12);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    dimension: usize,
    columns: usize,
    /// ln of the factors, for each trajectory: those of the first iterate, column by column, then of the next. The
    /// last trajectory is the one that is fed.
    runs: Vec<Vec<f64>>,
    /// The same of the iterate under way.
    open: Vec<f64>,
    /// Error of the columns, relative to the longest one, at each handing over.
    noise: f64,
    /// Parts of a period; 0 for a map, whose derivative may have no inverse.
    parts: u32,
    /// Largest distance by which columns have parted in one go.
    apart: f64,
    /// Errors of the logarithms by `noise`, added up, column by column; in the record and in the
    /// iterate under way.
    errors: Vec<f64>,
    open_errors: Vec<f64>,
}

/// A Kaplan-Yorke dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dimension {
    /// The dimension.
    pub value: f64,
    /// Its standard error, to first order in those of the exponents and with their correlation.
    pub standard_error: f64,
}

/// Exponents from the first iterates of a record.
#[derive(Clone, Debug, PartialEq)]
pub struct Running {
    /// Number of these iterates, of each trajectory.
    pub iterates: usize,
    /// The exponents from these alone.
    pub exponents: Vec<Exponent>,
}

impl Spectrum {
    /// An empty record for the `columns` largest exponents of a map in `dimension` dimensions.
    ///
    /// # Errors
    /// [`ExponentError::Columns`] unless there are 1 to `dimension` columns.
    pub fn new(dimension: usize, columns: usize) -> Result<Self, ExponentError> {
        if !(1..=dimension).contains(&columns) {
            return Err(ExponentError::Columns { columns, dimension });
        }
        Ok(Self {
            dimension,
            columns,
            runs: vec![Vec::new()],
            open: vec![0.0; columns],
            noise: f64::EPSILON,
            parts: 0,
            apart: 0.0,
            errors: vec![0.0; columns],
            open_errors: vec![0.0; columns],
        })
    }

    /// The same for a flow whose columns are handed over `parts` times in each period, each time with an error of
    /// `noise`, relative to the longest. No direction of a flow is lost between switches, so one that seems to be is
    /// no -inf, but unknown.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(crate) fn of_flow(
        dimension: usize,
        columns: usize,
        parts: u32,
        noise: f64,
    ) -> Result<Self, ExponentError> {
        Ok(Self {
            noise,
            parts: parts.max(1),
            ..Self::new(dimension, columns)?
        })
    }

    /// Orthonormal columns to start with, one after another; always the same, and along no axis.
    pub fn start_columns(&self) -> Vec<f64> {
        // multiples of the golden ratio, modulo one
        let generic = |k: usize| (k as f64 * 0.618_033_988_749_895).fract() - 0.5;
        let mut columns: Vec<f64> = (1..=self.dimension * self.columns).map(generic).collect();
        orthonormalise(&mut columns, self.dimension, &mut Vec::new());
        columns
    }

    /// Takes the columns as the iterate has left them, and makes them orthonormal for the next.
    ///
    /// A column with nothing left beside those before it, or no more than rounding, is a direction lost: it
    /// counts as -inf, behind the others, and gets a new direction. So -inf also stands for a contraction, in
    /// one iterate and relative to the largest stretching, below some 1e-15.
    ///
    /// # Errors
    /// [`ExponentError::Length`] and [`ExponentError::NotFinite`]; nothing is recorded or changed then.
    pub fn feed(&mut self, columns: &mut [f64]) -> Result<(), ExponentError> {
        self.part(columns, false)?;
        self.close(true);
        Ok(())
    }

    /// Takes the columns within an iterate, as after a part of a period; `switched` is whether there was a switch in
    /// this part. [`Self::close`] ends the iterate.
    ///
    /// # Errors
    /// As [`Self::feed`].
    pub(crate) fn part(
        &mut self,
        columns: &mut [f64],
        switched: bool,
    ) -> Result<(), ExponentError> {
        let (got, want) = (columns.len(), self.dimension * self.columns);
        if got != want {
            return Err(ExponentError::Length { got, want });
        }
        if !columns.iter().all(|x| x.is_finite()) {
            return Err(ExponentError::NotFinite);
        }
        let longest = longest(columns, self.dimension).max(0.0);
        let mut logs = Vec::with_capacity(self.columns);
        orthonormalise(columns, self.dimension, &mut logs);
        // by a switch, or by a map
        let may_be_lost = self.parts == 0 || switched && self.parts >= SWITCH;
        for (j, log) in logs.into_iter().enumerate() {
            self.open[j] += log;
            let apart = longest - log;
            self.open_errors[j] += match log {
                f64::NEG_INFINITY if may_be_lost => 0.0,
                f64::NEG_INFINITY => f64::INFINITY,
                // no logarithm is off by more than itself
                _ => (self.noise * apart.exp()).min(apart.max(1.0)),
            };
            if !may_be_lost {
                self.apart = self.apart.max(apart);
            }
        }
        Ok(())
    }

    /// Ends an iterate, and records it or not.
    pub(crate) fn close(&mut self, record: bool) {
        if let Some(run) = self.runs.last_mut().filter(|_| record) {
            run.append(&mut self.open);
            for (sum, error) in self.errors.iter_mut().zip(&self.open_errors) {
                *sum += error;
            }
        }
        self.open = vec![0.0; self.columns];
        self.open_errors = vec![0.0; self.columns];
    }

    /// Parts that each period must be cut into, if columns have parted by more than rounding allows. The record is
    /// worth nothing then: begin anew. `outgrown` is whether columns have left the range of numbers.
    pub(crate) fn needs_parts(&self, outgrown: bool) -> Option<u32> {
        let apart = if outgrown { f64::INFINITY } else { self.apart };
        if apart <= APART || self.parts == 0 || self.parts >= MOST_PARTS {
            return None;
        }
        let times = (apart / AIM).ceil().min(f64::from(SWITCH)) as u32;
        let parts = self.parts.saturating_mul(times.max(2));
        Some(parts.next_power_of_two().min(MOST_PARTS))
    }

    /// Forgets what was fed so far: a transient, in which the columns find their directions.
    pub fn forget(&mut self) {
        self.runs = vec![Vec::new()];
        self.errors = vec![0.0; self.columns];
        self.close(false);
    }

    /// Puts the record of another trajectory on the same attractor before the one that is fed, and behind those put
    /// there earlier. Pieces of one long trajectory belong in their order: slow changes show in it.
    ///
    /// # Errors
    /// [`ExponentError::Unlike`] if dimension or columns differ.
    pub fn merge(&mut self, other: &Self) -> Result<(), ExponentError> {
        if (self.dimension, self.columns) != (other.dimension, other.columns) {
            let shape = |one: &Self| format!("{} columns of length {}", one.columns, one.dimension);
            let (own, other) = (shape(self), shape(other));
            return Err(ExponentError::Unlike { own, other });
        }
        let last = self.runs.len() - 1;
        self.runs.splice(last..last, other.runs.iter().cloned());
        for (sum, error) in self.errors.iter_mut().zip(&other.errors) {
            *sum += error;
        }
        Ok(())
    }

    /// Iterates in the record, of all trajectories together.
    pub fn iterates(&self) -> usize {
        self.runs.iter().map(Vec::len).sum::<usize>() / self.columns
    }

    /// The exponents of a motion that has come to a cycle: those of its multipliers, where they are more accurate than
    /// the record. A record is off by the rest of the transient and by the part of a period that it begins or
    /// ends with, and turns a complex pair into two that wander about their mean.
    pub fn on_cycle(&self, orbit: &Orbit) -> Vec<Exponent> {
        let period = orbit.period() as f64;
        let of_orbit = |multiplier: &crate::Multiplier| {
            let modulus = multiplier.modulus();
            (modulus > 0.0).then(|| Exponent {
                per_iterate: modulus.ln() / period,
                standard_error: multiplier.error / modulus / period,
                batches: 0,
                batch_length: 0,
            })
        };
        let better = |(own, multiplier)| {
            let own: Exponent = own;
            of_orbit(multiplier)
                .filter(|found| found.standard_error <= own.standard_error.max(RESOLVED))
                .filter(|_| own.per_iterate.is_finite())
                .unwrap_or(own)
        };
        let own = self.estimate().into_iter();
        own.zip(&orbit.multipliers).map(better).collect()
    }

    /// The exponents, the largest first but for their errors.
    pub fn estimate(&self) -> Vec<Exponent> {
        self.estimate_of_first(usize::MAX)
    }

    /// The sum of the exponents, with the error of the sum: for all n of them the mean of ln |det|.
    pub fn sum(&self) -> Exponent {
        self.sum_of(self.columns)
    }

    /// The mean sum of the growths of the last iterates, as once around a cycle.
    pub fn sum_of_last(&self, iterates: usize) -> f64 {
        let last = self.runs.last().map_or(&[][..], Vec::as_slice);
        let last = &last[last.len().saturating_sub(iterates * self.columns)..];
        last.iter().sum::<f64>() / iterates.max(1) as f64
    }

    /// The weighted Birkhoff averages of the growth, column by column.
    pub fn weighted(&self) -> Vec<Weighted> {
        let average = |j: usize| birkhoff::weighted(&self.series(usize::MAX, |row| row[j]));
        (0..self.columns).map(average).collect()
    }

    /// The dimension of Kaplan & Yorke (1979): with j the most exponents whose sum S is not negative,
    /// j + S / |lambda_(j+1)|.
    ///
    /// A sum less than two standard errors below zero counts as zero: an
    /// invariant circle has dimension 1. A sink has 0; a map that contracts no volume has that of its state.
    /// `None` if more exponents would be needed than the record has, or the record is too short for errors.
    pub fn kaplan_yorke(&self) -> Option<Dimension> {
        let exponents = self.estimate();
        let mut within = 0.0;
        for (j, next) in exponents.iter().enumerate() {
            let sum = self.sum_of(j + 1);
            if sum.standard_error == f64::INFINITY {
                return None;
            }
            if sum.per_iterate < -2.0 * sum.standard_error {
                return Some(self.between(j, within, next.per_iterate));
            }
            within = sum.per_iterate.max(0.0);
        }
        let all = self.columns == self.dimension;
        all.then_some(Dimension {
            value: self.dimension as f64,
            standard_error: 0.0,
        })
    }

    /// `j` + `sum` / |`next`|, with the error of its linear part in sum and next: the mean of one more series.
    fn between(&self, j: usize, sum: f64, next: f64) -> Dimension {
        let part = sum / next.abs();
        let linear = |row: &[f64]| (row[..j].iter().sum::<f64>() + part * row[j]) / next.abs();
        let certain = j == 0 || next == f64::NEG_INFINITY;
        Dimension {
            value: j as f64 + part,
            standard_error: if certain {
                0.0
            } else {
                let noise = self.noise(j + 1) / next.abs();
                batches::mean(&self.series(usize::MAX, linear), noise).standard_error
            },
        }
    }

    /// Exponents from the first iterates, at up to 150 counts in equal ratios: the figure that shows convergence.
    pub fn convergence(&self) -> Vec<Running> {
        let longest = self.runs.iter().map(Vec::len).max().unwrap_or(0) / self.columns;
        let at = |i: usize| (longest as f64).powf(i as f64 / POINTS as f64).round() as usize;
        let mut counts: Vec<usize> = (1..=POINTS).map(at).filter(|n| *n > 0).collect();
        counts.dedup();
        let running = |iterates: usize| Running {
            iterates,
            exponents: self.estimate_of_first(iterates),
        };
        counts.into_iter().map(running).collect()
    }

    /// The exponent of the first column.
    pub(crate) fn largest(&self) -> Exponent {
        self.exponent(0, usize::MAX)
    }

    /// The weighted average of the growth of the first column.
    pub(crate) fn weighted_largest(&self) -> Weighted {
        birkhoff::weighted(&self.series(usize::MAX, |row| row[0]))
    }

    /// ln of the growth of the first column over the whole record; the mean of several.
    pub(crate) fn growth(&self) -> f64 {
        let series = self.series(usize::MAX, |row| row[0]);
        series.iter().flatten().sum::<f64>() / series.len().max(1) as f64
    }

    fn estimate_of_first(&self, iterates: usize) -> Vec<Exponent> {
        (0..self.columns)
            .map(|j| self.exponent(j, iterates))
            .collect()
    }

    /// The exponent of one column, from the first iterates.
    fn exponent(&self, j: usize, iterates: usize) -> Exponent {
        let noise = self.errors[j] / self.iterates().max(1) as f64;
        batches::mean(&self.series(iterates, |row| row[j]), noise)
    }

    /// The sum of the first exponents.
    fn sum_of(&self, count: usize) -> Exponent {
        let sum = self.series(usize::MAX, |row| row[..count].iter().sum());
        batches::mean(&sum, self.noise(count))
    }

    /// Error of the sum of the first exponents by rounding.
    fn noise(&self, count: usize) -> f64 {
        self.errors[..count].iter().sum::<f64>() / self.iterates().max(1) as f64
    }

    /// One number for each of the first iterates of each trajectory.
    fn series(&self, iterates: usize, value: impl Fn(&[f64]) -> f64) -> Vec<Vec<f64>> {
        let rows = |run: &Vec<f64>| {
            run.chunks_exact(self.columns)
                .take(iterates)
                .map(&value)
                .collect()
        };
        let fed = self.runs.iter().filter(|run| !run.is_empty());
        fed.map(rows).collect()
    }
}
