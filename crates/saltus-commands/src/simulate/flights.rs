//! When was a jumper in the air?

use super::Found;
use saltus::model::Contact;

/// Intervals (s) of jumper `index` in flight between `from` and the end of the run.
pub(super) fn of(found: &Found, index: usize, from: f64) -> Vec<(f64, f64)> {
    let trajectory = &found.trajectory;
    let entered = trajectory
        .switches
        .iter()
        .filter(|switch| switch.jumper == index)
        .filter_map(|switch| Some((switch.time, switch.into?)));
    let mut flights = Vec::new();
    // a first touch-down ends a flight that began with the run
    let mut since = Some(0.0);
    let mut switched = false;
    for (time, into) in entered {
        match into {
            Contact::Flight => since = Some(time),
            Contact::Stance => flights.extend(since.take().map(|start| (start, time))),
        }
        switched = true;
    }
    let end = trajectory.history.time.last().copied().unwrap_or(0.0);
    let airborne = |contact| Contact::of(contact) == Contact::Flight;
    let aloft = trajectory.end.point.modes.get(index).copied();
    if switched || aloft.is_some_and(airborne) {
        flights.extend(since.map(|start| (start, end)));
    }
    flights
        .into_iter()
        .filter(|flight| flight.1 > from)
        .map(|(start, stop)| (start.max(from), stop))
        .collect()
}
