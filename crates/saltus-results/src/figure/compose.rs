//! From a figure to one drawing: places panels on the sheet, with their axes, marks, titles and one legend.

use super::Figure;
use super::axes::{self, Side};
use super::axis::{Extent, Scale};
use super::colour::Colour;
use super::frame::Frame;
use super::ink::{Anchor, Drawing, Ink, Type};
use super::legend;
use super::lettering::{Line, plain, printable, width, wrap};
use super::marks;
use super::panel::{Key, Panel};
use super::style::{EDGE, LABEL, PANEL_TITLE, TICK, TITLE};

/// Distances (px).
const TITLE_LINE: f64 = 22.0;
const PANEL_LINE: f64 = 19.0;
const FLAG_LINE: f64 = 17.0;
const RIGHT: f64 = 14.0;
/// Least width of a plot beside others in a figure of given width (px).
const LEAST: f64 = 150.0;
/// Strokes of all clouds of a figure: about a megabyte of SVG.
const STROKES: usize = 75_000;

/// Lays out the whole figure.
pub(crate) fn drawing(figure: &Figure) -> Drawing {
    let target = figure
        .style
        .width
        .map(|width| width * LABEL / figure.style.font);
    let (columns, plot) = match target {
        Some(target) => fitted(figure, target),
        None => (figure.columns, figure.plot),
    };
    let drafts = drafts(figure, columns, plot);
    let sheet = Sheet::new(figure, columns, plot, &drafts);
    let mut drawing = sheet.blank(figure);
    for (index, draft) in drafts.iter().enumerate() {
        let (margins, corner) = (sheet.margins(index), sheet.corner(index));
        let strokes = STROKES / drafts.len().max(1);
        draft.draw(plot, margins, corner, strokes, &mut drawing.ink);
    }
    // a legend that is wider than the sheet widens it: then all is smaller, and the width is still the one asked for
    drawing.point = figure.style.width.map(|width| width / drawing.width);
    drawing
}

/// Columns and size of plots (px) with which the sheet is `target` wide (px).
fn fitted(figure: &Figure, target: f64) -> (usize, (f64, f64)) {
    let aspect = (figure.plot.1 / figure.plot.0).max(0.6);
    let most = figure.columns.min(figure.panels.len().max(1));
    for columns in (1..=most).rev() {
        let mut plot = figure.plot;
        // Margins depend on the numbers at ticks, and these on the size: a few rounds settle it.
        for _ in 0..4 {
            let sheet = Sheet::new(figure, columns, plot, &drafts(figure, columns, plot));
            let wide = (plot.0 + (target - sheet.panels) / columns as f64).max(80.0);
            plot = (wide, wide * aspect);
        }
        if plot.0 >= LEAST || columns == 1 {
            return (columns, plot);
        }
    }
    (1, figure.plot)
}

fn drafts(figure: &Figure, columns: usize, plot: (f64, f64)) -> Vec<Draft<'_>> {
    let mut extents: Vec<(Extent, Extent)> = figure.panels.iter().map(Panel::extents).collect();
    if figure.shared {
        let all = extents
            .iter()
            .fold((Extent::EMPTY, Extent::EMPTY), |all, one| {
                (all.0.with(one.0), all.1.with(one.1))
            });
        extents.iter_mut().for_each(|extents| *extents = all);
    }
    let stack = columns == 1 && stacked(&figure.panels);
    if stack {
        let all = extents
            .iter()
            .fold(Extent::EMPTY, |all, one| all.with(one.0));
        extents.iter_mut().for_each(|extents| extents.0 = all);
    }
    let panels = figure.panels.iter().zip(extents).enumerate();
    panels
        .map(|(index, (panel, extents))| {
            // With common scales the panels at the left and the lowest ones have the numbers for all.
            let below = index + columns < figure.panels.len();
            let bare = (
                below && (stack || figure.shared),
                figure.shared && index % columns > 0,
            );
            Draft::new(figure, (index, panel), extents, plot, bare)
        })
        .collect()
}

/// Whether panels below each other have the horizontal axis in common, so that the lowest alone needs its numbers.
fn stacked(panels: &[Panel]) -> bool {
    panels.len() > 1 && panels.iter().all(|panel| panel.x == panels[0].x)
}

/// Space around the plot area of a panel (px).
#[derive(Clone, Copy, Default)]
struct Margins {
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

/// A panel with its axes resolved and the margins it would like.
struct Draft<'a> {
    panel: &'a Panel,
    x: Scale,
    y: Scale,
    below: Side,
    left: Side,
    tag: String,
    title: Vec<String>,
    flags: Vec<Flag>,
    wish: Margins,
}

/// A label above the frame: at `x` (px from the left axis) in row `row`.
struct Flag {
    x: f64,
    row: usize,
    label: String,
}

