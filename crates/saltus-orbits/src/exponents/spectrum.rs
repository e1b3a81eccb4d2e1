//! The record of stretching factors, and what follows from it.

use super::ExponentError;
use super::batches::{self, Exponent};
use super::birkhoff::{self, Weighted};
use super::orthonormal::orthonormalise;

/// Points of [`Spectrum::convergence`] at most.
const POINTS: usize = 150;

/// Collects how tangent columns stretch along a trajectory, iterate by iterate.
///
/// It knows no map: whoever moves the state moves the columns with it and feeds them here after each iterate.
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
    /// Of each trajectory: ln of the factors of the first iterate, column by column, then of the next. The
    /// last trajectory is the one that is fed.
    runs: Vec<Vec<f64>>,
}

/// A Kaplan-Yorke dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dimension {
    /// The dimension.
    pub value: f64,
    /// Its standard error, to first order in those of the exponents and with their correlation.
    pub standard_error: f64,
}

/// What the first iterates of a record say.
#[derive(Clone, Debug, PartialEq)]
pub struct Running {
    /// How many of them, of each trajectory.
    pub iterates: usize,
    /// The exponents from these alone.
    pub exponents: Vec<Exponent>,
}

impl Spectrum {
    /// For the `columns` largest exponents of a map in `dimension` dimensions.
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
        let (got, want) = (columns.len(), self.dimension * self.columns);
        if got != want {
            return Err(ExponentError::Length { got, want });
        }
        if !columns.iter().all(|x| x.is_finite()) {
            return Err(ExponentError::NotFinite);
        }
        if let Some(run) = self.runs.last_mut() {
            orthonormalise(columns, self.dimension, run);
        }
        Ok(())
    }

    /// Forgets what was fed so far: a transient, in which the columns find their directions.
    pub fn forget(&mut self) {
        self.runs = vec![Vec::new()];
    }

    /// Adds the record of another trajectory on the same attractor; what is fed later still belongs to this one.
    ///
    /// # Errors
    /// [`ExponentError::Unlike`] if dimension or columns differ.
    pub fn merge(&mut self, other: &Self) -> Result<(), ExponentError> {
        if (self.dimension, self.columns) != (other.dimension, other.columns) {
            let shape = |one: &Self| format!("{} columns of length {}", one.columns, one.dimension);
            let (own, other) = (shape(self), shape(other));
            return Err(ExponentError::Unlike { own, other });
        }
        self.runs.splice(0..0, other.runs.iter().cloned());
        Ok(())
    }

    /// Iterates in the record, of all trajectories together.
    pub fn iterates(&self) -> usize {
        self.runs.iter().map(Vec::len).sum::<usize>() / self.columns
    }

    /// The exponents, the largest first but for their errors.
    pub fn estimate(&self) -> Vec<Exponent> {
        self.estimate_of_first(usize::MAX)
    }

    /// The sum of the exponents, with the error of the sum: for all n of them the mean of ln |det|.
    pub fn sum(&self) -> Exponent {
        batches::mean(&self.series(usize::MAX, |row| row.iter().sum()))
    }

    /// The weighted Birkhoff averages of the growth, column by column.
    pub fn weighted(&self) -> Vec<Weighted> {
        let average = |j: usize| birkhoff::weighted(&self.series(usize::MAX, |row| row[j]));
        (0..self.columns).map(average).collect()
    }

    /// The dimension of Kaplan & Yorke (1979): with j the most exponents whose sum S is not negative,
    /// j + S / |lambda_(j+1)|.
    ///
    /// A sum that cannot be told from zero, being less than two standard errors below, counts as zero: an
    /// invariant circle has dimension 1. A sink has 0; a map that contracts no volume has that of its state.
    /// `None` if more exponents would be needed than the record has, or the record is too short for errors.
    pub fn kaplan_yorke(&self) -> Option<Dimension> {
        let exponents = self.estimate();
        let sum_of =
            |j: usize| batches::mean(&self.series(usize::MAX, |row| row[..j].iter().sum()));
        let mut within = 0.0;
        for (j, next) in exponents.iter().enumerate() {
            let sum = sum_of(j + 1);
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
                batches::mean(&self.series(usize::MAX, linear)).standard_error
            },
        }
    }

    /// What the first iterates say, at up to 150 counts in equal ratios: the figure that shows convergence.
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
        batches::mean(&self.series(usize::MAX, |row| row[0]))
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
        let exponent = |j: usize| batches::mean(&self.series(iterates, |row| row[j]));
        (0..self.columns).map(exponent).collect()
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
