//! Layers to marks in pixels. Every coordinate is finite and inside the frame when it leaves here, so
//! neither backend needs a clip path, and a dot at the edge stays whole.

use super::axis::Scale;
use super::colour::Colour;
use super::mosaic::Mosaic;
use super::panel::{Layer, Panel};
use super::thin::{Stroke, polyline, strokes_within};

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
    fn point(&self, x: f64, y: f64) -> Option<(f64, f64)> {
        Some((self.x.pixel(x)?, self.y.pixel(y)?))
    }

    /// Inside the frame, with a hair of tolerance for rounding at its edge.
    fn holds(&self, point: (f64, f64)) -> bool {
        (self.left - 0.01..=self.right + 0.01).contains(&point.0)
            && (self.top - 0.01..=self.bottom + 0.01).contains(&point.1)
    }

    /// Pixels of the points that show.
    fn visible(&self, x: &[f64], y: &[f64]) -> Vec<(f64, f64)> {
        let points = x.iter().zip(y).filter_map(|(&x, &y)| self.point(x, y));
        points.filter(|&point| self.holds(point)).collect()
    }

    /// The part of a step between two pixels that lies inside the frame (Liang & Barsky 1984).
    fn clipped(&self, from: (f64, f64), to: (f64, f64)) -> Option<((f64, f64), (f64, f64))> {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let (mut start, mut end) = (0.0_f64, 1.0_f64);
        let sides = [
            (-dx, from.0 - self.left),
            (dx, self.right - from.0),
            (-dy, from.1 - self.top),
            (dy, self.bottom - from.1),
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
}

/// A mark in pixels of the SVG, ready for either backend.
#[derive(Clone, Debug)]
pub(crate) enum Ink {
    /// Lines drawn with a round pen.
    Trail {
        steps: Vec<Step>,
        width: f64,
        colour: Colour,
    },
    /// A dot with a white rim, so that neighbours stay apart.
    Dot {
        centre: (f64, f64),
        radius: f64,
        colour: Colour,
    },
    /// A translucent rectangle, through which the grid stays visible.
    Shade {
        corner: (f64, f64),
        size: (f64, f64),
        colour: Colour,
    },
    /// A solid rectangle.
    Block {
        corner: (f64, f64),
        size: (f64, f64),
        colour: Colour,
    },
    /// A solid triangle.
    Wedge {
        corners: [(f64, f64); 3],
        colour: Colour,
    },
    /// The cells of a map.
    Mosaic(Mosaic),
}

/// One move of a pen (px).
#[derive(Clone, Copy, Debug)]
pub(crate) enum Step {
    Move(f64, f64),
    Line(f64, f64),
}

/// Opacity of a shade, and width of the rim of a dot (px).
pub(crate) const SHADE: f64 = 0.3;
pub(crate) const RIM: f64 = 0.9;

/// Draws the layers of `panel`, with at most about `budget` strokes for its clouds.
pub(crate) fn draw(panel: &Panel, frame: &Frame, budget: usize, ink: &mut Vec<Ink>) {
    let mut dust = dust(panel, frame, budget).into_iter();
    for &(x, _) in &panel.flags {
        flag(x, frame, ink);
    }
    for layer in &panel.layers {
        match layer {
            Layer::Cells(cells) => {
                let sides = [frame.left, frame.top, frame.right, frame.bottom];
                ink.extend(cells.place(&frame.x, &frame.y, sides).map(Ink::Mosaic));
                // The cells cover the inner half of the frame's line.
                let size = (frame.right - frame.left, frame.bottom - frame.top);
                ink.push(outline((frame.left, frame.top), size, 1.0));
            }
            Layer::Bands { intervals, colour } => bands(intervals, *colour, frame, ink),
            Layer::Level { y } => level(*y, frame, ink),
            Layer::Line {
                x,
                y,
                width,
                colour,
            } => {
                ink.push(Ink::Trail {
                    steps: line(x, y, frame),
                    width: *width,
                    colour: *colour,
                });
            }
            Layer::Dots {
                x,
                y,
                radius,
                colour,
            } => {
                let points = frame.visible(x, y);
                ink.extend(points.into_iter().map(|centre| Ink::Dot {
                    centre,
                    radius: *radius,
                    colour: *colour,
                }));
            }
            Layer::Dust { pen, colour, .. } => {
                let steps = dust
                    .next()
                    .unwrap_or_default()
                    .iter()
                    .flat_map(stroke)
                    .collect();
                ink.push(Ink::Trail {
                    steps,
                    width: *pen,
                    colour: *colour,
                });
            }
        }
    }
}

/// Strokes of each cloud of the panel, thinned together.
fn dust(panel: &Panel, frame: &Frame, budget: usize) -> Vec<Vec<Stroke>> {
    let clouds: Vec<_> = panel
        .layers
        .iter()
        .filter_map(|layer| match layer {
            Layer::Dust { x, y, pen, .. } => Some((frame.visible(x, y), *pen)),
            _ => None,
        })
        .collect();
    strokes_within(&clouds, budget)
}

fn stroke(stroke: &Stroke) -> [Step; 2] {
    [
        Step::Move(stroke.x, stroke.top),
        Step::Line(stroke.x, stroke.bottom),
    ]
}

/// The visible parts of a line, in runs between points that are not finite.
fn line(x: &[f64], y: &[f64], frame: &Frame) -> Vec<Step> {
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
        let Some((from, to)) = frame.clipped(step[0], step[1]) else {
            continue;
        };
        if pen != Some(from) {
            steps.push(Step::Move(from.0, from.1));
        }
        steps.push(Step::Line(to.0, to.1));
        pen = Some(to);
    }
}

