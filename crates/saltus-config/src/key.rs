//! Keys: dotted names such as `plate.length`, `jumper.mass` (every jumper) and `jumper.0.mass` (one).

use crate::shown::printable;
use std::fmt;

/// A dotted name, segment by segment; empty for the study itself.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub(crate) struct Key(Vec<String>);

impl Key {
    /// Splits `plate.length`; `None` if a segment is empty.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let segments: Vec<String> = text.trim().split('.').map(str::to_owned).collect();
        segments
            .iter()
            .all(|s| !s.is_empty())
            .then_some(Self(segments))
    }

    pub(crate) fn child(&self, name: impl fmt::Display) -> Self {
        let mut segments = self.0.clone();
        segments.push(name.to_string());
        Self(segments)
    }

    /// The table that holds this key; the study itself has none.
    pub(crate) fn parent(&self) -> Option<Self> {
        let (_, rest) = self.0.split_last()?;
        Some(Self(rest.to_vec()))
    }

    pub(crate) fn segments(&self) -> &[String] {
        &self.0
    }

    /// The key without indices, as the schema knows it: `jumper.0.mass` is `jumper.mass`.
    pub(crate) fn without_indices(&self) -> String {
        let names: Vec<&str> = self
            .0
            .iter()
            .map(String::as_str)
            .filter(|s| index(s).is_none())
            .collect();
        names.join(".")
    }
}

/// The number in a segment such as the 0 of `jumper.0.mass`.
pub(crate) fn index(segment: &str) -> Option<usize> {
    segment
        .bytes()
        .all(|b| b.is_ascii_digit())
        .then(|| segment.parse().ok())
        .flatten()
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&printable(&self.0.join(".")))
    }
}
