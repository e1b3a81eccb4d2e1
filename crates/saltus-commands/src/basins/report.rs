//! The JSON document of basins.

use super::Basins;
use crate::per_jumper::PerJumper;
use crate::plane::{AxisReport, FirstFailure, Plane, Tally};
use saltus::study::Entry;
use saltus_config::Study;
use serde::Serialize;

/// The document; `saltus basins --help` explains each key.
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
    pub(super) attractors: Vec<AttractorReport>,
    periods_run: u64,
    pub(super) first_failure: Option<FirstFailure>,
    study: &'a Study,
}

/// One attractor.
#[derive(Serialize)]
pub(super) struct AttractorReport {
    pub(super) number: usize,
    /// Its number along the sweep of `saltus attractors`; null if it was not met there or not asked for.
    matched: Option<usize>,
    /// Null if not periodic.
    pub(super) period: Option<u32>,
    /// What kind of motion, in words.
    pub(super) kind: &'static str,
    pub(super) pixels: u64,
    pub(super) share: f64,
    /// The first pixel that leads to it.
    pub(super) start: [f64; 2],
    pub(super) contact_ratio: PerJumper<f64>,
    pub(super) peak_reaction: PerJumper<f64>,
    pub(super) peak_acceleration: f64,
    /// Section points.
    pub(super) z: PerJumper<Vec<f64>>,
    pub(super) v: PerJumper<Vec<f64>>,
    pub(super) z_range: PerJumper<[f64; 2]>,
    pub(super) v_range: PerJumper<[f64; 2]>,
}

impl<'a> Report<'a> {
    pub(super) fn new(study: &'a Study, plane: &Plane, basins: &Basins) -> Self {
        let layers = &basins.layers;
        let pixels = plane.grid.len();
        let attractors = basins.attractors.iter().enumerate();
        Self {
            version: env!("CARGO_PKG_VERSION"),
            x: plane.x.report(),
            y: plane.y.report(),
            transient: plane.search.transient,
            record: plane.search.record,
            pixels,
            tally: layers.tally(),
            attractors: attractors
                .map(|(place, entry)| AttractorReport {
                    matched: basins.identity(place).map(|identity| identity + 1),
                    ..AttractorReport::new(plane, place + 1, entry)
                })
                .collect(),
            periods_run: layers.periods_run.iter().map(|&n| u64::from(n)).sum(),
            first_failure: FirstFailure::of(plane, layers),
            study,
        }
    }
}

impl AttractorReport {
    fn new(plane: &Plane, number: usize, entry: &Entry) -> Self {
        let motion = &entry.attractor;
        // a cycle begins with its lowest sample of the first jumper: where it was met says nothing
        let first = motion.z.first().map_or(&[][..], Vec::as_slice);
        let lowest = (0..first.len()).min_by(|&a, &b| first[a].total_cmp(&first[b]));
        let rotated = |lists: &[Vec<f64>]| -> PerJumper<Vec<f64>> {
            let turn = |list: &Vec<f64>| {
                let mut list = list.clone();
                list.rotate_left(lowest.unwrap_or(0));
                list
            };
            lists.iter().map(turn).collect()
        };
        Self {
            number,
            matched: None,
            period: motion.kind.period(),
            kind: motion.kind.name(),
            pixels: entry.count,
            share: entry.share(plane.grid.len() as u64),
            start: plane.grid.at(entry.first).into(),
            contact_ratio: motion.contact_ratio.clone().into(),
            peak_reaction: motion.peak_reaction.clone().into(),
            peak_acceleration: motion.peak_acceleration,
            z: rotated(&motion.z),
            v: rotated(&motion.v),
            z_range: motion.ranges.iter().map(|range| range.0).collect(),
            v_range: motion.ranges.iter().map(|range| range.1).collect(),
        }
    }

    /// `2T`, or what else it is.
    pub(super) fn name(&self) -> String {
        self.period
            .map_or(self.kind.to_owned(), |n| format!("{n}T"))
    }
}
