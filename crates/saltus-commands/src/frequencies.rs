//! `saltus frequencies`: the plate empty, in its plane, and with the people on it.

use crate::answer::Answer;
use crate::context::RunContext;
use crate::data::about;
use crate::failure::CommandError;
use crate::quantities as q;
use saltus_config::Study;
use saltus_results::{Dataset, Quantity, Table};
use std::f64::consts::TAU;

/// All in Hz, lists ascending.
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
    study: Study,
}

pub(crate) fn ask(study: &Study, context: &RunContext) -> Result<Box<dyn Answer>, CommandError> {
    Ok(Box::new(frequencies(study, context)?))
}

impl Answer for Frequencies {
    fn study(&self) -> &Study {
        &self.study
    }

    fn data(&self) -> Dataset {
        data(self)
    }

    fn summary(&self) -> String {
        table(self)
    }
}

fn frequencies(study: &Study, context: &RunContext) -> Result<Frequencies, CommandError> {
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

fn data(found: &Frequencies) -> Dataset {
    let modes = |set: Dataset, mode: Quantity, quantity: Quantity, hz: &[f64]| {
        set.coordinate(mode.numbered(1, hz.len()))
            .variable(quantity.over(&[mode.name], hz.to_vec()))
    };
    let body = found.body_hz.unwrap_or(f64::NAN);
    let set = about("Natural frequencies of a plate with people", &found.study);
    let set = modes(set, q::PLATE_MODE, q::PLATE_FREQUENCY, &found.plate_hz);
    let set = modes(
        set,
        q::OCCUPIED_MODE,
        q::OCCUPIED_FREQUENCY,
        &found.occupied_hz,
    );
    let set = modes(
        set,
        q::IN_PLANE_MODE,
        q::IN_PLANE_FREQUENCY,
        &found.in_plane_hz,
    );
    set.coordinate(q::JUMPER.numbered(0, found.free_hz.len()))
        .variable(q::FREE_FREQUENCY.over(&["jumper"], found.free_hz.clone()))
        .variable(q::BODY_FREQUENCY.is(body))
        .variable(q::BASE.is(found.base_hz))
        .table(Table::of_document(&[
            "plate", "occupied", "in_plane", "free",
        ]))
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
