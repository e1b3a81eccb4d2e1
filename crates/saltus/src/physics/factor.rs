//! K^-1 by Cholesky's method, block by block.
//!
//! K couples u (m, n) with v (m', n') only: with the same half-waves in the shear-free basis, with
//! those of the other parity along x and y in the fixed one. So K falls into blocks, two terms each
//! or four classes of parity, and its inverse with it.

use super::{Entry, PhysicsError, algebra};
use std::collections::BTreeSet;

const WHAT: &str = "in-plane response to deflection";

/// The Cholesky factors of the blocks of a symmetric positive definite matrix.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Factor {
    blocks: Vec<Block>,
}

/// Terms coupled with each other and with no others.
#[derive(Clone, Debug, PartialEq)]
struct Block {
    /// Their indices, ascending.
    terms: Vec<usize>,
    /// L with L L^T = K restricted to them, row-major.
    lower: Vec<f64>,
}

impl Factor {
    /// Factors the row-major `size` x `size` matrix `k`.
    ///
    /// # Errors
    /// [`PhysicsError::Algebra`] if it is not positive definite or not finite.
    pub(super) fn new(size: usize, k: &[f64]) -> Result<Self, PhysicsError> {
        let block = |terms: Vec<usize>| {
            let part: Vec<f64> = terms
                .iter()
                .flat_map(|&row| terms.iter().map(move |&col| k[row * size + col]))
                .collect();
            let lower = algebra::cholesky(WHAT, terms.len(), &part)?;
            Ok(Block { terms, lower })
        };
        let blocks: Result<Vec<Block>, PhysicsError> =
            components(size, k).into_iter().map(block).collect();
        Ok(Self { blocks: blocks? })
    }

    /// K^-1 b.
    pub(super) fn solve(&self, b: &[f64]) -> Vec<f64> {
        let mut x = b.to_vec();
        self.half_solve(1, &mut x);
        for block in &self.blocks {
            block.solve_transpose(&mut x);
        }
        x
    }

    /// Turns the row-major B with `cols` columns into X = L^-1 B, so that X^T X = B^T K^-1 B.
    pub(super) fn half_solve(&self, cols: usize, b: &mut [f64]) {
        for block in &self.blocks {
            let mut part: Vec<f64> = block
                .terms
                .iter()
                .flat_map(|&term| b[term * cols..][..cols].iter().copied())
                .collect();
            block.half_solve(cols, &mut part);
            for (position, &term) in block.terms.iter().enumerate() {
                b[term * cols..][..cols].copy_from_slice(&part[position * cols..][..cols]);
            }
        }
    }

    /// K^-1, all entries of all blocks, sorted by row, then column.
    ///
    /// # Errors
    /// [`PhysicsError::Algebra`] if an entry overflows.
    pub(super) fn inverse(&self) -> Result<Vec<Entry>, PhysicsError> {
        let mut entries = Vec::new();
        for block in &self.blocks {
            let size = block.terms.len();
            let mut x = vec![0.0; size * size];
            (0..size).for_each(|row| x[row * size + row] = 1.0);
            block.half_solve(size, &mut x);
            let inverse = algebra::transpose_times(WHAT, size, size, &x, &x)?;
            entries.extend(dense(&block.terms, &inverse));
        }
        entries.sort_unstable_by_key(|entry: &Entry| (entry.row, entry.col));
        Ok(entries)
    }

    /// C K^-1 C^T for a C with one column per term; every entry may be listed in several parts.
    ///
    /// # Errors
    /// [`PhysicsError::Algebra`] if an entry overflows.
    pub(super) fn sandwich(&self, c: &[Entry]) -> Result<Vec<Entry>, PhysicsError> {
        let size = self.blocks.iter().map(|block| block.terms.len()).sum();
        let mut of_term = vec![Vec::new(); size];
        for entry in c {
            of_term[entry.col].push((entry.row, entry.value));
        }
        let mut entries = Vec::new();
        for block in &self.blocks {
            let met = block.terms.iter().flat_map(|&term| &of_term[term]);
            let rows: BTreeSet<usize> = met.map(|&(row, _)| row).collect();
            let rows: Vec<usize> = rows.into_iter().collect();
            let mut x = vec![0.0; block.terms.len() * rows.len()];
            for (x, &term) in x.chunks_exact_mut(rows.len().max(1)).zip(&block.terms) {
                for &(row, value) in &of_term[term] {
                    x[rows.partition_point(|&other| other < row)] = value;
                }
            }
            block.half_solve(rows.len(), &mut x);
            let product = algebra::transpose_times(WHAT, block.terms.len(), rows.len(), &x, &x)?;
            entries.extend(dense(&rows, &product));
        }
        Ok(entries)
    }
}

