//! A cloud of points as shades: the more points on a place, the darker it is.
//!
//! A vector element for each of 10⁶ points would be tens of megabytes, and where they crowd it would show an edge and
//! no inside.

use super::colour::Colour;
use super::ink::Density;

/// Cells across a cloud at least, which in a column of 85 mm are 400 to an inch, and cells per pixel.
const ACROSS: f64 = 1400.0;
const CELLS: (f64, f64) = (2.0, 4.0);
/// Opacity of a single point.
const FAINTEST: f64 = 0.3;

/// Shades of `points` (px) inside the rectangle `sides`, each point a square of `pen` (px); `None` without points.
pub(crate) fn density(
    points: &[(f64, f64)],
    pen: f64,
    colour: Colour,
    sides: [f64; 4],
) -> Option<Density> {
    let [left, top, right, bottom] = sides;
    let scale = (ACROSS / (right - left)).clamp(CELLS.0, CELLS.1);
    let size = (
        ((right - left) * scale).ceil() as usize,
        ((bottom - top) * scale).ceil() as usize,
    );
    let mut counts = vec![0_u32; size.0 * size.1];
    let reach = |at: f64, count: usize| {
        let low = (at - 0.5 * pen * scale).round().max(0.0) as usize;
        let high = (at + 0.5 * pen * scale).round() as usize;
        low..high.max(low + 1).min(count)
    };
    for &(x, y) in points {
        for row in reach((y - top) * scale, size.1) {
            for column in reach((x - left) * scale, size.0) {
                counts[row * size.0 + column] += 1;
            }
        }
    }
    let full = f64::from(crowded(&counts)?).ln_1p();
    let shade = |count: u32| match count {
        0 => 0,
        count => {
            let share = (f64::from(count).ln_1p() / full).min(1.0);
            ((FAINTEST + (1.0 - FAINTEST) * share) * 255.0).round() as u8
        }
    };
    Some(Density {
        sides,
        size,
        shades: counts.into_iter().map(shade).collect(),
        colour,
    })
}

/// The count that is drawn in full: 98 of 100 cells with points have no more, and it is 4 at least.
fn crowded(counts: &[u32]) -> Option<u32> {
    let mut some: Vec<u32> = counts.iter().copied().filter(|&count| count > 0).collect();
    let place = (some.len().checked_sub(1)? as f64 * 0.98) as usize;
    Some((*some.select_nth_unstable(place).1).max(4))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crowds_are_darker_and_nothing_is_nothing() {
        let mut points = vec![(10.0, 10.0); 50];
        points.push((90.0, 40.0));
        let cloud = density(&points, 1.5, Colour::BLACK, [0.0, 0.0, 100.0, 50.0]);
        let cloud = cloud.expect("there are points");
        let at = |x: f64, y: f64| {
            let cell = |v: f64, count: usize, long: f64| (v / long * count as f64) as usize;
            cloud.shades[cell(y, cloud.size.1, 50.0) * cloud.size.0 + cell(x, cloud.size.0, 100.0)]
        };
        assert_eq!((at(10.0, 10.0), at(50.0, 25.0)), (255, 0));
        assert!((77..180).contains(&at(90.0, 40.0)), "{}", at(90.0, 40.0));
        assert!(density(&[], 1.5, Colour::BLACK, [0.0, 0.0, 9.0, 9.0]).is_none());
        // points on the edge stay on the raster
        let edge = [(0.0, 0.0), (100.0, 50.0)];
        assert!(density(&edge, 3.0, Colour::BLACK, [0.0, 0.0, 100.0, 50.0]).is_some());
    }
}
