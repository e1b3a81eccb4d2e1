//! The JSON Schema of the study file, and the tree that structure, overrides and labels are read from.

use crate::Study;
use crate::key::{Key, index};
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value};
use std::sync::LazyLock;

static TREE: LazyLock<Value> = LazyLock::new(|| {
    let generator = SchemaSettings::draft2020_12()
        .with(|s| s.inline_subschemas = true)
        .into_generator();
    let mut tree = generator.into_root_schema_for::<Study>().to_value();
    unwrap_lines(&mut tree);
    tree
});

/// JSON Schema (draft 2020-12) of the study file, with units in the descriptions.
///
/// Beyond the standard's words, a number carries `x-unit`, `x-symbol` and `x-label`.
pub fn schema() -> Value {
    TREE.clone()
}

/// Every key that holds a value, such as `plate.length` and `jumper.mass`, tables first to last by name.
pub fn keys() -> Vec<String> {
    let mut found = Vec::new();
    collect(Node::root(), &Key::default(), &mut found);
    found
}

fn collect(node: Node, at: &Key, found: &mut Vec<String>) {
    match node.kind() {
        Kind::Table => node.names().for_each(|name| {
            if let Some(child) = node.child(name) {
                collect(child, &at.child(name), found);
            }
        }),
        Kind::Tables => collect(node.items(), at, found),
        _ => found.push(at.to_string()),
    }
}

/// Description of a key from the schema.
pub(crate) fn description(key: &Key) -> Option<String> {
    let node = Node::root().find(key.segments())?;
    let text = node.text("description")?;
    Some(text.trim_end_matches('.').to_owned())
}

/// Name of a table as it is written in the file.
pub(crate) fn header(table: &Key) -> String {
    let segments = table.segments();
    match Node::root().find(segments).map(Node::kind) {
        _ if segments.is_empty() => "a study".to_owned(),
        Some(Kind::Table) if segments.iter().any(|s| index(s).is_some()) => {
            format!("[[{}]]", table.without_indices())
        }
        Some(Kind::Table) => format!("[{table}]"),
        _ => format!("{table}"),
    }
}

/// A doc comment's line breaks are the source code's, not the reader's.
fn unwrap_lines(value: &mut Value) {
    match value {
        Value::String(text) => *text = text.replace('\n', " "),
        Value::Array(items) => items.iter_mut().for_each(unwrap_lines),
        Value::Object(map) => map.values_mut().for_each(unwrap_lines),
        _ => {}
    }
}

/// One key, table or item of the study file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node(&'static Value);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Table,
    /// A list of tables, written `[[name]]`.
    Tables,
    List,
    Number,
    Integer,
    Word,
    /// One of several kinds, decided by the value given.
    Any,
}

impl Node {
    pub(crate) fn root() -> Self {
        Self(&TREE)
    }

    pub(crate) fn kind(self) -> Kind {
        match self.text("type") {
            Some("object") => Kind::Table,
            Some("array") if self.items().kind() == Kind::Table => Kind::Tables,
            Some("array") => Kind::List,
            Some("number") => Kind::Number,
            Some("integer") => Kind::Integer,
            _ if self.0.get("anyOf").is_some() => Kind::Any,
            _ => Kind::Word,
        }
    }

    /// Names of the keys of a table.
    pub(crate) fn names(self) -> impl Iterator<Item = &'static str> {
        let properties = self.0.get("properties").and_then(Value::as_object);
        properties
            .into_iter()
            .flat_map(Map::keys)
            .map(String::as_str)
    }

    /// Names of the keys that a table must have.
    pub(crate) fn required(self) -> impl Iterator<Item = &'static str> {
        self.list("required").filter_map(Value::as_str)
    }

    /// The key of a table, or of the table among the alternatives.
    pub(crate) fn child(self, name: &str) -> Option<Self> {
        if let Some(table) = self.alternatives().find(|n| n.kind() == Kind::Table) {
            return table.child(name);
        }
        self.0.get("properties")?.get(name).map(Self)
    }

    pub(crate) fn items(self) -> Self {
        Self(self.0.get("items").unwrap_or(&Value::Null))
    }

    pub(crate) fn alternatives(self) -> impl Iterator<Item = Self> {
        self.list("anyOf").map(Self)
    }

    /// Words allowed, if only some are.
    pub(crate) fn words(self) -> Vec<&'static str> {
        self.list("oneOf")
            .filter_map(|w| w.get("const")?.as_str())
            .collect()
    }

    pub(crate) fn text(self, name: &str) -> Option<&'static str> {
        self.0.get(name)?.as_str()
    }

    pub(crate) fn number(self, name: &str) -> Option<f64> {
        self.0.get(name)?.as_f64()
    }

    /// The node of a dotted name, with or without indices.
    pub(crate) fn find(self, segments: &[String]) -> Option<Self> {
        let Some((first, rest)) = segments.split_first() else {
            return Some(self);
        };
        match (self.kind(), index(first)) {
            (Kind::Tables | Kind::List, Some(_)) => self.items().find(rest),
            (Kind::Tables, None) => self.items().find(segments),
            _ => self.child(first)?.find(rest),
        }
    }

    /// The values allowed, in words.
    pub(crate) fn wanted(self) -> String {
        let words = self.words();
        if !words.is_empty() {
            let quoted: Vec<String> = words.iter().map(|w| format!("{w:?}")).collect();
            return format!("one of {}", quoted.join(", "));
        }
        match self.kind() {
            Kind::Table => "a table".to_owned(),
            Kind::Tables => match self.number("maxItems") {
                Some(most) => format!("a list of at most {most} tables"),
                None => "a list of tables".to_owned(),
            },
            Kind::List => "a list".to_owned(),
            Kind::Number => format!("a number{}{}", self.range(), self.unit()),
            Kind::Integer => format!("a whole number{}", self.range()),
            Kind::Word => "a word".to_owned(),
            Kind::Any => self
                .alternatives()
                .map(Self::wanted)
                .collect::<Vec<_>>()
                .join(" or "),
        }
    }

    fn range(self) -> String {
        let bounds = |low, high| Some((self.number(low)?, self.number(high)?));
        if let Some((low, high)) = bounds("minimum", "maximum") {
            format!(" from {} to {}", tidy(low), tidy(high))
        } else if let Some((low, high)) = bounds("exclusiveMinimum", "exclusiveMaximum") {
            format!(" between {} and {} (both excluded)", tidy(low), tidy(high))
        } else {
            String::new()
        }
    }

    fn unit(self) -> String {
        self.text("x-unit")
            .filter(|u| *u != "-")
            .map(|u| format!(" ({u})"))
            .unwrap_or_default()
    }

    fn list(self, name: &str) -> impl Iterator<Item = &'static Value> {
        self.0
            .get(name)
            .and_then(Value::as_array)
            .into_iter()
            .flatten()
    }
}

/// Short form of a bound: 10000 but 1e13.
fn tidy(value: f64) -> String {
    if value == 0.0 || (1e-3..1e6).contains(&value.abs()) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}
