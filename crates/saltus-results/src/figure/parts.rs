//! A line in two parts, such as contact and flight or stable and unstable.

/// The steps whose mark is `wanted`; a NaN lifts the pen over the others.
pub(crate) fn only(x: &[f64], y: &[f64], marked: &[bool], wanted: bool) -> (Vec<f64>, Vec<f64>) {
    let count = x.len().min(y.len());
    let mark = |step: usize| marked.get(step).copied().unwrap_or(false) == wanted;
    let touches = |i: usize| (i + 1 < count && mark(i)) || (i > 0 && mark(i - 1));
    let (mut xs, mut ys) = (Vec::new(), Vec::new());
    for i in 0..count {
        if touches(i) {
            xs.push(x[i]);
            ys.push(y[i]);
        }
        if !mark(i) && xs.last().is_some_and(|x| !x.is_nan()) {
            xs.push(f64::NAN);
            ys.push(f64::NAN);
        }
    }
    (xs, ys)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_marked_path_splits_without_losing_a_step() {
        let x = [0.0, 1.0, 2.0, 3.0, 4.0];
        let marked = [false, true, true, false];
        let (plain, _) = only(&x, &x, &marked, false);
        let (flight, _) = only(&x, &x, &marked, true);
        let finite = |v: &[f64]| {
            v.iter()
                .copied()
                .filter(|v| v.is_finite())
                .collect::<Vec<_>>()
        };
        assert_eq!(finite(&flight), [1.0, 2.0, 3.0]);
        assert_eq!(finite(&plain), [0.0, 1.0, 3.0, 4.0]);
        assert!(plain[2].is_nan());
    }
}
