//! Data of the answer, described once.

use super::{Found, ranges};
use crate::data::{
    Of, about, coordinate, eta, name, padded, parameter, values, whole, wholes, without,
};
use crate::plane::Loss;
use crate::quantities as q;
use saltus::orbits::Exponent;
use saltus::study::{
    Arrival, AttractorCensus, BasinFraction, Bodies, CountedAttractor, Effects, Lost, Row,
    Transient,
};
use saltus_results::{Dataset, Quantity, Table};

pub(super) fn data(found: &Found) -> Dataset {
    let starts = found.study.attractors.starts;
    let set = about(
        "Coexisting attractors of people on a vibrating plate",
        &found.study,
    )
    .ragged("sample")
    .coordinate(q::JUMPER.numbered(0, found.jumpers()))
    .coordinate(q::ATTRACTOR.numbered(1, found.all.identities.len()))
    .variable(q::STARTS_ASKED.is(whole(starts)))
    .variable(q::UNSEEN.is(BasinFraction::unseen(starts.into())))
    .variable(q::UNFINISHED.is(whole(found.all.unfinished)))
    .variable(q::PERIODS_RUN.is(whole(found.periods_run)));
    let set = match &found.parameter {
        Some(changed) => parameter(set, changed).coordinate(coordinate(changed, &found.values())),
        // an empty column of each table
        None => set.column(q::VALUE.is(f64::NAN)),
    };
    let set = sections(attractors(set, found), found);
    let set = rows(transients(set, found), found);
    ranges::loops(ranges::ranges(set, found), found)
}

const NUMBERS: [Of<CountedAttractor, f64>; 8] = [
    (q::LARGEST_MULTIPLIER, |one| {
        one.entry.attractor.multiplier.unwrap_or(f64::NAN)
    }),
    (q::LARGEST_EXPONENT, |one| {
        exponent(one).map_or(f64::NAN, |e| e.per_iterate)
    }),
    (q::EXPONENT_ERROR, |one| {
        exponent(one).map_or(f64::NAN, |e| e.standard_error)
    }),
    (q::LIFETIME_LOW, |one| {
        one.survival.map_or(f64::NAN, |seen| seen.lifetime()[1])
    }),
    (q::SHARE, |one| share(one.fraction)[0]),
    (q::SHARE_LOW, |one| share(one.fraction)[1]),
    (q::SHARE_HIGH, |one| share(one.fraction)[2]),
    (q::PEAK_ACCELERATION, |one| {
        one.entry.attractor.peak_acceleration()
    }),
];

/// Whole numbers; 0 where there is none.
const COUNTS: [Of<CountedAttractor, u64>; 4] = [
    (q::ATTRACTOR_KIND, code),
    (q::PERIOD, |one| {
        one.entry.attractor.kind.period().unwrap_or(0).into()
    }),
    (q::WATCHED_MOTIONS, |one| {
        one.survival.map_or(0, |seen| seen.motions.into())
    }),
    (q::WATCHED_PERIODS, |one| {
        one.survival.map_or(0, |seen| seen.periods)
    }),
];

/// Numbers of each person.
type Each = fn(&CountedAttractor) -> &[f64];

const BODIES: [(Quantity, Each); 2] = [
    (q::CONTACT_RATIO, |one| &one.entry.attractor.contact_ratio),
    (q::PEAK_REACTION, |one| one.entry.attractor.peak_reaction()),
];

/// Numbers of each attractor at each value where it was met.
fn attractors(set: Dataset, found: &Found) -> Dataset {
    let (value, people) = (found.parameter.as_ref().map(name), found.jumpers());
    let value = value.as_deref().into_iter();
    let over: Vec<&str> = value.chain(["attractor", "jumper"]).collect();
    let cell = &over[..over.len() - 1];
    let all = found.places();
    let whole = |of: fn(&CountedAttractor) -> u64| wholes(all.iter().map(|one| one.map_or(0, of)));
    let set = set.variable(q::STARTS.over(cell, whole(|one| one.fraction.count)));
    let set = COUNTS.into_iter().fold(set, |set, (quantity, of)| {
        set.variable(quantity.over(cell, whole(of)).gap(0))
    });
    let set = NUMBERS.into_iter().fold(set, |set, (quantity, of)| {
        let numbers = all.iter().map(|one| one.map_or(f64::NAN, of));
        set.variable(quantity.over(cell, numbers.collect::<Vec<f64>>()))
    });
    let set = BODIES.into_iter().fold(set, |set, (quantity, of)| {
        let bodies = all.iter().map(|one| one.map_or(&[][..], of));
        let bodies = bodies.flat_map(|bodies| padded(bodies, people));
        set.variable(quantity.over(&over, bodies.collect::<Vec<f64>>()))
    });
    let table = |rows: &[&str], own: &[&str]| {
        Table::new("attractors", rows)
            .titled("value", found.value_name(""))
            .columns(own)
            .columns(&["period", "kind", "multiplier"])
            .columns(&["exponent", "exponent_error", "lifetime_low"])
            .columns(&["starts", "share", "share_low", "share_high"])
            .columns(&["contact_ratio", "peak_reaction", "peak_acceleration"])
            .columns(&["watched_motions", "watched_periods"])
            .only_where("share")
    };
    set.table(table(&over, &["attractor", "jumper"]).in_files())
        .table(table(cell, &["attractor"]).in_document())
}

