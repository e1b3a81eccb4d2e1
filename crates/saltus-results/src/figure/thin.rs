//! Fewer points, same picture: points on the same half pixel are drawn once.

/// One vertical stroke of a point cloud (px): equal `top` and `bottom` make a dot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stroke {
    pub(crate) x: f64,
    pub(crate) top: f64,
    pub(crate) bottom: f64,
}

/// Cell of the grid (px): two per pixel, as a PNG at twice the size can show.
pub(crate) const CELL: f64 = 0.5;

/// Points (px) to strokes for a round pen of diameter `pen` (px), on a grid of `cell` (px).
///
/// Points of one grid column whose dots touch become one stroke, which covers the same pixels. A
/// stroke ends at true points, so extremes stay where they are; its column stands at the mean of its
/// points, so that equidistant parameter values stay equidistant.
pub(crate) fn strokes(points: &[(f64, f64)], pen: f64, cell: f64) -> Vec<Stroke> {
    let mut cells: Vec<(i64, f64, f64)> = points
        .iter()
        .map(|&(x, y)| ((x / cell).floor() as i64, y, x))
        .collect();
    cells.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    cells
        .chunk_by(|a, b| a.0 == b.0)
        .flat_map(|column| column_strokes(column, pen, cell))
        .collect()
}

/// Strokes of one column, sorted by y.
fn column_strokes(column: &[(i64, f64, f64)], pen: f64, cell: f64) -> Vec<Stroke> {
    let x = column.iter().map(|point| point.2).sum::<f64>() / column.len() as f64;
    let gap = pen.max(cell);
    column
        .chunk_by(|above, below| below.1 - above.1 <= gap)
        .map(|run| Stroke {
            x,
            top: run[0].1,
            bottom: run[run.len() - 1].1,
        })
        .collect()
}

/// Strokes of several clouds at the finest common grid that keeps their number within `limit`.
pub(crate) fn strokes_within(clouds: &[(Vec<(f64, f64)>, f64)], limit: usize) -> Vec<Vec<Stroke>> {
    let mut cell = CELL;
    loop {
        let drawn: Vec<_> = clouds
            .iter()
            .map(|(points, pen)| strokes(points, *pen, cell))
            .collect();
        // Sixteen pixels is coarser than any mark: below that the number cannot be reduced further.
        if cell > 16.0 || drawn.iter().map(Vec::len).sum::<usize>() <= limit {
            return drawn;
        }
        cell *= 1.5;
    }
}

/// A polyline (px) with at most about `limit` vertices that looks the same.
///
/// Vertices on straight steps go first. If too many remain, as in a history of a thousand periods,
/// only the first, lowest, highest and last vertex are kept while the pen stays inside a grid column.
pub(crate) fn polyline(points: &[(f64, f64)], limit: usize) -> Vec<(f64, f64)> {
    // The second pass joins what the window of the first kept apart.
    let smooth = straightened(&straightened(points, SAG), SAG);
    let mut kept = smooth.clone();
    let mut cell = CELL;
    while kept.len() > limit && cell <= 16.0 {
        kept = column_extremes(&smooth, cell);
        cell *= 1.5;
    }
    kept
}

/// Deviation from a straight step that nobody sees (px).
const SAG: f64 = 0.08;

/// Joins steps that lie on one straight line to within `sag` (px). Each step goes to the farthest vertex for
/// which all vertices between lie near the chord.
fn straightened(points: &[(f64, f64)], sag: f64) -> Vec<(f64, f64)> {
    // Longer windows gain little and cost their square.
    const WINDOW: usize = 48;
    let mut kept: Vec<(f64, f64)> = points.first().copied().into_iter().collect();
    let mut at = 0;
    while at + 1 < points.len() {
        let straight = |end: &usize| near_chord(&points[at..=*end], sag);
        let farthest = (at + 2..points.len().min(at + WINDOW))
            .take_while(straight)
            .last();
        at = farthest.unwrap_or(at + 1);
        kept.push(points[at]);
    }
    kept
}

