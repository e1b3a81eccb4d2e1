//! Values.

use super::maps::{CIRCLE, DELAYED, DOUBLING, HENON, LOGISTIC, SPIRAL, TENT, Toy, place};
use saltus_orbits::{Exponent, ExponentError, Spectrum, settled, spectrum_of};

pub(crate) const HENON_CLASSIC: [f64; 2] = [1.4, 0.3];

pub(crate) fn record(map: &Toy, parameters: &[f64], start: &[f64], iterates: usize) -> Spectrum {
    spectrum_of(map, parameters, place(start), 1000, iterates, start.len()).unwrap()
}

/// Four standard errors: one such comparison in 15 000 fails by chance, and the seeds are fixed.
#[track_caller]
fn assert_is(found: &Exponent, known: f64, rounding: f64) {
    let off = (found.per_iterate - known).abs();
    assert!(
        off < 4.0 * found.standard_error + rounding,
        "{known}: {found:?}"
    );
}

/// Sprott, Chaos and Time-Series Analysis (2003), appendix A: five decimals.
#[test]
fn henon_and_the_delayed_logistic_map_have_the_published_exponents() {
    for (map, parameters, published) in [
        (&HENON, &HENON_CLASSIC[..], [0.41922, -1.62319]),
        (&DELAYED, &[2.27], [0.18312, -1.24199]),
    ] {
        let found = record(map, parameters, &[0.1, 0.1], 200_000).estimate();
        for (exponent, known) in found.iter().zip(published) {
            assert_is(exponent, known, 1e-5);
            assert!(exponent.standard_error < 7e-3, "{exponent:?}");
        }
    }
}

#[test]
fn the_sum_is_the_mean_of_the_logarithm_of_the_determinant() {
    let spectrum = record(&HENON, &HENON_CLASSIC, &[0.1, 0.1], 20_000);
    let sum = spectrum.sum();
    // det = -b everywhere, so nothing but rounding is left of the errors of the single exponents
    assert!((sum.per_iterate - 0.3_f64.ln()).abs() < 1e-13, "{sum:?}");
    // each logarithm is known to the rounding of its columns, of which one is some ten times the other
    assert!(sum.standard_error < 1e-13, "{sum:?}");
    assert!(spectrum.estimate()[0].standard_error > 1e-4);
}

#[test]
fn henon_has_the_dimension_of_kaplan_and_yorke() {
    let spectrum = record(&HENON, &HENON_CLASSIC, &[0.1, 0.1], 200_000);
    let found = spectrum.kaplan_yorke().unwrap();
    // 1 + 0.41922 / 1.62319 (Sprott 2003)
    assert!(
        (found.value - 1.25827).abs() < 4.0 * found.standard_error,
        "{found:?}"
    );
    // the sum c = ln b has no error, so D = 1 + x/(x - c) has that of x times |c| / (x - c)^2
    let (largest, sum) = (spectrum.estimate()[0], 0.3_f64.ln());
    let slope = -sum / (largest.per_iterate - sum).powi(2);
    let ratio = found.standard_error / (slope * largest.standard_error);
    assert!((ratio - 1.0).abs() < 1e-6, "{ratio}");
}

#[test]
fn edge_cases_have_the_dimension_of_the_set() {
    let dimension = |spectrum: &Spectrum| spectrum.kaplan_yorke().map(|found| found.value);
    // a sink, an invariant circle, and a line that is filled
    let sink = record(&HENON, &[0.2, 0.3], &[0.1, 0.1], 2000);
    assert_eq!(dimension(&sink), Some(0.0));
    let torus = dimension(&record(&DELAYED, &[2.1], &[0.1, 0.1], 20_000)).unwrap();
    assert!((torus - 1.0).abs() < 1e-3, "{torus}");
    assert_eq!(dimension(&record(&TENT, &[1.9], &[0.1], 2000)), Some(1.0));
    // one exponent of two is too few, and so are ten iterates
    let one = spectrum_of(&HENON, &HENON_CLASSIC, place(&[0.1, 0.1]), 1000, 2000, 1).unwrap();
    assert_eq!(dimension(&one), None);
    assert_eq!(
        dimension(&record(&HENON, &HENON_CLASSIC, &[0.1, 0.1], 10)),
        None
    );
}