/// The sections of all attractors, one after the other: the points of a bifurcation diagram.
fn sections(set: Dataset, found: &Found) -> Dataset {
    let over = ["motion", "jumper", "sample"];
    let bodies =
        |of: fn(&Arrival) -> &[Vec<f64>]| found.met().flat_map(move |(_, one)| of(&one.arrival));
    let longest = bodies(Arrival::z).map(Vec::len).max().unwrap_or(0);
    let samples = |of: fn(&Arrival) -> &[Vec<f64>]| -> Vec<f64> {
        let samples = |body: &Vec<f64>| padded(body, longest).collect::<Vec<f64>>();
        bodies(of).flat_map(samples).collect()
    };
    let numbers = wholes(found.met().map(|(_, one)| one.identity + 1));
    let at: Vec<f64> = found.met().map(|(row, _)| row.value).collect();
    let (each, heights) = match &found.parameter {
        Some(parameter) => (2, eta(&found.study, Some((parameter, &at)))),
        None => (1, eta(&found.study, None)),
    };
    let table = |rows: &[&str], own: &[&str]| {
        Table::new("sections", rows)
            .titled("value", found.value_name("motion_"))
            .titled("attractor", "motion_attractor")
            .columns(own)
            .columns(&["z", "v"])
    };
    let samples_table = table(&over, &["jumper", "sample"]).only_where("z");
    found
        .values_along(set, "motion", at)
        .coordinate(q::MOTION.numbered(0, numbers.len()))
        .coordinate(q::CONNECTED_SAMPLE.numbered(1, longest))
        .variable(q::MOTION_ATTRACTOR.over(&over[..1], numbers))
        .variable(q::ETA.over(&over[2 - each..2], heights))
        .variable(q::Z.over(&over, samples(Arrival::z)))
        .variable(q::V.over(&over, samples(Arrival::v)))
        .table(samples_table.in_files())
        .table(table(&over[..1], &[]).in_document())
}

/// Chaos that ends.
fn transients(set: Dataset, found: &Found) -> Dataset {
    let over = ["transient"];
    let all: Vec<(&Row, &Transient)> = found.transients().collect();
    let count = |of: fn(&(&Row, &Transient)) -> u64| wholes(all.iter().map(of));
    let lifetime = |part: usize| -> Vec<f64> {
        let lifetimes = all.iter().map(|(_, one)| one.survival.lifetime());
        lifetimes.map(|lifetime| lifetime[part]).collect()
    };
    let set = found.values_along(
        set.dimension(over[0], all.len()),
        over[0],
        all.iter().map(|(row, _)| row.value).collect(),
    );
    let named = [
        q::TRANSIENT_STARTS,
        q::TRANSIENT_SHARE,
        q::TRANSIENT_SHARE_LOW,
        q::TRANSIENT_SHARE_HIGH,
    ];
    let fractions = all.iter().map(|(_, one)| one.fraction);
    let fractions: Vec<BasinFraction> = fractions.collect();
    let ends = |(row, one): &(&Row, &Transient)| row.attractors()[one.to].identity + 1;
    let table = Table::new("transients", &over).titled("value", found.value_name("transient_"));
    let table = without("transient_", table, &["starts", "attractor", "motions"]);
    let table = without("transient_", table, &["ended", "periods", "lifetime"]);
    let table = without("transient_", table, &["lifetime_low", "lifetime_high"]);
    let table = without("transient_", table, &["share", "share_low", "share_high"]);
    shares(set, &over, named, &fractions)
        .variable(q::TRANSIENT_ATTRACTOR.over(&over, wholes(all.iter().map(ends))))
        .variable(q::TRANSIENT_MOTIONS.over(&over, count(|one| one.1.survival.motions.into())))
        .variable(q::TRANSIENT_ENDED.over(&over, count(|one| one.1.survival.ended.into())))
        .variable(q::TRANSIENT_PERIODS.over(&over, count(|one| one.1.survival.periods)))
        .variable(q::TRANSIENT_LIFETIME.over(&over, lifetime(0)))
        .variable(q::TRANSIENT_LIFETIME_LOW.over(&over, lifetime(1)))
        .variable(q::TRANSIENT_LIFETIME_HIGH.over(&over, lifetime(2)))
        .table(table)
}

