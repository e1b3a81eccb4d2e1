//! Special points, with the orbits to begin with again.

use super::Found;
use crate::continuation::view::Seen;
use crate::data::{in_unit_of, motion, name, padded, texts, values, wholes};
use crate::kinds;
use crate::quantities as q;
use saltus::orbits::Special;
use saltus_config::Parameter;
use saltus_results::{Dataset, Quantity, Table};

pub(super) fn specials(set: Dataset, found: &Found) -> Dataset {
    let (over, parameter) = (["special"], &found.question.parameter);
    let all: Vec<(usize, &Special, &Seen)> = found.specials().collect();
    let text = |quantity: Quantity, of: for<'a> fn(&'a Special) -> &'a str| {
        quantity.over(&over, texts(all.iter().map(|(_, special, _)| of(special))))
    };
    let whole = |quantity: Quantity, of: fn(&Special) -> usize| {
        quantity.over(&over, wholes(all.iter().map(|(_, special, _)| of(special))))
    };
    let number = |of: &dyn Fn(&Special) -> f64| -> Vec<f64> {
        all.iter().map(|(_, special, _)| of(special)).collect()
    };
    let along = number(&|special| special.parameter);
    let angles = number(&|special| kinds::angle(&special.kind).unwrap_or(f64::NAN));
    let index = found.question.along().parameter;
    let values_of_orbits = number(&|special| special.orbit.parameters[index]);
    let branches = wholes(all.iter().map(|(branch, ..)| *branch));
    let sequences = all.iter().map(|(.., seen)| seen.sequence.as_str());
    let set = set
        .dimension("special", all.len())
        .variable(text(q::SPECIAL_LABEL, |special| &special.label))
        .variable(text(q::SPECIAL_KIND, |special| special.kind.short()))
        .variable(text(q::SPECIAL_NAME, |special| kinds::name(&special.kind)))
        .variable(q::SPECIAL_BRANCH.over(&over, branches))
        .variable(values(parameter, &over, along).named(special_value(parameter)))
        .variable(whole(q::SPECIAL_PERIOD, |special| special.orbit.period()))
        .variable(whole(q::SPECIAL_OUTSIDE_BEFORE, |special| {
            special.outside[0]
        }))
        .variable(whole(q::SPECIAL_OUTSIDE_AFTER, |special| {
            special.outside[1]
        }))
        .variable(q::SPECIAL_ANGLE.over(&over, angles))
        .variable(q::SPECIAL_SEQUENCE.over(&over, texts(sequences)))
        .variable(text(q::SPECIAL_REMARK, |special| {
            special.remark.as_deref().unwrap_or_default()
        }))
        .variable(in_unit_of(
            parameter,
            q::SPECIAL_ORBIT_VALUE.over(&over, values_of_orbits),
        ));
    let sections = found.sections(all.iter().map(|(.., seen)| *seen));
    let over = ["special", "place"];
    let set = motion::section(set, "special_", &over, &found.model, &sections);
    special_tables(states(set, found, &all), parameter)
}

/// The orbits as the model has them, to begin with again.
fn states(set: Dataset, found: &Found, all: &[(usize, &Special, &Seen)]) -> Dataset {
    let (people, states) = (found.model.setup().jumpers.len(), found.model.free_states());
    let most = found.places();
    let places = || {
        let orbits = all.iter().map(|(_, special, _)| &special.orbit);
        orbits.flat_map(|orbit| (0..most).map(|place| orbit.places.get(place)))
    };
    let modes = places().flat_map(|place| {
        let known = place.map_or(&[][..], |place| &place.modes);
        let known = wholes(known.iter().copied()).into_iter();
        known.chain(std::iter::repeat(-1)).take(people)
    });
    let x = places().flat_map(|place| padded(place.map_or(&[][..], |place| &place.x), states));
    set.dimension("state", states)
        .variable(
            q::SPECIAL_MODES
                .over(&["special", "place", "jumper"], modes.collect::<Vec<i32>>())
                .gap(-1),
        )
        .variable(q::SPECIAL_X.over(&["special", "place", "state"], x.collect::<Vec<f64>>()))
}

fn special_tables(set: Dataset, parameter: &Parameter) -> Dataset {
    let titled = |table: Table, titles: &[&str]| {
        let add = |table: Table, title: &&str| table.titled(*title, format!("special_{title}"));
        titles.iter().fold(table, add)
    };
    let table = |title: String| {
        let table = Table::new("special_points", &["special"]);
        let table = titled(table, &["label", "kind", "name", "branch"]);
        let table = table.titled(title, special_value(parameter));
        let table = titled(table, &["period", "outside_before", "outside_after"]);
        titled(table, &["angle", "sequence", "remark"])
    };
    let records = table("value".to_owned());
    let records = titled(
        records,
        &["z", "v", "phase", "w", "orbit_value", "modes", "x"],
    );
    set.table(table(name(parameter)).in_files())
        .table(records.in_document())
}

fn special_value(parameter: &Parameter) -> String {
    format!("special_{}", name(parameter))
}
