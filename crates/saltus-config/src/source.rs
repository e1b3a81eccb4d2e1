//! Places of keys and values in the text of a study file.

use crate::error::{Place, StudyError, StudyErrorKind};
use crate::key::Key;
use crate::schema::{Kind, Node};
use crate::shown::{printable, printable_source};
use miette::NamedSource;
use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A study file's text and the places of its keys and values.
pub(crate) struct Source {
    text: NamedSource<Arc<str>>,
    keys: HashMap<String, Range<usize>>,
    values: HashMap<String, Range<usize>>,
}

impl Source {
    /// Parses `text`; the table has plain values, the source remembers where they stood.
    pub(crate) fn parse(name: &str, text: &str) -> Result<(Self, toml::Table), StudyError> {
        let mut source = Self {
            text: NamedSource::new(printable(name), Arc::from(printable_source(text)))
                .with_language("TOML"),
            keys: HashMap::new(),
            values: HashMap::new(),
        };
        let table: toml::Table = toml::from_str(text).map_err(|e| source.syntax_error(&e))?;
        let spanned = DeTable::parse(text).map_err(|e| source.syntax_error(&e))?;
        source.note_table(spanned.get_ref(), &Key::default());
        Ok((source, table))
    }

    /// The key itself, with a few words for the label.
    pub(crate) fn key(&self, key: &Key, label: &'static str) -> Option<Place> {
        let span = self
            .keys
            .get(&key.to_string())
            .or_else(|| self.values.get(&key.to_string()))?;
        Some(self.place(span.clone(), label))
    }

    /// The value, or the nearest thing around it that the file has.
    pub(crate) fn value(&self, key: &Key, label: &'static str) -> Option<Place> {
        let mut at = Some(key.clone());
        while let Some(key) = at {
            if let Some(span) = self.values.get(&key.to_string()) {
                return Some(self.place(span.clone(), label));
            }
            at = key.parent();
        }
        None
    }

    fn place(&self, span: Range<usize>, label: &'static str) -> Place {
        Place {
            text: self.text.clone(),
            span,
            label,
        }
    }

    fn syntax_error(&self, error: &toml::de::Error) -> StudyError {
        let text = self.text.inner();
        let span = error.span().unwrap_or(0..0);
        let line = text
            .get(..span.start)
            .map_or(1, |before| before.matches('\n').count() + 1);
        let message = error.message().trim().replace('\n', "; ");
        let name = text.get(span.clone()).unwrap_or_default();
        let people = Node::root().child(name).map(Node::kind) == Some(Kind::Tables);
        let help = match (message.as_str(), people) {
            ("duplicate key", true) => format!(
                "write [[{name}]], in double brackets, each time: once for each of them"
            ),
            ("duplicate key", false) => "give each table and each key once".to_owned(),
            _ => "a study file is TOML: [tables] of key = value lines; `saltus init paper` prints an example"
                .to_owned(),
        };
        StudyError::new(
            StudyErrorKind::Syntax,
            format!("{}, line {line}: {message}", self.text.name()),
        )
        .help(help)
        .at(Some(self.place(span, "here")))
    }

    fn note_table(&mut self, table: &DeTable<'_>, at: &Key) {
        for (name, value) in table {
            let key = at.child(name.get_ref());
            self.keys.insert(key.to_string(), name.span());
            self.note_value(value, &key);
        }
    }

    fn note_value(&mut self, value: &Spanned<DeValue<'_>>, key: &Key) {
        self.values.insert(key.to_string(), value.span());
        match value.get_ref() {
            DeValue::Table(table) => self.note_table(table, key),
            DeValue::Array(items) => {
                for (i, item) in items.iter().enumerate() {
                    self.note_value(item, &key.child(i));
                }
            }
            _ => {}
        }
    }
}