/// The entries of a matrix given for these rows and columns, row-major.
fn dense<'a>(at: &'a [usize], values: &'a [f64]) -> impl Iterator<Item = Entry> + 'a {
    let places = at
        .iter()
        .flat_map(move |&row| at.iter().map(move |&col| (row, col)));
    places
        .zip(values)
        .map(|((row, col), &value)| Entry { row, col, value })
}

impl Block {
    /// L^-1 B for B with one row per term.
    fn half_solve(&self, cols: usize, b: &mut [f64]) {
        let size = self.terms.len();
        for row in 0..size {
            let (done, rest) = b.split_at_mut(row * cols);
            let (own, _) = rest.split_at_mut(cols);
            let lower = &self.lower[row * size..][..=row];
            for (l, done) in lower.iter().zip(done.chunks_exact(cols.max(1))) {
                own.iter_mut()
                    .zip(done)
                    .for_each(|(own, done)| *own -= l * done);
            }
            own.iter_mut().for_each(|own| *own /= lower[row]);
        }
    }

    /// L^-T applied to this block's part of `b`.
    fn solve_transpose(&self, b: &mut [f64]) {
        let size = self.terms.len();
        for row in (0..size).rev() {
            let lower = &self.lower[row * size..][..=row];
            let x = b[self.terms[row]] / lower[row];
            b[self.terms[row]] = x;
            for (l, &term) in lower[..row].iter().zip(&self.terms) {
                b[term] -= l * x;
            }
        }
    }
}

/// The sets of indices that nonzero entries of `k` connect, each ascending.
fn components(size: usize, k: &[f64]) -> Vec<Vec<usize>> {
    let mut known = vec![false; size];
    let mut components = Vec::new();
    for start in 0..size {
        if known[start] {
            continue;
        }
        known[start] = true;
        let mut terms = vec![start];
        let mut next = 0;
        while let Some(&term) = terms.get(next) {
            next += 1;
            for other in 0..size {
                if !known[other] && k[term * size + other] != 0.0 {
                    known[other] = true;
                    terms.push(other);
                }
            }
        }
        terms.sort_unstable();
        components.push(terms);
    }
    components
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// Two blocks, {0, 2} and {1}.
    const K: [f64; 9] = [4.0, 0.0, 2.0, 0.0, 9.0, 0.0, 2.0, 0.0, 5.0];

    #[test]
    fn blocks_are_solved_each_for_itself() {
        let factor = Factor::new(3, &K).unwrap();
        assert_eq!(factor.blocks.len(), 2);
        let x = factor.solve(&[8.0, 18.0, 12.0]);
        // K (1, 2, 2) = (8, 18, 12)
        for (x, expected) in x.iter().zip([1.0, 2.0, 2.0]) {
            assert!((x - expected).abs() < 1e-15);
        }
    }

    #[test]
    fn the_inverse_has_the_blocks_of_the_matrix() {
        // [4 2; 2 5]^-1 = [5 -2; -2 4]/16
        let expected = [
            (0, 0, 5.0),
            (0, 2, -2.0),
            (1, 1, 16.0 / 9.0),
            (2, 0, -2.0),
            (2, 2, 4.0),
        ];
        let inverse = Factor::new(3, &K).unwrap().inverse().unwrap();
        assert_eq!(inverse.len(), expected.len());
        for (entry, (row, col, value)) in inverse.iter().zip(expected) {
            assert_eq!((entry.row, entry.col), (row, col));
            assert!((entry.value - value / 16.0).abs() < 1e-15);
        }
    }

    #[test]
    fn what_is_not_positive_definite_is_refused() {
        assert!(Factor::new(2, &[1.0, 2.0, 2.0, 1.0]).is_err());
        assert!(Factor::new(1, &[f64::NAN]).is_err());
    }
}
