//! A dataset as a NetCDF-4 file: HDF5 in which the axes are "dimension scales".
//!
//! The conventions are those of netCDF-C (NetCDF User's Guide, "NetCDF-4 Format"; HDF5 Dimension Scale
//! Specification): each dimension is a dataset of the same name with `CLASS` = "DIMENSION_SCALE" and a
//! `REFERENCE_LIST` of the arrays over it, each array has a `DIMENSION_LIST` that refers back. hdf5-writer
//! encodes all of them; the crate netcdf-writer would set them for us, but copies every array more often
//! on the way, which for a thousand by a thousand cells with eight layers means 300 MB instead of 180.

use super::check::refuse;
use super::{Attribute, Dataset, Values, Variable};
use crate::ResultsError;
use hdf5_writer::{
    AttributeBuilder, ByteOrder, DatasetBuilder, Error, FILTER_DEFLATE, FILTER_SHUFFLE,
    FilterDescription, H5WriteElement, Hdf5Builder, WriteOptions,
};

/// Little-endian on every machine, so that equal datasets are equal bytes.
const ORDER: ByteOrder = ByteOrder::LittleEndian;
/// Arrays of fewer bytes are kept as they are.
const SMALL: usize = 4096;
/// Bytes of a chunk, as netCDF-C chooses: what a reader unpacks at once.
const CHUNK: usize = 1 << 20;
/// Effort of deflate; more costs time and saves little on floating-point numbers.
const LEVEL: u32 = 4;
/// Texts up to this length are written as characters. An HDF5 message holds 64 KiB, with a name and a type before it.
const SHORT_TEXT: usize = 60_000;

/// The file of a dataset whose parts fit. Arrays move over one by one, so that none is held twice for long.
pub(super) fn encode(dataset: Dataset) -> Result<Vec<u8>, ResultsError> {
    let scales = Scales::of(&dataset);
    let mut builder = Hdf5Builder::new();
    for (name, value) in dataset.attributes() {
        builder = builder.attribute(attribute(name, value).map_err(refused(name))?);
    }
    for scale in scales.list.iter().filter(|scale| !scale.coordinate) {
        builder = builder.dataset(scale.placeholder().map_err(refused(&scale.name))?);
    }
    for variable in dataset.variables {
        let name = variable.name.clone();
        builder = builder.dataset(array(variable, &scales).map_err(refused(&name))?);
    }
    builder
        .into_plan()
        .and_then(|plan| {
            plan.encode(WriteOptions {
                byte_order: ORDER,
                ..WriteOptions::default()
            })
        })
        .map_err(refused("the file"))
}

fn refused(name: &str) -> impl Fn(Error) -> ResultsError {
    move |error| refuse(name, format!("is refused by the HDF5 writer: {error}"))
}

/// The dimensions as HDF5 sees them.
struct Scales {
    list: Vec<Scale>,
}

struct Scale {
    name: String,
    length: usize,
    /// Its number, as `_Netcdf4Dimid`.
    id: i32,
    /// Whether a variable of the same name holds the values along it.
    coordinate: bool,
    /// The arrays over it, each with the place of the dimension among theirs.
    users: Vec<(String, u32)>,
}

impl Scales {
    fn of(dataset: &Dataset) -> Self {
        let scale = |((name, length), id): (&(String, usize), i32)| {
            let others = dataset.variables.iter().filter(|v| v.name != *name);
            let users = others.flat_map(|variable| {
                let places = variable.dimensions.iter().zip(0..);
                places
                    .filter(|place| place.0 == name)
                    .map(|place| (variable.name.clone(), place.1))
            });
            Scale {
                name: name.clone(),
                length: *length,
                id,
                coordinate: dataset.variables.iter().any(|v| v.name == *name),
                users: users.collect(),
            }
        };
        Self {
            list: dataset.dimensions.iter().zip(0..).map(scale).collect(),
        }
    }

    fn get(&self, name: &str) -> Option<&Scale> {
        self.list.iter().find(|scale| scale.name == name)
    }

    /// Lengths of the dimensions of `variable`.
    fn shape(&self, variable: &Variable) -> Vec<u64> {
        let lengths = variable.dimensions.iter().filter_map(|name| self.get(name));
        lengths.map(|scale| scale.length as u64).collect()
    }
}

