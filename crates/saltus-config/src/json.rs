//! Studies from JSON: the same tables, keys and checks as in a file.
//!
//! A number that is not finite has no spelling in JSON. It is given as text, as TOML spells it ("nan", "inf",
//! "-inf"), and refused as it is there. A null is refused too, wherever it stands: some writers put it in
//! place of such a number, and a key that is taken for absent silently has its default.

use crate::error::{StudyError, StudyErrorKind};
use crate::fault::{Fault, Point, refuse};
use crate::key::Key;
use crate::schema::{Kind, Node, description};
use serde_json::Value as Json;
use toml::{Table, Value};

/// The tables of a JSON text.
pub(crate) fn table(text: &str) -> Result<Table, StudyError> {
    let json = serde_json::from_str(text).map_err(|e| malformed(&e.to_string()))?;
    let mut faults = Vec::new();
    let tree = value(Some(Node::root()), json, &Key::default(), &mut faults);
    let Some(Value::Table(table)) = tree else {
        return Err(malformed("an object of tables is needed"));
    };
    refuse(faults).map(|()| table)
}

fn malformed(reason: &str) -> StudyError {
    StudyError::new(StudyErrorKind::Syntax, format!("not a study in JSON: {reason}"))
        .help("write {\"plate\": {\"length\": 14.0, ...}, \"jumper\": [{...}], ...}, with the keys of a study file")
}

/// The same value as TOML has it; `node` is what the schema says of it, if anything.
fn value(node: Option<Node>, json: Json, key: &Key, faults: &mut Vec<Fault>) -> Option<Value> {
    Some(match json {
        Json::Null => {
            faults.push(null(node, key));
            return None;
        }
        Json::Bool(value) => Value::Boolean(value),
        Json::Number(number) => match number.as_i64() {
            Some(whole) => Value::Integer(whole),
            None => Value::Float(number.as_f64()?),
        },
        Json::String(text) => not_finite(node, &text).unwrap_or(Value::String(text)),
        Json::Array(items) => {
            let items = items.into_iter().enumerate();
            let item = |(i, item)| value(node.map(Node::items), item, &key.child(i), faults);
            Value::Array(items.filter_map(item).collect())
        }
        Json::Object(entries) => {
            let entry = |(name, json): (String, Json)| {
                let child = node.and_then(|node| node.child(&name));
                Some((name.clone(), value(child, json, &key.child(&name), faults)?))
            };
            Value::Table(entries.into_iter().filter_map(entry).collect())
        }
    })
}

fn not_finite(node: Option<Node>, text: &str) -> Option<Value> {
    let number = [Kind::Number, Kind::Integer].contains(&node?.kind());
    let named = ["nan", "inf", "-inf"].contains(&text);
    (number && named).then(|| text.parse().ok().map(Value::Float))?
}

fn null(node: Option<Node>, key: &Key) -> Fault {
    let wanted = node.map_or("a value".to_owned(), Node::wanted);
    Fault {
        kind: StudyErrorKind::Value,
        key: key.clone(),
        point: Point::Value,
        message: format!("{key} = null: {wanted} is needed; leave out a key that has no value"),
        help: description(key),
    }
}
