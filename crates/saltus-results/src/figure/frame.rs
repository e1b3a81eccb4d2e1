//! The area between the axes of a panel, and the parts of a line that show in it.

use super::axis::Scale;
use super::ink::Step;
use super::thin::polyline;

/// The plot area of a panel (px) and the scales of its axes.
pub(crate) struct Frame {
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) top: f64,
    pub(crate) bottom: f64,
    pub(crate) x: Scale,
    pub(crate) y: Scale,
}

/// Vertices of all lines of a panel stay within this.
const LINE_VERTICES: usize = 40_000;

impl Frame {
    pub(crate) fn point(&self, x: f64, y: f64) -> Option<(f64, f64)> {
        Some((self.x.pixel(x)?, self.y.pixel(y)?))
    }

    /// Inside the frame, with a hair of tolerance for rounding at its edge.
    pub(crate) fn holds(&self, point: (f64, f64)) -> bool {
        (self.left - 0.01..=self.right + 0.01).contains(&point.0)
            && (self.top - 0.01..=self.bottom + 0.01).contains(&point.1)
    }

    /// Pixels of the points that show.
    pub(crate) fn visible(&self, x: &[f64], y: &[f64]) -> Vec<(f64, f64)> {
        let points = x.iter().zip(y).filter_map(|(&x, &y)| self.point(x, y));
        points.filter(|&point| self.holds(point)).collect()
    }

    /// Left, top, right and bottom (px).
    pub(crate) fn sides(&self) -> [f64; 4] {
        [self.left, self.top, self.right, self.bottom]
    }
}

/// The part of a step between two pixels that lies inside a rectangle (Liang & Barsky 1984).
pub(crate) fn clip(
    [left, top, right, bottom]: [f64; 4],
    from: (f64, f64),
    to: (f64, f64),
) -> Option<((f64, f64), (f64, f64))> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let (mut start, mut end) = (0.0_f64, 1.0_f64);
    let sides = [
        (-dx, from.0 - left),
        (dx, right - from.0),
        (-dy, from.1 - top),
        (dy, bottom - from.1),
    ];
    for (speed, room) in sides {
        if speed == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if speed < 0.0 {
            start = start.max(room / speed);
        } else {
            end = end.min(room / speed);
        }
    }
    let at = |t: f64| (from.0 + t * dx, from.1 + t * dy);
    (start <= end).then(|| (at(start), at(end)))
}

/// The visible parts of a line, in runs between points that are not finite.
pub(crate) fn line(x: &[f64], y: &[f64], frame: &Frame) -> Vec<Step> {
    let pixels: Vec<_> = x.iter().zip(y).map(|(&x, &y)| frame.point(x, y)).collect();
    let mut steps = Vec::new();
    for run in pixels.split(Option::is_none) {
        let run: Vec<_> = run.iter().copied().flatten().collect();
        let share = LINE_VERTICES * run.len() / pixels.len().max(1);
        append_run(&polyline(&run, share.max(16)), frame, &mut steps);
    }
    steps
}

/// Appends the visible steps of a run, lifting the pen where the line leaves the frame.
fn append_run(run: &[(f64, f64)], frame: &Frame, steps: &mut Vec<Step>) {
    let mut pen = None;
    for step in run.windows(2) {
        let Some((from, to)) = clip(frame.sides(), step[0], step[1]) else {
            continue;
        };
        if pen != Some(from) {
            steps.push(Step::Move(from.0, from.1));
        }
        steps.push(Step::Line(to.0, to.1));
        pen = Some(to);
    }
}
