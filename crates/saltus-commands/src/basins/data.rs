//! Data of the answer, described once.

use super::Found;
use crate::data::{eta, name, padded, values, whole, wholes};
use crate::plane::{self, period};
use crate::quantities as q;
use saltus::study::{Attractor, Bodies, Effects, Entry, Range};
use saltus_results::{Dataset, Quantity, Table};

pub(super) fn data(found: &Found) -> Dataset {
    let (plane, basins) = (&found.plane, &found.basins);
    let title = "Basins of attraction of a jumper on a plate";
    let over = [&*name(&plane.y.parameter), &*name(&plane.x.parameter)];
    let set = plane::data(title, &found.study, plane, &basins.layers)
        .variable(q::BASIN.over(&over, basins.attractor.clone()))
        .variable(q::ETA.over(&["jumper"], eta(&found.study, None)));
    tables(bodies(attractors(set, found), found), found)
}

/// Kind of each attractor, and the pixels that lead to it.
fn attractors(set: Dataset, found: &Found) -> Dataset {
    let over = ["attractor_number"];
    let (plane, entries) = (&found.plane, &found.basins.attractors);
    let number = |of: &dyn Fn(&Entry) -> f64| -> Vec<f64> { entries.iter().map(of).collect() };
    let matched = (0..entries.len()).map(|place| found.basins.identity(place));
    let matched = wholes(matched.map(|identity| identity.map_or(0, |identity| identity + 1)));
    let periods = entries.iter().map(|entry| period(entry.attractor.kind));
    let periods = wholes(periods.map(|period| period.unwrap_or(0)));
    let kinds = entries.iter().map(|entry| entry.attractor.kind.name());
    let pixels: Vec<i64> = entries.iter().map(|entry| whole(entry.count)).collect();
    let shares = number(&|entry| entry.share(plane.grid.len() as u64));
    let set = set
        .coordinate(q::BASIN_NUMBER.numbered(1, entries.len()))
        .variable(q::BASIN_MATCHED.over(&over, matched).gap(0))
        .variable(q::BASIN_PERIOD.over(&over, periods).gap(0))
        .variable(q::BASIN_KIND.spelt(&over, kinds))
        .variable(q::BASIN_PIXELS.over(&over, pixels))
        .variable(q::BASIN_SHARE.over(&over, shares))
        .variable(
            q::BASIN_PEAK_ACCELERATION
                .over(&over, number(&|entry| entry.attractor.peak_acceleration())),
        );
    // the first pixel that leads to it
    let starts = [
        (&plane.x, number(&|entry| plane.grid.at(entry.first).0)),
        (&plane.y, number(&|entry| plane.grid.at(entry.first).1)),
    ];
    starts.into_iter().fold(set, |set, (axis, along)| {
        let start = values(&axis.parameter, &over, along);
        set.variable(start.named(format!("attractor_{}", name(&axis.parameter))))
    })
}

/// Contact, reaction and section of each person.
fn bodies(set: Dataset, found: &Found) -> Dataset {
    let over = ["attractor_number", "jumper"];
    let (entries, samples) = (&found.basins.attractors, found.samples());
    let motions = || entries.iter().map(|entry| &entry.attractor);
    let numbers =
        |of: fn(&Attractor) -> &[f64]| -> Vec<f64> { motions().flat_map(of).copied().collect() };
    let people = found.study.jumper.len();
    let ends = |set: Dataset, [min, max]: [Quantity; 2], of: fn((Range, Range)) -> Range| {
        let of_all = move |motion: &Attractor| -> Vec<Range> {
            (0..people).map(|body| of(motion.range(body))).collect()
        };
        let ranges = || motions().flat_map(of_all);
        set.variable(min.over(&over, ranges().map(|range| range[0]).collect::<Vec<f64>>()))
            .variable(max.over(&over, ranges().map(|range| range[1]).collect::<Vec<f64>>()))
    };
    let section = |of: fn(&Attractor) -> &[Vec<f64>]| -> Vec<f64> {
        let lists = motions().flat_map(|motion| from_the_lowest(motion, of(motion)));
        lists
            .flat_map(|list| padded(&list, samples).collect::<Vec<f64>>())
            .collect()
    };
    let places = ["attractor_number", "jumper", "sample"];
    let set = set
        .variable(q::BASIN_CONTACT_RATIO.over(&over, numbers(|motion| &motion.contact_ratio)))
        .variable(q::BASIN_PEAK_REACTION.over(&over, numbers(Attractor::peak_reaction)))
        .coordinate(q::BASIN_SAMPLE.numbered(1, samples))
        .ragged("sample")
        .variable(q::BASIN_Z.over(&places, section(Attractor::z)))
        .variable(q::BASIN_V.over(&places, section(Attractor::v)));
    let set = ends(set, [q::BASIN_Z_MIN, q::BASIN_Z_MAX], |range| range.0);
    ends(set, [q::BASIN_V_MIN, q::BASIN_V_MAX], |range| range.1)
}

