//! Data of the answer, described once.

use super::{Found, search};
use crate::data::{about, base, eta, motion, whole};
use crate::quantities as q;
use saltus::orbits::Multiplier;
use saltus_results::{Dataset, Table};

pub(super) fn data(found: &Found) -> Dataset {
    let (orbit, seen) = (&found.orbit, &found.portrait);
    let stability = orbit.stability();
    let points: Vec<_> = seen.section.iter().map(Some).collect();
    let set = about(
        "A periodic orbit of people on a vibrating plate",
        &found.study,
    )
    .attribute(q::STABILITY.name, stability.name())
    .attribute(q::SEQUENCE.name, found.sequence())
    .variable(q::PERIOD.is(whole(orbit.period())))
    .variable(q::PERIOD_ASKED.is(whole(found.study.orbit.period)).gap(0))
    .variable(q::OUTSIDE.is(whole(orbit.outside())))
    .variable(q::IN_FAMILY.is(orbit.in_family()))
    .variable(q::RESIDUAL.is(orbit.residual))
    .variable(q::ITERATIONS.is(whole(orbit.iterations)))
    .variable(q::SEGMENTS.is(whole(found.segments())))
    .coordinate(q::POINT.numbered(0, points.len()));
    let set = multipliers(base(set, &found.model), &orbit.multipliers);
    let set = motion::dimensions(set, &found.model)
        .variable(q::ETA.over(&["jumper"], eta(&found.study, None)));
    let set = motion::section(set, "", &["point"], &found.model, &points);
    let section = Table::new("section", &["point"]).columns(&["point"]);
    let set = set.table(motion::columns(section, "", &found.model));
    let set = motion::history(jumpers(set, found), &seen.history, &found.model);
    motion::switches(set, &seen.switches)
}

fn multipliers(set: Dataset, all: &[Multiplier]) -> Dataset {
    let over = ["multiplier"];
    let of = |value: fn(&Multiplier) -> f64| -> Vec<f64> { all.iter().map(value).collect() };
    set.coordinate(q::MULTIPLIER.numbered(1, all.len()))
        .variable(q::MULTIPLIER_REAL.over(&over, of(|m| m.re)))
        .variable(q::MULTIPLIER_IMAGINARY.over(&over, of(|m| m.im)))
        .variable(q::MULTIPLIER_MODULUS.over(&over, of(|m| m.re.hypot(m.im))))
        .variable(q::MULTIPLIER_ERROR.over(&over, of(|m| m.error)))
        .table(
            Table::new("multipliers", &over)
                .titled("re", "multiplier_real")
                .titled("im", "multiplier_imaginary")
                .titled("modulus", "multiplier_modulus")
                .titled("error", "multiplier_error"),
        )
}

/// Contact, reaction and touch-downs of each person once around.
fn jumpers(set: Dataset, found: &Found) -> Dataset {
    let seen = &found.portrait;
    let most = seen.touch_down_phases.iter().map(Vec::len).max();
    let most = most.unwrap_or(0);
    let phases = seen.touch_down_phases.iter();
    let phases = phases.flat_map(|phases| crate::data::padded(phases, most));
    set.dimension("touch_down", most)
        .ragged("touch_down")
        .variable(q::CONTACT_RATIO.over(&["jumper"], seen.contact_ratio.clone()))
        .variable(q::PEAK_REACTION.over(&["jumper"], seen.peak_reaction.clone()))
        .variable(q::TOUCH_DOWN_PHASE.over(&["jumper", "touch_down"], phases.collect::<Vec<f64>>()))
        .table(Table::of_document(&[
            "eta",
            "contact_ratio",
            "peak_reaction",
            "touch_down_phase",
        ]))
}

impl Found {
    /// The order of the switches.
    pub(super) fn sequence(&self) -> String {
        saltus::study::sequence(&self.model, &self.orbit)
    }

    /// Pieces that Newton's method joined.
    pub(super) fn segments(&self) -> usize {
        let period = self.orbit.period();
        let asked = search(&self.study.orbit).segments;
        asked.map_or(period, |segments| segments.min(period))
    }

    pub(super) fn jumpers(&self) -> usize {
        self.study.jumper.len()
    }
}