impl<'a> Draft<'a> {
    fn new(
        figure: &Figure,
        (index, panel): (usize, &'a Panel),
        (across, up): (Extent, Extent),
        (width, height): (f64, f64),
        bare: (bool, bool),
    ) -> Self {
        let ticks = |length: f64, room: f64| (length / room).round().clamp(3.0, 8.0) as usize;
        let x =
            Scale::resolve(&panel.x, across, panel.pad.0, ticks(width, 95.0)).between(0.0, width);
        let y = Scale::resolve(&panel.y, up, panel.pad.1, ticks(height, 60.0)).between(height, 0.0);
        let mut below = Side::horizontal(&x, &x.label(&panel.x), width);
        if bare.0 {
            below.strip();
        }
        let mut left = Side::vertical(&y, &y.label(&panel.y), height);
        if bare.1 {
            left.strip();
        }
        let tag = if figure.tagged {
            tag(index)
        } else {
            String::new()
        };
        let words = if figure.style.titles {
            panel.title.as_str()
        } else {
            ""
        };
        let title = wrap(&format!("{tag} {words}"), PANEL_TITLE, width);
        let flags = flags(panel, &x, width);
        let rows = rows(&flags);
        let wish = Margins {
            left: left.left_room(),
            right: match &panel.bar {
                Some(bar) => bar.width(height),
                None => RIGHT.max(below.right_room(width) + EDGE),
            },
            top: title.len() as f64 * PANEL_LINE + rows * FLAG_LINE + 7.0,
            bottom: below.bottom_room(),
        };
        Self {
            panel,
            x,
            y,
            below,
            left,
            tag,
            title,
            flags,
            wish,
        }
    }

    /// Draws the panel with its upper left corner at `corner`, with at most about so many strokes for its clouds.
    fn draw(
        &self,
        (width, height): (f64, f64),
        margins: Margins,
        corner: (f64, f64),
        strokes: usize,
        ink: &mut Vec<Ink>,
    ) {
        let (left, top) = (corner.0 + margins.left, corner.1 + margins.top);
        let frame = Frame {
            left,
            right: left + width,
            top,
            bottom: top + height,
            x: self.x.clone().between(left, left + width),
            y: self.y.clone().between(top + height, top),
        };
        // In a column of panels the labels stand in line.
        axes::draw(&frame, (&self.below, &self.left), margins.left, ink);
        marks::draw(self.panel, &frame, strokes, ink);
        if let Some(bar) = &self.panel.bar {
            bar.draw(&frame, ink);
        }
        self.heading(&frame, ink);
    }

    /// Title lines and flag labels above the frame.
    fn heading(&self, frame: &Frame, ink: &mut Vec<Ink>) {
        for flag in &self.flags {
            let y = frame.top - 5.0 - flag.row as f64 * FLAG_LINE;
            ink.push(Ink::Type(Type {
                colour: Colour::DARK,
                ..Type::new(&flag.label, TICK, (frame.left + flag.x, y), Anchor::Middle)
            }));
        }
        let last = frame.top - rows(&self.flags) * FLAG_LINE - 9.0;
        for (above, line) in self.title.iter().rev().enumerate() {
            let y = last - above as f64 * PANEL_LINE;
            let first = above + 1 == self.title.len();
            let bold = if first { self.tag.len() } else { 0 };
            let (bold, rest) = line.split_at(bold);
            let bold = heading(frame.left, y, PANEL_TITLE, bold, true);
            let start = frame.left + bold.line.width * PANEL_TITLE;
            ink.push(Ink::Type(bold));
            ink.push(Ink::Type(heading(start, y, PANEL_TITLE, rest, false)));
        }
    }
}

/// Rows of labels above a frame.
fn rows(flags: &[Flag]) -> f64 {
    flags.iter().map(|flag| flag.row + 1).max().unwrap_or(0) as f64
}

/// Places on the sheet (px): margins, titles, legend.
struct Sheet {
    columns: Vec<Margins>,
    rows: Vec<Margins>,
    plot: (f64, f64),
    title: Vec<String>,
    legend: Vec<Vec<Key>>,
    /// Width of the panels with their margins, and of the sheet.
    panels: f64,
    width: f64,
}

impl Sheet {
    /// Panels of one column share their left margin, panels of one row the others: frames align.
    fn new(figure: &Figure, columns: usize, plot: (f64, f64), drafts: &[Draft]) -> Self {
        let count = drafts.len().max(1);
        let columns = columns.min(count);
        let mut sheet = Self {
            columns: vec![Margins::default(); columns],
            rows: vec![Margins::default(); count.div_ceil(columns)],
            plot,
            title: Vec::new(),
            legend: Vec::new(),
            panels: 0.0,
            width: 0.0,
        };
        for (index, draft) in drafts.iter().enumerate() {
            let column = &mut sheet.columns[index % columns];
            column.left = column.left.max(draft.wish.left);
            column.right = column.right.max(draft.wish.right);
            let row = &mut sheet.rows[index / columns];
            row.top = row.top.max(draft.wish.top);
            row.bottom = row.bottom.max(draft.wish.bottom);
        }
        let keys = legend::keys(&figure.panels);
        let left = sheet.columns[0].left;
        let right = sheet.columns[columns - 1].right;
        let panels = sheet.columns.iter().map(|c| c.left + plot.0 + c.right);
        sheet.panels = panels.sum::<f64>() + 2.0 * EDGE;
        sheet.width = sheet.panels.max(left + legend::widest(&keys) + 2.0 * EDGE);
        let room = sheet.width - 2.0 * EDGE - left - right.min(RIGHT);
        if figure.style.titles {
            sheet.title = wrap(&figure.title, TITLE, room / BOLDER);
        }
        sheet.legend = legend::rows(&keys, room);
        sheet
    }

