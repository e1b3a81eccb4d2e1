//! After how many forcing periods does a section repeat? A count for summaries, not a verdict.

use saltus::study::recurrence;

/// Samples that differ by no more than this (in the paper's units) are the same.
pub(super) const SAME: f64 = 1e-6;

/// The number after which the samples of all jumpers repeat; none if not within half of them.
/// `samples` gives z and v of one jumper.
pub(super) fn every(
    jumpers: usize,
    count: usize,
    samples: impl Fn(usize) -> (Vec<f64>, Vec<f64>),
) -> Option<u32> {
    let of = |jumper| {
        let (z, v) = samples(jumper);
        recurrence(&z, &v, SAME)
    };
    let period = (0..jumpers)
        .map(of)
        .try_fold(1, |all: u32, own| common(all, own?))?;
    let seen_twice = jumpers > 0 && 2 * period as usize <= count;
    seen_twice.then_some(period)
}

/// Least common multiple.
fn common(a: u32, b: u32) -> Option<u32> {
    let (mut divisor, mut rest) = (a, b);
    while rest != 0 {
        (divisor, rest) = (rest, divisor % rest);
    }
    (a / divisor).checked_mul(b)
}

#[cfg(test)]
mod tests {
    use super::every;

    #[test]
    fn jumpers_repeat_together() {
        let samples = |jumper: usize| {
            let z: Vec<f64> = (0..24).map(|i| (i % (2 + jumper)) as f64).collect();
            (z.clone(), z)
        };
        assert_eq!(every(1, 24, samples), Some(2));
        assert_eq!(every(2, 24, samples), Some(6));
        assert_eq!(every(3, 24, samples), Some(12));
        assert_eq!(every(4, 24, samples), None);
        assert_eq!(every(0, 24, samples), None);
    }
}
