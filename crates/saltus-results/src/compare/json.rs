//! Reports, by the path of keys.

use super::Difference;
use serde_json::Value;
use std::fs;
use std::path::Path;

pub(super) fn differences(first: &Path, second: &Path) -> Result<Vec<Difference>, String> {
    let read = |path| -> Result<Value, String> {
        let bytes = fs::read(path).map_err(|error| error.to_string())?;
        serde_json::from_slice(&bytes).map_err(|error| format!("not JSON: {error}"))
    };
    Ok(values(&read(first)?, &read(second)?))
}

/// Differences between two values in memory.
pub(super) fn values(first: &Value, second: &Value) -> Vec<Difference> {
    let mut all = Difference::new("");
    walk(&mut all, &mut String::new(), first, second);
    all.found().into_iter().collect()
}

/// Depth is bounded: serde_json reads no more than 128 levels.
fn walk(all: &mut Difference, path: &mut String, first: &Value, second: &Value) {
    match (first, second) {
        (Value::Object(ours), Value::Object(theirs)) => {
            for (key, value) in ours {
                let other = theirs.get(key);
                step(all, path, &key_step(path, key), Some(value), other);
            }
            for (key, value) in theirs.iter().filter(|entry| !ours.contains_key(entry.0)) {
                step(all, path, &key_step(path, key), None, Some(value));
            }
        }
        (Value::Array(ours), Value::Array(theirs)) => {
            for index in 0..ours.len().max(theirs.len()) {
                step(
                    all,
                    path,
                    &format!("[{index}]"),
                    ours.get(index),
                    theirs.get(index),
                );
            }
        }
        (Value::Number(ours), Value::Number(theirs)) => {
            all.texts(&ours.to_string(), &theirs.to_string(), || path.clone());
        }
        _ => other(all, path, first, second),
    }
}

fn key_step(path: &str, key: &str) -> String {
    if path.is_empty() {
        key.to_owned()
    } else {
        format!(".{key}")
    }
}

fn other(all: &mut Difference, path: &str, first: &Value, second: &Value) {
    all.compared += 1;
    if first != second {
        let words = |value: &Value| value.as_str().map_or(value.to_string(), str::to_owned);
        all.mismatch(|| path.to_owned(), &words(first), &words(second));
    }
}

fn step(
    all: &mut Difference,
    path: &mut String,
    step: &str,
    first: Option<&Value>,
    second: Option<&Value>,
) {
    let length = path.len();
    path.push_str(step);
    match (first, second) {
        (Some(first), Some(second)) => walk(all, path, first, second),
        (first, second) => {
            let words = |value: Option<&Value>| value.map_or("absent".to_owned(), Value::to_string);
            all.compared += 1;
            all.mismatch(|| path.clone(), &words(first), &words(second));
        }
    }
    path.truncate(length);
}
