//! Areas between two curves, cut to the frame.

use super::frame::Frame;
use super::thin::polyline;

/// Pixels beyond this are far outside any frame; larger ones would overflow when they are cut.
const FAR: f64 = 1e6;
/// Vertices of each border of an area stay within this.
const VERTICES: usize = 10_000;

/// Corners (px) of the visible parts between `low` and `high` over `x`: one list for each run of finite
/// points. A finite `low` that has no logarithm lies below the frame.
pub(crate) fn between(x: &[f64], low: &[f64], high: &[f64], frame: &Frame) -> Vec<Vec<(f64, f64)>> {
    let borders = |((&x, &low), &high): ((&f64, &f64), &f64)| {
        let x = frame.x.pixel(x)?.clamp(-FAR, FAR);
        let below = low.is_finite().then_some(FAR);
        let low = frame.y.pixel(low).or(below)?.clamp(-FAR, FAR);
        let high = frame.y.pixel(high)?.clamp(-FAR, FAR);
        Some(((x, low), (x, high)))
    };
    let pixels: Vec<_> = x.iter().zip(low).zip(high).map(borders).collect();
    let runs = pixels.split(Option::is_none).map(|run| {
        let (low, high): (Vec<_>, Vec<_>) = run.iter().copied().flatten().unzip();
        let mut corners = polyline(&high, VERTICES);
        corners.extend(polyline(&low, VERTICES).into_iter().rev());
        cut(corners, frame)
    });
    runs.filter(|corners| corners.len() > 2).collect()
}

/// The part of a polygon inside the frame (Sutherland & Hodgman 1974).
fn cut(corners: Vec<(f64, f64)>, frame: &Frame) -> Vec<(f64, f64)> {
    let inside = [
        |p: (f64, f64), frame: &Frame| p.0 - frame.left,
        |p: (f64, f64), frame: &Frame| frame.right - p.0,
        |p: (f64, f64), frame: &Frame| p.1 - frame.top,
        |p: (f64, f64), frame: &Frame| frame.bottom - p.1,
    ];
    inside.into_iter().fold(corners, |corners, depth| {
        half(&corners, |p| depth(p, frame))
    })
}

/// The part of a polygon where `depth` is not negative.
fn half(corners: &[(f64, f64)], depth: impl Fn((f64, f64)) -> f64) -> Vec<(f64, f64)> {
    let Some(&last) = corners.last() else {
        return Vec::new();
    };
    let mut from = last;
    let mut kept = Vec::new();
    for &to in corners {
        let (a, b) = (depth(from), depth(to));
        if (a < 0.0) != (b < 0.0) {
            let share = a / (a - b);
            kept.push((
                from.0 + share * (to.0 - from.0),
                from.1 + share * (to.1 - from.1),
            ));
        }
        if b >= 0.0 {
            kept.push(to);
        }
        from = to;
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::axis::Scale;

    /// The square from 0 to 100 px, for values from 0 to 1.
    fn frame() -> Frame {
        Frame {
            left: 0.0,
            right: 100.0,
            top: 0.0,
            bottom: 100.0,
            x: Scale::of_unit().between(0.0, 100.0),
            y: Scale::of_unit().between(100.0, 0.0),
        }
    }

    /// Area of a polygon (px²), by Gauss's formula.
    fn area(corners: &[(f64, f64)]) -> f64 {
        let next = corners.iter().cycle().skip(1);
        let twice: f64 = corners
            .iter()
            .zip(next)
            .map(|(a, b)| a.0 * b.1 - b.0 * a.1)
            .sum();
        0.5 * twice.abs()
    }

    #[test]
    fn an_area_is_cut_where_the_frame_ends() {
        // The triangle under y = 4x, cut at y = 1: all but the corner above the line, 1/8.
        let parts = between(&[0.0, 1.0], &[-9.0, -9.0], &[0.0, 4.0], &frame());
        assert_eq!(parts.len(), 1);
        assert!((area(&parts[0]) - 8750.0).abs() < 1e-6, "{parts:?}");
    }

    #[test]
    fn an_area_has_gaps_and_nothing_outside() {
        let x = [0.0, 0.2, 0.4, 0.6, 0.8];
        let low = [0.1, 0.1, f64::NAN, 0.1, 0.1];
        let parts = between(&x, &low, &[0.2; 5], &frame());
        assert_eq!(parts.len(), 2);
        assert!((area(&parts[1]) - 200.0).abs() < 1e-6);
        assert!(between(&x, &[2.0; 5], &[1e300; 5], &frame()).is_empty());
        assert!(between(&[], &[], &[], &frame()).is_empty());
    }
}
