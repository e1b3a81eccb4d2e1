//! A dataset out of the bytes of its NetCDF-4 file: what [`encode`](super::file::encode) made, and nothing else.

use super::{Attribute, Dataset, Values, Variable};
use hdf5_reader::error::{Error, Result};
use hdf5_reader::group::Group;
use hdf5_reader::messages::datatype::Datatype;
use hdf5_reader::reference::read_object_references;
use hdf5_reader::{Attribute as Stored, Dataset as Array, Hdf5File, OpenOptions};
use std::collections::HashMap;

/// Attributes that are other parts of a variable here.
const PARTS: [&str; 9] = [
    "CLASS",
    "NAME",
    "DIMENSION_LIST",
    "REFERENCE_LIST",
    "_Netcdf4Dimid",
    "_FillValue",
    "flag_values",
    "flag_meanings",
    "dtype",
];

/// Length of an address in the file.
const ADDRESS: usize = 8;

/// The dataset in these bytes, without tables. Variables come in the order in which they were written.
pub(super) fn decode(bytes: Vec<u8>) -> Result<Dataset> {
    let root = group(bytes)?;
    let mut arrays = root.datasets()?;
    arrays.sort_by_key(Array::address);
    let names: HashMap<u64, &str> = arrays.iter().map(|a| (a.address(), a.name())).collect();
    let mut set = Dataset::new("");
    (set.header, set.attributes) = (Vec::new(), Vec::new());
    for stored in root.attributes()? {
        set = set.header(stored.name.clone(), attribute(&stored)?);
    }
    let mut scales = Vec::new();
    for array in &arrays {
        let about = array.attributes();
        let find = |name: &str| about.iter().find(|attribute| attribute.name == name);
        let scale = find("_Netcdf4Dimid").filter(|_| find("CLASS").is_some());
        if let Some(id) = scale {
            let length = array.shape().first().copied().unwrap_or(0);
            scales.push((id.read_as_f64()? as i64, array.name(), length as usize));
        }
        let named = find("NAME").map(Stored::read_string).transpose()?;
        if named.is_some_and(|name| name.starts_with("This is a netCDF dimension but not")) {
            continue;
        }
        let dimensions: Vec<&str> = match (scale, find("DIMENSION_LIST")) {
            (Some(_), _) => vec![array.name()],
            (None, None) => Vec::new(),
            (None, Some(list)) => {
                let ties = list.raw_data.chunks_exact(root.offset_size() as usize + 8);
                let tied = ties.map(|tie| {
                    let target = root.resolve_vlen_reference_bytes(tie, ADDRESS)?;
                    let target = read_object_references(&target, root.offset_size())?;
                    let name = target
                        .first()
                        .and_then(|address| names.get(address).copied());
                    name.ok_or_else(|| broken(array, "is over a dimension that is not there"))
                });
                tied.collect::<Result<_>>()?
            }
        };
        set.variables.push(variable(array, &about, &dimensions)?);
    }
    scales.sort_unstable();
    set.dimensions = scales
        .into_iter()
        .map(|(_, name, length)| (name.to_owned(), length))
        .collect();
    Ok(set)
}

/// The group of all arrays. A damaged file may claim any size; deflate packs no more than 1032 bytes into one.
pub(crate) fn group(bytes: Vec<u8>) -> Result<Group> {
    let most = bytes.len().saturating_mul(1032);
    let options = OpenOptions::default().with_max_read_bytes(most);
    Hdf5File::from_vec_with_options(bytes, options)?.root_group()
}

fn variable(array: &Array, about: &[Stored], dimensions: &[&str]) -> Result<Variable> {
    let find = |name: &str| about.iter().find(|attribute| attribute.name == name);
    let flag = find("dtype").is_some();
    let mut variable = Variable::new(array.name(), dimensions, values(array, flag)?);
    for stored in about
        .iter()
        .filter(|known| !PARTS.contains(&known.name.as_str()))
    {
        variable = variable.attribute(stored.name.clone(), attribute(stored)?);
    }
    if flag || matches!(variable.values, Values::F64(_) | Values::F32(_)) {
        return Ok(variable);
    }
    if let (Some(codes), Some(words)) = (find("flag_values"), find("flag_meanings")) {
        let words = words.read_string()?;
        let codes = integers(codes)?.into_iter();
        variable = variable.flags(codes.zip(words.split(' ')));
    }
    if let Some(fill) = find("_FillValue") {
        variable.fill = integers(fill)?.first().copied();
    }
    Ok(variable)
}

fn values(array: &Array, flag: bool) -> Result<Values> {
    macro_rules! read {
        ($type:ty) => {
            array
                .read_array::<$type>()?
                .into_iter()
                .collect::<Vec<$type>>()
        };
    }
    Ok(match *array.dtype() {
        Datatype::FloatingPoint { size: 8, .. } => read!(f64).into(),
        Datatype::FloatingPoint { size: 4, .. } => read!(f32).into(),
        Datatype::FixedPoint { size: 1, .. } if flag => {
            let codes = read!(u8).into_iter();
            codes.map(|code| code != 0).collect::<Vec<bool>>().into()
        }
        Datatype::FixedPoint {
            size: 1,
            signed: false,
            ..
        } => read!(u8).into(),
        Datatype::FixedPoint {
            size: 2,
            signed: false,
            ..
        } => read!(u16).into(),
        Datatype::FixedPoint {
            size: 4,
            signed: true,
            ..
        } => read!(i32).into(),
        Datatype::FixedPoint {
            size: 8,
            signed: true,
            ..
        } => read!(i64).into(),
        Datatype::String { .. } | Datatype::VarLen { .. } => array.read_strings()?.into(),
        _ => return Err(broken(array, "is of a type that saltus does not write")),
    })
}

fn attribute(stored: &Stored) -> Result<Attribute> {
    Ok(match stored.datatype {
        Datatype::FloatingPoint { .. } => match stored.read_1d::<f64>()?.as_slice() {
            [number] => Attribute::Number(*number),
            numbers => Attribute::Numbers(numbers.to_vec()),
        },
        Datatype::FixedPoint { .. } => Attribute::Integer(stored.read_as_f64()? as i32),
        _ => Attribute::Text(stored.read_string()?),
    })
}

/// Codes of any type that holds them.
fn integers(stored: &Stored) -> Result<Vec<i32>> {
    Ok(match stored.datatype {
        Datatype::FixedPoint { size: 1, .. } => {
            stored.raw_data.iter().map(|&code| code.into()).collect()
        }
        Datatype::FixedPoint { size: 2, .. } => stored
            .read_1d::<u16>()?
            .into_iter()
            .map(i32::from)
            .collect(),
        Datatype::FixedPoint { size: 8, .. } => stored
            .read_1d::<i64>()?
            .into_iter()
            .map(|code| code as i32)
            .collect(),
        _ => stored.read_1d::<i32>()?,
    })
}

fn broken(array: &Array, problem: &str) -> Error {
    Error::InvalidData(format!("`{}` {problem}", array.name()))
}