impl Scale {
    /// Marks `dataset` as the scale of this dimension.
    fn mark(&self, dataset: DatasetBuilder, name: &str) -> Result<DatasetBuilder, Error> {
        let dataset = dataset
            .attribute(AttributeBuilder::fixed_string("CLASS", "DIMENSION_SCALE"))
            .attribute(AttributeBuilder::fixed_string("NAME", name))
            .attribute(AttributeBuilder::scalar("_Netcdf4Dimid", self.id)?);
        if self.users.is_empty() {
            return Ok(dataset);
        }
        let users = self.users.clone();
        Ok(dataset.attribute(AttributeBuilder::object_reference_list(
            "REFERENCE_LIST",
            users,
        )))
    }

    /// The dataset that stands for a dimension without values; readers know it by this very name.
    fn placeholder(&self) -> Result<DatasetBuilder, Error> {
        let name = format!(
            "This is a netCDF dimension but not a netCDF variable. {:>10}",
            self.length
        );
        let zeros = vec![0.0_f32; self.length];
        let dataset =
            DatasetBuilder::typed_with_order::<f32>(&self.name, [self.length as u64], ORDER);
        self.mark(dataset.raw_data(bytes(&zeros)), &name)
    }
}

/// One array with its attributes; its values are dropped once they are encoded.
fn array(variable: Variable, scales: &Scales) -> Result<DatasetBuilder, Error> {
    let shape = scales.shape(&variable);
    let Variable {
        name,
        dimensions,
        values,
        attributes,
        flags,
        fill,
        ..
    } = variable;
    let (flag_codes, words): (Vec<i32>, Vec<String>) = flags.into_iter().unzip();
    let codes = Codes {
        flags: &flag_codes,
        fill,
    };
    let own = scales.get(&name);
    let mut dataset = match values {
        Values::F64(values) => floats(&name, &shape, &values, f64::NAN, own.is_none())?,
        Values::F32(values) => floats(&name, &shape, &values, f32::NAN, own.is_none())?,
        Values::I32(values) => codes.integers(&name, &shape, &values, |code| code)?,
        // The codes are known to fit.
        Values::U16(values) => codes.integers(&name, &shape, &values, |code| code as u16)?,
        Values::U8(values) => codes.integers(&name, &shape, &values, |code| code as u8)?,
        Values::I64(values) => codes.integers(&name, &shape, &values, i64::from)?,
        Values::Bool(values) => yes_or_no(&name, &shape, &values)?,
        Values::Text(values) => texts(&name, &shape, &values)?,
    };
    dataset = match own {
        Some(scale) => scale.mark(dataset, &name)?,
        None if dimensions.is_empty() => dataset,
        None => {
            let targets = dimensions.into_iter().map(|name| vec![name]).collect();
            dataset.attribute(AttributeBuilder::vlen_object_references(
                "DIMENSION_LIST",
                targets,
            ))
        }
    };
    for (name, value) in &attributes {
        dataset = dataset.attribute(attribute(name, value)?);
    }
    if !words.is_empty() {
        dataset = dataset.attribute(text("flag_meanings", &words.join(" "))?);
    }
    Ok(dataset)
}

/// An array whose gaps are NaN, and says so unless it is a coordinate, which must have none (CF 2.5.1).
fn floats<T: H5WriteElement>(
    name: &str,
    shape: &[u64],
    values: &[T],
    nan: T,
    gaps: bool,
) -> Result<DatasetBuilder, Error> {
    let dataset = plain(name, shape, values);
    if gaps {
        filled(dataset, nan)
    } else {
        Ok(dataset)
    }
}

/// Yes or no as CF flags and as xarray marks what it wrote itself.
fn yes_or_no(name: &str, shape: &[u64], values: &[bool]) -> Result<DatasetBuilder, Error> {
    let values: Vec<u8> = values.iter().map(|&value| value.into()).collect();
    Ok(plain(name, shape, &values)
        .attribute(numbers("flag_values", &[0_u8, 1]))
        .attribute(text("flag_meanings", "false true")?)
        .attribute(text("dtype", "bool")?))
}

