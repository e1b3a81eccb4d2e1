//! A sweep that takes each value anew, as work that can be cut.

use super::{PERIODS, Row, measure, periods};
use crate::failure::CommandError;
use crate::models::Models;
use crate::pieces::{Job, Reader, Sink, Writer};
use saltus::hybrid::Status;
use saltus::study::{Control, Label, Sweep, SweepRow};
use saltus_config::{Study, SweepTable};

/// A sweep of restarts. Item `pass * values + index` is value `index` of that pass.
pub(super) struct Restarts<'a> {
    study: &'a Study,
    table: &'a SweepTable,
    sweep: Sweep,
    models: Models<'a>,
}

impl<'a> Restarts<'a> {
    pub(super) fn new(
        study: &'a Study,
        table: &'a SweepTable,
        sweep: &Sweep,
        models: Models<'a>,
    ) -> Self {
        Self {
            study,
            table,
            sweep: sweep.clone(),
            models,
        }
    }

    fn place(&self, item: usize) -> (usize, f64) {
        let count = self.sweep.values.len();
        (item / count, self.sweep.values[item % count])
    }

    /// Some items as a sweep for each pass, in the order of the items.
    fn part(&self, items: &[usize]) -> Vec<Sweep> {
        let passes = items.chunk_by(|&a, &b| self.place(a).0 == self.place(b).0);
        passes
            .map(|items| Sweep {
                values: items.iter().map(|&item| self.place(item).1).collect(),
                passes: vec![self.sweep.passes[self.place(items[0]).0].clone()],
                ..self.sweep.clone()
            })
            .collect()
    }
}

impl Job for Restarts<'_> {
    type Item = Row;
    const LEAST: usize = 8;
    const ITEMS: &'static str = "values";

    fn command(&self) -> &'static str {
        "sweep"
    }

    fn study(&self) -> &Study {
        self.study
    }

    fn items(&self) -> usize {
        self.sweep.values.len() * self.sweep.passes.len()
    }

    fn effort(&self, items: usize) -> (u64, &'static str) {
        (items as u64 * periods(self.table), PERIODS)
    }

    fn compute(
        &self,
        items: &[usize],
        control: &Control,
        sink: Sink<Self::Item>,
    ) -> Result<(), CommandError> {
        let rows = measure(&self.part(items), self.table, &self.models, control)?;
        for (&item, mut row) in items.iter().zip(rows) {
            row.run.pass = self.place(item).0;
            // nobody goes on from here, and pieces do not keep it
            row.run.end = None;
            if let Some(label) = &mut row.label {
                label.end = None;
            }
            sink(item, row)?;
        }
        Ok(())
    }

    fn write(&self, row: &Row, out: &mut Writer) {
        let run = &row.run;
        write_status(run.status.as_ref().ok(), out);
        out.whole(run.section.len() as u64);
        out.whole(run.section.first().map_or(0, Vec::len) as u64);
        run.section.iter().for_each(|samples| out.numbers(samples));
        out.whole(run.contact_ratio.len() as u64);
        out.numbers(&run.contact_ratio);
        out.whole(row.label.is_some().into());
        if let Some(label) = &row.label {
            out.kind(label.kind);
            out.exponent(label.exponent);
            out.whole(label.confidence.is_some().into());
            out.numbers(&[label.confidence.unwrap_or_default()]);
        }
        out.whole(row.exponents.len() as u64);
        row.exponents
            .iter()
            .for_each(|&exponent| out.exponent(Some(exponent)));
    }

    fn read(&self, number: usize, from: &mut Reader) -> Option<Row> {
        let (pass, value) = self.place(number);
        let status = match status(from)? {
            Some(status) => Ok(status),
            // asked again rather than kept: that there is no model costs nothing to find
            None => Err(self.models.at(&[value]).err()?),
        };
        let (channels, samples) = (size(from)?, size(from)?);
        let run = SweepRow {
            pass,
            value,
            section: from.lists(channels, samples)?,
            contact_ratio: size(from).and_then(|count| from.numbers(count))?,
            status,
            end: None,
        };
        let label = match from.whole()? {
            0 => None,
            _ => Some(label(from)?),
        };
        let count = size(from)?;
        let exponents: Option<_> = (0..count).map(|_| from.exponent()?).collect();
        Some(Row {
            run,
            label,
            exponents: exponents?,
        })
    }
}

fn size(from: &mut Reader) -> Option<usize> {
    usize::try_from(from.whole()?).ok()
}

fn label(from: &mut Reader) -> Option<Label> {
    let (kind, exponent) = (from.kind()?, from.exponent()?);
    let (known, confidence) = (from.whole()? != 0, from.number()?);
    Some(Label {
        kind,
        exponent,
        confidence: known.then_some(confidence),
        end: None,
    })
}

/// How a run ended, in three words; `None` stands for a value without a model.
fn write_status(status: Option<&Status>, out: &mut Writer) {
    let (kind, time, count) = match status {
        None => (0, 0.0, 0),
        Some(Status::Completed) => (1, 0.0, 0),
        Some(&Status::Chattering {
            time,
            count,
            at_once,
        }) => (if at_once { 5 } else { 2 }, time, count.into()),
        Some(&Status::NotFinite { time, state }) => (3, time, state as u64),
        Some(&Status::TooManySteps { time, count }) => (4, time, count.into()),
        // an ending that is new here: not read back, and so computed again
        Some(_) => (u64::MAX, 0.0, 0),
    };
    out.whole(kind);
    out.numbers(&[time]);
    out.whole(count);
}

fn status(from: &mut Reader) -> Option<Option<Status>> {
    let (kind, time, count) = (from.whole()?, from.number()?, from.whole()?);
    let small = || u32::try_from(count).ok();
    Some(match kind {
        0 => None,
        1 => Some(Status::Completed),
        2 | 5 => Some(Status::Chattering {
            time,
            count: small()?,
            at_once: kind == 5,
        }),
        3 => Some(Status::NotFinite {
            time,
            state: usize::try_from(count).ok()?,
        }),
        4 => Some(Status::TooManySteps {
            time,
            count: small()?,
        }),
        _ => return None,
    })
}
