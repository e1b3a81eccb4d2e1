//! `saltus frequencies`: the plate empty, in its plane, and with the people on it.

use crate::failure::Failure;
use crate::request::Answer;
use crate::store::{self, Store};
use saltus::physics::PhysicsError;
use saltus_config::Study;
use serde::Serialize;
use std::f64::consts::TAU;
use std::io::{self, Write};

/// All in Hz, lists ascending.
#[derive(Serialize)]
struct Frequencies {
    /// Transverse, empty plate.
    plate_hz: Vec<f64>,
    /// Transverse, every jumper standing on the plate.
    occupied_hz: Vec<f64>,
    /// In the plane of the plate.
    in_plane_hz: Vec<f64>,
    /// Of those occupied, the one in which the first jumper moves most.
    body_hz: Option<f64>,
    /// Each jumper on rigid ground, in the order of the file.
    free_hz: Vec<f64>,
    /// Base motion, Omega/(2 pi).
    base_hz: f64,
}

pub(crate) fn ask(study: &Study) -> Result<Box<dyn Answer>, Failure> {
    let found = frequencies(study).map_err(Failure::computation)?;
    Ok(Box::new(found))
}

impl Answer for Frequencies {
    fn summary(&self) -> String {
        table(self)
    }

    fn document(&self, to: &mut dyn Write) -> io::Result<()> {
        store::stream_json(to, self)
    }

    fn fill(&self, _: &mut dyn Store) -> Result<(), Failure> {
        Ok(())
    }
}

fn frequencies(study: &Study) -> Result<Frequencies, PhysicsError> {
    let (plate, jumpers) = (study.plate(), study.jumpers());
    let occupied = plate.occupied(&jumpers)?;
    Ok(Frequencies {
        plate_hz: plate.frequencies_hz()?,
        in_plane_hz: plate.in_plane_frequencies_hz()?,
        body_hz: occupied.body_index.map(|i| occupied.hz[i]),
        occupied_hz: occupied.hz,
        free_hz: jumpers.iter().map(|jumper| jumper.omega() / TAU).collect(),
        base_hz: study.base().omega(&plate, &jumpers)? / TAU,
    })
}

fn table(found: &Frequencies) -> String {
    let row = |name: &str, hz: &[f64]| {
        let numbers: Vec<String> = hz.iter().map(|f| format!("{f:>10.4}")).collect();
        // eight to a line
        let lines: Vec<String> = numbers.chunks(8).map(<[String]>::concat).collect();
        format!("{name:<22}{}\n", lines.join(&format!("\n{:<22}", "")))
    };
    let body: Vec<f64> = found.body_hz.into_iter().collect();
    [
        ("frequencies (Hz)", [].as_slice()),
        ("empty plate", &found.plate_hz),
        ("occupied plate", &found.occupied_hz),
        ("  of these the body's", &body),
        ("bodies, rigid ground", &found.free_hz),
        ("in the plane", &found.in_plane_hz),
        ("base motion", &[found.base_hz]),
    ]
    .into_iter()
    .filter(|(name, hz)| !hz.is_empty() || name.starts_with("freq"))
    .map(|(name, hz)| row(name, hz))
    .collect()
}
