//! Layers to marks in pixels. Every coordinate is finite and inside the frame, so neither backend needs a clip
//! path, and a dot at the edge stays whole.

use super::area;
use super::colour::Colour;
use super::dash::dashed;
use super::density::density;
use super::frame::{Frame, clip, line};
use super::ink::{Ink, Step, outline, rectangle};
use super::notes;
use super::panel::{Layer, Panel};
use super::style::{REFERENCE, SHADE};
use super::thin::{Stroke, strokes_within};

/// Draws the layers of `panel`, with at most about `budget` strokes for its clouds.
pub(crate) fn draw(panel: &Panel, frame: &Frame, budget: usize, ink: &mut Vec<Ink>) {
    let mut dust = dust(panel, frame, budget).into_iter();
    for &(x, _) in &panel.flags {
        flag(x, frame, ink);
    }
    for layer in &panel.layers {
        match layer {
            Layer::Notes(notes) => ink.extend(notes::place(notes, panel, frame)),
            Layer::Dust {
                x,
                y,
                pen,
                colour,
                shaded: true,
            } => {
                let shades = density(&frame.visible(x, y), *pen, *colour, frame.sides());
                ink.extend(shades.map(Ink::Density));
            }
            Layer::Dust { pen, colour, .. } => {
                let strokes = dust.next().unwrap_or_default();
                let steps = strokes.iter().flat_map(stroke).collect();
                ink.push(Ink::trail(steps, *pen, *colour));
            }
            alone => draw_alone(alone, frame, ink),
        }
    }
}

/// Draws a layer that depends on no other layer of its panel; notes and dust do.
fn draw_alone(layer: &Layer, frame: &Frame, ink: &mut Vec<Ink>) {
    match layer {
        Layer::Notes(_) | Layer::Dust { .. } => {}
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
            let steps = if *broken { dashed(&whole) } else { whole };
            ink.push(Ink::trail(steps, *width, *colour));
        }
        Layer::Area {
            x,
            low,
            high,
            colour,
            opacity,
        } => {
            let areas = area::between(x, low, high, frame).into_iter();
            ink.extend(areas.map(|corners| Ink::area(corners, *colour, *opacity)));
        }
        Layer::Bars {
            x,
            low,
            high,
            colour,
        } => ink.push(Ink::trail(bars(x, low, high, frame), 1.3, *colour)),
        Layer::Symbols { kind, x, y } => {
            let points = frame.visible(x, y).into_iter();
            ink.extend(points.flat_map(|centre| kind.symbol(centre)));
        }
        Layer::Dots {
            x,
            y,
            radius,
            colour,
        } => {
            let points = frame.visible(x, y).into_iter();
            ink.extend(points.map(|centre| Ink::dot(centre, *radius, *colour)));
        }
    }
}

/// Strokes of each cloud of the panel, thinned together.
fn dust(panel: &Panel, frame: &Frame, budget: usize) -> Vec<Vec<Stroke>> {
    let clouds: Vec<_> = panel
        .layers
        .iter()
        .filter_map(|layer| match layer {
            Layer::Dust {
                x,
                y,
                pen,
                shaded: false,
                ..
            } => Some((frame.visible(x, y), *pen)),
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

/// A dashed straight line for reference.
fn dashes(from: (f64, f64), to: (f64, f64)) -> Ink {
    let (width, colour) = REFERENCE;
    let steps = dashed(&[Step::Move(from.0, from.1), Step::Line(to.0, to.1)]);
    Ink::trail(steps, width, colour)
}
