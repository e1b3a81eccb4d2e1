//! Faults of a study, each at its key, before it is known where the key came from.

use crate::error::{StudyError, StudyErrorKind};
use crate::key::Key;
use crate::schema::{description, header};
use toml::Value;

/// One fault.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Fault {
    pub(crate) kind: StudyErrorKind,
    pub(crate) key: Key,
    pub(crate) point: Point,
    pub(crate) message: String,
    pub(crate) help: Option<String>,
}

/// Part of the file to underline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Point {
    /// The name of the key.
    Name,
    /// Its value.
    Value,
    /// The table in which it is missing.
    Table,
}

impl Fault {
    /// A value that is wrong, with the value in the message.
    pub(crate) fn value(key: &Key, given: &Value, what: &str) -> Self {
        let message = format!("{key} = {}: {what}", shown(given));
        Self::told(key, message, description(key))
    }

    /// A value that is wrong, in these words.
    pub(crate) fn told(key: &Key, message: String, help: Option<String>) -> Self {
        Self {
            kind: StudyErrorKind::Value,
            key: key.clone(),
            point: Point::Value,
            message,
            help,
        }
    }

    /// A key that is not there.
    pub(crate) fn missing(key: &Key, help: Option<String>) -> Self {
        let parent = key.parent().filter(|p| !p.segments().is_empty());
        let message = match parent {
            Some(parent) => format!("{key} is missing from {}", header(&parent)),
            None => format!("the table [{key}] is missing"),
        };
        Self {
            kind: StudyErrorKind::Key,
            key: key.clone(),
            point: Point::Table,
            message,
            help,
        }
    }
}

/// Faults found: the first ones, and how many there are. A file of another kind has more than anybody reads.
#[derive(Default)]
pub(crate) struct Faults {
    first: Vec<Fault>,
    count: usize,
}

impl Faults {
    /// More than are reported, since those that stand first in the file need not be found first.
    const KEPT: usize = 10 * StudyError::TOLD;

    pub(crate) fn add(&mut self, fault: impl FnOnce() -> Fault) {
        if !self.is_full() {
            self.first.push(fault());
        }
        self.count += 1;
    }

    pub(crate) fn is_full(&self) -> bool {
        self.first.len() >= Self::KEPT
    }

    pub(crate) fn count(&self) -> usize {
        self.count
    }
}

impl IntoIterator for Faults {
    type Item = Fault;
    type IntoIter = std::vec::IntoIter<Fault>;

    fn into_iter(self) -> Self::IntoIter {
        self.first.into_iter()
    }
}

impl FromIterator<Fault> for Faults {
    fn from_iter<I: IntoIterator<Item = Fault>>(faults: I) -> Self {
        let mut found = Self::default();
        faults.into_iter().for_each(|fault| found.add(|| fault));
        found
    }
}

/// The first fault as an error that carries the others.
pub(crate) fn refuse(faults: Vec<Fault>) -> Result<(), StudyError> {
    let count = faults.len();
    let problems = faults.into_iter().take(StudyError::TOLD).map(|fault| {
        let error = StudyError::new(fault.kind, fault.message).key_is(fault.key.to_string());
        match fault.help {
            Some(help) => error.help(help),
            None => error,
        }
    });
    StudyError::first_of(problems.collect(), count).map_or(Ok(()), Err)
}

/// The key of a dotted name that is written in this crate.
pub(crate) fn key(name: &str) -> Key {
    Key::parse(name).unwrap_or_default()
}

/// A value at a dotted name that is wrong, with the value in the message.
pub(crate) fn wrong(name: &str, given: impl Into<Value>, what: &str) -> Fault {
    Fault::value(&key(name), &given.into(), what)
}

/// The value as written, cut to a length that fits in a message.
fn shown(value: &Value) -> String {
    let text = value.to_string().replace('\n', " ");
    let mut short: String = text.chars().take(60).collect();
    if short.len() < text.len() {
        short.push_str("...");
    }
    short
}