fn bands(intervals: &[(f64, f64)], colour: Colour, frame: &Frame, ink: &mut Vec<Ink>) {
    for &(start, end) in intervals {
        let left = frame
            .x
            .pixel(start)
            .unwrap_or(frame.left)
            .clamp(frame.left, frame.right);
        let right = frame
            .x
            .pixel(end)
            .unwrap_or(frame.right)
            .clamp(frame.left, frame.right);
        if right > left {
            let size = (right - left, frame.bottom - frame.top);
            ink.push(Ink::Shade {
                corner: (left, frame.top),
                size,
                colour,
            });
        }
    }
}

fn level(y: f64, frame: &Frame, ink: &mut Vec<Ink>) {
    let Some(y) = frame
        .y
        .pixel(y)
        .filter(|y| (frame.top..=frame.bottom).contains(y))
    else {
        return;
    };
    ink.push(dashes((frame.left, y), (frame.right, y)));
}

fn flag(x: f64, frame: &Frame, ink: &mut Vec<Ink>) {
    let Some(x) = frame
        .x
        .pixel(x)
        .filter(|x| (frame.left..=frame.right).contains(x))
    else {
        return;
    };
    ink.push(dashes((x, frame.top), (x, frame.bottom)));
}

/// The sides of a rectangle, drawn with a pen of `width` (px).
pub(crate) fn outline((x, y): (f64, f64), size: (f64, f64), width: f64) -> Ink {
    let steps = vec![
        Step::Move(x, y),
        Step::Line(x, y + size.1),
        Step::Line(x + size.0, y + size.1),
        Step::Line(x + size.0, y),
        Step::Line(x, y),
    ];
    Ink::Trail {
        steps,
        width,
        colour: Colour::BLACK,
    }
}

/// A dashed straight line. The dashes are drawn one by one, so that both backends agree on them.
pub(crate) fn dashes(from: (f64, f64), to: (f64, f64)) -> Ink {
    const DASH: f64 = 7.0;
    const GAP: f64 = 4.0;
    let length = (to.0 - from.0).hypot(to.1 - from.1).max(1e-9);
    let at = |s: f64| {
        (
            from.0 + (to.0 - from.0) * s / length,
            from.1 + (to.1 - from.1) * s / length,
        )
    };
    let mut steps = Vec::new();
    let mut s = 0.0;
    while s < length {
        let (a, b) = (at(s), at((s + DASH).min(length)));
        steps.extend([Step::Move(a.0, a.1), Step::Line(b.0, b.1)]);
        s += DASH + GAP;
    }
    Ink::Trail {
        steps,
        width: 1.2,
        colour: Colour::DARK,
    }
}
