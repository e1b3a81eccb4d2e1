//! From a figure to one kuva scene: kuva draws axes, ticks and labels; panels are placed here, and the marks
//! between the axes are ours.

use super::axis::Scale;
use super::colour::Colour;
use super::frame::Frame;
use super::ink::Drawing;
use super::legend;
use super::marks;
use super::panel::{Key, Panel};
use super::style::{EDGE, LABEL, PANEL_TITLE, TICK, TITLE};
use super::{Figure, text};
use kuva::plot::LinePlot;
use kuva::render::layout::{AxisLabelOverlap, ComputedLayout, Layout};
use kuva::render::plots::Plot;
use kuva::render::render::{Primitive, Scene, TextAnchor, TextSpan, render_multiple};
use kuva::render::theme::Theme;

/// Distances (px).
const TITLE_LINE: f64 = 22.0;
const PANEL_LINE: f64 = 19.0;
const FLAG_LINE: f64 = 17.0;
const RIGHT: f64 = 28.0;
/// Strokes of all clouds of a figure: about a megabyte of SVG.
const STROKES: usize = 75_000;

/// Lays out the whole figure.
pub(crate) fn drawing(figure: &Figure) -> Drawing {
    let drafts: Vec<Draft> = figure
        .panels
        .iter()
        .enumerate()
        .map(|(i, panel)| Draft::new(figure, i, panel))
        .collect();
    let sheet = Sheet::new(figure, &drafts);
    let mut drawing = sheet.blank(figure);
    for (index, draft) in drafts.iter().enumerate() {
        draft.draw(
            figure,
            sheet.margins(index),
            sheet.corner(index),
            &mut drawing,
        );
    }
    drawing
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
    fn new(figure: &Figure, index: usize, panel: &'a Panel) -> Self {
        let (width, height) = figure.plot;
        let (across, up) = panel.extents();
        let ticks = |length: f64, room: f64| (length / room).round().clamp(3.0, 8.0) as usize;
        let x =
            Scale::resolve(&panel.x, across, panel.pad.0, ticks(width, 95.0)).between(0.0, width);
        let y = Scale::resolve(&panel.y, up, panel.pad.1, ticks(height, 60.0)).between(height, 0.0);
        let tag = if figure.tagged {
            tag(index)
        } else {
            String::new()
        };
        let title = text::wrap(&format!("{tag} {}", panel.title), PANEL_TITLE, width);
        let flags = flags(panel, &x, width);
        let mut draft = Self {
            panel,
            x,
            y,
            tag,
            title,
            flags,
            wish: Margins::default(),
        };
        let auto = ComputedLayout::from_layout(&draft.layout(figure.plot));
        let rows = draft
            .flags
            .iter()
            .map(|flag| flag.row + 1)
            .max()
            .unwrap_or(0);
        let top = draft.title.len() as f64 * PANEL_LINE + rows as f64 * FLAG_LINE + 7.0;
        draft.wish = Margins {
            left: auto.margin_left.ceil(),
            right: panel.bar.as_ref().map_or(RIGHT, |bar| bar.width(height)),
            top,
            bottom: auto.margin_bottom.ceil(),
        };
        draft
    }

    /// Limits, ticks and labels as kuva takes them.
    fn layout(&self, (width, height): (f64, f64)) -> Layout {
        let (x_label, y_label) = (self.x.label(&self.panel.x), self.y.label(&self.panel.y));
        let x_wrap = letters(&x_label, width);
        let y_wrap = letters(&y_label, height);
        Layout::new((self.x.low, self.x.high), (self.y.low, self.y.high))
            .with_x_axis_min(self.x.low)
            .with_x_axis_max(self.x.high)
            .with_y_axis_min(self.y.low)
            .with_y_axis_max(self.y.high)
            .with_x_tick_step(self.x.step)
            .with_y_tick_step(self.y.step)
            .with_x_tick_format(self.x.tick_format())
            .with_y_tick_format(self.y.tick_format())
            .with_x_label_overlap(AxisLabelOverlap::Thin)
            .with_x_label(x_label)
            .with_y_label(y_label)
            .with_x_label_wrap(x_wrap)
            .with_y_label_wrap(y_wrap)
            .with_label_size(LABEL)
            .with_tick_size(TICK)
            .with_box_axes()
            .with_theme(theme())
    }

    /// Draws the panel with its upper left corner at `corner`.
    fn draw(&self, figure: &Figure, margins: Margins, corner: (f64, f64), drawing: &mut Drawing) {
        let (width, height) = figure.plot;
        let layout = self
            .layout(figure.plot)
            .with_width(margins.left + width + margins.right)
            .with_height(margins.top + height + margins.bottom)
            .with_force_margins(margins.left, margins.right)
            // kuva ties the label to the ticks; in a column of panels the labels must stand in line.
            .with_y_label_offset(self.wish.left - margins.left, 0.0)
            .with_force_margins_y(margins.top, margins.bottom);
        // Without any plot kuva draws no axes; an empty one is enough. Its clip path holds nothing.
        let axes = render_multiple(vec![Plot::Line(LinePlot::new())], layout).elements;
        let clip = |e: &Primitive| matches!(e, Primitive::ClipStart { .. } | Primitive::ClipEnd);
        let transform = Some(format!("translate({},{})", corner.0, corner.1));
        drawing.scene.add(Primitive::GroupStart {
            transform,
            title: None,
            extra_attrs: None,
        });
        drawing
            .scene
            .elements
            .extend(axes.into_iter().filter(|element| !clip(element)));
        drawing.scene.add(Primitive::GroupEnd);

        let (left, top) = (corner.0 + margins.left, corner.1 + margins.top);
        let frame = Frame {
            left,
            right: left + width,
            top,
            bottom: top + height,
            x: self.x.clone().between(left, left + width),
            y: self.y.clone().between(top + height, top),
        };
        marks::draw(
            self.panel,
            &frame,
            STROKES / figure.panels.len().max(1),
            &mut drawing.ink,
        );
        if let Some(bar) = &self.panel.bar {
            bar.draw(&frame, &mut drawing.scene.elements, &mut drawing.ink);
        }
        self.heading(&frame, &mut drawing.scene.elements);
    }

    /// Title lines and flag labels above the frame.
    fn heading(&self, frame: &Frame, words: &mut Vec<Primitive>) {
        for flag in &self.flags {
            let y = frame.top - 5.0 - flag.row as f64 * FLAG_LINE;
            words.push(small_text(frame.left + flag.x, y, &flag.label));
        }
        let rows = self
            .flags
            .iter()
            .map(|flag| flag.row + 1)
            .max()
            .unwrap_or(0) as f64;
        let last = frame.top - rows * FLAG_LINE - 9.0;
        for (above, line) in self.title.iter().rev().enumerate() {
            let y = last - above as f64 * PANEL_LINE;
            let first = above + 1 == self.title.len();
            let (bold, plain) = if first {
                line.split_at(self.tag.len())
            } else {
                ("", line.as_str())
            };
            words.push(heading(frame.left, y, PANEL_TITLE, bold, plain));
        }
    }
}

