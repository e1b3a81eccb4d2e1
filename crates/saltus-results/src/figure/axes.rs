//! The axes of a panel: grid, frame, ticks, numbers and labels.

use super::axis::{Scale, Tick};
use super::colour::Colour;
use super::frame::Frame;
use super::ink::{Anchor, Ink, Step, Type, outline};
use super::lettering::{width, wrap};
use super::style::{GRID, LABEL, TICK};

/// Lengths of ticks and of those between them, distance of numbers, of labels, and from line to line (px).
const LONG: f64 = 5.0;
const SHORT: f64 = 3.0;
const SPACE: f64 = 4.0;
const GAP: f64 = 6.0;
const LINE: f64 = 18.0;
/// Least distance of numbers side by side (px).
const APART: f64 = 9.0;

/// One axis of a panel, ready to be drawn: its ticks and its label in lines.
pub(crate) struct Side {
    ticks: Vec<Tick>,
    minor: Vec<f64>,
    label: Vec<String>,
}

impl Side {
    /// The horizontal axis over `length` (px), with as many numbers as have room.
    pub(crate) fn horizontal(scale: &Scale, label: &str, length: f64) -> Self {
        let mut side = Self::vertical(scale, label, length);
        let widest = side.widest();
        if let [first, second, ..] = &side.ticks[..] {
            let every = ((widest + APART) / (second.pixel - first.pixel).abs()).ceil();
            let every = (every as i64).max(1);
            for tick in &mut side.ticks {
                if tick.number.rem_euclid(every) != 0 {
                    tick.text.clear();
                }
            }
        }
        side
    }

    /// The vertical axis over `length` (px).
    pub(crate) fn vertical(scale: &Scale, label: &str, length: f64) -> Self {
        Self {
            ticks: scale.ticks(),
            minor: scale.minor(),
            label: wrap(label, LABEL, length),
        }
    }

    /// Leaves the ticks without numbers and label: another panel has them.
    pub(crate) fn strip(&mut self) {
        self.ticks.iter_mut().for_each(|tick| tick.text.clear());
        self.label.clear();
    }

    fn widest(&self) -> f64 {
        let widths = self.ticks.iter().map(|tick| width(&tick.text, TICK));
        widths.fold(0.0, f64::max)
    }

    fn label_room(&self) -> f64 {
        match self.label.len() {
            0 => 0.0,
            lines => lines as f64 * LINE + GAP,
        }
    }

    /// Room at the left of a frame for this as its vertical axis (px).
    pub(crate) fn left_room(&self) -> f64 {
        (LONG + SPACE + self.widest() + self.label_room()).ceil()
    }

    /// Room below a frame for this as its horizontal axis (px).
    pub(crate) fn bottom_room(&self) -> f64 {
        let numbers = if self.widest() > 0.0 { TICK } else { 0.0 };
        (LONG + SPACE + numbers + self.label_room()).ceil()
    }

    /// Room that the last number of a horizontal axis needs beyond the frame of `length` (px).
    pub(crate) fn right_room(&self, length: f64) -> f64 {
        let beyond = |tick: &Tick| tick.pixel + 0.5 * width(&tick.text, TICK) - length;
        self.ticks.iter().map(beyond).fold(0.0, f64::max)
    }
}

/// Draws both axes around `frame`; the label of the vertical one begins `outer` (px) to the left of it.
pub(crate) fn draw(frame: &Frame, (x, y): (&Side, &Side), outer: f64, ink: &mut Vec<Ink>) {
    let line =
        |from: (f64, f64), to: (f64, f64)| [Step::Move(from.0, from.1), Step::Line(to.0, to.1)];
    let across = |tick: f64| frame.left + tick;
    let up = |tick: f64| frame.top + tick;
    let grid_x = x.ticks.iter().map(|tick| across(tick.pixel));
    let grid_y = y.ticks.iter().map(|tick| up(tick.pixel));
    let grid = grid_x
        .flat_map(|x| line((x, frame.top), (x, frame.bottom)))
        .chain(grid_y.flat_map(|y| line((frame.left, y), (frame.right, y))));
    ink.push(Ink::trail(grid.collect(), 1.0, GRID));

    let mut ticks = Vec::new();
    for (pixels, long) in [(&x.minor, SHORT), (&pixels(x), LONG)] {
        let mark = |&at: &f64| {
            line(
                (across(at), frame.bottom),
                (across(at), frame.bottom + long),
            )
        };
        ticks.extend(pixels.iter().flat_map(mark));
    }
    for (pixels, long) in [(&y.minor, SHORT), (&pixels(y), LONG)] {
        let mark = |&at: &f64| line((frame.left - long, up(at)), (frame.left, up(at)));
        ticks.extend(pixels.iter().flat_map(mark));
    }
    ink.push(Ink::trail(ticks, 1.0, Colour::BLACK));
    let size = (frame.right - frame.left, frame.bottom - frame.top);
    ink.push(outline((frame.left, frame.top), size, 1.0));

    let below = frame.bottom + LONG + SPACE;
    for tick in x.ticks.iter().filter(|tick| !tick.text.is_empty()) {
        let at = (across(tick.pixel), below + 0.78 * TICK);
        ink.push(Ink::Type(Type::new(&tick.text, TICK, at, Anchor::Middle)));
    }
    for tick in &y.ticks {
        let at = (frame.left - LONG - SPACE, up(tick.pixel));
        ink.push(Ink::Type(
            Type::new(&tick.text, TICK, at, Anchor::End).centred(),
        ));
    }
    for (number, words) in x.label.iter().enumerate() {
        let at = (
            0.5 * (frame.left + frame.right),
            below + TICK + GAP + (number as f64 + 0.75) * LINE,
        );
        ink.push(Ink::Type(Type::new(words, LABEL, at, Anchor::Middle)));
    }
    ink.extend(turned(&y.label, frame.left - outer, frame));
}

fn pixels(side: &Side) -> Vec<f64> {
    side.ticks.iter().map(|tick| tick.pixel).collect()
}

/// Lines of a label that is read from below to above, from `left` on, at the middle of the frame.
pub(crate) fn turned(lines: &[String], left: f64, frame: &Frame) -> impl Iterator<Item = Ink> {
    let middle = 0.5 * (frame.top + frame.bottom);
    lines.iter().enumerate().map(move |(number, words)| {
        let at = (left + (number as f64 + 0.75) * LINE, middle);
        Ink::Type(Type {
            turned: true,
            ..Type::new(words, LABEL, at, Anchor::Middle)
        })
    })
}