/// Texts of any length. Filters would reach only the references to them.
fn texts(name: &str, shape: &[u64], values: &[String]) -> Result<DatasetBuilder, Error> {
    let values: Vec<String> = values.iter().map(|value| printable(value)).collect();
    DatasetBuilder::vlen_string_data(name, shape, &values)
}

/// What the whole numbers of an array mean, in the type of the array as CF 3.5 asks.
struct Codes<'a> {
    flags: &'a [i32],
    fill: Option<i32>,
}

impl Codes<'_> {
    fn integers<T: H5WriteElement>(
        &self,
        name: &str,
        shape: &[u64],
        values: &[T],
        typed: impl Fn(i32) -> T,
    ) -> Result<DatasetBuilder, Error> {
        let mut dataset = plain(name, shape, values);
        if let Some(fill) = self.fill {
            dataset = filled(dataset, typed(fill))?;
        }
        if !self.flags.is_empty() {
            let flags: Vec<T> = self.flags.iter().map(|&code| typed(code)).collect();
            dataset = dataset.attribute(numbers("flag_values", &flags));
        }
        Ok(dataset)
    }
}

fn filled<T: H5WriteElement>(dataset: DatasetBuilder, value: T) -> Result<DatasetBuilder, Error> {
    Ok(dataset
        .fill_value(bytes(&[value]))
        .attribute(numbers("_FillValue", &[value])))
}

/// Values in the file's byte order, in chunks and compressed unless they are few.
fn plain<T: H5WriteElement>(name: &str, shape: &[u64], values: &[T]) -> DatasetBuilder {
    let size = size_of::<T>();
    let dataset = DatasetBuilder::typed_with_order::<T>(name, shape, ORDER).raw_data(bytes(values));
    if size_of_val(values) < SMALL {
        return dataset;
    }
    let filter = |id, client_data| FilterDescription {
        id,
        name: None,
        client_data,
    };
    let dataset = dataset.chunked(chunk(shape, CHUNK / size));
    let dataset = if size > 1 {
        dataset.filter(filter(FILTER_SHUFFLE, Vec::new()))
    } else {
        dataset
    };
    dataset.filter(filter(FILTER_DEFLATE, vec![LEVEL]))
}

/// The shape of a chunk of `most` elements at most: whole rows as long as they fit.
fn chunk(shape: &[u64], most: usize) -> Vec<u64> {
    let mut room = most as u64;
    let mut chunk: Vec<u64> = shape
        .iter()
        .rev()
        .map(|&length| {
            let part = length.min(room.max(1));
            room /= part;
            part
        })
        .collect();
    chunk.reverse();
    chunk
}

fn bytes<T: H5WriteElement>(values: &[T]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(size_of_val(values));
    values
        .iter()
        .for_each(|value| value.write_one(ORDER, &mut bytes));
    bytes
}

fn attribute(name: &str, value: &Attribute) -> Result<AttributeBuilder, Error> {
    match value {
        Attribute::Text(content) => text(name, content),
        Attribute::Number(number) => Ok(numbers(name, &[*number])),
        Attribute::Integer(number) => Ok(numbers(name, &[*number])),
        Attribute::Numbers(list) => Ok(numbers(name, list)),
    }
}

fn numbers<T: H5WriteElement>(name: &str, values: &[T]) -> AttributeBuilder {
    AttributeBuilder::new(
        name,
        T::hdf5_type_with_order(ORDER),
        [values.len() as u64],
        bytes(values),
    )
}

/// Text as characters (NC_CHAR), in UTF-8 where letters are beyond ASCII: one type for all attributes, and the only one
/// that readers by C, Fortran, Ferret and older MATLAB know. Only what does not fit becomes a string (NC_STRING).
fn text(name: &str, content: &str) -> Result<AttributeBuilder, Error> {
    let content = printable(content);
    if content.len() <= SHORT_TEXT {
        Ok(AttributeBuilder::fixed_string(name, content))
    } else {
        AttributeBuilder::vlen_strings(name, &[content])
    }
}

/// A string ends at its first zero byte.
fn printable(content: &str) -> String {
    content.replace('\0', " ")
}
