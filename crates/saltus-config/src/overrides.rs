//! Overrides, `--set table.key=value`: changes to a study from outside its file.

use crate::error::{StudyError, StudyErrorKind};
use crate::key::{Key, index};
use crate::schema::{Kind, Node, description, keys};
use crate::structure::{brackets, nearest, single};
use std::collections::HashMap;
use toml::{Table, Value};

/// Keys of one table that say the same thing as another key of it: what is given last stands.
const INSTEAD: [(&str, &[&str]); 6] = [
    ("frequency", &["frequency_ratio"]),
    ("frequency_ratio", &["frequency"]),
    ("values", &["from", "to", "count"]),
    ("from", &["values"]),
    ("to", &["values"]),
    ("count", &["values"]),
];

/// Keys that were set from outside, each with the text of its override.
pub(crate) type SetBy = HashMap<String, String>;

/// Applies each override in turn; later ones win.
pub(crate) fn apply(sets: &[String], table: Table) -> Result<(Table, SetBy), StudyError> {
    let mut tree = Value::Table(table);
    let mut set_by = SetBy::new();
    let mut problems = Vec::new();
    for text in sets {
        match apply_one(text, &mut tree, &set_by) {
            Ok(places) => set_by.extend(places.into_iter().map(|key| (key, text.clone()))),
            Err(problem) => problems.push(problem),
        }
        // nobody reads more of them
        if problems.len() == StudyError::TOLD {
            break;
        }
    }
    let count = problems.len();
    match (StudyError::first_of(problems, count), tree) {
        (None, Value::Table(table)) => Ok((table, set_by)),
        (Some(problem), _) => Err(problem),
        (None, _) => Err(malformed("", "the study itself cannot be replaced")),
    }
}

fn apply_one(text: &str, tree: &mut Value, set_by: &SetBy) -> Result<Vec<String>, StudyError> {
    let Some((name, value)) = text.split_once('=') else {
        return Err(malformed(text, "there is no `=` in it"));
    };
    let key = Key::parse(name).ok_or_else(|| malformed(text, "there is no key before the `=`"))?;
    if value.trim().is_empty() {
        return Err(malformed(text, "there is no value after the `=`").key_is(key.to_string()));
    }
    settable(&key, text)?;
    drop_alternatives(&key, tree, set_by);
    set(
        Node::root(),
        tree,
        key.segments(),
        &Key::default(),
        &read_value(value),
    )
    .map_err(|reason| malformed(text, &reason).key_is(key.to_string()))
}

/// A TOML value; anything else is text, so that quotes need not survive the shell. TOML's whole numbers have 64 bits:
/// a larger one is a number all the same, so that its range is what is wrong with it.
fn read_value(text: &str) -> Value {
    let text = text.trim();
    let digits = text.trim_start_matches(['+', '-']);
    let whole = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    let number = || text.parse().ok().filter(|_| whole).map(Value::Float);
    let other = || number().unwrap_or_else(|| Value::String(text.to_owned()));
    text.parse().unwrap_or_else(|_| other())
}

fn settable(key: &Key, text: &str) -> Result<(), StudyError> {
    let Some(node) = Node::root().find(key.segments()) else {
        let known = keys();
        let near = nearest(&key.without_indices(), known.iter().map(String::as_str));
        let advice = match near {
            Some(near) => format!("did you mean {near}?"),
            None => {
                "a key is written table.key, such as plate.length, jumper.mass or jumper.0.mass"
                    .to_owned()
            }
        };
        let message = format!("--set {text}: unknown key {key}");
        return Err(StudyError::new(StudyErrorKind::Override, message)
            .help(advice)
            .key_is(key.to_string()));
    };
    if node.kind() == Kind::Table {
        let example = node.names().next().unwrap_or_default();
        let reason = format!(
            "{key} is a table; set one of its keys, such as {}",
            key.child(example)
        );
        return Err(malformed(text, &reason).key_is(key.to_string()));
    }
    Ok(())
}

/// Takes out what `key` replaces, unless that too was set from outside (then both stand, and are refused).
fn drop_alternatives(key: &Key, tree: &mut Value, set_by: &SetBy) {
    let (Some((name, path)), Some(parent)) = (key.segments().split_last(), key.parent()) else {
        return;
    };
    let others = INSTEAD.iter().filter(|(given, _)| given == name);
    let table = path.iter().try_fold(tree, |at, name| at.get_mut(name));
    let Some(table) = table.and_then(Value::as_table_mut) else {
        return;
    };
    for other in others.flat_map(|(_, others)| *others) {
        if !set_by.contains_key(&parent.child(other).to_string()) {
            table.remove(*other);
        }
    }
}

/// Writes `new` at every place that `segments` names below `at`, and says which these are.
pub(crate) fn set(
    node: Node,
    value: &mut Value,
    segments: &[String],
    at: &Key,
    new: &Value,
) -> Result<Vec<String>, String> {
    let Some((first, rest)) = segments.split_first() else {
        value.clone_from(new);
        return Ok(vec![at.to_string()]);
    };
    match value {
        Value::Array(items) if node.kind() == Kind::Tables => {
            set_items(node, items, segments, at, new)
        }
        Value::Table(_) if node.kind() == Kind::Tables => {
            Err(format!("{}; {} in the study", single(at), brackets(at)))
        }
        Value::Table(table) => {
            let child = node
                .child(first)
                .ok_or_else(|| format!("unknown key {}", at.child(first)))?;
            let empty = if child.kind() == Kind::Tables {
                Value::Array(Vec::new())
            } else {
                Table::new().into()
            };
            let inner = table.entry(first.as_str()).or_insert(empty);
            set(child, inner, rest, &at.child(first), new)
        }
        _ => Err(format!(
            "{at} holds one value here, so nothing below it can be set; set {at} itself"
        )),
    }
}

fn set_items(
    node: Node,
    items: &mut [Value],
    segments: &[String],
    at: &Key,
    new: &Value,
) -> Result<Vec<String>, String> {
    let count = items.len();
    if count == 0 {
        return Err(format!("the study has no [[{at}]]"));
    }
    if let Some(i) = index(&segments[0]) {
        let item = items.get_mut(i).ok_or_else(|| {
            format!(
                "there is no {at}.{i}; the study has {count}, {at}.0 to {at}.{}",
                count - 1
            )
        })?;
        return set(node.items(), item, &segments[1..], &at.child(i), new);
    }
    let mut places = Vec::new();
    for (i, item) in items.iter_mut().enumerate() {
        places.extend(set(node.items(), item, segments, &at.child(i), new)?);
    }
    Ok(places)
}

fn malformed(text: &str, reason: &str) -> StudyError {
    let key = text.split_once('=').and_then(|(name, _)| Key::parse(name));
    let advice = key.and_then(|k| description(&k)).unwrap_or_else(|| {
        "write --set table.key=value, such as --set jumper.damping_ratio=0.28 or --set jumper.0.mass=80".to_owned()
    });
    StudyError::new(StudyErrorKind::Override, format!("--set {text}: {reason}")).help(advice)
}