/// In files a row for each sample, and one without a sample for a motion that is not periodic; in documents a row for
/// each attractor.
fn tables(set: Dataset, found: &Found) -> Dataset {
    let (entries, samples) = (&found.basins.attractors, found.samples());
    let people = found.study.jumper.len();
    let cells = entries.iter().flat_map(|entry| {
        let known = length(&entry.attractor);
        (0..samples).map(move |sample| if sample < known { sample + 1 } else { 0 })
    });
    let cells = wholes(cells);
    let wanted = entries.iter().flat_map(|entry| {
        let rows = length(&entry.attractor).max(1);
        (0..people * samples).map(move |row| row % samples < rows)
    });
    let titled = |table: Table, titles: &[&str]| {
        let add = |table: Table, title: &&str| table.titled(*title, format!("attractor_{title}"));
        titles.iter().fold(table, add)
    };
    let begun =
        |over: &[&str]| Table::new("attractors", over).titled("attractor", "attractor_number");
    let rows = begun(&["attractor_number", "jumper", "sample"]);
    let rows = titled(rows, &["period", "kind", "pixels", "share"]).columns(&["jumper"]);
    let rows = titled(
        rows,
        &["contact_ratio", "peak_reaction", "peak_acceleration"],
    );
    let rows = titled(rows.titled("sample", "sample_cell"), &["z", "v"]);
    let records = titled(begun(&["attractor_number"]), &["matched", "period", "kind"]);
    let records = titled(records, &["pixels", "share", "start_z", "start_v"]);
    let records = titled(
        records,
        &["contact_ratio", "peak_reaction", "peak_acceleration"],
    );
    let records = titled(records, &["z", "v", "z_min", "z_max", "v_min", "v_max"]);
    set.column(
        q::BASIN_SAMPLE_CELL
            .over(&["attractor_number", "sample"], cells)
            .gap(0),
    )
    .table(rows.only_rows(wanted.collect()).in_files())
    .table(records.in_document())
}

/// Samples of a cycle; 0 if the motion is none.
fn length(motion: &Attractor) -> usize {
    motion.z().first().map_or(0, Vec::len)
}

/// Rotates lists of samples so that a cycle begins with the lowest one of the first jumper: where it was met says
/// nothing.
fn from_the_lowest(motion: &Attractor, lists: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let first = motion.z().first().map_or(&[][..], Vec::as_slice);
    let lowest = (0..first.len()).min_by(|&a, &b| first[a].total_cmp(&first[b]));
    let turned = lists.iter().map(|list| {
        let mut list = list.clone();
        list.rotate_left(lowest.unwrap_or(0));
        list
    });
    turned.collect()
}

impl Found {
    /// Samples of the longest cycle, and at least one: rows without a sample have a place too.
    fn samples(&self) -> usize {
        let entries = self.basins.attractors.iter();
        let most = entries.map(|entry| length(&entry.attractor)).max();
        most.unwrap_or(0).max(1)
    }
}
