//! The stroboscopic map of systems with closed forms.

use std::f64::consts::TAU;
use std::sync::atomic::AtomicBool;

use saltus_hybrid::{Method, Options, testing};
use saltus_orbits::{MapPoint, MapRequest, NoImage, ParametricMap, Stroboscopic};

fn options() -> Options {
    Options {
        method: Method::Taylor {
            tolerance: 1e-14,
            order: 20,
        },
        ..Options::default()
    }
}

fn at(x: f64, v: f64) -> MapPoint {
    MapPoint {
        modes: vec![0],
        x: vec![x, v],
    }
}

#[test]
fn a_linear_oscillator_has_the_matrix_exponential() {
    let (zeta, omega) = (0.05_f64, 1.1);
    let stop = AtomicBool::new(false);
    let system = |p: &[f64]| Ok(testing::forced_oscillator(p[0], 1.0, omega, 0.3));
    for threads in [1, 2] {
        let map = Stroboscopic::new(system, 2, options(), threads, &stop);
        let start = at(0.1, 0.4);
        let shot = MapRequest {
            parameters: &[zeta],
            start: &start,
            derivative: true,
        };
        let images = map.images(&[shot]);
        let image = images[0].as_ref().unwrap();
        let d = image.derivative.as_ref().unwrap();
        let (t, w) = (TAU / omega, (1.0 - zeta * zeta).sqrt());
        let decay = (-zeta * t).exp();
        let (s, c) = (w * t).sin_cos();
        let exact = [[c + zeta / w * s, s / w], [-s / w, c - zeta / w * s]];
        for (row, column) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let difference = d[(row, column)] - decay * exact[row][column];
            assert!(difference.abs() < 1e-12, "{row} {column}: {difference}");
        }
        // A plain image is the same to the bit, and tells nothing of the way.
        let plain = map.images(&[MapRequest {
            derivative: false,
            ..shot
        }]);
        let plain = plain[0].as_ref().unwrap();
        assert_eq!(plain.place, image.place);
        assert!(plain.crossings.is_empty() && !image.crossings.is_empty());
    }
}

#[test]
fn what_happens_on_the_way_is_told() {
    // x = cos t - 0.5 cos(w t) passes 0.3 both ways; a wall a little above a top is not reached.
    let stop = AtomicBool::new(false);
    let system = |p: &[f64]| Ok(testing::forced_oscillator(0.05, 0.0, 1.0, p[0]));
    let map = Stroboscopic::new(system, 2, options(), 1, &stop);
    let start = at(0.0, 1.0);
    let shot = |wall| {
        let parameters = [wall];
        let shot = MapRequest {
            parameters: &parameters,
            start: &start,
            derivative: true,
        };
        map.images(&[shot]).remove(0).unwrap()
    };
    let crossed = shot(0.5);
    let way: Vec<_> = crossed.crossings.iter().map(|c| (c.from, c.to)).collect();
    assert_eq!(way, [(0, 1), (1, 0)]);
    assert!(crossed.crossings[0].at < crossed.crossings[1].at);
    // The first top of the damped swing from rest at speed 1: exp(-zeta t) sin(w t)/w at tan(w t) = w/zeta.
    let (zeta, w) = (0.05_f64, (1.0 - 0.05_f64 * 0.05).sqrt());
    let t = (w / zeta).atan() / w;
    let top = (-zeta * t).exp() * (w * t).sin() / w;
    let missed = shot(top + 1e-3);
    assert!(missed.crossings.is_empty());
    let nearest = missed.touches[0];
    assert!((nearest.value - 1e-3).abs() < 1e-12 && (nearest.at - t / TAU).abs() < 1e-9);
}

#[test]
fn what_cannot_be_run_is_told_and_disturbs_no_other() {
    let stop = AtomicBool::new(false);
    let system = |p: &[f64]| match p[0] {
        zeta if zeta > 0.0 => Ok(testing::forced_oscillator(zeta, 1.0, 1.1, 0.3)),
        zeta => Err(format!("zeta = {zeta}: a positive number is needed")),
    };
    let map = Stroboscopic::new(system, 2, options(), 1, &stop);
    let (good, long) = (
        at(0.1, 0.4),
        MapPoint {
            modes: vec![0],
            x: vec![1.0; 3],
        },
    );
    let nan = at(f64::NAN, 0.0);
    let shot = |parameters, start, derivative| MapRequest {
        parameters,
        start,
        derivative,
    };
    let images = map.images(&[
        shot(&[0.1], &good, true),
        shot(&[-0.1], &good, true),
        shot(&[0.1], &long, false),
        shot(&[0.1], &nan, true),
        shot(&[0.1], &good, false),
    ]);
    assert!(images[0].is_ok() && images[4].is_ok());
    assert_eq!(
        images[1],
        Err(NoImage::NoMap(
            "zeta = -0.1: a positive number is needed".into()
        ))
    );
    assert!(
        matches!(&images[2], Err(NoImage::NoMap(_))),
        "{:?}",
        images[2]
    );
    assert!(
        matches!(&images[3], Err(NoImage::Ended(_))),
        "{:?}",
        images[3]
    );
    stop.store(true, std::sync::atomic::Ordering::Relaxed);
    assert_eq!(
        map.images(&[shot(&[0.1], &good, true)])[0],
        Err(NoImage::Interrupted)
    );
}

#[test]
fn differences_give_the_derivative_that_the_flow_has() {
    let stop = AtomicBool::new(false);
    let system = |p: &[f64]| Ok(testing::forced_oscillator(p[0], 1.0, 1.1, 0.3));
    let map = Stroboscopic::new(system, 2, options(), 1, &stop);
    let (start, parameters) = (at(0.1, 0.4), [0.05]);
    let shot = |derivative| MapRequest {
        parameters: &parameters,
        start: &start,
        derivative,
    };
    let exact = map.images(&[shot(true)]).remove(0).unwrap();
    let differences = saltus_orbits::Differences::new(&map, 1e-4);
    let both = differences.images(&[shot(false), shot(true), shot(true)]);
    let plain = both[0].as_ref().unwrap();
    assert_eq!((&plain.place, &plain.derivative), (&exact.place, &None));
    for image in &both[1..] {
        let a = image.as_ref().unwrap().derivative.as_ref().unwrap();
        let b = exact.derivative.as_ref().unwrap();
        let mut entries = (0..a.nrows()).flat_map(|i| (0..a.ncols()).map(move |j| (i, j)));
        // a linear flow: only rounding over 1e-4
        assert!(entries.all(|entry| (a[entry] - b[entry]).abs() < 1e-10));
    }
}