    fn header(&self) -> f64 {
        EDGE + self.title.len() as f64 * TITLE_LINE + legend::height(&self.legend)
    }

    fn margins(&self, index: usize) -> Margins {
        let row = self.rows[index / self.columns.len()];
        let column = self.columns[index % self.columns.len()];
        Margins {
            left: column.left,
            right: column.right,
            ..row
        }
    }

    /// Upper left corner of panel `index`.
    fn corner(&self, index: usize) -> (f64, f64) {
        let (row, column) = (index / self.columns.len(), index % self.columns.len());
        let x: f64 = self.columns[..column]
            .iter()
            .map(|c| c.left + self.plot.0 + c.right)
            .sum();
        let y: f64 = self.rows[..row]
            .iter()
            .map(|r| r.top + self.plot.1 + r.bottom)
            .sum();
        (EDGE + x, self.header() + y)
    }

    /// A sheet with the title and the legend.
    fn blank(&self, figure: &Figure) -> Drawing {
        let panels: f64 = self
            .rows
            .iter()
            .map(|r| r.top + self.plot.1 + r.bottom)
            .sum();
        let rows = if figure.panels.is_empty() {
            0.0
        } else {
            panels
        };
        let left = EDGE + self.columns[0].left;
        let mut ink = Vec::new();
        for (number, line) in self.title.iter().enumerate() {
            let y = EDGE + (number as f64 + 0.75) * TITLE_LINE;
            ink.push(Ink::Type(heading(left, y, TITLE, line, true)));
        }
        let top = EDGE + self.title.len() as f64 * TITLE_LINE;
        legend::draw(&self.legend, left, top, &mut ink);
        Drawing {
            width: self.width.ceil(),
            height: (self.header() + rows + EDGE).ceil(),
            point: None,
            title: plain(&printable(&figure.title)),
            description: description(figure),
            ink,
        }
    }
}

/// Bold type is wider than the regular type that lines are broken by.
const BOLDER: f64 = 1.14;

/// Quantities of each panel, for those who do not see it.
fn description(figure: &Figure) -> String {
    let axes = |panel: &Panel| {
        let title = if panel.title.is_empty() {
            String::new()
        } else {
            format!("{}: ", panel.title)
        };
        format!("{title}{} over {}.", panel.y.label, panel.x.label)
    };
    let mut sentences: Vec<String> = figure.panels.iter().map(axes).collect();
    sentences.dedup();
    let keys = legend::keys(&figure.panels);
    if !keys.is_empty() {
        let labels: Vec<String> = keys.into_iter().map(|key| key.label).collect();
        sentences.push(format!("Legend: {}.", labels.join("; ")));
    }
    plain(&printable(&sentences.join(" ")))
}

/// (a) to (z), then (27) and so on.
fn tag(index: usize) -> String {
    match u8::try_from(index) {
        Ok(small) if small < 26 => format!("({})", char::from(b'a' + small)),
        _ => format!("({})", index + 1),
    }
}

/// Labels of vertical lines, each in the lowest row where it touches no other.
fn flags(panel: &Panel, x: &Scale, plot: f64) -> Vec<Flag> {
    let mut shown: Vec<(f64, &String)> = panel
        .flags
        .iter()
        .filter_map(|(value, label)| Some((x.pixel(*value)?, label)))
        .filter(|(px, label)| (0.0..=plot).contains(px) && !label.is_empty())
        .collect();
    shown.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut ends: Vec<f64> = Vec::new();
    let mut flags = Vec::new();
    for (px, label) in shown {
        let half = width(label, TICK) / 2.0;
        // A label near the edge moves inwards rather than over it.
        let centre = px.min(plot + RIGHT - half).max(half);
        let row = ends
            .iter()
            .position(|&end| end + 8.0 <= centre - half)
            .unwrap_or(ends.len());
        if row == ends.len() {
            ends.push(0.0);
        }
        ends[row] = centre + half;
        flags.push(Flag {
            x: centre,
            row,
            label: label.clone(),
        });
    }
    flags
}

/// A line of type from `x` to the right.
fn heading(x: f64, y: f64, size: f64, words: &str, bold: bool) -> Type {
    Type {
        line: Line::set(&printable(words), bold),
        ..Type::new("", size, (x, y), Anchor::Start)
    }
}