/// Places on the sheet (px): margins, titles, legend.
struct Sheet {
    columns: Vec<Margins>,
    rows: Vec<Margins>,
    plot: (f64, f64),
    title: Vec<String>,
    legend: Vec<Vec<Key>>,
    width: f64,
}

impl Sheet {
    /// Panels of one column share their left margin, panels of one row the others: frames align.
    fn new(figure: &Figure, drafts: &[Draft]) -> Self {
        let count = drafts.len().max(1);
        let columns = figure.columns.min(count);
        let mut sheet = Self {
            columns: vec![Margins::default(); columns],
            rows: vec![Margins::default(); count.div_ceil(columns)],
            plot: figure.plot,
            title: Vec::new(),
            legend: Vec::new(),
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
        let panels: f64 = sheet
            .columns
            .iter()
            .map(|c| c.left + figure.plot.0 + c.right)
            .sum();
        sheet.width = panels.max(left + legend::widest(&keys)) + 2.0 * EDGE;
        let room = sheet.width - left - right.min(RIGHT);
        sheet.title = text::wrap(&figure.title, TITLE, room / BOLDER);
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

    /// A white sheet with the title and the legend.
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
        let mut scene = Scene::new(self.width.ceil(), (self.header() + rows + EDGE).ceil());
        scene.font_family =
            ComputedLayout::from_layout(&Layout::new((0.0, 1.0), (0.0, 1.0))).font_family;
        let left = EDGE + self.columns[0].left;
        for (number, line) in self.title.iter().enumerate() {
            let y = EDGE + (number as f64 + 0.75) * TITLE_LINE;
            scene.add(heading(left, y, TITLE, line, ""));
        }
        let top = EDGE + self.title.len() as f64 * TITLE_LINE;
        let mut ink = Vec::new();
        legend::draw(&self.legend, left, top, &mut scene.elements, &mut ink);
        Drawing { scene, ink }
    }
}

/// Bold type is wider than the regular type that `text::width` measures.
const BOLDER: f64 = 1.14;

/// (a) to (z), then (27) and so on.
fn tag(index: usize) -> String {
    match u8::try_from(index) {
        Ok(small) if small < 26 => format!("({})", char::from(b'a' + small)),
        _ => format!("({})", index + 1),
    }
}

/// Letters per line at which kuva must break `label` so that it fits `room` (px).
fn letters(label: &str, room: f64) -> usize {
    let count = label.chars().count().max(1);
    let share = room / text::width(label, LABEL).max(1.0);
    if share >= 1.0 {
        count
    } else {
        ((count as f64 * share * 0.92) as usize).max(8)
    }
}

/// Labels of vertical lines, each in the lowest row where it touches no other.
fn flags(panel: &Panel, x: &Scale, width: f64) -> Vec<Flag> {
    let mut shown: Vec<(f64, &String)> = panel
        .flags
        .iter()
        .filter_map(|(value, label)| Some((x.pixel(*value)?, label)))
        .filter(|(px, label)| (0.0..=width).contains(px) && !label.is_empty())
        .collect();
    shown.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut ends: Vec<f64> = Vec::new();
    let mut flags = Vec::new();
    for (px, label) in shown {
        let half = text::width(label, TICK) / 2.0;
        // A label near the edge moves inwards rather than over it.
        let centre = px.min(width + RIGHT - half).max(half);
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

fn theme() -> Theme {
    Theme {
        grid_color: "#e4e4e4".to_owned(),
        ..Theme::light()
    }
}

/// A line of type from `x` to the right, beginning in bold.
fn heading(x: f64, y: f64, size: u32, bold: &str, plain: &str) -> Primitive {
    let mut spans = Vec::new();
    for (words, bold) in [(bold, true), (plain, false)] {
        if !words.is_empty() {
            spans.push(TextSpan {
                bold,
                ..TextSpan::plain(text::printable(words))
            });
        }
    }
    Primitive::RichText {
        x,
        y,
        spans,
        size,
        anchor: TextAnchor::Start,
        color: Some(Colour::BLACK.into()),
    }
}

fn small_text(x: f64, y: f64, content: &str) -> Primitive {
    Primitive::Text {
        x,
        y,
        content: text::printable(content),
        size: TICK,
        anchor: TextAnchor::Middle,
        rotate: None,
        bold: false,
        color: Some(Colour::DARK.into()),
    }
}
