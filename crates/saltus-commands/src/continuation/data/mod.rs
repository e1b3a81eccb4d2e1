//! Data of branches: all points one after the other, branches, special points, and curves over two
//! parameters.

mod curves;
mod specials;

use super::Found;
use super::view::Seen;
use crate::data::{about, eta, in_unit_of, motion, name, padded, parameter, texts, values, wholes};
use crate::quantities as q;
use saltus::model::Section;
use saltus::orbits::{BranchWithOrigin, Multiplier, Point, Special, Stability};
use saltus_results::{Dataset, Quantity, Table};

pub(super) fn data(found: &Found) -> Dataset {
    let (question, table) = (&found.question, &found.question.table);
    let set = about("Branches of periodic orbits", &found.study);
    let set = parameter(set, &question.parameter)
        .variable(in_unit_of(
            &question.parameter,
            q::RANGE_FROM.is(table.from),
        ))
        .variable(in_unit_of(&question.parameter, q::RANGE_TO.is(table.to)))
        .variable(q::COMPLETE.is(found.complete()));
    let also = format!("m n branch number {}", name(&question.parameter));
    let set = motion::dimensions(set, &found.model)
        .header("coordinates", also)
        .coordinate(q::PLACE.numbered(0, found.places()))
        .ragged("place");
    let set = points(set, found);
    let set = branches(set, found);
    let set = specials::specials(set, found);
    match &question.second {
        Some(second) => curves::curves(set, found, second),
        None => set,
    }
}

/// A point with where it is.
struct OnBranch<'a> {
    branch: usize,
    number: usize,
    limb: &'a BranchWithOrigin,
    point: &'a Point,
    seen: &'a Seen,
}

fn points(set: Dataset, found: &Found) -> Dataset {
    let (over, parameter) = (["point"], &found.question.parameter);
    let all = found.points();
    let whole = |quantity: Quantity, of: fn(&OnBranch) -> usize| {
        quantity.over(&over, wholes(all.iter().map(of)))
    };
    let flag = |quantity: Quantity, of: fn(&Point) -> bool| {
        let flags = all.iter().map(|at| of(at.point));
        quantity.over(&over, flags.collect::<Vec<bool>>())
    };
    let along: Vec<f64> = all.iter().map(|at| at.point.parameter).collect();
    let heights = eta(&found.study, Some((parameter, &along)));
    let sequences = all.iter().map(|at| at.seen.sequence.as_str());
    let set = set
        .coordinate(q::BRANCH_POINT.numbered(0, all.len()))
        .variable(whole(q::BRANCH, |at| at.branch))
        .variable(whole(q::NUMBER_ON_BRANCH, |at| at.number))
        .variable(values(parameter, &over, along))
        .variable(whole(q::PERIOD, |at| at.point.orbit.period()))
        .variable(flag(q::STABLE, |point| point.stable))
        .variable(flag(q::NEUTRAL, |point| {
            point.orbit.stability() == Stability::Neutral
        }))
        .variable(whole(q::OUTSIDE, |at| at.point.outside))
        .variable(q::ETA.over(&["point", "jumper"], heights))
        .variable(q::SEQUENCE.over(&over, texts(sequences)));
    let set = stability(multipliers(set, &all), &all);
    let sections = found.sections(all.iter().map(|at| at.seen));
    let set = motion::section(set, "", &["point", "place"], &found.model, &sections);
    point_tables(set, found)
}

/// Whether orbits are stable, in a word, and for cells of a file: true or false unless some are neutral.
fn stability(set: Dataset, all: &[OnBranch]) -> Dataset {
    let over = ["point"];
    let known = || all.iter().map(|at| at.point.orbit.stability());
    let cells: Option<Vec<bool>> = known().map(Stability::is_stable).collect();
    let cells = match cells {
        Some(flags) => q::STABLE_CELL.over(&over, flags),
        None => {
            let word = |stability: Stability| match stability.is_stable() {
                Some(true) => "true",
                Some(false) => "false",
                None => "neutral",
            };
            q::STABLE_CELL.over(&over, texts(known().map(word)))
        }
    };
    let origins = all.iter().map(|at| origin(at.limb));
    set.column(q::STABILITY.spelt(&over, known().map(Stability::name)))
        .column(cells)
        .column(q::ORIGIN.over(&over, texts(origins)))
}

/// All multipliers of each point, NaN where an orbit has fewer.
fn multipliers(set: Dataset, all: &[OnBranch]) -> Dataset {
    let lists = || all.iter().map(|at| &at.point.orbit.multipliers);
    let most = lists().map(Vec::len).max().unwrap_or(0);
    let part = |quantity: Quantity, of: fn(&Multiplier) -> f64| {
        let of = |list: &Vec<Multiplier>| -> Vec<f64> {
            let parts: Vec<f64> = list.iter().map(of).collect();
            padded(&parts, most).collect()
        };
        let parts: Vec<f64> = lists().flat_map(of).collect();
        quantity.over(&["point", "multiplier"], parts)
    };
    let largest = |quantity: Quantity, of: fn(&Multiplier) -> f64| {
        let parts = all.iter().map(|at| of(&at.seen.multiplier));
        quantity.over(&["point"], parts.collect::<Vec<f64>>())
    };
    set.coordinate(q::MULTIPLIER.numbered(1, most))
        .variable(part(q::MULTIPLIER_REAL, |m| m.re))
        .variable(part(q::MULTIPLIER_IMAGINARY, |m| m.im))
        .column(largest(q::LARGEST_REAL, |m| m.re))
        .column(largest(q::LARGEST_IMAGINARY, |m| m.im))
}

