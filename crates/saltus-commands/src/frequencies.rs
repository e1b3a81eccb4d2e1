//! `saltus frequencies`: the plate empty, in its plane, and with the people on it.

use crate::context::Context;
use crate::dataset::motion::jumpers;
use crate::dataset::{about, numbered, variable};
use crate::failure::Failure;
use crate::request::Answer;
use crate::store::{self, Store};
use saltus_config::Study;
use saltus_results::Dataset;
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
    #[serde(skip)]
    study: Study,
}

pub(crate) fn ask(study: &Study, context: &Context) -> Result<Box<dyn Answer>, Failure> {
    Ok(Box::new(frequencies(study, context)?))
}

impl Answer for Frequencies {
    fn summary(&self) -> String {
        table(self)
    }

    fn document(&self, to: &mut dyn Write) -> io::Result<()> {
        store::stream_json(to, self)
    }

    fn fill(&self, store: &mut dyn Store) -> Result<(), Failure> {
        store.dataset("frequencies.nc", dataset(self))
    }
}

fn frequencies(study: &Study, context: &Context) -> Result<Frequencies, Failure> {
    let (plate, jumpers) = (study.plate(), study.jumpers());
    let occupied = plate.occupied(&jumpers)?;
    Ok(Frequencies {
        plate_hz: plate.frequencies_hz()?,
        in_plane_hz: plate.in_plane_frequencies_hz_until(&context.stop)?,
        body_hz: occupied.body_index.map(|i| occupied.hz[i]),
        occupied_hz: occupied.hz,
        free_hz: jumpers.iter().map(|jumper| jumper.omega() / TAU).collect(),
        base_hz: study.base().omega(&plate, &jumpers)? / TAU,
        study: study.clone(),
    })
}

/// All of them over dimensions of their own, for xarray and its like.
fn dataset(found: &Frequencies) -> Dataset {
    let modes = |set: Dataset, name: &str, hz: &[f64], long_name: &str| {
        let dimension = format!("{name}_mode");
        let counted = "Mode, the lowest frequency first";
        set.coordinate(numbered(&dimension, 1, hz.len(), counted))
            .variable(variable(
                name,
                &[&dimension],
                hz.to_vec(),
                (long_name, "Hz"),
            ))
    };
    let body = found.body_hz.unwrap_or(f64::NAN);
    let moves = "Of those occupied, the one in which the first jumper moves most";
    let mut set = about("Natural frequencies of a plate with people", &found.study);
    set = modes(set, "plate", &found.plate_hz, "Transverse, empty plate");
    set = modes(
        set,
        "occupied",
        &found.occupied_hz,
        "Transverse, people standing on the plate",
    );
    set = modes(
        set,
        "in_plane",
        &found.in_plane_hz,
        "In the plane of the plate",
    );
    set.coordinate(jumpers(found.free_hz.len()))
        .variable(variable(
            "free",
            &["jumper"],
            found.free_hz.clone(),
            ("Body on rigid ground", "Hz"),
        ))
        .variable(variable("body", &[], body, (moves, "Hz")))
        .variable(variable("base", &[], found.base_hz, ("Base motion", "Hz")))
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
