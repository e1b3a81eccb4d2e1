//! Placing of short labels beside points inside the frame: none overlaps another, and few hide a curve.

use super::frame::{Frame, clip, line};
use super::ink::{Anchor, Ink, Step, Type};
use super::lettering::width;
use super::panel::{Layer, Note, Panel, Place};
use super::style::TICK;

/// Points of a cycle that are tried: each costs a look at all curves.
const ENOUGH: usize = 16;

impl Place {
    /// The points that show (px).
    fn points(&self, frame: &Frame) -> Vec<(f64, f64)> {
        match self {
            Self::At(points) => {
                let (x, y): (Vec<_>, Vec<_>) = points.iter().copied().unzip();
                let mut shown = frame.visible(&x, &y);
                shown.truncate(ENOUGH);
                shown
            }
            Self::Along(x, y) => along(&line(x, y, frame)),
        }
    }
}

/// Points along what shows of a curve, from its middle to its ends by tenths of its length.
fn along(steps: &[Step]) -> Vec<(f64, f64)> {
    let segments = || steps.windows(2).filter_map(segment);
    let whole: f64 = segments().map(length).sum();
    let at = |share: f64| {
        let mut left = share * whole;
        segments().find_map(|(from, to)| {
            let long = length((from, to));
            if left > long {
                left -= long;
                return None;
            }
            let share = left / long.max(1e-9);
            Some((
                from.0 + share * (to.0 - from.0),
                from.1 + share * (to.1 - from.1),
            ))
        })
    };
    let shares = [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9];
    shares.into_iter().filter_map(at).collect()
}

/// The ends of a step that draws.
fn segment(pair: &[Step]) -> Option<((f64, f64), (f64, f64))> {
    match *pair {
        [Step::Move(a, b) | Step::Line(a, b), Step::Line(c, d)] => Some(((a, b), (c, d))),
        _ => None,
    }
}

fn length((from, to): ((f64, f64), (f64, f64))) -> f64 {
    (to.0 - from.0).hypot(to.1 - from.1)
}

/// Left, top, right and bottom (px).
type Sides = [f64; 4];

/// Distances of a label from its point (px), and half the size of the symbol at the point.
const DISTANCES: [f64; 2] = [8.0, 14.0];
const SYMBOL: f64 = 6.0;
/// Directions from the point, right and down, the best first.
const DIRECTIONS: [(f64, f64); 8] = [
    (0.7, -0.7),
    (-0.7, -0.7),
    (0.7, 0.7),
    (-0.7, 0.7),
    (0.0, -1.0),
    (0.0, 1.0),
    (1.0, 0.0),
    (-1.0, 0.0),
];

/// The notes of a panel one after the other, each where it hides the least length of curves; one that
/// finds no room is left out.
pub(crate) fn place(notes: &[Note], panel: &Panel, frame: &Frame) -> Vec<Ink> {
    let obstacles = Obstacles::of(panel, frame);
    let mut taken: Vec<Sides> = Vec::new();
    let mut ink = Vec::new();
    for note in notes {
        let best = candidates(note, width(&note.text, TICK), frame)
            .filter(|sides| obstacles.admits(sides, frame))
            .filter(|sides| !taken.iter().any(|other| overlap(sides, other)))
            .enumerate()
            // Later candidates must be clearer by a little to be taken.
            .map(|(rank, sides)| (obstacles.hidden(&sides) + 0.2 * rank as f64, sides))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, sides)) = best {
            taken.push(sides);
            let at = (sides[0], sides[3] - 1.5);
            ink.push(Ink::Type(Type {
                rim: true,
                ..Type::new(&note.text, TICK, at, Anchor::Start)
            }));
        }
    }
    ink
}

fn candidates(note: &Note, width: f64, frame: &Frame) -> impl Iterator<Item = Sides> {
    let half = (0.5 * width + 1.0, 0.5 * TICK);
    note.place.points(frame).into_iter().flat_map(move |point| {
        DISTANCES.into_iter().flat_map(move |distance| {
            DIRECTIONS.into_iter().map(move |(right, down)| {
                let x = point.0 + right * distance + half.0 * sign(right);
                let y = point.1 + down * distance + half.1 * sign(down);
                [x - half.0, y - half.1, x + half.0, y + half.1]
            })
        })
    })
}

/// `signum`, but zero for zero.
fn sign(value: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value.signum() }
}

