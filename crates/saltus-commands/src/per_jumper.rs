//! A quantity that each jumper has: a value for one jumper, a list for none or several.

use serde::Serialize;

/// In JSON a bare value if there is exactly one.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub(crate) enum PerJumper<T> {
    /// Of the only jumper.
    One(T),
    /// Of each, in the order of the study file.
    Each(Vec<T>),
}

impl<T> PerJumper<T> {
    /// In the order of the study file, however many there are.
    pub(crate) fn as_slice(&self) -> &[T] {
        match self {
            Self::One(value) => std::slice::from_ref(value),
            Self::Each(values) => values,
        }
    }
}

impl<T> From<Vec<T>> for PerJumper<T> {
    fn from(mut values: Vec<T>) -> Self {
        match (values.len(), values.pop()) {
            (1, Some(value)) => Self::One(value),
            (_, last) => {
                values.extend(last);
                Self::Each(values)
            }
        }
    }
}

impl<T> FromIterator<T> for PerJumper<T> {
    fn from_iter<I: IntoIterator<Item = T>>(values: I) -> Self {
        values.into_iter().collect::<Vec<T>>().into()
    }
}

/// Names of columns of a table: `z` for one jumper, `z_0`, `z_1`, ... for several.
pub(crate) fn column(name: &str, jumper: usize, jumpers: usize) -> String {
    if jumpers == 1 {
        name.to_owned()
    } else {
        format!("{name}_{jumper}")
    }
}

/// Panels of a figure: beyond some it shows nothing.
pub(crate) const PANELS: usize = 6;

/// Title of a jumper's panel; none is needed for one.
pub(crate) fn panel_title(jumper: usize, jumpers: usize) -> String {
    match jumpers {
        1 => String::new(),
        _ if jumpers > PANELS => {
            format!("Jumper {jumper} (of {jumpers}, the first {PANELS} shown)")
        }
        _ => format!("Jumper {jumper}"),
    }
}

#[cfg(test)]
mod tests {
    use super::PerJumper;

    #[test]
    fn one_is_bare_and_others_are_lists() {
        let json = |values: Vec<f64>| serde_json::to_string(&PerJumper::from(values)).ok();
        assert_eq!(json(vec![1.5]).as_deref(), Some("1.5"));
        assert_eq!(json(vec![]).as_deref(), Some("[]"));
        assert_eq!(json(vec![1.0, 2.0]).as_deref(), Some("[1.0,2.0]"));
    }
}
