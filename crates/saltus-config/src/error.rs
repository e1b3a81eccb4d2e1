//! Errors of a study: the fault, its place in the file, and what would be right.

use crate::shown::{printable, printable_lines};
use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode};
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// Kind of a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum StudyErrorKind {
    /// The file cannot be read.
    Unreadable,
    /// The text is not TOML.
    Syntax,
    /// A key is unknown or missing.
    Key,
    /// A value has the wrong type, is out of range, or contradicts another.
    Value,
    /// An override is malformed or names no key.
    Override,
}

/// A problem with a study, and any further ones found in the same reading.
///
/// Prints one line; as a [`Diagnostic`] it shows the place in the file and what would be right.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyError(Box<Problem>);

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Problem {
    pub(crate) kind: StudyErrorKind,
    pub(crate) message: String,
    pub(crate) help: Option<String>,
    pub(crate) key: Option<String>,
    pub(crate) place: Option<Place>,
    pub(crate) others: Vec<StudyError>,
}

/// A stretch of the study file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Place {
    pub(crate) text: NamedSource<Arc<str>>,
    pub(crate) span: Range<usize>,
    pub(crate) label: &'static str,
}

impl StudyError {
    pub(crate) fn new(kind: StudyErrorKind, message: impl Into<String>) -> Self {
        Self(Box::new(Problem {
            kind,
            message: printable_lines(&message.into()),
            help: None,
            key: None,
            place: None,
            others: Vec::new(),
        }))
    }

    pub(crate) fn help(mut self, help: impl Into<String>) -> Self {
        self.0.help = Some(printable_lines(&help.into()));
        self
    }

    pub(crate) fn key_is(mut self, key: impl Into<String>) -> Self {
        self.0.key = Some(printable(&key.into()));
        self
    }

    pub(crate) fn at(mut self, place: Option<Place>) -> Self {
        self.0.place = place;
        self
    }

    /// The first of these problems, carrying the next ones; `None` if there is none. There are `count` of them: the
    /// list may end before.
    pub(crate) fn first_of(problems: Vec<Self>, count: usize) -> Option<Self> {
        let mut problems = problems.into_iter().take(Self::TOLD);
        let mut first = problems.next()?;
        first.0.others.extend(problems);
        if let more @ 1.. = count.saturating_sub(Self::TOLD) {
            let more = Self::new(first.kind(), format!("and {more} more"));
            first.0.others.push(more);
        }
        Some(first)
    }

    /// Number of problems that are reported one by one.
    pub(crate) const TOLD: usize = 20;

    /// Kind of the fault.
    pub fn kind(&self) -> StudyErrorKind {
        self.0.kind
    }

    /// The key concerned, such as `jumper.0.mass`.
    pub fn key(&self) -> Option<&str> {
        self.0.key.as_deref()
    }

    /// Advice: what would be right.
    pub fn advice(&self) -> Option<&str> {
        self.0.help.as_deref()
    }

    /// Line of the study file, from 1, if the problem is in the file.
    pub fn line(&self) -> Option<usize> {
        let place = self.0.place.as_ref()?;
        let before = place.text.inner().get(..place.span.start)?;
        Some(before.matches('\n').count() + 1)
    }

    /// Start of its place in the file (bytes), if it has one.
    pub(crate) fn start(&self) -> Option<usize> {
        Some(self.0.place.as_ref()?.span.start)
    }

    /// Further problems found in the same reading. Beyond the twentieth problem the last one says how many more.
    pub fn others(&self) -> &[StudyError] {
        &self.0.others
    }
}

impl fmt::Display for StudyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.message)
    }
}

impl std::error::Error for StudyError {}

impl Diagnostic for StudyError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.0
            .help
            .as_ref()
            .map(|h| Box::new(h) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.0.place.as_ref().map(|p| &p.text as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let place = self.0.place.as_ref()?;
        let label = LabeledSpan::new(
            Some(place.label.to_owned()),
            place.span.start,
            place.span.len(),
        );
        Some(Box::new(std::iter::once(label)))
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        if self.0.others.is_empty() {
            return None;
        }
        Some(Box::new(self.0.others.iter().map(|e| e as &dyn Diagnostic)))
    }
}
