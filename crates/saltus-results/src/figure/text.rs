//! Width of a text, and breaking it into lines.

use kuva::render::layout::{ComputedLayout, Layout};

/// Width of `text` (px) at `size` in the typeface of the figures.
///
/// kuva keeps its glyph widths private; the space it reserves for a category label is the way in.
/// It reserves two ems at least, hence the three letters added and taken off again.
pub(crate) fn width(text: &str, size: u32) -> f64 {
    const PAD: &str = "MMM";
    reserved(format!("{text}{PAD}"), size) - reserved(PAD.to_owned(), size)
}

fn reserved(text: String, size: u32) -> f64 {
    let layout = Layout::new((0.0, 1.0), (0.0, 1.0))
        .with_y_categories(vec![text])
        .with_tick_size(size);
    ComputedLayout::from_layout(&layout).y_tick_label_px
}

/// Breaks `text` at spaces so that no line is wider than `limit` (px); a longer word stands alone.
pub(crate) fn wrap(text: &str, size: u32, limit: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(&format!("{line} {word}"), size) <= limit => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// Without control characters, which XML forbids.
pub(crate) fn printable(text: &str) -> String {
    text.chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wider_text_is_wider_and_lines_keep_the_limit() {
        assert!(width("i", 14) < width("W", 14));
        assert!(width("", 14).abs() < 1e-9);
        let lines = wrap(
            "a title that is far too long for one line of a narrow panel",
            14,
            120.0,
        );
        assert!(lines.len() > 2);
        assert!(
            lines.iter().all(|line| width(line, 14) <= 120.0),
            "{lines:?}"
        );
    }
}
