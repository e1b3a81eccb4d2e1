//! Whether the parts of a dataset fit each other, before anything is encoded.

use super::{Attribute, Dataset, Values, Variable};
use crate::ResultsError;

/// Attributes that make a file NetCDF-4; they follow from the dataset and cannot be given.
const RESERVED: [&str; 7] = [
    "CLASS",
    "NAME",
    "DIMENSION_LIST",
    "REFERENCE_LIST",
    "_FillValue",
    "_Netcdf4Dimid",
    "_NCProperties",
];

/// A refusal that names the part and the problem.
pub(super) fn refuse(name: &str, problem: impl Into<String>) -> ResultsError {
    ResultsError::Dataset {
        name: name.to_owned(),
        problem: problem.into(),
    }
}

/// Every dimension is there once, every name is free and allowed, every array has as many
/// values as its dimensions say, and every code fits the type of its array.
pub(super) fn check(dataset: &Dataset) -> Result<(), ResultsError> {
    for (index, (name, _)) in dataset.dimensions.iter().enumerate() {
        check_name(name)?;
        if dataset.dimensions[..index].iter().any(|d| d.0 == *name) {
            return Err(refuse(name, "is a dimension twice: use two names"));
        }
    }
    check_attributes(dataset.attributes())?;
    for (index, variable) in dataset.variables.iter().enumerate() {
        check_name(&variable.name)?;
        if dataset.variables[..index]
            .iter()
            .any(|v| v.name == variable.name)
        {
            return Err(refuse(&variable.name, "is a variable twice: use two names"));
        }
        check_attributes(&variable.attributes)?;
        check_shape(variable, dataset)?;
        check_codes(variable)?;
    }
    for column in &dataset.columns {
        check_shape(column, dataset)?;
    }
    for table in &dataset.tables {
        table.check(dataset)?;
    }
    Ok(())
}

/// NetCDF allows more, but `/` begins a group and blanks at the ends are lost.
fn check_name(name: &str) -> Result<(), ResultsError> {
    let forbidden = |c: char| c == '/' || c.is_control();
    if name.is_empty() || name.trim() != name || name.contains(forbidden) {
        let problem = "is no name: use letters, digits and `_`, without `/` or blanks at the ends";
        return Err(refuse(name, problem));
    }
    Ok(())
}

fn check_attributes<'a>(
    attributes: impl IntoIterator<Item = &'a (String, Attribute)>,
) -> Result<(), ResultsError> {
    for (name, value) in attributes {
        check_name(name)?;
        if RESERVED.contains(&name.as_str()) {
            return Err(refuse(
                name,
                "is an attribute that the file format sets itself",
            ));
        }
        // An HDF5 message holds 64 KiB.
        if matches!(value, Attribute::Numbers(numbers) if numbers.len() > 8000) {
            return Err(refuse(
                name,
                "has more than 8000 numbers: make it a variable",
            ));
        }
    }
    Ok(())
}

fn check_shape(variable: &Variable, dataset: &Dataset) -> Result<(), ResultsError> {
    let name = &variable.name;
    let own_dimension = dataset.dimensions.iter().any(|d| d.0 == *name);
    if own_dimension && variable.dimensions != [name.as_str()] {
        let problem =
            "has the name of a dimension, but is not the values along it: use another name";
        return Err(refuse(name, problem));
    }
    let mut expected = 1;
    for wanted in &variable.dimensions {
        let Some((_, length)) = dataset.dimensions.iter().find(|d| d.0 == *wanted) else {
            let problem = format!("uses the dimension `{wanted}`, which is not there");
            return Err(refuse(name, problem));
        };
        expected *= length;
    }
    let found = variable.values.len();
    if found != expected {
        let problem = format!("has {found} values, its dimensions ask for {expected}");
        return Err(refuse(name, problem));
    }
    Ok(())
}

fn check_codes(variable: &Variable) -> Result<(), ResultsError> {
    let codes = variable
        .flags
        .iter()
        .map(|flag| flag.0)
        .chain(variable.fill);
    let (largest, smallest) = match variable.values {
        Values::I32(_) => (i32::MAX, i32::MIN),
        Values::U16(_) => (u16::MAX.into(), 0),
        Values::U8(_) => (u8::MAX.into(), 0),
        Values::I64(_) => return Ok(()),
        Values::F64(_) | Values::F32(_) | Values::Bool(_) | Values::Text(_) => {
            let problem = "has flags or a fill value, which are for arrays of whole numbers";
            return match codes.into_iter().next() {
                Some(_) => Err(refuse(&variable.name, problem)),
                None => Ok(()),
            };
        }
    };
    match codes
        .into_iter()
        .find(|code| !(smallest..=largest).contains(code))
    {
        Some(code) => {
            let problem = format!("has the code {code}, its type holds {smallest} to {largest}");
            Err(refuse(&variable.name, problem))
        }
        None => Ok(()),
    }
}
