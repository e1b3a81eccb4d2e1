//! A motion as several commands tell it: points of its section, its switches.

use crate::failure::Failure;
use crate::per_jumper::{PerJumper, column};
use crate::store::Store;
use crate::words::phase;
use saltus::model::{Contact, Model, Section};
use saltus::study::TrajectorySwitch;
use saltus_results::Value;
use serde::Serialize;

/// A point of the section in JSON.
#[derive(Serialize)]
pub(super) struct SectionPoint<'a> {
    z: PerJumper<f64>,
    v: PerJumper<f64>,
    w: &'a [f64],
    phase: PerJumper<&'static str>,
}

/// A switch in JSON.
#[derive(Serialize)]
pub(super) struct SwitchPoint {
    pub(super) time: f64,
    pub(super) jumper: usize,
    pub(super) kind: &'static str,
}

/// Notes on the columns of [`header`].
pub(super) const COLUMNS: [(&str, &str); 4] = [
    ("z", "height over eta = g/omega_h^2 (-)"),
    ("v", "velocity over eta omega_h (-)"),
    ("phase", "contact or flight"),
    ("w_m_n", "plate amplitude over thickness h, term (m, n) (-)"),
];

/// Names of the columns of a point of the section.
pub(super) fn header(model: &Model) -> impl Iterator<Item = String> {
    let setup = model.setup();
    let jumpers = setup.jumpers.len();
    let bodies = move |i| ["z", "v", "phase"].map(|name| column(name, i, jumpers));
    let terms = setup.plate.modes.w.iter();
    let plate = terms.map(|w| format!("w_{}_{}", w.m, w.n));
    (0..jumpers).flat_map(bodies).chain(plate)
}

/// Its cells.
pub(super) fn cells(point: &Section) -> impl Iterator<Item = Value> {
    let bodies = point.z.iter().zip(&point.v).zip(&point.phase);
    let bodies = bodies.flat_map(|((&z, &v), &of)| [z.into(), v.into(), phase(of).into()]);
    bodies.chain(point.w.iter().copied().map(Value::from))
}

/// The table of switches.
pub(super) fn write_switches(
    folder: &mut dyn Store,
    switches: &[SwitchPoint],
    settings: &[(&str, &str)],
) -> Result<(), Failure> {
    let header = ["time_s", "jumper", "kind"].map(str::to_owned);
    let rows = switches.iter().map(|switch| {
        vec![
            switch.time.into(),
            Value::Integer(switch.jumper as i64),
            switch.kind.into(),
        ]
    });
    folder.table("switches.csv", settings, &header, rows)
}

impl<'a> From<&'a Section> for SectionPoint<'a> {
    fn from(section: &'a Section) -> Self {
        Self {
            z: section.z.iter().copied().collect(),
            v: section.v.iter().copied().collect(),
            w: &section.w,
            phase: section.phase.iter().copied().map(phase).collect(),
        }
    }
}

impl From<&TrajectorySwitch> for SwitchPoint {
    fn from(switch: &TrajectorySwitch) -> Self {
        Self {
            time: switch.time,
            jumper: switch.jumper,
            kind: match switch.into {
                Some(Contact::Flight) => "take-off",
                Some(Contact::Stance) => "touch-down",
                None => "tangency",
            },
        }
    }
}
