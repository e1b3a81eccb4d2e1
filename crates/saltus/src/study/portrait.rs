//! Effect of a periodic orbit on floor and people.

use std::f64::consts::TAU;

use saltus_hybrid::Options;
use saltus_orbits::{MapPoint, Orbit};
use saltus_study::{Control, ORBIT_METHOD, point};

use super::StudyError;
use super::trajectory::{History, TrajectorySwitch, simulate};
use crate::model::{Contact, Model, Section};

/// Points per period of the way around.
const POINTS: u32 = 2000;

/// Effect of an orbit on floor and people.
#[derive(Clone, Debug, PartialEq)]
pub struct Portrait {
    /// Its points at cos(Omega t) = 1 in the paper's units, one per forcing period.
    pub section: Vec<Section>,
    /// Switches over the whole orbit, in time order; times from the first point on (s).
    pub switches: Vec<TrajectorySwitch>,
    /// Part of the time on the floor, of each body.
    pub contact_ratio: Vec<f64>,
    /// Phases of the drive at each touch-down of each body, in (0, 2 pi] (rad).
    pub touch_down_phases: Vec<Vec<f64>>,
    /// Largest plate reaction force on each body, in units of its weight.
    pub peak_reaction: Vec<f64>,
    /// The way around, at 2000 equal times per forcing period.
    pub history: History,
}

/// Follows an orbit of `model` once around.
///
/// # Errors
/// [`StudyError::Integrate`] for options out of range or when stopped.
pub fn portrait(model: &Model, orbit: &Orbit, control: &Control) -> Result<Portrait, StudyError> {
    let control = Control {
        options: Options {
            method: ORBIT_METHOD,
            ..control.options
        },
        ..control.clone()
    };
    let bodies = model.setup().jumpers.len();
    let periods = orbit.period() as u64;
    let start = point(model, &orbit.places[0]);
    let way = simulate(model, &start, periods, periods, POINTS, &control)?;
    let seconds = model.scales().period();
    let phase = |switch: &TrajectorySwitch| {
        let turns = switch.time / seconds;
        let part = turns - turns.ceil() + 1.0;
        part * TAU
    };
    let touch_downs = |body: usize| {
        let lands = |s: &&TrajectorySwitch| s.jumper == body && s.into == Some(Contact::Stance);
        way.switches.iter().filter(lands).map(phase).collect()
    };
    let mean = |body: usize| {
        way.contact_ratio.iter().map(|r| r[body]).sum::<f64>() / way.contact_ratio.len() as f64
    };
    let here = |place: &MapPoint| {
        let point = point(model, place);
        model.section(&point.modes, &point.x)
    };
    Ok(Portrait {
        section: orbit.places.iter().map(here).collect(),
        contact_ratio: (0..bodies).map(mean).collect(),
        touch_down_phases: (0..bodies).map(touch_downs).collect(),
        peak_reaction: way.peak_reaction,
        switches: way.switches,
        history: way.history,
    })
}

/// The order of the switches of an orbit in letters: T for take-off and L for touch-down, with the number of the
/// body from 1 where there are several; a bar between forcing periods, such as `LT|LT`.
pub fn sequence(model: &Model, orbit: &Orbit) -> String {
    let several = model.setup().jumpers.len() > 1;
    let letter = |crossing: &saltus_orbits::Crossing| {
        let (from, to) = (Contact::of(crossing.from), Contact::of(crossing.to));
        let letter = match to {
            _ if from == to => return String::new(),
            Contact::Flight => "T",
            Contact::Stance => "L",
        };
        let body = if several {
            (crossing.unit + 1).to_string()
        } else {
            String::new()
        };
        format!("{letter}{body}")
    };
    let period = |crossings: &Vec<_>| crossings.iter().map(letter).collect::<String>();
    let periods: Vec<String> = orbit.crossings.iter().map(period).collect();
    periods.join("|")
}
