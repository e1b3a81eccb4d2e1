//! Check of a table against the keys, types and ranges of the schema. All faults are found, not only the first.

use crate::error::StudyErrorKind;
use crate::fault::{Fault, Faults, Point};
use crate::key::Key;
use crate::schema::{Kind, Node, description, header, keys};
use toml::Value;

/// The least number that is too large for the whole numbers of TOML.
const TWO_TO_63: f64 = 9_223_372_036_854_775_808.0;

/// Appends every fault of `value`, which stands at `key`, against `node`.
pub(crate) fn check(node: Node, value: &Value, key: &Key, faults: &mut Faults) {
    match (node.kind(), value) {
        (Kind::Any, _) => check_any(node, value, key, faults),
        (Kind::Table, Value::Table(table)) => check_table(node, table, key, faults),
        (Kind::Tables | Kind::List, Value::Array(items)) => {
            check_list(node, items, value, key, faults);
        }
        (Kind::Number, Value::Float(x)) => check_range(node, *x, value, key, faults),
        // a whole number beyond 64 bits
        (Kind::Integer, Value::Float(x)) if x.is_finite() && x.abs() >= TWO_TO_63 => {
            check_range(node, *x, value, key, faults);
        }
        #[expect(
            clippy::cast_precision_loss,
            reason = "a bound is far below the integers that f64 cannot hold"
        )]
        (Kind::Number | Kind::Integer, Value::Integer(i)) => {
            check_range(node, *i as f64, value, key, faults);
        }
        (Kind::Word, Value::String(word)) => check_word(node, word, value, key, faults),
        _ => faults.add(|| wrong_type(node, value, key)),
    }
}

fn check_table(node: Node, table: &toml::Table, key: &Key, faults: &mut Faults) {
    let mut meant = Vec::new();
    for (name, value) in table {
        match node.child(name) {
            Some(child) => check(child, value, &key.child(name), faults),
            None => {
                if !faults.is_full() {
                    meant.extend(nearest(name, node.names()));
                }
                faults.add(|| unknown(node, key, name));
            }
        }
    }
    // a key that is there under a wrong name is not missing as well
    for name in node
        .required()
        .filter(|name| !table.contains_key(*name) && !meant.contains(name))
    {
        faults.add(|| {
            let missing = key.child(name);
            let help = description(&missing).map(|d| format!("{name}: {d}"));
            Fault::missing(&missing, help)
        });
    }
}

fn check_list(node: Node, items: &[Value], value: &Value, key: &Key, faults: &mut Faults) {
    #[expect(clippy::cast_precision_loss, reason = "no list has 2^52 items")]
    let length = items.len() as f64;
    let short = node.number("minItems").is_some_and(|min| length < min);
    let long = node.number("maxItems").is_some_and(|max| length > max);
    if short || long {
        let bounds = ["minItems", "maxItems"].map(|name| node.number(name).unwrap_or_default());
        let wanted = match bounds {
            [_, most] if node.kind() == Kind::Tables => {
                let message = format!("{key}: {length} were given, at most {most} are possible");
                faults.add(|| Fault::told(key, message, description(key)));
                return;
            }
            [least, most] if least == most => format!("{least}"),
            [least, most] => format!("{least} to {most}"),
        };
        let what = format!("{wanted} numbers are needed, {length} were given");
        faults.add(|| Fault::value(key, value, &what));
        return;
    }
    for (i, item) in items.iter().enumerate() {
        check(node.items(), item, &key.child(i), faults);
    }
}

/// A value outside its range is a fault. NaN fails every comparison, so the comparisons ask for what is right.
fn check_range(node: Node, x: f64, value: &Value, key: &Key, faults: &mut Faults) {
    let above = node.number("minimum").is_none_or(|min| x >= min)
        && node.number("exclusiveMinimum").is_none_or(|min| x > min);
    let below = node.number("maximum").is_none_or(|max| x <= max)
        && node.number("exclusiveMaximum").is_none_or(|max| x < max);
    if !(x.is_finite() && above && below) {
        faults.add(|| Fault::value(key, value, &format!("{} is needed", node.wanted())));
    }
}