/// Whether every vertex lies within `sag` of the chord and between its ends.
fn near_chord(points: &[(f64, f64)], sag: f64) -> bool {
    let ((x0, y0), (x1, y1)) = (points[0], points[points.len() - 1]);
    let (dx, dy) = (x1 - x0, y1 - y0);
    let length = dx.hypot(dy);
    points.iter().all(|&(x, y)| {
        let (along, across) = ((x - x0) * dx + (y - y0) * dy, (x - x0) * dy - (y - y0) * dx);
        across.abs() <= sag * length && (-sag * length..=length * (length + sag)).contains(&along)
    })
}

fn column_extremes(points: &[(f64, f64)], cell: f64) -> Vec<(f64, f64)> {
    let column = |point: &(f64, f64)| (point.0 / cell).floor() as i64;
    let mut kept = Vec::new();
    for run in points.chunk_by(|a, b| column(a) == column(b)) {
        if run.len() <= 4 {
            kept.extend_from_slice(run);
            continue;
        }
        let by_height = |&a: &usize, &b: &usize| run[a].1.total_cmp(&run[b].1);
        let last = run.len() - 1;
        let highest = (0..run.len()).max_by(by_height).unwrap_or(0);
        let lowest = (0..run.len()).min_by(by_height).unwrap_or(0);
        let mut indices = [0, highest.min(lowest), highest.max(lowest), last].to_vec();
        indices.dedup();
        kept.extend(indices.into_iter().map(|index| run[index]));
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(count: usize) -> Vec<(f64, f64)> {
        // Weyl sequences fill the rectangle evenly and need no random numbers.
        (0..count)
            .map(|i| {
                (
                    (i as f64 * 0.618_033_988_7).fract() * 760.0,
                    (i as f64 * 0.754_877_666_2).fract() * 420.0,
                )
            })
            .collect()
    }

    #[test]
    fn extremes_survive() {
        let points = noise(50_000);
        let drawn = strokes(&points, 1.5, CELL);
        let low = points.iter().map(|p| p.1).fold(f64::INFINITY, f64::min);
        let high = points.iter().map(|p| p.1).fold(0.0, f64::max);
        assert_eq!(
            drawn.iter().map(|s| s.top).fold(f64::INFINITY, f64::min),
            low
        );
        assert_eq!(drawn.iter().map(|s| s.bottom).fold(0.0, f64::max), high);
        let lines = polyline(&points, 1_000_000);
        assert_eq!(lines.iter().map(|p| p.1).fold(0.0, f64::max), high);
    }

    #[test]
    fn the_number_of_strokes_is_bounded() {
        let clouds = vec![(noise(200_000), 1.2), (noise(200_000), 2.0)];
        let drawn: usize = strokes_within(&clouds, 20_000).iter().map(Vec::len).sum();
        assert!(drawn <= 20_000, "{drawn}");
    }

    #[test]
    fn every_point_is_covered() {
        let points = noise(20_000);
        let drawn = strokes(&points, 1.5, CELL);
        for &(x, y) in points.iter().step_by(97) {
            let near = |s: &Stroke| (s.x - x).abs() <= CELL && s.top <= y && y <= s.bottom;
            assert!(drawn.iter().any(near), "({x}, {y})");
        }
    }

    #[test]
    fn equidistant_columns_stay_equidistant() {
        let points: Vec<_> = (0..100).map(|i| (f64::from(i) * 1.9, 10.0)).collect();
        let drawn = strokes(&points, 1.5, CELL);
        assert!(
            drawn
                .windows(2)
                .all(|w| (w[1].x - w[0].x - 1.9).abs() < 1e-9)
        );
    }

    #[test]
    fn a_straight_line_needs_two_ends_and_a_corner_stays() {
        let points: Vec<_> = (0..40)
            .map(|i| (f64::from(i), if i < 20 { 0.0 } else { f64::from(i - 19) }))
            .collect();
        assert_eq!(
            polyline(&points, 1000),
            [(0.0, 0.0), (19.0, 0.0), (39.0, 20.0)]
        );
        assert_eq!(polyline(&[], 1000), []);
    }

    #[test]
    fn a_long_history_keeps_its_envelope() {
        let points: Vec<_> = (0..500_000)
            .map(|i| (f64::from(i) * 0.0016, (f64::from(i) * 0.7).sin()))
            .collect();
        let kept = polyline(&points, 30_000);
        assert!(kept.len() <= 30_000);
        assert!(kept.iter().any(|p| p.1 > 0.9999) && kept.iter().any(|p| p.1 < -0.9999));
    }
}
