//! One number of a study, by its key, as a sweep changes it and an axis shows it.

use crate::error::{StudyError, StudyErrorKind};
use crate::fault;
use crate::key::Key;
use crate::overrides;
use crate::schema::{Kind, Node, keys};
use crate::structure::nearest;
use crate::validate;
use crate::{AttractorsTable, Study};
use serde::Deserialize;
use std::fmt;
use toml::Value;

/// A number of a study, such as `jumper.damping_ratio` (of every jumper) or `jumper.0.mass` (of one).
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    key: Key,
}

impl Parameter {
    /// The parameter of that name.
    ///
    /// # Errors
    /// [`StudyError`] if no key has this name, or if it does not hold a number that can vary.
    pub fn parse(name: &str) -> Result<Self, StudyError> {
        let key = Key::parse(name).unwrap_or_default();
        if varies(&key) {
            return Ok(Self { key });
        }
        let known = parameters();
        let near = nearest(&key.without_indices(), known.iter().map(String::as_str));
        let advice = match near {
            Some(near) => format!("did you mean {near}?"),
            None => format!("parameters: {}", known.join(", ")),
        };
        let message = format!("{name:?} is not a key that holds a number");
        Err(StudyError::new(StudyErrorKind::Key, message)
            .key_is(name)
            .help(advice))
    }

    /// The study with this parameter at `value`, checked.
    ///
    /// # Errors
    /// [`StudyError`] if the value is out of range or the study has no such jumper.
    pub fn apply(&self, study: &Study, value: f64) -> Result<Study, StudyError> {
        let refused = |reason: String| {
            StudyError::new(StudyErrorKind::Value, format!("{self} = {value}: {reason}"))
                .key_is(self.key())
        };
        // questions stay as they are, and the lists of values among them may be long
        let mut base = Study {
            sweep: None,
            map: None,
            basins: None,
            attractors: AttractorsTable::default(),
            ..study.clone()
        };
        match self.key().as_str() {
            "base.frequency" => base.base.frequency_ratio = None,
            "base.frequency_ratio" => base.base.frequency = None,
            _ => {}
        }
        let mut tree = Value::try_from(&base).map_err(|e| refused(e.to_string()))?;
        // an empty list is not written, and an empty table in its place would hide that there is none
        if base.jumper.is_empty()
            && let Value::Table(table) = &mut tree
        {
            table.insert("jumper".to_owned(), Value::Array(Vec::new()));
        }
        overrides::set(
            Node::root(),
            &mut tree,
            self.key.segments(),
            &Key::default(),
            &Value::Float(value),
        )
        .map_err(&refused)?;
        let changed = Study::deserialize(tree).map_err(|e| refused(e.message().to_owned()))?;
        fault::refuse(validate::faults_of_system(&changed))?;
        Ok(Study {
            sweep: study.sweep.clone(),
            map: study.map.clone(),
            basins: study.basins.clone(),
            attractors: study.attractors.clone(),
            ..changed
        })
    }

    /// Its value in a study; of several jumpers, the first one's.
    pub fn value(&self, study: &Study) -> Option<f64> {
        let tree = Value::try_from(study).ok()?;
        let found = self
            .key
            .segments()
            .iter()
            .try_fold(&tree, |at, name| match at {
                Value::Array(items) => match crate::key::index(name) {
                    Some(i) => items.get(i),
                    None => items.first()?.get(name.as_str()),
                },
                other => other.get(name.as_str()),
            });
        found?.as_float()
    }

    /// The key as written, such as `jumper.0.mass`.
    pub fn key(&self) -> String {
        self.key.to_string()
    }

    /// Symbol, such as `ζ_h`.
    pub fn symbol(&self) -> &'static str {
        self.note("x-symbol")
    }

    /// SI unit; `-` for a pure number.
    pub fn unit(&self) -> &'static str {
        self.note("x-unit")
    }

    /// Axis label: name, symbol, unit, such as `damping ratio ζ_h (-)`.
    pub fn label(&self) -> String {
        format!(
            "{} {} ({})",
            self.note("x-label"),
            self.symbol(),
            self.unit()
        )
    }

    fn note(&self, name: &str) -> &'static str {
        Node::root()
            .find(self.key.segments())
            .and_then(|n| n.text(name))
            .unwrap_or_default()
    }
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.key.fmt(f)
    }
}

impl Study {
    /// This study with the number at a dotted key changed; see [`Parameter`].
    ///
    /// # Errors
    /// As [`Parameter::parse`] and [`Parameter::apply`].
    pub fn set(&self, key: &str, value: f64) -> Result<Self, StudyError> {
        Parameter::parse(key)?.apply(self, value)
    }
}

/// Tables of questions: no question changes itself or another.
const QUESTIONS: [&str; 7] = [
    "sweep",
    "map",
    "basins",
    "orbit",
    "lyapunov",
    "continue",
    "attractors",
];

/// Whether the key holds a number of the system or its start.
fn varies(key: &Key) -> bool {
    let number = Node::root()
        .find(key.segments())
        .is_some_and(|n| n.kind() == Kind::Number);
    number
        && key
            .segments()
            .first()
            .is_some_and(|table| !QUESTIONS.contains(&table.as_str()))
}

fn parameters() -> Vec<String> {
    let mut keys = keys();
    keys.retain(|name| Key::parse(name).is_some_and(|key| varies(&key)));
    keys
}
