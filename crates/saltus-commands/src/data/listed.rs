//! Lists of records, such as special points or loops: one dimension, one variable and one column for each quantity.

use saltus_results::{Dataset, Quantity, Table, Values};

/// A list of records on its way into a dataset.
pub(crate) struct Listed<'a, T> {
    records: &'a [T],
    axis: &'static str,
    set: Dataset,
    table: Table,
}

impl<'a, T> Listed<'a, T> {
    /// Adds the dimension `axis`, with a place for each record, and begins the table `name`.
    pub(crate) fn new(set: Dataset, name: &str, axis: &'static str, records: &'a [T]) -> Self {
        Self {
            records,
            axis,
            set: set.dimension(axis, records.len()),
            table: Table::new(name, &[axis]),
        }
    }

    /// Adds a quantity of the records: the variable of its name, and the column `title`.
    pub(crate) fn column<V>(self, title: &str, quantity: Quantity, of: impl Fn(&T) -> V) -> Self
    where
        Vec<V>: Into<Values>,
    {
        self.with(title, quantity, None, of)
    }

    /// Adds a whole number that `gap` stands in for where there is none.
    pub(crate) fn whole(
        self,
        title: &str,
        quantity: Quantity,
        gap: i32,
        of: impl Fn(&T) -> Option<usize>,
    ) -> Self {
        let whole = |record: &T| of(record).map_or(gap, |n| i32::try_from(n).unwrap_or(i32::MAX));
        self.with(title, quantity, Some(gap), whole)
    }

    /// Adds one of the words of `quantity`.
    pub(crate) fn word(
        mut self,
        title: &str,
        quantity: Quantity,
        of: impl Fn(&T) -> &'static str,
    ) -> Self {
        let words = self.records.iter().map(of);
        let variable = quantity.spelt(&[self.axis], words);
        self.set = self.set.variable(variable);
        self.table = self.table.titled(title, quantity.name);
        self
    }

    fn with<V>(
        mut self,
        title: &str,
        quantity: Quantity,
        gap: Option<i32>,
        of: impl Fn(&T) -> V,
    ) -> Self
    where
        Vec<V>: Into<Values>,
    {
        let values: Vec<V> = self.records.iter().map(of).collect();
        let variable = quantity.over(&[self.axis], values);
        self.set = self.set.variable(match gap {
            Some(gap) => variable.gap(gap),
            None => variable,
        });
        self.table = self.table.titled(title, quantity.name);
        self
    }

    /// The dataset with the list and its table.
    pub(crate) fn end(self) -> Dataset {
        self.set.table(self.table)
    }
}
