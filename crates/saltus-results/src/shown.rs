//! Names and texts of others, fit to be shown: characters that a terminal would obey are written out.

use std::fmt::Write;
use std::path::Path;

/// `text` on one line, with control characters and marks that change the direction of writing as `\u{1b}`.
pub fn printable(text: &str) -> String {
    escaped(text, |_| false)
}

/// As [`printable`], but line breaks and tabs stay.
pub fn printable_lines(text: &str) -> String {
    escaped(text, |letter| matches!(letter, '\n' | '\t'))
}

/// A path as [`printable`] shows it.
pub fn path(path: &Path) -> String {
    printable(&path.display().to_string())
}

fn escaped(text: &str, stays: impl Fn(char) -> bool) -> String {
    let mut shown = String::with_capacity(text.len());
    for letter in text.chars() {
        if commands(letter) && !stays(letter) {
            // writing to a string cannot fail
            let _ = write!(shown, "{}", letter.escape_default());
        } else {
            shown.push(letter);
        }
    }
    shown
}

/// Whether a terminal obeys the letter instead of showing it.
fn commands(letter: char) -> bool {
    letter.is_control()
        || matches!(letter, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::{printable, printable_lines};

    #[test]
    fn what_a_terminal_would_obey_is_written_out() {
        for (text, shown) in [
            ("ζ_h = 0.3, größer", "ζ_h = 0.3, größer"),
            ("\u{1b}]0;title\u{7}", "\\u{1b}]0;title\\u{7}"),
            ("\u{9b}31m\u{7f}", "\\u{9b}31m\\u{7f}"),
            ("a\nb\tc", "a\\nb\\tc"),
            ("\u{202e}txt.exe", "\\u{202e}txt.exe"),
        ] {
            assert_eq!(printable(text), shown);
        }
        assert_eq!(printable_lines("a\n\u{1b}\tb"), "a\n\\u{1b}\tb");
    }
}