/// In files a row for each place of an orbit, in documents one for each orbit.
fn point_tables(set: Dataset, found: &Found) -> Dataset {
    let parameter = &found.question.parameter;
    let multiplier = |table: Table| {
        table
            .titled("multiplier_re", "largest_real")
            .titled("multiplier_im", "largest_imaginary")
            .columns(&["sequence"])
    };
    let rows = Table::new("branches", &["point", "place"])
        .columns(&["branch", "origin"])
        .titled("point", "number")
        .columns(&[&name(parameter)])
        .columns(&["period"])
        .titled("stable", "stable_cell")
        .columns(&["outside"]);
    let rows = multiplier(rows).columns(&["place"]).only_where("z");
    let records = Table::new("points", &["point"])
        .columns(&["branch"])
        .titled("point", "number")
        .titled("value", name(parameter))
        .columns(&["period", "stability", "outside"]);
    let records = multiplier(records).columns(&["z", "v", "phase", "w"]);
    set.table(motion::columns(rows, "", &found.model).in_files())
        .table(records.in_document())
}

fn branches(set: Dataset, found: &Found) -> Dataset {
    let over = ["branch_number"];
    let (parameter, limbs) = (&found.question.parameter, &found.limbs);
    let whole = |quantity: Quantity, of: fn(&BranchWithOrigin) -> usize| {
        quantity.over(&over, wholes(limbs.iter().map(of)))
    };
    let value = |quantity: Quantity, of: fn(&[Point]) -> Option<&Point>| {
        let value =
            |limb: &BranchWithOrigin| of(&limb.branch.points).map_or(f64::NAN, |p| p.parameter);
        let values: Vec<f64> = limbs.iter().map(value).collect();
        in_unit_of(parameter, quantity.over(&over, values))
    };
    let end = |quantity: Quantity, which: usize| {
        let ends = limbs.iter().map(|limb| limb.branch.ends[which].to_string());
        quantity.over(&over, ends.collect::<Vec<String>>())
    };
    let key = name(parameter);
    let table = |name, titles: [String; 2]| {
        let [first, last] = titles;
        Table::new(name, &over)
            .titled("branch", "branch_number")
            .titled("origin", "branch_origin")
            .titled("period", "branch_period")
            .titled("points", "branch_points")
            .titled(first, "branch_first")
            .titled(last, "branch_last")
            .titled("end_first", "branch_end_first")
            .titled("end_last", "branch_end_last")
    };
    set.coordinate(q::BRANCH_NUMBER.numbered(0, limbs.len()))
        .variable(q::BRANCH_ORIGIN.over(&over, texts(limbs.iter().map(origin))))
        .variable(whole(q::BRANCH_PERIOD, period))
        .variable(whole(q::BRANCH_POINTS, |limb| limb.branch.points.len()))
        .variable(value(q::BRANCH_FIRST, <[Point]>::first))
        .variable(value(q::BRANCH_LAST, <[Point]>::last))
        .variable(end(q::BRANCH_END_FIRST, 0))
        .variable(end(q::BRANCH_END_LAST, 1))
        .table(table("ends", ["first", "last"].map(|end| format!("{key}_{end}"))).in_files())
        .table(table("branches", ["value_first", "value_last"].map(str::to_owned)).in_document())
}

fn origin(limb: &BranchWithOrigin) -> &str {
    limb.origin.as_deref().unwrap_or_default()
}

/// Forcing periods of the orbits of a branch.
pub(super) fn period(limb: &BranchWithOrigin) -> usize {
    limb.branch.points.first().map_or(0, |p| p.orbit.period())
}

impl Found {
    /// Whether no branch was left out because there were too many.
    pub(in super::super) fn complete(&self) -> bool {
        self.limbs.len() < self.question.options().branches
    }

    /// All points, branch by branch.
    fn points(&self) -> Vec<OnBranch<'_>> {
        let limbs = self.limbs.iter().zip(&self.views).enumerate();
        let points = limbs.flat_map(|(branch, (limb, view))| {
            let points = limb.branch.points.iter().zip(&view.points).enumerate();
            points.map(move |(number, (point, seen))| OnBranch {
                branch,
                number,
                limb,
                point,
                seen,
            })
        });
        points.collect()
    }

    /// All special points, each with the number of its branch.
    pub(super) fn specials(&self) -> impl Iterator<Item = (usize, &Special, &Seen)> {
        let limbs = self.limbs.iter().zip(&self.views).enumerate();
        limbs.flat_map(|(branch, (limb, view))| {
            let specials = limb.branch.specials.iter().zip(&view.specials);
            specials.map(move |(special, seen)| (branch, special, seen))
        })
    }

    /// Places of the longest orbit.
    fn places(&self) -> usize {
        let views = self.views.iter();
        let seen = views.flat_map(|view| view.points.iter().chain(&view.specials));
        seen.map(|seen| seen.section.len()).max().unwrap_or(0)
    }

    /// The places of each orbit, each as many as the longest has.
    fn sections<'a>(&self, seen: impl Iterator<Item = &'a Seen>) -> Vec<Option<&'a Section>> {
        let places = self.places();
        seen.flat_map(|seen| (0..places).map(|place| seen.section.get(place)))
            .collect()
    }
}