#[test]
fn maps_of_the_line_have_the_exponents_of_their_formulas() {
    let two = 2.0_f64.ln();
    assert_is(
        &record(&LOGISTIC, &[4.0], &[0.1234], 100_000).estimate()[0],
        two,
        0.0,
    );
    // constant slopes: nothing but rounding
    assert_is(
        &record(&DOUBLING, &[], &[0.1234], 1000).estimate()[0],
        two,
        1e-13,
    );
    assert_is(
        &record(&TENT, &[1.9], &[0.1234], 1000).estimate()[0],
        1.9_f64.ln(),
        1e-13,
    );
}

/// A record of 501 iterates ends in the middle of a cycle, and a complex pair makes two columns wander: multipliers
/// do neither.
#[test]
fn on_a_cycle_exponents_are_those_of_its_multipliers() {
    let r = 3.2_f64;
    let of = |map: &Toy, parameters: &[f64], start: &[f64]| {
        let spectrum = spectrum_of(map, parameters, place(start), 200, 501, start.len()).unwrap();
        let mut x = start.to_vec();
        (0..701).for_each(|_| x = map.next(parameters, &x));
        let orbit = settled(map, parameters, &place(&x)).unwrap();
        (spectrum.estimate(), spectrum.on_cycle(&orbit))
    };
    // 4 + 2 r - r^2 is the multiplier of the 2-cycle
    let exact = (4.0 + 2.0 * r - r * r).abs().ln() / 2.0;
    let (record, cycle) = of(&LOGISTIC, &[r], &[0.3]);
    assert!((record[0].per_iterate - exact).abs() > 1e-5, "{record:?}");
    assert!(
        (cycle[0].per_iterate - exact).abs() < cycle[0].standard_error,
        "{cycle:?}"
    );
    assert!(cycle[0].standard_error < 1e-9, "{cycle:?}");
    // both of the pair shrink by 0.9
    let (record, cycle) = of(&SPIRAL, &[], &[0.1, 0.1]);
    for (record, cycle) in record.iter().zip(cycle) {
        assert!(
            (record.per_iterate - 0.9_f64.ln()).abs() > 1e-6,
            "{record:?}"
        );
        assert!(
            (cycle.per_iterate - 0.9_f64.ln()).abs() < cycle.standard_error,
            "{cycle:?}"
        );
        assert!(cycle.standard_error < 1e-9, "{cycle:?}");
    }
    // chaos is on no cycle
    assert_eq!(settled(&HENON, &HENON_CLASSIC, &place(&[0.1, 0.1])), None);
}

#[test]
fn a_superstable_cycle_has_minus_infinity() {
    // the critical point 1/2 is fixed at r = 2
    let found = record(&LOGISTIC, &[2.0], &[0.5], 100).estimate()[0];
    assert_eq!(
        (found.per_iterate, found.standard_error),
        (f64::NEG_INFINITY, 0.0)
    );
    // of two directions one is lost, and the other keeps its exponent: b = 0 makes Hénon's map logistic
    let henon = record(&HENON, &[1.8, 0.0], &[0.1, 0.0], 2000);
    let alone = spectrum_of(&HENON, &[1.8, 0.0], place(&[0.1, 0.0]), 1000, 2000, 1).unwrap();
    assert_eq!(henon.estimate()[0], alone.estimate()[0]);
    assert_eq!(henon.estimate()[1].per_iterate, f64::NEG_INFINITY);
    assert_eq!(henon.sum().per_iterate, f64::NEG_INFINITY);
    assert_eq!(henon.kaplan_yorke().unwrap().value, 1.0);
}

