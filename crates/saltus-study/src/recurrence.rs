//! The number of periods after which a section repeats itself.

/// The smallest n at which every kept sample agrees with the one n periods later to `tolerance`, at
/// most half the samples; `None` if there is none.
///
/// This is a count, not a verdict: a slow transient repeats too, and a torus or a narrow band does not
/// repeat at any tolerance below its width.
pub fn recurrence(z: &[f64], v: &[f64], tolerance: f64) -> Option<u32> {
    let close = |a: f64, b: f64| (a - b).abs() <= tolerance;
    let repeats = |&n: &usize| {
        z.iter().zip(&z[n..]).all(|(a, b)| close(*a, *b))
            && v.iter().zip(&v[n..]).all(|(a, b)| close(*a, *b))
    };
    (1..=z.len() / 2).find(repeats).map(|n| n as u32)
}

#[cfg(test)]
mod tests {
    use super::recurrence;

    #[test]
    fn finds_the_shortest_period() {
        let z: Vec<f64> = (0..40).map(|i| [1.0, 2.0, 1.0, 3.0][i % 4]).collect();
        assert_eq!(recurrence(&z, &z, 1e-9), Some(4));
        assert_eq!(recurrence(&[1.0; 10], &[2.0; 10], 1e-9), Some(1));
    }

    #[test]
    fn a_rotation_does_not_repeat() {
        let z: Vec<f64> = (0..100)
            .map(|i| (f64::from(i) * 0.618_034 * std::f64::consts::TAU).sin())
            .collect();
        assert_eq!(recurrence(&z, &z, 1e-3), None);
    }

    #[test]
    fn no_samples_no_period() {
        assert_eq!(recurrence(&[], &[], 1.0), None);
        assert_eq!(recurrence(&[1.0], &[1.0], 1.0), None);
    }
}
