//! Dashes along any path, drawn one by one so that both backends agree on them.

use super::ink::Step;

/// Length of a dash and of the gap after it (px), both stretched a little to fit the path.
const DASH: f64 = 6.5;
const GAP: f64 = 4.5;
/// Most dashes of one run; a line with more fills the frame.
const MOST: f64 = 5000.0;

/// The path in dashes. Each run begins and ends with a dash and has two at least, so that a short
/// dashed piece does not pass for a solid one.
pub(crate) fn dashed(steps: &[Step]) -> Vec<Step> {
    steps
        .chunk_by(|_, next| matches!(next, Step::Line(..)))
        .flat_map(run)
        .collect()
}

fn run(run: &[Step]) -> Vec<Step> {
    let points: Vec<_> = run
        .iter()
        .map(|&(Step::Move(x, y) | Step::Line(x, y))| (x, y))
        .collect();
    let segments = || points.windows(2).map(|pair| (pair[0], pair[1]));
    let length: f64 = segments().map(|(a, b)| distance(a, b)).sum();
    let gap_share = GAP / (DASH + GAP);
    let count = ((length + GAP) / (DASH + GAP)).round().clamp(2.0, MOST);
    let period = length / (count - gap_share);
    let (dash, gap) = (period * (1.0 - gap_share), period * gap_share);

    let mut steps: Vec<Step> = points
        .iter()
        .take(1)
        .map(|p| Step::Move(p.0, p.1))
        .collect();
    let (mut down, mut left) = (true, dash);
    for (from, to) in segments() {
        let whole = distance(from, to);
        let mut done = 0.0;
        while whole - done > left {
            done += left;
            let at = |a: f64, b: f64| a + (b - a) * done / whole;
            let (x, y) = (at(from.0, to.0), at(from.1, to.1));
            steps.push(if down {
                Step::Line(x, y)
            } else {
                Step::Move(x, y)
            });
            down = !down;
            left = if down { dash } else { gap };
        }
        left -= whole - done;
        if down {
            steps.push(Step::Line(to.0, to.1));
        }
    }
    steps
}

fn distance(a: (f64, f64), b: (f64, f64)) -> f64 {
    (b.0 - a.0).hypot(b.1 - a.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Length drawn, and number of dashes.
    fn drawn(steps: &[Step]) -> (f64, usize) {
        let dashes = dashed(steps);
        let mut pen = (0.0, 0.0);
        let (mut length, mut count) = (0.0, 0);
        for step in dashes {
            let (Step::Move(x, y) | Step::Line(x, y)) = step;
            match step {
                Step::Move(..) => count += 1,
                Step::Line(..) => length += distance(pen, (x, y)),
            }
            pen = (x, y);
        }
        (length, count)
    }

    #[test]
    fn dashes_go_round_corners_and_cover_their_share() {
        let corner = [
            Step::Move(0.0, 0.0),
            Step::Line(50.0, 0.0),
            Step::Line(50.0, 55.5),
        ];
        let (length, count) = drawn(&corner);
        // Ten dashes and nine gaps are 105.5 px long, as the corner is.
        assert_eq!(count, 10);
        assert!((length - 65.0).abs() < 1e-9, "{length}");
    }

    #[test]
    fn a_short_piece_has_two_dashes_and_an_endless_one_an_end() {
        assert_eq!(drawn(&[Step::Move(0.0, 0.0), Step::Line(3.0, 0.0)]).1, 2);
        assert_eq!(drawn(&[Step::Move(0.0, 0.0), Step::Line(1e9, 0.0)]).1, 5000);
        assert_eq!(drawn(&[Step::Move(1.0, 1.0), Step::Line(1.0, 1.0)]).0, 0.0);
        assert!(dashed(&[]).is_empty());
    }
}
