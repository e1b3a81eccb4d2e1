//! The format of a study: whether this version is new enough to read it.

use crate::Study;
use crate::error::StudyErrorKind;
use crate::fault::{Fault, Point};
use crate::key::Key;
use toml::{Table, Value};

/// The fault of a study that a newer version wrote.
pub(crate) fn newer(table: &Table) -> Option<Fault> {
    let format = table.get("format").and_then(Value::as_integer)?;
    (format > Study::FORMAT.into()).then(|| Fault {
        kind: StudyErrorKind::Value,
        key: Key::default().child("format"),
        point: Point::Value,
        message: format!(
            "format = {format}: this study needs a newer saltus; saltus {} reads formats up to {}",
            env!("CARGO_PKG_VERSION"),
            Study::FORMAT
        ),
        help: Some("update saltus".to_owned()),
    })
}
