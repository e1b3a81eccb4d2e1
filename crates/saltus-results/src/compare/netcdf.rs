//! Datasets, variable by variable.

use super::Difference;
use crate::dataset::open::group;
use hdf5_reader::messages::datatype::Datatype;
use hdf5_reader::{Attribute, Dataset, H5Type};
use std::fs;
use std::path::Path;

/// Attributes by which the format ties arrays together; the shapes say the same.
const TIES: [&str; 5] = [
    "CLASS",
    "NAME",
    "DIMENSION_LIST",
    "REFERENCE_LIST",
    "_Netcdf4Dimid",
];

pub(super) fn differences(first: &Path, second: &Path) -> Result<Vec<Difference>, String> {
    let open = |path| -> Result<Contents, String> {
        let bytes = fs::read(path).map_err(|error| error.to_string())?;
        contents(bytes).map_err(|error| format!("not NetCDF-4: {error}"))
    };
    let (ours, theirs) = (open(first)?, open(second)?);
    let mut whole = Difference::new("");
    attributes(&mut whole, &ours.attributes, &theirs.attributes);
    let mut parts = Vec::new();
    let find = |list: &[Dataset], name: &str| list.iter().position(|known| known.name() == name);
    for array in &ours.arrays {
        match find(&theirs.arrays, array.name()) {
            Some(index) => parts.extend(variable(array, &theirs.arrays[index])?),
            None => whole.mismatch(|| format!("variable `{}`", array.name()), "there", "absent"),
        }
    }
    for array in &theirs.arrays {
        if find(&ours.arrays, array.name()).is_none() {
            whole.mismatch(|| format!("variable `{}`", array.name()), "absent", "there");
        }
    }
    Ok(whole.found().into_iter().chain(parts).collect())
}

struct Contents {
    attributes: Vec<Attribute>,
    arrays: Vec<Dataset>,
}

fn contents(bytes: Vec<u8>) -> hdf5_reader::error::Result<Contents> {
    let root = group(bytes)?;
    Ok(Contents {
        attributes: root.attributes()?,
        arrays: root.datasets()?,
    })
}

fn variable(ours: &Dataset, theirs: &Dataset) -> Result<Option<Difference>, String> {
    let name = ours.name();
    let mut all = Difference::new(name);
    attributes(&mut all, &ours.attributes(), &theirs.attributes());
    let shapes = (ours.shape(), theirs.shape());
    let types = (ours.dtype(), theirs.dtype());
    if shapes.0 != shapes.1 {
        let words = |shape: &[u64]| format!("{shape:?}");
        all.mismatch(
            || "its shape".to_owned(),
            &words(shapes.0),
            &words(shapes.1),
        );
    } else if types.0 != types.1 {
        let words = |datatype: &Datatype| format!("{datatype:?}");
        all.mismatch(|| "its type".to_owned(), &words(types.0), &words(types.1));
    } else {
        values(&mut all, ours, theirs)
            .map_err(|error| format!("`{name}` cannot be read: {error}"))?;
    }
    Ok(all.found())
}

fn values(
    all: &mut Difference,
    ours: &Dataset,
    theirs: &Dataset,
) -> hdf5_reader::error::Result<()> {
    let shape = ours.shape();
    match ours.dtype() {
        Datatype::FloatingPoint { size: 8, .. } => numbers(all, ours, theirs, |x: f64| x),
        Datatype::FloatingPoint { size: 4, .. } => numbers(all, ours, theirs, |x: f32| x.into()),
        Datatype::FixedPoint {
            size: 1,
            signed: false,
            ..
        } => numbers(all, ours, theirs, |n: u8| n.into()),
        Datatype::FixedPoint {
            size: 2,
            signed: false,
            ..
        } => numbers(all, ours, theirs, |n: u16| n.into()),
        Datatype::FixedPoint {
            size: 4,
            signed: true,
            ..
        } => numbers(all, ours, theirs, |n: i32| n.into()),
        Datatype::String { .. } | Datatype::VarLen { .. } => {
            let (a, b) = (ours.read_strings()?, theirs.read_strings()?);
            for (index, (a, b)) in a.iter().zip(&b).enumerate() {
                all.texts(a, b, || place(shape, index));
            }
            Ok(())
        }
        // Whole numbers of eight bytes are not all floating-point numbers; other types are not ours.
        _ => {
            let (a, b) = (ours.read_raw_bytes()?, theirs.read_raw_bytes()?);
            let size = ours.raw_element_size()?.max(1);
            for (index, (a, b)) in a.chunks(size).zip(b.chunks(size)).enumerate() {
                all.texts(&raw(a), &raw(b), || place(shape, index));
            }
            Ok(())
        }
    }
}

fn numbers<T: H5Type + Copy>(
    all: &mut Difference,
    ours: &Dataset,
    theirs: &Dataset,
    number: impl Fn(T) -> f64,
) -> hdf5_reader::error::Result<()> {
    let (a, b) = (ours.read_array::<T>()?, theirs.read_array::<T>()?);
    for (index, (&a, &b)) in a.iter().zip(&b).enumerate() {
        all.numbers(number(a), number(b), || place(ours.shape(), index));
    }
    Ok(())
}

/// Eight bytes as the whole number that they are, others as digits.
fn raw(bytes: &[u8]) -> String {
    match bytes.try_into() {
        Ok(bytes) => i64::from_le_bytes(bytes).to_string(),
        Err(_) => format!("{bytes:02x?}"),
    }
}

/// Indices of an element that is the `index`-th in the file.
fn place(shape: &[u64], mut index: usize) -> String {
    let mut indices: Vec<String> = Vec::new();
    for &length in shape.iter().rev() {
        let length = usize::try_from(length).unwrap_or(usize::MAX).max(1);
        indices.insert(0, (index % length).to_string());
        index /= length;
    }
    format!("[{}]", indices.join(", "))
}

fn attributes(all: &mut Difference, ours: &[Attribute], theirs: &[Attribute]) {
    let known = |attribute: &&Attribute| !TIES.contains(&attribute.name.as_str());
    let find = |list: &[Attribute], name: &str| {
        let found = list.iter().find(|attribute| attribute.name == name);
        found.map_or("absent".to_owned(), words)
    };
    for attribute in ours.iter().filter(known) {
        let place = || format!("attribute `{}`", attribute.name);
        all.texts(&words(attribute), &find(theirs, &attribute.name), place);
    }
    for attribute in theirs.iter().filter(known) {
        if !ours.iter().any(|other| other.name == attribute.name) {
            let place = || format!("attribute `{}`", attribute.name);
            all.mismatch(place, "absent", &words(attribute));
        }
    }
}

/// The value of an attribute as a text.
fn words(attribute: &Attribute) -> String {
    if let Ok(text) = attribute.read_string() {
        return text;
    }
    match attribute.read_1d::<f64>() {
        Ok(numbers) if numbers.len() == 1 => format!("{:?}", numbers[0]),
        Ok(numbers) => format!("{numbers:?}"),
        Err(_) => format!("{:02x?}", attribute.raw_data),
    }
}