/// Initial conditions that came to no attractor at each value, and why the first of those that were lost was.
fn rows(set: Dataset, found: &Found) -> Dataset {
    let value = found.parameter.as_ref().map(name);
    let over: Vec<&str> = value.as_deref().into_iter().collect();
    let fractions = |of: fn(&AttractorCensus) -> BasinFraction| -> Vec<BasinFraction> {
        let rows = found.all.rows.iter().map(|row| row.census.as_ref());
        rows.map(|census| census.map_or_else(|_| BasinFraction::default(), of))
            .collect()
    };
    let undecided = [
        q::UNDECIDED_STARTS,
        q::UNDECIDED,
        q::UNDECIDED_LOW,
        q::UNDECIDED_HIGH,
    ];
    let lost = [q::LOST_STARTS, q::LOST, q::LOST_LOW, q::LOST_HIGH];
    let set = shares(set, &over, undecided, &fractions(|census| census.undecided));
    let set = shares(set, &over, lost, &fractions(|census| census.lost));
    let words = |loss: Loss| (loss.status, loss.reason);
    let failures = found.all.rows.iter().map(first_failure);
    let failures = failures.map(|loss| loss.map(words).unwrap_or_default());
    let (status, texts): (Vec<String>, Vec<String>) = failures.unzip();
    set.variable(q::FIRST_FAILURE_STATUS.over(&over, status))
        .variable(q::FIRST_FAILURE_STATUS_TEXT.over(&over, texts))
        .table(
            Table::new("rows", &over)
                .titled("value", found.value_name(""))
                .columns(&undecided.map(|quantity| quantity.name))
                .columns(&lost.map(|quantity| quantity.name))
                .columns(&["first_failure_status", "first_failure_status_text"]),
        )
}

/// Counts of initial conditions, their shares and the ends of their intervals.
fn shares(set: Dataset, over: &[&str], named: [Quantity; 4], all: &[BasinFraction]) -> Dataset {
    let [starts, shares, low, high] = named;
    let part = |part: usize| -> Vec<f64> { all.iter().map(|&one| share(one)[part]).collect() };
    set.variable(starts.over(over, wholes(all.iter().map(|one| one.count))))
        .variable(shares.over(over, part(0)))
        .variable(low.over(over, part(1)))
        .variable(high.over(over, part(2)))
}

/// Part of the initial conditions, and its 95 % confidence interval.
pub(super) fn share(fraction: BasinFraction) -> [f64; 3] {
    let [low, high] = fraction.interval();
    [fraction.value(), low, high]
}

/// Why there is no model at a value, or why the first run that ended early did.
pub(super) fn first_failure(row: &Row) -> Option<Loss> {
    let lost = match &row.census {
        Ok(census) => census.first_lost.clone(),
        Err(error) => Some(Lost::NoModel(error.clone())),
    };
    lost.map(Loss::from)
}

/// The largest exponent, where it is what says that an attractor is one.
pub(super) fn exponent(one: &CountedAttractor) -> Option<Exponent> {
    let motion = &one.entry.attractor;
    motion.exponent.filter(|_| motion.kind.never_repeats())
}

/// Place of the kind among the words for it.
fn code(one: &CountedAttractor) -> u64 {
    let (words, name) = (q::ATTRACTOR_KIND.words, one.entry.attractor.kind.name());
    let place = words.iter().position(|word| *word == name);
    place.unwrap_or(words.len() - 1) as u64
}

impl Found {
    /// Each attractor at each value, where it was met.
    fn places(&self) -> Vec<Option<&CountedAttractor>> {
        let count = self.all.identities.len();
        let mut all = vec![None; count * self.all.rows.len()];
        for (places, row) in all.chunks_mut(count.max(1)).zip(&self.all.rows) {
            for one in row.attractors() {
                places[one.identity] = Some(one);
            }
        }
        all
    }

    /// Name of the values of the parameter at the places of an axis.
    fn value_name(&self, prefix: &str) -> String {
        let named = |parameter| format!("{prefix}{}", name(parameter));
        self.parameter.as_ref().map_or("value".to_owned(), named)
    }

    /// Adds the values of the parameter at the places of `axis`, if there is one.
    fn values_along(&self, set: Dataset, axis: &str, at: Vec<f64>) -> Dataset {
        match &self.parameter {
            Some(parameter) => {
                let named = self.value_name(&format!("{axis}_"));
                set.variable(values(parameter, &[axis], at).named(named))
            }
            None => set,
        }
    }
}
