//! The colour bar at the right of a map: the values that its colours stand for.

use super::axes::turned;
use super::axis::Scale;
use super::colour::Colour;
use super::frame::Frame;
use super::ink::{Anchor, Ink, Step, Type, outline};
use super::lettering::{width, wrap};
use super::mosaic::{Cells, Mixing};
use super::style::{EDGE, LABEL, TICK};

/// Distance from the frame, width of the bar, length of ticks, distance of texts (px).
const GAP: f64 = 16.0;
const WIDTH: f64 = 16.0;
const TICKS: f64 = 5.0;
const SPACE: f64 = 4.0;
/// Height of a line of the label, and of the arrow at an end that has values beyond it (px).
const LINE: f64 = 18.0;
const ARROW: f64 = 12.0;

/// A colour scale with its axis.
#[derive(Clone, Debug)]
pub(crate) struct Bar {
    pub(crate) label: String,
    pub(crate) scale: Scale,
    /// From the lowest value to the highest.
    pub(crate) colours: Vec<Colour>,
    /// Whether values lie below the lowest, or above the highest, that the scale shows.
    pub(crate) below: bool,
    pub(crate) above: bool,
}

impl Bar {
    /// Room at the right of a frame of the given height (px).
    pub(crate) fn width(&self, height: f64) -> f64 {
        let lines = wrap(&self.label, LABEL, height).len() as f64;
        self.label_start() + lines * LINE + EDGE
    }

    /// Distance from the frame to the label (px).
    fn label_start(&self) -> f64 {
        let ticks = self.scale.ticks();
        let widest = ticks
            .iter()
            .map(|tick| width(&tick.text, TICK))
            .fold(0.0, f64::max);
        GAP + WIDTH + TICKS + SPACE + widest + 2.0 * SPACE
    }

    /// Draws the bar beside `frame`, as high as that.
    pub(crate) fn draw(&self, frame: &Frame, ink: &mut Vec<Ink>) {
        let left = frame.right + GAP;
        let room = |arrow: bool| if arrow { ARROW } else { 0.0 };
        let (top, bottom) = (
            frame.top + room(self.above),
            frame.bottom - room(self.below),
        );
        self.arrows(left, (top, bottom), ink);
        ink.extend(self.gradient(left, (top, bottom)));
        ink.push(outline((left, top), (WIDTH, bottom - top), 1.0));
        let scale = self.scale.clone().between(bottom, top);
        for tick in scale.ticks() {
            let (from, y) = (left + WIDTH, tick.pixel);
            let steps = vec![Step::Move(from, y), Step::Line(from + TICKS, y)];
            ink.push(Ink::trail(steps, 1.0, Colour::BLACK));
            let at = (from + TICKS + SPACE, y);
            ink.push(Ink::Type(
                Type::new(&tick.text, TICK, at, Anchor::Start).centred(),
            ));
        }
        let lines = wrap(&self.label, LABEL, frame.bottom - frame.top);
        ink.extend(turned(&lines, frame.right + self.label_start(), frame));
    }

    /// The colours as cells of a map one cell wide.
    fn gradient(&self, left: f64, (top, bottom): (f64, f64)) -> Option<Ink> {
        let steps = self.colours.len();
        let cells = Cells {
            x: vec![0.0, 1.0],
            y: (0..=steps).map(|step| step as f64 / steps as f64).collect(),
            codes: (0..steps).map(|step| step as u8).collect(),
            colours: self.colours.clone(),
            mixing: Mixing::Largest,
        };
        let right = left + WIDTH;
        let (x, y) = (
            Scale::of_unit().between(left, right),
            Scale::of_unit().between(bottom, top),
        );
        cells
            .place(&x, &y, [left, top, right, bottom])
            .map(Ink::Mosaic)
    }

    /// Arrows at the ends that have values beyond them.
    fn arrows(&self, left: f64, (top, bottom): (f64, f64), ink: &mut Vec<Ink>) {
        let ends = [
            (self.above, top, -ARROW, self.colours.last()),
            (self.below, bottom, ARROW, self.colours.first()),
        ];
        for (shown, base, height, colour) in ends {
            let Some(&colour) = colour.filter(|_| shown) else {
                continue;
            };
            let corners = [
                (left, base),
                (left + 0.5 * WIDTH, base + height),
                (left + WIDTH, base),
            ];
            let steps = vec![
                Step::Move(corners[0].0, corners[0].1),
                Step::Line(corners[1].0, corners[1].1),
                Step::Line(corners[2].0, corners[2].1),
            ];
            ink.push(Ink::area(corners.to_vec(), colour, 1.0));
            ink.push(Ink::trail(steps, 1.0, Colour::BLACK));
        }
    }
}
