//! Orthonormal columns by Gram and Schmidt, with the logarithms of the lengths that were left.

/// Makes the columns of length `n` orthonormal, in their order, and appends to `logs` the logarithm of the
/// length that was left of each before it was made one.
///
/// A column with nothing left but rounding (4 n eps of its length) goes behind the others, counts as -inf and
/// gets a new direction, orthogonal to all. Numbers are finite, columns no more than `n`.
///
/// Every column is projected twice, and "twice is enough" [Parlett, The symmetric eigenvalue problem, 1998,
/// section 6.9]. It is first divided by its largest entry, so no square overflows or underflows.
pub(super) fn orthonormalise(columns: &mut [f64], n: usize, logs: &mut Vec<f64>) {
    let count = columns.len() / n;
    let (mut done, mut alive) = (0, count);
    while done < alive {
        let (before, from_here) = columns.split_at_mut(done * n);
        let column = &mut from_here[..n];
        if let Some(log) = left(column, before) {
            logs.push(log);
            done += 1;
        } else {
            columns[done * n..alive * n].rotate_left(n);
            alive -= 1;
        }
    }
    for lost in alive..count {
        let (before, from_here) = columns.split_at_mut(lost * n);
        replace(&mut from_here[..n], before);
        logs.push(f64::NEG_INFINITY);
    }
}

/// Logarithm of the length of the longest column; -inf if all are zero.
pub(super) fn longest(columns: &[f64], n: usize) -> f64 {
    let scale = columns.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
    if scale == 0.0 {
        return f64::NEG_INFINITY;
    }
    let square = |column: &[f64]| column.iter().map(|x| (x / scale).powi(2)).sum::<f64>();
    let most = columns.chunks_exact(n).map(square).fold(0.0, f64::max);
    scale.ln() + 0.5 * most.ln()
}

/// Makes `column` orthogonal to those before and of length one; the logarithm of what was left of it, if any.
fn left(column: &mut [f64], before: &[f64]) -> Option<f64> {
    let n = column.len();
    let scale = column.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
    if scale == 0.0 {
        return None;
    }
    divide(column, scale);
    let whole = norm(column);
    for _ in 0..2 {
        for unit in before.chunks_exact(n) {
            let along = dot(unit, column);
            for (x, u) in column.iter_mut().zip(unit) {
                *x -= along * u;
            }
        }
    }
    let left = norm(column);
    if left <= 4.0 * n as f64 * f64::EPSILON * whole {
        return None;
    }
    divide(column, left);
    Some(scale.ln() + left.ln())
}

/// The axis furthest from all columns before, made orthogonal to them. With fewer than n of them it keeps at
/// least 1/n of its squared length, since the squares of all their entries sum to their number.
fn replace(column: &mut [f64], before: &[f64]) {
    let n = column.len();
    let share = |axis: usize| -> f64 {
        let entries = before.chunks_exact(n).map(|unit| unit[axis]);
        entries.map(|entry| entry * entry).sum()
    };
    let furthest = (0..n).min_by(|a, b| share(*a).total_cmp(&share(*b)));
    column.fill(0.0);
    column[furthest.unwrap_or(0)] = 1.0;
    left(column, before);
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

fn divide(a: &mut [f64], by: f64) {
    a.iter_mut().for_each(|x| *x /= by);
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn worst_angle(columns: &[f64], n: usize) -> f64 {
        let count = columns.len() / n;
        let column = |j: usize| &columns[j * n..(j + 1) * n];
        let pairs = (0..count).flat_map(|j| (0..=j).map(move |k| (j, k)));
        let off = pairs.map(|(j, k)| dot(column(j), column(k)) - f64::from(j == k));
        off.fold(0.0, |most, x| f64::max(most, x.abs()))
    }

    fn logs(columns: &mut [f64], n: usize) -> Vec<f64> {
        let mut logs = Vec::new();
        orthonormalise(columns, n, &mut logs);
        logs
    }

    proptest! {
        /// Holds for a parallelepiped of any thinness and scale.
        #[test]
        fn columns_leave_orthonormal(
            entries in prop::collection::vec(-1.0_f64..1.0, 12),
            thin in -17..1, scale in -290..290,
        ) {
            let mut columns = entries;
            let (first, second) = columns.split_at_mut(4);
            for (b, a) in second.iter_mut().zip(first.iter()) {
                *b = a + *b * 10_f64.powi(thin);
            }
            columns.iter_mut().for_each(|x| *x *= 10_f64.powi(scale));
            prop_assert_eq!(logs(&mut columns, 4).len(), 3);
            prop_assert!(worst_angle(&columns, 4) < 1e-14); // a few eps
        }
    }

    #[test]
    fn the_product_of_the_lengths_is_the_determinant() {
        let logs = logs(&mut [1.0, 2.0, 3.0, -1.0, 0.5, 4.0, 2.0, 2.0, -7.0], 3);
        // 1(-3.5 - 8) - 2(7 - 8) + 3(-2 - 1)
        assert!((logs.iter().sum::<f64>() - 18.5_f64.ln()).abs() < 1e-14);
    }

    #[test]
    fn a_column_without_a_direction_counts_as_minus_infinity_behind_the_others() {
        for first in [[0.0, 0.0], [0.1, 0.3]] {
            let mut columns = [first[0], first[1], 0.3, 0.9];
            let logs = logs(&mut columns, 2);
            assert!(
                logs[0].is_finite() && logs[1] == f64::NEG_INFINITY,
                "{logs:?}"
            );
            assert!(worst_angle(&columns, 2) < 1e-15);
        }
        let mut nothing = [0.0; 9];
        assert_eq!(logs(&mut nothing, 3), [f64::NEG_INFINITY; 3]);
        assert_eq!(worst_angle(&nothing, 3), 0.0);
    }
}
