//! A motion as arrays: people and plate, points of the section, time history, switches.

use super::{each_jumper, each_term, wholes};
use crate::quantities as q;
use crate::words::phase;
use saltus::model::{Contact, Model, Observation, Section};
use saltus::study::{History, TrajectorySwitch};
use saltus_results::{Dataset, Table};

/// The dimensions of people and of the plate's transverse terms, with the half-waves of these.
pub(crate) fn dimensions(set: Dataset, model: &Model) -> Dataset {
    let setup = model.setup();
    let terms = &setup.plate.modes.w;
    set.header("coordinates", "m n")
        .coordinate(q::JUMPER.numbered(0, setup.jumpers.len()))
        .coordinate(q::TERM.numbered(0, terms.len()))
        .variable(q::TERM_M.over(&["term"], wholes(terms.iter().map(|w| w.m))))
        .variable(q::TERM_N.over(&["term"], wholes(terms.iter().map(|w| w.n))))
}

/// Points of the section over the dimensions `over`, the last of which varies fastest; NaN and no phase where there is
/// none. Their names begin with `prefix`.
pub(crate) fn section(
    set: Dataset,
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
    let named = |name: &str| format!("{prefix}{name}");
    let (jumper, term) = ([over, &["jumper"]].concat(), [over, &["term"]].concat());
    set.variable(q::Z.over(&jumper, all(people, |p| &p.z)).named(named("z")))
        .variable(q::V.over(&jumper, all(people, |p| &p.v)).named(named("v")))
        .variable(q::PHASE.spelt(&jumper, phases).gap(2).named(named("phase")))
        .variable(q::W.over(&term, all(terms, |p| &p.w)).named(named("w")))
}

/// Adds the columns of a point of the section to a table of points.
pub(crate) fn columns(table: Table, prefix: &str, model: &Model) -> Table {
    let columns = ["z", "v", "phase", "w"];
    let add = |table: Table, name: &str| table.titled(name, format!("{prefix}{name}"));
    let jumpers = model.setup().jumpers.len();
    columns
        .into_iter()
        .fold(table, add)
        .beside("jumper", each_jumper(jumpers))
        .beside("term", each_term(model))
}

/// Observations along a motion of `model`, and their table.
pub(crate) fn history(set: Dataset, history: &History, model: &Model) -> Dataset {
    let over = ["history_time", "jumper"];
    let all = |of: fn(&Observation) -> &Vec<f64>| -> Vec<f64> {
        history.states.iter().flat_map(|s| of(s).clone()).collect()
    };
    let states = || history.states.iter();
    let base: Vec<f64> = states().map(|s| s.base).collect();
    let phases = states().flat_map(|s| s.phase.iter().copied().map(phase));
    // the base's own acceleration is -Omega^2 times its height
    let square = model.scales().omega.powi(2);
    let relative = states().flat_map(|s| {
        let accelerations = s.floor_acceleration.iter();
        accelerations.map(move |absolute| absolute + square * s.base)
    });
    set.coordinate(q::HISTORY_TIME.along(history.time.clone()))
        .variable(q::HISTORY_Z.over(&over, all(|s| &s.z)))
        .variable(q::HISTORY_V.over(&over, all(|s| &s.v)))
        .variable(q::HISTORY_PHASE.spelt(&over, phases))
        .variable(q::HISTORY_PRF.over(&over, all(|s| &s.prf)))
        .variable(q::HISTORY_W.over(&["history_time", "term"], all(|s| &s.w)))
        .variable(q::HISTORY_BASE.over(&over[..1], base))
        .variable(q::HISTORY_FLOOR.over(&over, all(|s| &s.floor)))
        .variable(q::HISTORY_FLOOR_ACCELERATION.over(&over, all(|s| &s.floor_acceleration)))
        .variable(q::HISTORY_FLOOR_RELATIVE.over(&over, relative.collect::<Vec<f64>>()))
        .table(
            Table::new("history", &over[..1])
                .titled("time_s", "history_time")
                .titled("z", "history_z")
                .titled("v", "history_v")
                .titled("phase", "history_phase")
                .titled("prf", "history_prf")
                .titled("floor_m", "history_floor")
                .titled("floor_acceleration", "history_floor_acceleration")
                .titled(
                    "floor_acceleration_relative",
                    "history_floor_acceleration_relative",
                )
                .titled("base_m", "history_base")
                .titled("w", "history_w")
                .beside("jumper", each_jumper(model.setup().jumpers.len()))
                .beside("term", each_term(model))
                .in_files(),
        )
}

/// Take-offs, touch-downs and tangencies in the order of time, and their table.
pub(crate) fn switches(set: Dataset, switches: &[TrajectorySwitch]) -> Dataset {
    let over = ["switch"];
    let times: Vec<f64> = switches.iter().map(|switch| switch.time).collect();
    let who = wholes(switches.iter().map(|switch| switch.jumper));
    let kinds = switches.iter().map(|switch| kind(switch));
    set.dimension("switch", switches.len())
        .variable(q::SWITCH_TIME.over(&over, times))
        .variable(q::SWITCH_JUMPER.over(&over, who))
        .variable(q::SWITCH_KIND.spelt(&over, kinds))
        .table(
            Table::new("switches", &over)
                .titled("time_s", "switch_time")
                .titled("jumper", "switch_jumper")
                .titled("kind", "switch_kind"),
        )
}

/// Word for a switch.
pub(crate) fn kind(switch: &TrajectorySwitch) -> &'static str {
    match switch.into {
        Some(Contact::Flight) => "take-off",
        Some(Contact::Stance) => "touch-down",
        None => "tangency",
    }
}
