//! Single orbits.

use super::maps::{Smooth, at, henon, logistic};
use saltus_orbits::{NewtonOptions, NoImage, NotFound, Orbit, find_orbit};

fn segments(count: usize) -> NewtonOptions {
    NewtonOptions {
        segments: Some(count),
        ..NewtonOptions::default()
    }
}

/// The 8-cycle of the Hénon map at a = 1.04, b = 0.3 (stable from 1.0262 to 1.0512), reached by iteration.
fn eight_cycle(options: &NewtonOptions) -> Orbit {
    let mut x = [0.5, 0.5];
    for _ in 0..4000 {
        x = [1.04 - x[0] * x[0] + 0.3 * x[1], x[0]];
    }
    let start: Vec<_> = (0..8)
        .map(|_| {
            let place = at(&[x[0] + 1e-3, x[1]]);
            x = [1.04 - x[0] * x[0] + 0.3 * x[1], x[0]];
            place
        })
        .collect();
    find_orbit(&henon(), &[1.04, 0.3], &start, options).unwrap()
}

#[test]
fn multipliers_do_not_depend_on_the_number_of_segments() {
    let whole = eight_cycle(&segments(8));
    assert_eq!(whole.period(), 8);
    // The determinant of the derivative of one iterate is -b.
    let product: f64 = whole.multipliers.iter().map(|mu| mu.re).product();
    assert!((product - 0.3_f64.powi(8)).abs() < 1e-12);
    for count in 1..8 {
        let other = eight_cycle(&segments(count));
        for (a, b) in whole.multipliers.iter().zip(&other.multipliers) {
            // A residual of 1e-11 is amplified by the condition of an 8-cycle, some 100.
            assert!(
                (a.re - b.re).hypot(a.im - b.im) < 1e-8,
                "{count}: {a:?} {b:?}"
            );
        }
    }
}

#[test]
fn a_two_cycle_started_as_a_four_cycle_is_a_two_cycle() {
    let (r, options) = (3.2_f64, NewtonOptions::default());
    let root = ((r + 1.0) * (r - 3.0)).sqrt();
    let exact = [-1.0, 1.0].map(|s| (r + 1.0 + s * root) / (2.0 * r));
    let start: Vec<_> = [0, 1, 0, 1].map(|i| at(&[exact[i] + 0.01])).to_vec();
    let orbit = find_orbit(&logistic(), &[r], &start, &options).unwrap();
    assert_eq!(orbit.period(), 2);
    assert!((orbit.places[0].x[0] - exact[0]).abs() < 1e-11);
    // 4 + 2 r - r^2 is the multiplier of the 2-cycle.
    assert!((orbit.multipliers[0].re - (4.0 + 2.0 * r - r * r)).abs() < 1e-10);
    assert!(orbit.stable());
}

#[test]
fn a_singular_start_says_so() {
    // x -> x + 1 + x^2/10 has no fixed point, and at 0 its derivative is 1.
    let map = Smooth::new(|_, [x]| ([x + 1.0 + 0.1 * x * x], [[1.0 + 0.2 * x]]));
    let answer = find_orbit(&map, &[], &[at(&[0.0])], &NewtonOptions::default());
    assert!(matches!(answer, Err(NotFound::Singular { residual, .. }) if residual == 1.0));
}

#[test]
fn without_an_orbit_newton_gives_up_and_keeps_its_best_guess() {
    let map = Smooth::new(|_, [x]| ([x + 1.0 + 0.1 * x * x], [[1.0 + 0.2 * x]]));
    let answer = find_orbit(&map, &[], &[at(&[2.3])], &NewtonOptions::default());
    let (Err(NotFound::NotConverged {
        residual, places, ..
    })
    | Err(NotFound::Singular { residual, places })) = answer
    else {
        panic!("{answer:?}");
    };
    // The gap 1 + x^2/10 is smallest at 0.
    assert!((1.0..1.1).contains(&residual) && places[0].x[0].abs() < 1.0);
}

#[test]
fn a_map_that_is_not_finite_is_lost_and_does_not_hang() {
    let map = Smooth::new(|_, [_, y]| ([f64::NAN, y], [[f64::NAN; 2]; 2]));
    let answer = find_orbit(&map, &[], &[at(&[0.1, 0.2])], &NewtonOptions::default());
    assert!(matches!(
        answer,
        Err(NotFound::NoImage {
            reason: NoImage::Ended(_),
            ..
        })
    ));
}

#[test]
fn starts_that_are_none_are_refused_by_name() {
    let options = NewtonOptions::default();
    let find = |start: &[_]| find_orbit(&logistic(), &[3.2], start, &options).unwrap_err();
    assert_eq!(find(&[]), NotFound::NoPlaces);
    let bad = NotFound::BadPlace {
        place: 1,
        dimension: 1,
    };
    assert_eq!(find(&[at(&[0.1]), at(&[0.1, 0.2])]), bad);
    assert_eq!(find(&[at(&[0.1]), at(&[f64::INFINITY])]), bad);
    assert!(bad.to_string().contains("place 1"));
}
