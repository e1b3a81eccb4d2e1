//! Layers to marks in pixels. Every coordinate is finite and inside the frame when it leaves here, so
//! neither backend needs a clip path, and a dot at the edge stays whole.

use super::area;
use super::axis::Scale;
use super::colour::Colour;
use super::dash::dashed;
use super::mosaic::Mosaic;
use super::notes;
use super::panel::{Layer, Panel, REFERENCE};
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
    /// A filled polygon; the grid stays visible through one that is translucent.
    Area {
        corners: Vec<(f64, f64)>,
        colour: Colour,
        opacity: f64,
    },
    /// Type of the size of ticks with a white rim.
    Word {
        left: f64,
        baseline: f64,
        content: String,
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

/// Opacity of a shade, width of the rim of a dot, and of the pen that draws the rim of type (px).
pub(crate) const SHADE: f64 = 0.3;
pub(crate) const RIM: f64 = 0.9;
pub(crate) const HALO: f64 = 3.0;

/// Draws the layers of `panel`, with at most about `budget` strokes for its clouds.
pub(crate) fn draw(panel: &Panel, frame: &Frame, budget: usize, ink: &mut Vec<Ink>) {
    let mut dust = dust(panel, frame, budget).into_iter();
    for &(x, _) in &panel.flags {
        flag(x, frame, ink);
    }
    for layer in &panel.layers {
        match layer {
            Layer::Cells(cells) => {
                let place = cells.place(&frame.x, &frame.y, frame.sides());
                ink.extend(place.map(Ink::Mosaic));
            }
            Layer::Frame => {
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
                dashed: broken,
            } => {
                let whole = line(x, y, frame);
                ink.push(Ink::Trail {
                    steps: if *broken { dashed(&whole) } else { whole },
                    width: *width,
                    colour: *colour,
                });
            }
            Layer::Area {
                x,
                low,
                high,
                colour,
                opacity,
            } => {
                let areas = area::between(x, low, high, frame).into_iter();
                ink.extend(areas.map(|corners| Ink::Area {
                    corners,
                    colour: *colour,
                    opacity: *opacity,
                }));
            }
            Layer::Bars {
                x,
                low,
                high,
                colour,
            } => ink.push(Ink::Trail {
                steps: bars(x, low, high, frame),
                width: 1.3,
                colour: *colour,
            }),
            Layer::Symbols { kind, x, y } => {
                let points = frame.visible(x, y).into_iter();
                ink.extend(points.flat_map(|centre| kind.symbol(centre)));
            }
            Layer::Notes(notes) => ink.extend(notes::place(notes, panel, frame)),
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

fn bands(intervals: &[(f64, f64)], colour: Colour, frame: &Frame, ink: &mut Vec<Ink>) {
    let inside = |value: f64, beyond: f64| {
        let pixel = frame.x.pixel(value).unwrap_or(beyond);
        pixel.clamp(frame.left, frame.right)
    };
    for &(start, end) in intervals {
        let (left, right) = (inside(start, frame.left), inside(end, frame.right));
        if right > left {
            let size = (right - left, frame.bottom - frame.top);
            ink.push(rectangle((left, frame.top), size, colour, SHADE));
        }
    }
}

/// Bars from `low` to `high` with caps at the ends that show.
fn bars(x: &[f64], low: &[f64], high: &[f64], frame: &Frame) -> Vec<Step> {
    const CAP: f64 = 3.0;
    let ends = |((&x, &low), &high): ((&f64, &f64), &f64)| {
        let (from, to) = (frame.point(x, low)?, frame.point(x, high)?);
        Some((from, to, clip(frame.sides(), from, to)?))
    };
    let mut steps = Vec::new();
    for (from, to, shown) in x.iter().zip(low).zip(high).filter_map(ends) {
        let (x, y) = shown.0;
        steps.extend([Step::Move(x, y), Step::Line(shown.1.0, shown.1.1)]);
        for (x, y) in [from, to].into_iter().filter(|&end| frame.holds(end)) {
            let (left, right) = ((x - CAP).max(frame.left), (x + CAP).min(frame.right));
            steps.extend([Step::Move(left, y), Step::Line(right, y)]);
        }
    }
    steps
}

/// A filled rectangle.
pub(crate) fn rectangle((x, y): (f64, f64), size: (f64, f64), colour: Colour, opacity: f64) -> Ink {
    let (right, below) = (x + size.0, y + size.1);
    Ink::Area {
        corners: vec![(x, y), (x, below), (right, below), (right, y)],
        colour,
        opacity,
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

/// A dashed straight line for reference.
fn dashes(from: (f64, f64), to: (f64, f64)) -> Ink {
    let (width, colour) = REFERENCE;
    let steps = dashed(&[Step::Move(from.0, from.1), Step::Line(to.0, to.1)]);
    Ink::Trail {
        steps,
        width,
        colour,
    }
}
