//! Data of the answer, described once.

use super::{Found, Row};
use crate::data::{about, coordinate, each_number, eta, name, padded, parameter, wholes};
use crate::quantities as q;
use crate::status;
use crate::words::direction;
use saltus::orbits::{Exponent, MotionKind};
use saltus::study::{Bodies, SweepRow};
use saltus_results::{Dataset, Table};

pub(super) fn data(found: &Found) -> Dataset {
    let set = about("Long-term motion over a parameter", &found.study)
        .ragged("sample")
        .ragged("exponent_number");
    let set = passes(parameter(set, &found.parameter), found)
        .coordinate(coordinate(&found.parameter, &found.sweep.values))
        .coordinate(q::JUMPER.numbered(0, found.jumpers()))
        .coordinate(q::SAMPLE.numbered(1, found.sweep.record as usize))
        .coordinate(q::EXPONENT_NUMBER.numbered(1, found.most_exponents()));
    let set = motions(samples(set, found), found);
    tables(exponents(set, found), &name(&found.parameter), found)
}

/// The ways through the values, with the initial condition of each.
fn passes(set: Dataset, found: &Found) -> Dataset {
    let (over, passes) = (["direction"], &found.sweep.passes);
    let start = |part: usize| -> Vec<f64> {
        let starts = passes.iter().map(|pass| found.start(pass)[part]);
        starts.collect()
    };
    let directions: Vec<String> = passes.iter().map(direction).collect();
    set.header("coordinates", "start_z start_v")
        .coordinate(q::DIRECTION.along(directions))
        .variable(q::START_Z.over(&over, start(0)))
        .variable(q::START_V.over(&over, start(1)))
        .table(
            Table::new("passes", &over)
                .columns(&["direction", "start_z", "start_v"])
                .in_document(),
        )
}

fn samples(set: Dataset, found: &Found) -> Dataset {
    let (value, record) = (name(&found.parameter), found.sweep.record as usize);
    let over = ["direction", &value, "jumper", "sample"];
    let jumpers = found.jumpers();
    // a row without a model has no samples of anybody
    let each = |of: fn(&SweepRow) -> &[Vec<f64>]| -> Vec<f64> {
        let bodies = found.rows.iter().flat_map(|row| {
            let samples = move |i| of(&row.run).get(i).map_or(&[][..], Vec::as_slice);
            (0..jumpers).map(samples)
        });
        bodies.flat_map(|samples| padded(samples, record)).collect()
    };
    let ratios = found.rows.iter();
    let ratios = ratios.flat_map(|row| padded(&row.run.contact_ratio, jumpers));
    let heights = eta(&found.study, Some((&found.parameter, &found.sweep.values)));
    set.variable(q::ETA.over(&over[1..3], heights))
        .variable(q::Z.over(&over, each(SweepRow::z)))
        .variable(q::V.over(&over, each(SweepRow::v)))
        .variable(q::CONTACT_RATIO.over(&over[..3], ratios.collect::<Vec<f64>>()))
}

/// The kind of motion at each value, and how its run ended.
fn motions(set: Dataset, found: &Found) -> Dataset {
    let (value, rows) = (name(&found.parameter), found.rows.iter());
    let over = ["direction", &value];
    let confidence = |row: &Row| row.label.as_ref().and_then(|label| label.confidence);
    let confidence = rows.clone().map(|row| confidence(row).unwrap_or(f64::NAN));
    let status = rows.clone().map(Row::status);
    let texts: Vec<String> = rows.clone().map(Row::status_text).collect();
    set.variable(q::LABEL.spelt(&over, rows.clone().map(Row::label)).gap(0))
        .variable(q::PERIOD.over(&over, wholes(rows.map(Row::period))).gap(0))
        .variable(q::CONFIDENCE.over(&over, confidence.collect::<Vec<f64>>()))
        .variable(q::STATUS.spelt(&over, status))
        .variable(q::STATUS_TEXT.over(&over, texts))
}

fn exponents(set: Dataset, found: &Found) -> Dataset {
    let (value, most) = (name(&found.parameter), found.most_exponents());
    let over = ["direction", &value, "exponent_number"];
    let each = |of: fn(&Exponent) -> f64| -> Vec<f64> {
        let rows = found.rows.iter();
        let rows = rows.map(|row| row.exponents.iter().map(of).collect::<Vec<f64>>());
        rows.flat_map(|row| padded(&row, most).collect::<Vec<f64>>())
            .collect()
    };
    set.variable(q::EXPONENT.over(&over, each(|e| e.per_iterate)))
        .variable(q::EXPONENT_ERROR.over(&over, each(|e| e.standard_error)))
}

/// Samples and values: in files a row for each jumper, in the document lists.
fn tables(set: Dataset, value: &str, found: &Found) -> Dataset {
    let row = |rows: &[&str], own: &[&str]| {
        Table::new("rows", rows)
            .columns(&["direction", "start_z", "start_v"])
            .titled("value", value)
            .columns(own)
            .columns(&["contact_ratio", "label", "period", "confidence"])
            .columns(&["status", "status_text"])
            .titled("exponent", "exponent")
            .titled("error", "exponent_error")
            .beside("exponent_number", each_number(found.most_exponents()))
    };
    set.table(
        Table::new("sweep", &["direction", value, "jumper", "sample"])
            .columns(&["direction"])
            .titled("value", value)
            .columns(&["jumper", "sample", "z", "v"])
            .only_where("z")
            .in_files(),
    )
    .table(row(&["direction", value, "jumper"], &["jumper"]).in_files())
    .table(row(&["direction", value], &["z", "v"]).in_document())
}

/// All kinds of motion that a row may have.
pub(super) fn labels() -> &'static [&'static str] {
    // the first of the words is that of a row without one
    &q::LABEL.words[1..]
}

impl Found {
    /// Exponents of a row at most; without a question there is the one that a label took.
    fn most_exponents(&self) -> usize {
        self.table.exponents.max(1) as usize
    }
}

impl Row {
    /// Word for its kind of motion.
    pub(super) fn label(&self) -> &'static str {
        match self.label.as_ref().map(|label| label.kind) {
            None => q::LABEL.words[0],
            // exponents were asked for, so it is not known only because they do not tell
            Some(MotionKind::NotPeriodic) => MotionKind::Undecided.name(),
            Some(kind) => kind.name(),
        }
    }

    /// Period in forcing periods, 0 if it is not periodic.
    pub(super) fn period(&self) -> u32 {
        let period = self.label.as_ref().and_then(|label| label.kind.period());
        period.unwrap_or(0)
    }

    /// Word for how its run ended.
    fn status(&self) -> &'static str {
        self.run
            .status
            .as_ref()
            .map_or("no-model", |end| end.name())
    }

    /// End of its run, in a sentence.
    pub(super) fn status_text(&self) -> String {
        match &self.run.status {
            Ok(end) => status::text(end, None),
            Err(error) => error.to_string(),
        }
    }
}
