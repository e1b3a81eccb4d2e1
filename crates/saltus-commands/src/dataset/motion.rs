//! A motion as arrays, for the datasets of several commands: section, time history, switches.

use super::{numbered, variable, wholes, words};
use crate::motion::SwitchPoint;
use crate::words::phase;
use saltus::model::{Model, Section};
use saltus::study::History;
use saltus_results::{Dataset, Variable};

/// What heights and velocities are, in the units of DP.
pub(crate) const HEIGHT: (&str, &str) = ("Height over eta = g/omega_h^2", "1");
pub(crate) const VELOCITY: (&str, &str) = ("Velocity over eta omega_h", "1");

/// The dimension of people.
pub(crate) fn jumpers(count: usize) -> Variable {
    numbered("jumper", 0, count, "Jumper, in the order of the study")
}

/// The dimensions of people and of the plate's transverse terms, with the half-waves of these.
pub(crate) fn dimensions(dataset: Dataset, model: &Model) -> Dataset {
    let setup = model.setup();
    let terms = &setup.plate.modes.w;
    let half_waves = |name: &str, numbers: Vec<i32>, along: &str| {
        let words = format!("Half-waves of the term along {along}");
        variable(name, &["term"], numbers, (&words, "1"))
    };
    let term = numbered("term", 0, terms.len(), "Transverse term of the plate");
    dataset
        .header("coordinates", "m n")
        .coordinate(jumpers(setup.jumpers.len()))
        .coordinate(term)
        .variable(half_waves("m", wholes(terms.iter().map(|w| w.m)), "x"))
        .variable(half_waves("n", wholes(terms.iter().map(|w| w.n)), "y"))
}

/// Points of the section over the dimensions `over`, the last of which varies fastest; NaN and no phase where
/// there is none. Their names begin with `prefix`.
pub(crate) fn section(
    dataset: Dataset,
    prefix: &str,
    over: &[&str],
    model: &Model,
    points: &[Option<&Section>],
) -> Dataset {
    let setup = model.setup();
    let (people, terms) = (setup.jumpers.len(), setup.plate.modes.w.len());
    let all = |width: usize, of: fn(&Section) -> &Vec<f64>| -> Vec<f64> {
        let values = |point: &Option<&Section>| match point {
            Some(point) => of(point).clone(),
            None => vec![f64::NAN; width],
        };
        points.iter().flat_map(values).collect()
    };
    let phases = points.iter().flat_map(|point| match point {
        Some(point) => point.phase.iter().copied().map(phase).collect(),
        None => vec!["none"; people],
    });
    let known = &["contact", "flight", "none"][..];
    let known = &known[..if points.contains(&None) { 3 } else { 2 }];
    let named = |name: &str| format!("{prefix}{name}");
    let (jumper, term) = ([over, &["jumper"]].concat(), [over, &["term"]].concat());
    let amplitude = ("Plate amplitude over thickness h, by terms", "1");
    dataset
        .variable(variable(named("z"), &jumper, all(people, |p| &p.z), HEIGHT))
        .variable(variable(
            named("v"),
            &jumper,
            all(people, |p| &p.v),
            VELOCITY,
        ))
        .variable(words(
            named("phase"),
            &jumper,
            known,
            phases,
            "Contact or flight",
        ))
        .variable(variable(named("w"), &term, all(terms, |p| &p.w), amplitude))
}

/// Observations at equal times.
pub(crate) fn history(dataset: Dataset, history: &History) -> Dataset {
    let over = ["history_time", "jumper"];
    let states = &history.states;
    let time = Variable::coordinate("history_time", history.time.clone())
        .long_name("Time since the start")
        .units("s");
    let z: Vec<f64> = states.iter().flat_map(|s| s.z.clone()).collect();
    let v: Vec<f64> = states.iter().flat_map(|s| s.v.clone()).collect();
    let prf: Vec<f64> = states.iter().flat_map(|s| s.prf.clone()).collect();
    let floor: Vec<f64> = states.iter().flat_map(|s| s.floor.clone()).collect();
    let force = ("Plate reaction force over body weight", "1");
    let feet = ("Height of the plate under the feet", "m");
    dataset
        .coordinate(time)
        .variable(variable("history_z", &over, z, HEIGHT))
        .variable(variable("history_v", &over, v, VELOCITY))
        .variable(variable("history_prf", &over, prf, force))
        .variable(variable("history_floor", &over, floor, feet))
}

/// Take-offs, touch-downs and tangencies in the order of time.
pub(crate) fn switches(dataset: Dataset, switches: &[SwitchPoint]) -> Dataset {
    let over = ["switch"];
    let times: Vec<f64> = switches.iter().map(|switch| switch.time).collect();
    let who = wholes(switches.iter().map(|switch| switch.jumper));
    let kinds = switches.iter().map(|switch| switch.kind);
    let known = ["take-off", "touch-down", "tangency"];
    dataset
        .dimension("switch", switches.len())
        .variable(variable(
            "switch_time",
            &over,
            times,
            ("Time since the start", "s"),
        ))
        .variable(variable("switch_jumper", &over, who, ("Who switches", "1")))
        .variable(words(
            "switch_kind",
            &over,
            &known,
            kinds,
            "What happens; a tangency touches the threshold and does not cross it",
        ))
}