fn overlap(a: &Sides, b: &Sides) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// Symbols and curves that labels should keep away from (px).
struct Obstacles {
    symbols: Vec<Sides>,
    curves: Vec<Vec<Step>>,
}

impl Obstacles {
    fn of(panel: &Panel, frame: &Frame) -> Self {
        let around = |(x, y)| [x - SYMBOL, y - SYMBOL, x + SYMBOL, y + SYMBOL];
        let symbols = panel.layers.iter().filter_map(|layer| match layer {
            Layer::Symbols { x, y, .. } => Some(frame.visible(x, y)),
            _ => None,
        });
        let curves = panel.layers.iter().filter_map(|layer| match layer {
            Layer::Line { x, y, .. } => Some(line(x, y, frame)),
            _ => None,
        });
        Self {
            symbols: symbols.flatten().map(around).collect(),
            curves: curves.collect(),
        }
    }

    /// Whether the label is inside the frame and off all symbols.
    fn admits(&self, sides: &Sides, frame: &Frame) -> bool {
        let inside = sides[0] > frame.left + 2.0
            && sides[1] > frame.top + 2.0
            && sides[2] < frame.right - 2.0
            && sides[3] < frame.bottom - 2.0;
        inside && !self.symbols.iter().any(|symbol| overlap(sides, symbol))
    }

    /// Length of curves under the label (px).
    fn hidden(&self, sides: &Sides) -> f64 {
        let curves = self.curves.iter().flat_map(|steps| steps.windows(2));
        let under = |(from, to)| clip(*sides, from, to).map_or(0.0, length);
        curves.filter_map(segment).map(under).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::axis::{Axis, Scale};
    use crate::figure::colour::Colour;

    fn frame() -> Frame {
        Frame {
            left: 0.0,
            right: 400.0,
            top: 0.0,
            bottom: 300.0,
            x: Scale::of_unit().between(0.0, 400.0),
            y: Scale::of_unit().between(300.0, 0.0),
        }
    }

    #[test]
    fn a_curve_of_two_far_points_has_its_label_inside() {
        let far = Note {
            text: "NS".to_owned(),
            place: Place::Along(vec![-5.0, 9.0], vec![0.5, 0.5]),
        };
        let words = placed(&place(&[far], &panel(), &frame()));
        assert!((words[0].0 - 200.0).abs() < 30.0, "{words:?}");
    }

    fn note(text: &str, x: f64, y: f64) -> Note {
        Note {
            text: text.to_owned(),
            place: Place::At(vec![(x, y)]),
        }
    }

    fn panel() -> Panel {
        Panel::new(String::new(), Axis::new("x"), Axis::new("y"), (0.0, 0.0))
    }

    fn placed(ink: &[Ink]) -> Vec<(f64, f64)> {
        let word = |ink: &Ink| match ink {
            Ink::Type(word) => Some(word.at),
            _ => None,
        };
        ink.iter().filter_map(word).collect()
    }

    #[test]
    fn crowded_labels_move_and_then_drop_out() {
        let notes: Vec<Note> = (0..40)
            .map(|i| note("PD1", 0.5 + 1e-4 * f64::from(i), 0.5))
            .collect();
        let words = placed(&place(&notes, &panel(), &frame()));
        assert!((2..40).contains(&words.len()), "{words:?}");
        let wide = width("PD1", TICK);
        for (i, a) in words.iter().enumerate() {
            for b in &words[..i] {
                let apart = (a.0 - b.0).abs() >= wide || (a.1 - b.1).abs() >= TICK;
                assert!(apart, "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn a_label_avoids_a_curve_and_the_edge() {
        let mut panel = panel();
        // A rising line passes through the place liked best, above and to the right.
        panel.layers.push(Layer::Line {
            x: vec![0.0, 1.0],
            y: vec![0.0, 1.0],
            width: 1.0,
            colour: Colour::BLACK,
            dashed: false,
        });
        let words = placed(&place(&[note("SN", 0.5, 0.5)], &panel, &frame()));
        assert!(words[0].0 < 200.0, "{words:?}");
        let words = placed(&place(&[note("SN", 0.995, 0.995)], &panel, &frame()));
        assert!(words[0].0 < 390.0 && words[0].1 > 10.0, "{words:?}");
        assert!(place(&[note("SN", 2.0, f64::NAN)], &panel, &frame()).is_empty());
    }
}
