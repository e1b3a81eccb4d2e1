//! B and Q written out as lists, for plates with few terms. DP Eqs. (1)-(3).
//!
//! Both follow from the strain harmonics ([`Harmonics`]): B_ijk = Σ C_row,i H_row,jk and, with
//! M = H^T W H, Q_jklm = 1/6 (M_jk,lm + M_jl,km + M_jm,kl).

use super::factor::Factor;
use super::harmonics::{by_row, multiplicity, pair};
use super::in_plane::Sum;
use super::{Harmonics, PhysicsError, algebra};

/// One independent entry of B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CouplingTerm {
    /// In-plane index, 0..N_p.
    pub i: usize,
    /// Transverse index.
    pub j: usize,
    /// Transverse index, j <= k.
    pub k: usize,
    /// B_ijk itself (N/m^2). For j < k the energy holds it twice, as B_ijk and B_ikj.
    pub value: f64,
}

/// One independent entry of Q (or of the condensed Q).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuarticTerm {
    /// Smallest index.
    pub j: usize,
    /// Second index.
    pub k: usize,
    /// Third index.
    pub l: usize,
    /// Largest index.
    pub m: usize,
    /// Q_jklm itself (N/m^3). The energy holds it once per distinct order of its indices.
    pub value: f64,
}

impl CouplingTerm {
    /// Occurrences of the entry in the full sum: 1 if j = k, else 2.
    pub fn multiplicity(&self) -> f64 {
        multiplicity(self.j, self.k)
    }
}

impl QuarticTerm {
    /// Occurrences of the entry in the full sum: the number of distinct orders of (j, k, l, m).
    pub fn multiplicity(&self) -> f64 {
        // 4!/(product of the factorials of the lengths of runs of equal indices)
        let indices = self.indices();
        let (mut orders, mut run) = (24, 1);
        for pair in indices.windows(2) {
            run = if pair[0] == pair[1] { run + 1 } else { 1 };
            orders /= run;
        }
        f64::from(orders)
    }

    /// (j, k, l, m) as an array.
    pub fn indices(&self) -> [usize; 4] {
        [self.j, self.k, self.l, self.m]
    }
}

/// B_ijk with j <= k (N/m^2) for `in_plane` terms, nonzero entries only, sorted by i, j, k.
pub(super) fn coupling(harmonics: &Harmonics, in_plane: usize) -> Vec<CouplingTerm> {
    let pairs = harmonics.pairs.len();
    let mut sums = vec![Sum::default(); in_plane * pairs];
    let strain_of_row = by_row(harmonics.rows, &harmonics.strain);
    for c in &harmonics.in_plane {
        for h in strain_of_row[c.row] {
            sums[c.col * pairs + h.col].add(c.value * h.value);
        }
    }
    let mut terms = Vec::new();
    for (i, sums) in sums.chunks_exact(pairs).enumerate() {
        for (&(j, k), sum) in harmonics.pairs.iter().zip(sums) {
            let value = sum.get();
            if value != 0.0 {
                terms.push(CouplingTerm { i, j, k, value });
            }
        }
    }
    terms.sort_unstable_by_key(|b| (b.i, b.j, b.k));
    terms
}

/// Q_jklm (N/m^3), or with the factored K of the `in_plane` terms Q_eff = Q - 1/2 sym(B K^-1 B);
/// j <= k <= l <= m, nonzero entries only, sorted.
pub(super) fn quartic(
    harmonics: &Harmonics,
    transverse: usize,
    relief: Option<(usize, &Factor)>,
) -> Result<Vec<QuarticTerm>, PhysicsError> {
    let pairs = harmonics.pairs.len();
    // M = H^T (W H)
    let strain_of_row = by_row(harmonics.rows, &harmonics.strain);
    let mut stress = vec![0.0; harmonics.rows * pairs];
    for w in &harmonics.weights {
        for h in strain_of_row[w.col] {
            stress[w.row * pairs + h.col] += w.value * h.value;
        }
    }
    let mut product = vec![0.0; pairs * pairs];
    for h in &harmonics.strain {
        let stress = &stress[h.row * pairs..][..pairs];
        let product = &mut product[h.col * pairs..][..pairs];
        product
            .iter_mut()
            .zip(stress)
            .for_each(|(m, n)| *m += h.value * n);
    }
    // Hoelder's bound |Q_jklm|^4 <= Q_jjjj Q_kkkk Q_llll Q_mmmm sets the scale of rounding
    let size: Vec<f64> = (0..transverse)
        .map(|j| (0.5 * product[pair(j, j) * (pairs + 1)]).powf(0.25))
        .collect();
    if let Some((in_plane, factor)) = relief {
        let mut response = vec![0.0; in_plane * pairs];
        for b in coupling(harmonics, in_plane) {
            response[b.i * pairs + pair(b.j, b.k)] = b.value;
        }
        factor.half_solve(pairs, &mut response);
        let what = "condensed plate stiffness";
        let relief = algebra::transpose_times(what, in_plane, pairs, &response, &response)?;
        product
            .iter_mut()
            .zip(relief)
            .for_each(|(m, relief)| *m -= relief);
    }
    let product = |j: usize, k: usize, l: usize, m: usize| {
        product[pair(j.min(k), j.max(k)) * pairs + pair(l.min(m), l.max(m))]
    };
    let mut terms = Vec::new();
    for_each_sorted_quadruple(transverse, |[j, k, l, m]| {
        let value = (product(j, k, l, m) + product(j, l, k, m) + product(j, m, k, l)) / 6.0;
        if value.abs() > 1e-13 * size[j] * size[k] * size[l] * size[m] {
            terms.push(QuarticTerm { j, k, l, m, value });
        }
    });
    Ok(terms)
}

/// Calls `f` with every 0 <= j <= k <= l <= m < `size`, in lexicographic order.
pub(super) fn for_each_sorted_quadruple(size: usize, mut f: impl FnMut([usize; 4])) {
    for j in 0..size {
        for k in j..size {
            for l in k..size {
                for m in l..size {
                    f([j, k, l, m]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn multiplicities_count_all_orders() {
        for (indices, orders) in [
            ([0, 0, 0, 0], 1.0),
            ([0, 0, 0, 1], 4.0),
            ([0, 1, 1, 1], 4.0),
            ([0, 0, 1, 1], 6.0),
            ([0, 1, 1, 2], 12.0),
            ([0, 1, 2, 2], 12.0),
            ([0, 1, 2, 3], 24.0),
        ] {
            let [j, k, l, m] = indices;
            assert_eq!(
                QuarticTerm {
                    j,
                    k,
                    l,
                    m,
                    value: 1.0
                }
                .multiplicity(),
                orders,
                "{indices:?}"
            );
        }
    }
}
