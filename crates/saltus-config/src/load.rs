//! From a file and overrides to a checked study.

use crate::Study;
use crate::error::{StudyError, StudyErrorKind};
use crate::fault::{Fault, Faults, Point};
use crate::format;
use crate::json;
use crate::key::Key;
use crate::overrides::{self, SetBy};
use crate::questions;
use crate::schema::Node;
use crate::source::Source;
use crate::structure;
use serde::Deserialize;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// A study file holds a few hundred lines; more than this is some other file.
const MAX_BYTES: u64 = 4 << 20;

/// Reads and checks the study file at `path`, with overrides such as `jumper.mass=80`.
///
/// # Errors
/// A [`StudyError`] of kind [`Unreadable`](StudyErrorKind::Unreadable) that names the path, or as [`parse`].
pub fn load(path: impl AsRef<Path>, sets: &[String]) -> Result<Study, StudyError> {
    let path = path.as_ref();
    let name = path.display().to_string();
    match open(path) {
        Ok(file) => read(&name, file, sets),
        Err(e) if e.kind() == io::ErrorKind::NotFound => {
            Err(unreadable(&name, "there is no such file")
                .help("`saltus init paper --out FILE` writes one to start from"))
        }
        Err(e) => Err(unreadable(&name, &plain(&e))),
    }
}

fn open(path: &Path) -> io::Result<File> {
    let file = File::open(path)?;
    if file.metadata()?.is_dir() {
        return Err(io::Error::new(
            io::ErrorKind::IsADirectory,
            "it is a directory, not a file",
        ));
    }
    Ok(file)
}

/// Reads and checks a study from anywhere, such as standard input; `name` stands for it in messages.
///
/// # Errors
/// As [`load`].
pub fn read(name: &str, from: impl Read, sets: &[String]) -> Result<Study, StudyError> {
    let mut bytes = Vec::new();
    // one byte more than is allowed is enough to know that there is too much
    from.take(MAX_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(|e| unreadable(name, &plain(&e)))?;
    if bytes.len() as u64 > MAX_BYTES {
        let reason = format!(
            "it is larger than {} MiB, too large for a study file",
            MAX_BYTES >> 20
        );
        return Err(unreadable(name, &reason));
    }
    if let Some(encoding) = other_encoding(&bytes) {
        let reason =
            format!("it is {encoding} text, not UTF-8, as `>` in Windows PowerShell writes it");
        return Err(unreadable(name, &reason).help(
            "save it as UTF-8: `saltus init paper --out FILE` does, and so does `... | Out-File -Encoding utf8 FILE`",
        ));
    }
    let text = String::from_utf8(bytes).map_err(|e| {
        unreadable(
            name,
            &format!(
                "it is not UTF-8 text (byte {} is not)",
                e.utf8_error().valid_up_to()
            ),
        )
    })?;
    parse(name, &text, sets)
}

/// The encoding of a text with two or four bytes to a letter: its mark, or zeros beside the first letter.
fn other_encoding(bytes: &[u8]) -> Option<&'static str> {
    match bytes {
        [0xff, 0xfe, 0, 0, ..] | [0, 0, 0xfe, 0xff, ..] => Some("UTF-32"),
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => Some("UTF-16"),
        [0, 0, 0, 1..=255, ..] | [1..=255, 0, 0, 0, ..] => Some("UTF-32"),
        [0, 1..=255, ..] | [1..=255, 0, ..] => Some("UTF-16"),
        _ => None,
    }
}

fn unreadable(name: &str, reason: &str) -> StudyError {
    StudyError::new(
        StudyErrorKind::Unreadable,
        format!("cannot read the study file {name}: {reason}"),
    )
}

fn plain(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        _ => error.to_string(),
    }
}

/// Checks the text of a study file; `name` stands for the file in messages.
///
/// # Errors
/// A [`StudyError`] with key, value, what would be right, and the line or the override it came from.
pub fn parse(name: &str, text: &str, sets: &[String]) -> Result<Study, StudyError> {
    let (source, table) = Source::parse(name, text)?;
    let file = Some((name, &source));
    study(file, table, sets)
}

impl Study {
    /// Checks a study written as JSON, with overrides: an object of the tables of a study file, the people as the
    /// list `jumper`.
    ///
    /// Whole numbers are numbers too. A null is refused, and so are the texts "nan", "inf" and "-inf" for a number.
    ///
    /// # Errors
    /// A [`StudyError`] with key, value and what would be right, or the override it came from.
    pub fn from_json(text: &str, sets: &[String]) -> Result<Self, StudyError> {
        study(None, json::table(text)?, sets)
    }
}

/// The study of these tables, with overrides.
fn study(
    file: Option<(&str, &Source)>,
    table: toml::Table,
    sets: &[String],
) -> Result<Study, StudyError> {
    let nothing_set = Origin {
        file,
        set_by: &SetBy::new(),
    };
    // names of keys in a newer version would only mislead
    nothing_set.refuse(format::newer(&table).into_iter().collect())?;
    let (table, set_by) = overrides::apply(sets, table)?;
    let origin = Origin {
        file,
        set_by: &set_by,
    };
    let tree = toml::Value::Table(table);

    let mut faults = Faults::default();
    structure::check(Node::root(), &tree, &Key::default(), &mut faults);
    origin.refuse(faults)?;

    // the structure is right, so this fails only if schema and records disagree
    let study = Study::deserialize(tree)
        .map_err(|e| StudyError::new(StudyErrorKind::Value, e.message().to_owned()))?;
    origin.refuse(questions::faults(&study).into_iter().collect())?;
    Ok(study)
}

/// Origin of keys: a file, if there is one, and overrides.
struct Origin<'a> {
    file: Option<(&'a str, &'a Source)>,
    set_by: &'a SetBy,
}

impl Origin<'_> {
    /// The problems that stand first in the file, and the number of further ones.
    fn refuse(&self, faults: Faults) -> Result<(), StudyError> {
        let count = faults.count();
        let located = faults.into_iter().map(|fault| self.locate(fault));
        let mut problems: Vec<StudyError> = located.collect();
        problems.sort_by_key(StudyError::start);
        StudyError::first_of(problems, count).map_or(Ok(()), Err)
    }

    fn locate(&self, fault: Fault) -> StudyError {
        let set_by = self.set_by(&fault.key);
        let source = self.file.filter(|_| set_by.is_none());
        let place = source.and_then(|(_, source)| match fault.point {
            Point::Name => source.key(&fault.key, "not a key of a study"),
            Point::Value => source.value(&fault.key, "this value"),
            Point::Table => source.value(&fault.key, "missing in this table"),
        });
        let message = match (set_by, source, &place) {
            (Some(text), ..) => format!("--set {text}: {}", fault.message),
            (None, Some((name, _)), None) => format!("{name}: {}", fault.message),
            _ => fault.message,
        };
        let error = StudyError::new(fault.kind, message)
            .key_is(fault.key.to_string())
            .at(place);
        match fault.help {
            Some(help) => error.help(help),
            None => error,
        }
    }

    /// The override that set this key or something around it.
    fn set_by(&self, key: &Key) -> Option<&str> {
        let mut at = Some(key.clone());
        while let Some(key) = at {
            if let Some(text) = self.set_by.get(&key.to_string()) {
                return Some(text);
            }
            at = key.parent();
        }
        None
    }
}
