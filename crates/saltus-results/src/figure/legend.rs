//! The legend: a row of entries above the panels, broken into more rows where needed. It stands
//! outside the axes, so it cannot cover data.

use super::colour::Colour;
use super::dash::dashed;
use super::ink::{Anchor, Ink, Step, Type, outline, rectangle};
use super::lettering::width as width_of;
use super::panel::{Key, Panel, Swatch, Tally};
use super::style::{BAND, SHADE, TICK};

/// Height of a row (px).
const ROW: f64 = 21.0;
/// Space between entries (px).
const SPACE: f64 = 22.0;

/// Entries of all panels, each label once; tallies add up, and what never occurs is left out.
pub(crate) fn keys(panels: &[Panel]) -> Vec<Key> {
    let mut keys: Vec<Key> = Vec::new();
    for key in panels.iter().flat_map(|panel| &panel.keys) {
        match keys.iter_mut().find(|known| known.label == key.label) {
            Some(known) => {
                if let (Some(sum), Some(more)) = (&mut known.tally, key.tally) {
                    sum.cells += more.cells;
                    sum.total += more.total;
                    // A share of all cells would say little if some belong to a map without shares.
                    sum.share &= more.share;
                }
            }
            None => keys.push(key.clone()),
        }
    }
    keys.retain(|key| key.tally.is_none_or(|tally| tally.cells > 0));
    for key in &mut keys {
        if let Some(tally) = key.tally.filter(|tally| tally.share) {
            key.label = format!("{} ({})", key.label, percent(tally));
        }
    }
    keys
}

/// A share to a tenth of a per cent; what occurs is never 0, and what is not all never 100.
fn percent(tally: Tally) -> String {
    let share = 100.0 * tally.cells as f64 / tally.total as f64;
    if share < 0.1 {
        "< 0.1 %".to_owned()
    } else if tally.cells < tally.total && share > 99.9 {
        "> 99.9 %".to_owned()
    } else {
        format!("{share:.1} %")
    }
}

/// Width of the widest entry (px).
pub(crate) fn widest(keys: &[Key]) -> f64 {
    keys.iter().map(extent).fold(0.0, f64::max)
}

fn extent(key: &Key) -> f64 {
    swatch_width(key) + 7.0 + width_of(&key.label, TICK) + SPACE
}

/// Entries in rows no wider than `width` (px).
pub(crate) fn rows(keys: &[Key], width: f64) -> Vec<Vec<Key>> {
    let mut rows: Vec<Vec<Key>> = Vec::new();
    let mut used = f64::INFINITY;
    for key in keys {
        let need = extent(key);
        if used + need - SPACE > width {
            rows.push(Vec::new());
            used = 0.0;
        }
        used += need;
        if let Some(row) = rows.last_mut() {
            row.push(key.clone());
        }
    }
    rows
}

/// Height of `rows` (px).
pub(crate) fn height(rows: &[Vec<Key>]) -> f64 {
    if rows.is_empty() {
        0.0
    } else {
        rows.len() as f64 * ROW + 5.0
    }
}

/// Draws `rows` from the corner at `left`, `top`.
pub(crate) fn draw(rows: &[Vec<Key>], left: f64, top: f64, ink: &mut Vec<Ink>) {
    for (number, row) in rows.iter().enumerate() {
        let middle = top + (number as f64 + 0.5) * ROW;
        let mut x = left;
        for key in row {
            swatch(key.swatch, x, middle, swatch_width(key), ink);
            let at = (x + swatch_width(key) + 7.0, middle);
            ink.push(Ink::Type(
                Type::new(&key.label, TICK, at, Anchor::Start).centred(),
            ));
            x += extent(key);
        }
    }
}

/// Room of the swatch (px): a dot needs less than a line.
fn swatch_width(key: &Key) -> f64 {
    match key.swatch {
        Swatch::Dot { .. } | Swatch::Symbol(_) | Swatch::Bar => 12.0,
        Swatch::Patch { .. } => 18.0,
        _ => 26.0,
    }
}

fn swatch(swatch: Swatch, x: f64, y: f64, width: f64, ink: &mut Vec<Ink>) {
    let centre = (x + width / 2.0, y);
    let across = || vec![Step::Move(x, y), Step::Line(x + width, y)];
    let (corner, size) = ((x, y - 7.0), (width, 14.0));
    match swatch {
        Swatch::Dot { radius, colour } => ink.push(Ink::dot(centre, radius, colour)),
        Swatch::Dashed { width: pen, colour } => {
            ink.push(Ink::trail(dashed(&across()), pen, colour));
        }
        Swatch::Band => {
            // Grey stands for the band of any curve.
            let colour = Colour::DARK;
            ink.push(rectangle(corner, size, colour, BAND));
            ink.push(Ink::trail(across(), 1.8, colour));
        }
        Swatch::Bar => {
            let steps = vec![
                Step::Move(x + 3.0, y - 6.5),
                Step::Line(x + 9.0, y - 6.5),
                Step::Move(x + 3.0, y + 6.5),
                Step::Line(x + 9.0, y + 6.5),
                Step::Move(x + 6.0, y - 6.5),
                Step::Line(x + 6.0, y + 6.5),
            ];
            ink.push(Ink::trail(steps, 1.3, Colour::DARK));
        }
        Swatch::Symbol(kind) => ink.extend(kind.symbol(centre)),
        Swatch::Shade { colour } => ink.push(rectangle(corner, size, colour, SHADE)),
        Swatch::Patch { colour } => {
            ink.push(rectangle(corner, size, colour, 1.0));
            ink.push(outline(corner, size, 0.7));
        }
        Swatch::Line {
            width: pen,
            colour,
            dotted,
        } => {
            ink.push(Ink::trail(across(), pen, colour));
            if dotted {
                ink.push(Ink::dot(centre, 3.6, colour));
            }
        }
    }
}
