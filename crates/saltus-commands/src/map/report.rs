//! The JSON document of a map.

use crate::per_jumper::PerJumper;
use crate::plane::{AxisReport, FirstFailure, Layers, Plane, Span, Tally, span};
use saltus_config::Study;
use serde::Serialize;

/// The document; `saltus map --help` explains each key.
#[derive(Serialize)]
pub(super) struct Report<'a> {
    version: &'static str,
    x: AxisReport,
    y: AxisReport,
    transient: u64,
    record: u64,
    pub(super) pixels: usize,
    #[serde(flatten)]
    pub(super) tally: Tally,
    pub(super) contact_ratio: PerJumper<Option<Span>>,
    pub(super) peak_reaction: PerJumper<Option<Span>>,
    pub(super) peak_acceleration: Option<Span>,
    pub(super) periods_run: u64,
    pub(super) first_failure: Option<FirstFailure>,
    study: &'a Study,
}

impl<'a> Report<'a> {
    pub(super) fn new(study: &'a Study, plane: &Plane, layers: &Layers) -> Self {
        let spans = |list: &[Vec<f64>]| list.iter().map(|values| span(values)).collect();
        Self {
            version: env!("CARGO_PKG_VERSION"),
            x: plane.x.report(),
            y: plane.y.report(),
            transient: plane.search.transient,
            record: plane.search.record,
            pixels: plane.grid.len(),
            tally: layers.tally(),
            contact_ratio: spans(&layers.contact_ratio),
            peak_reaction: spans(&layers.peak_reaction),
            peak_acceleration: span(&layers.peak_acceleration),
            periods_run: layers.periods_run.iter().map(|&n| u64::from(n)).sum(),
            first_failure: FirstFailure::of(plane, layers),
            study,
        }
    }
}