/// The record of growths that are given.
pub(crate) fn fed(growths: impl Iterator<Item = f64>) -> Spectrum {
    let mut spectrum = Spectrum::new(1, 1).unwrap();
    for growth in growths {
        spectrum.feed(&mut [growth.exp()]).unwrap();
    }
    spectrum
}

/// omega for which the circle map turns by the golden mean, by halving: the rotation number grows with omega.
pub(crate) fn golden(k: f64) -> f64 {
    let mean = (5.0_f64.sqrt() - 1.0) / 2.0;
    let turns = |omega: f64| {
        let turn =
            |x: f64, _| x + omega - k / std::f64::consts::TAU * (std::f64::consts::TAU * x).sin();
        (0..100_000).fold(0.0, turn) / 1e5
    };
    let (mut low, mut high) = (0.5, 0.7);
    while high - low > 1e-9 {
        let middle = f64::midpoint(low, high);
        if turns(middle) < mean {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::midpoint(low, high)
}

#[test]
fn on_a_torus_the_weighted_average_has_ten_digits_where_the_plain_mean_has_four() {
    let spectrum = record(&CIRCLE, &[golden(0.9), 0.9], &[0.1], 10_000);
    let (plain, weighted) = (spectrum.estimate()[0], spectrum.weighted()[0]);
    // the true exponent is zero
    assert!(plain.per_iterate.abs() > 1e-6, "{plain:?}");
    assert!(weighted.mean.abs() < 1e-12, "{weighted:?}");
    assert!(weighted.digits() > 12.0, "{weighted:?}");
    assert!(
        plain.per_iterate.abs() < 2.0 * plain.standard_error,
        "{plain:?}"
    );
}

#[test]
fn in_chaos_the_weighted_average_has_no_more_digits_than_the_plain_mean() {
    let weighted = record(&HENON, &HENON_CLASSIC, &[0.1, 0.1], 30_000).weighted()[0];
    assert!(weighted.digits() < 4.0, "{weighted:?}");
    assert!((weighted.mean - 0.41922).abs() < 0.02, "{weighted:?}");
}

#[test]
fn bad_input_is_an_error_and_changes_nothing() {
    let columns = |columns| Spectrum::new(2, columns).err();
    assert_eq!(
        columns(0),
        Some(ExponentError::Columns {
            columns: 0,
            dimension: 2
        })
    );
    assert_eq!(
        columns(3),
        Some(ExponentError::Columns {
            columns: 3,
            dimension: 2
        })
    );
    assert!(Spectrum::new(0, 0).is_err());

    let mut spectrum = Spectrum::new(2, 1).unwrap();
    assert_eq!(
        spectrum.feed(&mut [1.0]),
        Err(ExponentError::Length { got: 1, want: 2 })
    );
    assert_eq!(
        spectrum.feed(&mut [1.0, f64::NAN]),
        Err(ExponentError::NotFinite)
    );
    assert_eq!(spectrum.iterates(), 0);
    let empty = spectrum.estimate()[0];
    assert_eq!(
        (empty.per_iterate, empty.standard_error),
        (0.0, f64::INFINITY)
    );
    assert!(spectrum.convergence().is_empty() && spectrum.kaplan_yorke().is_none());
    assert!(spectrum.merge(&Spectrum::new(2, 2).unwrap()).is_err());

    let off = spectrum_of(&HENON, &HENON_CLASSIC, place(&[0.0]), 0, 1, 1);
    assert_eq!(off, Err(ExponentError::Length { got: 1, want: 2 }));
    let away = spectrum_of(&HENON, &HENON_CLASSIC, place(&[9.0, 0.0]), 0, 100, 1);
    assert_eq!(away, Err(ExponentError::NotFinite));
}

#[test]
fn the_same_start_gives_the_same_bits() {
    let again = || record(&HENON, &HENON_CLASSIC, &[0.1, 0.1], 500);
    assert_eq!(again(), again());
}
