//! Names and texts from a study, fit to be shown: characters that a terminal would obey are written out.

use std::fmt::Write;

/// `text` on one line, with control characters and marks that change the direction of writing as `\u{1b}`.
pub(crate) fn printable(text: &str) -> String {
    escaped(text, |_| false)
}

/// As [`printable`], but line breaks stay, as those of an override.
pub(crate) fn printable_lines(text: &str) -> String {
    escaped(text, |letter| letter == '\n')
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

/// The lines of a file, of the same length in bytes, with such letters as `?` or a mark of their length: places in
/// the text stay where they are.
pub(crate) fn printable_source(text: &str) -> String {
    let stays = |letter| matches!(letter, '\n' | '\r' | '\t') || !commands(letter);
    let mark = |letter: char| match letter.len_utf8() {
        _ if stays(letter) => letter,
        1 => '?',
        2 => '\u{bf}',
        _ => '\u{fffd}',
    };
    text.chars().map(mark).collect()
}

/// Whether a terminal obeys the letter instead of showing it.
fn commands(letter: char) -> bool {
    letter.is_control()
        || matches!(letter, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::{printable, printable_source};

    #[test]
    fn what_a_terminal_would_obey_is_not_shown_as_it_is() {
        assert_eq!(printable("a\u{1b}[31m\nζ\u{9b}"), "a\\u{1b}[31m\\nζ\\u{9b}");
        let text = "ζ = 1 # \u{1b}]0;x\u{7}\u{9b}\u{202e}\n\tz = 2";
        let shown = printable_source(text);
        assert_eq!(shown, "ζ = 1 # ?]0;x?\u{bf}\u{fffd}\n\tz = 2");
        assert_eq!(shown.len(), text.len());
    }
}
