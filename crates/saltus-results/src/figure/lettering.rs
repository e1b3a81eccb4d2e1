//! Type on one line, with typeset symbols: `$ζ_h$` is an italic ζ with the index h, `$10^{−3}$` a power.
//!
//! Between two `$` a single letter stands for a quantity and is italic, several in a row are a name such as cos and
//! upright; `_` lowers and `^` raises what follows, a run of letters and digits or a group in braces. All else is as
//! written.

use super::typeface::{Curve, Style};

/// Size of raised and lowered type, and how far it is raised or lowered (em).
const SCRIPT: f64 = 0.7;
const RAISED: f64 = 0.36;
const LOWERED: f64 = -0.17;

/// Type of one line, in ems of its size.
#[derive(Clone, Debug, Default)]
pub(crate) struct Line {
    pub(crate) runs: Vec<Run>,
    pub(crate) width: f64,
}

/// Letters of one style, size and height.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    pub(crate) text: String,
    pub(crate) style: Style,
    /// Size (em of the line).
    pub(crate) size: f64,
    /// Height above the baseline (em).
    pub(crate) rise: f64,
    start: f64,
}

impl Line {
    /// Sets `content`.
    pub(crate) fn set(content: &str, bold: bool) -> Self {
        let mut line = Self::default();
        let plain = if bold { Style::Bold } else { Style::Regular };
        for (index, part) in content.split('$').enumerate() {
            if index % 2 == 0 {
                line.push(part, plain, 0.0);
            } else {
                line.symbols(part, plain);
            }
        }
        line
    }

    fn symbols(&mut self, part: &str, plain: Style) {
        let letters: Vec<char> = part.chars().collect();
        let mut at = 0;
        while let Some(&letter) = letters.get(at) {
            let run =
                |fits: fn(&char) -> bool| letters[at..].iter().take_while(|c| fits(c)).count();
            match letter {
                '_' | '^' => {
                    let rise = if letter == '_' { LOWERED } else { RAISED };
                    let (script, next) = group(&letters, at + 1);
                    self.push(&script, plain, rise);
                    at = next;
                }
                _ if run(char::is_ascii_alphabetic) > 1 => {
                    let end = at + run(char::is_ascii_alphabetic);
                    self.push(&letters[at..end].iter().collect::<String>(), plain, 0.0);
                    at = end;
                }
                _ => {
                    let style = if letter.is_alphabetic() && plain == Style::Regular {
                        Style::Oblique
                    } else {
                        plain
                    };
                    self.push(letter.encode_utf8(&mut [0; 4]), style, 0.0);
                    at += 1;
                }
            }
        }
    }

    fn push(&mut self, text: &str, style: Style, rise: f64) {
        if text.is_empty() {
            return;
        }
        let size = if rise == 0.0 { 1.0 } else { SCRIPT };
        let width: f64 = text.chars().map(|letter| style.advance(letter)).sum();
        let start = self.width;
        self.width += size * width;
        match self.runs.last_mut() {
            Some(last) if last.style == style && last.rise == rise => last.text.push_str(text),
            _ => self.runs.push(Run {
                text: text.to_owned(),
                style,
                size,
                rise,
                start,
            }),
        }
    }

    /// Outlines of the letters, the line beginning at (0, 0), y up (em).
    pub(crate) fn outlines(&self) -> impl Iterator<Item = Curve> {
        self.runs.iter().flat_map(|run| {
            let mut start = run.start;
            run.text.chars().flat_map(move |letter| {
                let at = start;
                start += run.size * run.style.advance(letter);
                let place = move |(x, y)| (at + run.size * x, run.rise + run.size * y);
                let outline = run.style.outline(letter).into_iter();
                outline.map(move |curve| curve.map(place))
            })
        })
    }
}

/// Letters of a script from `from` on, and the place of the rest.
fn group(letters: &[char], from: usize) -> (String, usize) {
    if letters.get(from) == Some(&'{') {
        let inside = letters[from + 1..].iter().take_while(|&&c| c != '}');
        let script: String = inside.collect();
        let next = from + 2 + script.chars().count();
        return (script, next.min(letters.len()));
    }
    let inside = letters[from.min(letters.len())..].iter();
    let script: String = inside.take_while(|c| c.is_alphanumeric()).collect();
    let next = from + script.chars().count();
    (script, next)
}

/// Width of `content` (px) at `size` (px).
pub(crate) fn width(content: &str, size: f64) -> f64 {
    Line::set(content, false).width * size
}

/// Breaks `content` at spaces outside of symbols so that no line is wider than `limit` (px); a longer word stands
/// alone.
pub(crate) fn wrap(content: &str, size: f64, limit: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let mut open = false;
    let words = content.split(|c: char| {
        open ^= c == '$';
        c.is_whitespace() && !open
    });
    for word in words.filter(|word| !word.is_empty()) {
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

/// The words of `content` without the marks of its symbols, for readers that typeset nothing: ζ_h.
pub(crate) fn plain(content: &str) -> String {
    content
        .chars()
        .filter(|c| !matches!(c, '$' | '{' | '}'))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_are_italic_with_their_indices_and_names_upright() {
        let line = Line::set("Ratio $ζ_h$ at $cos Ωt = 10^{−3}$ (m)", false);
        let runs: Vec<_> = line
            .runs
            .iter()
            .map(|run| (run.text.as_str(), run.style, run.rise))
            .collect();
        let expected = [
            ("Ratio ", Style::Regular, 0.0),
            ("ζ", Style::Oblique, 0.0),
            ("h", Style::Regular, LOWERED),
            (" at cos ", Style::Regular, 0.0),
            ("Ωt", Style::Oblique, 0.0),
            (" = 10", Style::Regular, 0.0),
            ("−3", Style::Regular, RAISED),
            (" (m)", Style::Regular, 0.0),
        ];
        assert_eq!(runs, expected);
        for odd in ["$", "$_", "$^{", "a$b_{", "_x", "$$"] {
            Line::set(odd, false);
        }
    }

    #[test]
    fn wider_text_is_wider_and_lines_keep_the_limit() {
        assert!(width("i", 14.0) < width("W", 14.0));
        assert!(width("", 14.0).abs() < 1e-9);
        assert!(width("$x_h$", 14.0) < width("xh", 14.0));
        let content = "a title with $z / η$ that is far too long for one line of a narrow panel";
        let lines = wrap(content, 14.0, 130.0);
        assert!(lines.len() > 2);
        assert!(lines.iter().all(|line| width(line, 14.0) <= 130.0));
        assert!(
            lines.iter().any(|line| line.contains("$z / η$")),
            "{lines:?}"
        );
    }

    #[test]
    fn outlines_stand_on_the_baseline_one_after_the_other() {
        let line = Line::set("HH", false);
        let points = line.outlines().filter_map(|curve| match curve {
            Curve::Move(p) | Curve::Line(p) => Some(p),
            _ => None,
        });
        let (xs, ys): (Vec<f64>, Vec<f64>) = points.unzip();
        let most = |values: &[f64]| values.iter().copied().fold(f64::MIN, f64::max);
        assert!(most(&xs) > 0.5 * line.width && most(&xs) < line.width);
        // DejaVu's capitals are 0.73 em high.
        assert!((most(&ys) - 0.729).abs() < 0.01, "{}", most(&ys));
        assert!(ys.iter().all(|y| *y >= 0.0));
    }
}