fn check_word(node: Node, word: &str, value: &Value, key: &Key, faults: &mut Faults) {
    let words = node.words();
    if !words.is_empty() && !words.contains(&word) {
        faults.add(|| {
            let mut fault = Fault::value(key, value, &format!("{} is needed", node.wanted()));
            if let Some(near) = nearest(word, words.into_iter()) {
                fault.help = Some(format!("did you mean {near:?}?"));
            }
            fault
        });
    }
    if node.text("format") == Some("mode-set")
        && let Err(reason) = word.parse::<crate::Modes>()
    {
        faults.add(|| Fault::value(key, value, &reason));
    }
}

fn check_any(node: Node, value: &Value, key: &Key, faults: &mut Faults) {
    let wanted = if value.is_table() {
        Kind::Table
    } else {
        Kind::Word
    };
    match node.alternatives().find(|n| n.kind() == wanted) {
        Some(branch) if value.is_table() || value.is_str() => check(branch, value, key, faults),
        _ => faults.add(|| wrong_type(node, value, key)),
    }
}

fn wrong_type(node: Node, value: &Value, key: &Key) -> Fault {
    let tables = |items: &Vec<Value>| items.iter().all(Value::is_table);
    match (node.kind(), value) {
        (Kind::Tables, Value::Table(_)) => Fault::told(key, single(key), Some(brackets(key))),
        (Kind::Table, Value::Array(items)) if tables(items) => Fault::told(
            key,
            format!("{key} is a list of tables, [[{key}]], and must be one table"),
            Some(format!("write [{key}], in single brackets, once")),
        ),
        (kind, _) => {
            let what = format!("{} was given, {} is needed", type_of(value), node.wanted());
            let fault = Fault::value(key, value, &what);
            let help = match kind {
                Kind::Table => Some(format!("write it as a table, [{key}]")),
                Kind::Tables => Some(brackets(key)),
                _ => fault.help.clone(),
            };
            Fault { help, ..fault }
        }
    }
}

/// The fault of one table in place of a list of them.
pub(crate) fn single(key: &Key) -> String {
    format!("{key} is one table, [{key}], and must be a list of them")
}

/// Advice in that case.
pub(crate) fn brackets(key: &Key) -> String {
    format!("write [[{key}]], in double brackets, once for each")
}

fn unknown(node: Node, table: &Key, name: &str) -> Fault {
    let key = table.child(name);
    let names: Vec<&str> = node.names().collect();
    let takes = format!("{} takes {}", header(table), names.join(", "));
    let help = match (nearest(name, names.iter().copied()), elsewhere(name)) {
        (Some(near), _) => format!("did you mean {}? {takes}", table.child(near)),
        (None, Some(other)) => format!("did you mean {other}? {takes}"),
        (None, None) => takes,
    };
    Fault {
        kind: StudyErrorKind::Key,
        message: format!("unknown key {key}"),
        key,
        point: Point::Name,
        help: Some(help),
    }
}

/// A key of that name in another table.
fn elsewhere(name: &str) -> Option<String> {
    keys()
        .into_iter()
        .find(|key| key.rsplit('.').next() == Some(name))
}

/// The candidate most like `word`, if any is like it at all.
pub(crate) fn nearest<'a>(
    word: &str,
    candidates: impl Iterator<Item = &'a str>,
) -> Option<&'a str> {
    let likeness = |c: &str| strsim::jaro_winkler(&word.to_lowercase(), c);
    let best = candidates
        .map(|c| (likeness(c), c))
        .max_by(|a, b| a.0.total_cmp(&b.0))?;
    // 0.8: "lenght" and "dampingratio" find their key, "colour" finds none
    (best.0 > 0.8).then_some(best.1)
}

fn type_of(value: &Value) -> &'static str {
    match value {
        Value::String(_) => "text",
        Value::Integer(_) => "a whole number",
        Value::Float(_) => "a number with a decimal point",
        Value::Boolean(_) => "true or false",
        Value::Datetime(_) => "a date",
        Value::Array(_) => "a list",
        Value::Table(_) => "a table",
    }
}
