//! Datasets as JSON documents: attributes and single values as keys, tables as lists of records.
//!
//! Values over axes that are no rows are nested lists. A gap is null, and so is an infinite number, which JSON does not
//! have.

use crate::dataset::{Attribute, Cell, Dataset, Variable};
use crate::table::{Column, Rows};
use serde::ser::{Error, Serialize, SerializeMap, SerializeSeq, Serializer};

/// A dataset on its way into a document, a map of keys.
#[derive(Clone, Copy, Debug)]
pub struct Document<'a>(&'a Dataset);

impl<'a> Document<'a> {
    /// The document of a dataset.
    pub fn new(dataset: &'a Dataset) -> Self {
        Self(dataset)
    }
}

impl Serialize for Document<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let dataset = self.0;
        let mut map = to.serialize_map(None)?;
        for (name, attribute) in dataset.told() {
            match attribute {
                Attribute::Text(text) => map.serialize_entry(name, text)?,
                Attribute::Number(number) => map.serialize_entry(name, number)?,
                Attribute::Integer(number) => map.serialize_entry(name, number)?,
                Attribute::Numbers(numbers) => map.serialize_entry(name, numbers)?,
            }
        }
        let single = |variable: &&Variable| variable.dimensions().is_empty();
        for variable in dataset.variables().iter().filter(single) {
            map.serialize_entry(variable.name(), &variable.cell(0))?;
        }
        for table in dataset
            .tables()
            .iter()
            .filter(|table| table.is_in_document())
        {
            let rows = Rows::of(table, dataset).map_err(S::Error::custom)?;
            let columns = rows.columns(table, dataset).map_err(S::Error::custom)?;
            let records = Records {
                dataset,
                rows,
                columns,
            };
            match table.name() {
                "" => records.columns.iter().try_for_each(|column| {
                    map.serialize_entry(&column.title, &records.list(column, &[]))
                })?,
                name => map.serialize_entry(name, &records)?,
            }
        }
        map.end()
    }
}

impl Serialize for Cell<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match *self {
            Self::Gap => to.serialize_none(),
            Self::Number(number) => number.serialize(to),
            Self::Whole(number) => number.serialize(to),
            Self::Flag(flag) => flag.serialize(to),
            Self::Text(text) => text.serialize(to),
        }
    }
}

/// The rows of a table, each a map.
struct Records<'a> {
    dataset: &'a Dataset,
    rows: Rows<'a>,
    columns: Vec<Column<'a>>,
}

impl<'a> Records<'a> {
    fn list(&'a self, column: &'a Column<'a>, row: &[usize]) -> List<'a> {
        List {
            dataset: self.dataset,
            variable: column.variable,
            axes: &column.inner,
            index: column.index(row),
        }
    }
}

impl Serialize for Records<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut records = to.serialize_seq(None)?;
        for row in self.rows.iter() {
            records.serialize_element(&Record(self, &row))?;
        }
        records.end()
    }
}

struct Record<'a>(&'a Records<'a>, &'a [usize]);

impl Serialize for Record<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let Self(records, row) = self;
        let mut map = to.serialize_map(Some(records.columns.len()))?;
        for column in &records.columns {
            map.serialize_entry(&column.title, &records.list(column, row))?;
        }
        map.end()
    }
}

/// A value, or lists of values along the axes that are left.
#[derive(Clone, Copy)]
struct List<'a> {
    dataset: &'a Dataset,
    variable: &'a Variable,
    axes: &'a [(&'a str, usize, usize)],
    index: usize,
}

impl List<'_> {
    /// Its places along the first axis, up to the last known one if their number varies.
    fn places(&self, axis: &(&str, usize, usize)) -> usize {
        let &(name, length, _) = axis;
        match self.dataset.is_ragged(name) {
            true => (0..length)
                .rev()
                .find(|&place| self.at(place).is_known())
                .map_or(0, |last| last + 1),
            false => length,
        }
    }

    fn at(&self, place: usize) -> Self {
        let (stride, axes) = match self.axes {
            [first, rest @ ..] => (first.2, rest),
            [] => (0, self.axes),
        };
        Self {
            axes,
            index: self.index + place * stride,
            ..*self
        }
    }

    fn is_known(&self) -> bool {
        match self.axes.first() {
            None => self.variable.cell(self.index) != Cell::Gap,
            Some(&(_, length, _)) => (0..length).any(|place| self.at(place).is_known()),
        }
    }
}

impl Serialize for List<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self.axes.first() {
            None => self.variable.cell(self.index).serialize(to),
            Some(axis) => to.collect_seq((0..self.places(axis)).map(|place| self.at(place))),
        }
    }
}
