//! Branches as a dataset for xarray and its like: all points one after the other, then special points, then
//! curves over two parameters.

use super::Run;
use super::report::Report;
use super::view::Seen;
use crate::dataset::{about, motion, name, numbered, texts, values, variable, wholes};
use saltus::model::Section;
use saltus::orbits::{Multiplier, Point, Stability};
use saltus_results::{Dataset, Variable};

const OUTSIDE: (&str, &str) = ("Floquet multipliers outside the unit circle", "1");
const PERIOD: (&str, &str) = ("Period in forcing periods", "1");
const BRANCH: (&str, &str) = ("Branch, the first one 0", "1");
const ANGLE: (&str, &str) = (
    "Angle of the multiplier on the unit circle; NaN where none turns round it",
    "rad",
);

pub(super) fn dataset(run: &Run, report: &Report) -> Dataset {
    let mut set = about("Branches of periodic orbits", &run.study);
    set = motion::dimensions(set, &run.model);
    let place = "Place of the orbit at cos(Omega t) = 1";
    set = set.coordinate(numbered("place", 0, places(run), place));
    set = points(set, run);
    set = specials(set, run, report);
    curves(set, run, report)
}

/// Places of the longest orbit.
fn places(run: &Run) -> usize {
    let seen = run
        .views
        .iter()
        .flat_map(|v| v.points.iter().chain(&v.specials));
    seen.map(|seen| seen.section.len()).max().unwrap_or(0)
}

/// The places of each orbit, as many for each as the longest has.
fn sections<'a>(seen: impl Iterator<Item = &'a Seen>, places: usize) -> Vec<Option<&'a Section>> {
    seen.flat_map(|seen| (0..places).map(|place| seen.section.get(place)))
        .collect()
}

fn points(set: Dataset, run: &Run) -> Dataset {
    let over = ["point"];
    let all = || run.limbs.iter().flat_map(|limb| &limb.branch.points);
    let seen = || run.views.iter().flat_map(|view| &view.points);
    let lengths = || run.limbs.iter().map(|limb| limb.branch.points.len());
    let branch = lengths().enumerate();
    let branch = branch.flat_map(|(branch, length)| std::iter::repeat_n(branch, length));
    let whole = |name, of: fn(&Point) -> usize, meaning| {
        variable(name, &over, wholes(all().map(of)), meaning)
    };
    let number = wholes(lengths().flat_map(|length| 0..length));
    let parameter = all().map(|point| point.parameter).collect();
    let stable: Vec<bool> = all().map(|point| point.stable).collect();
    let is_neutral = |point: &Point| point.orbit.stability() == Stability::Neutral;
    let neutral: Vec<bool> = all().map(is_neutral).collect();
    let points = lengths().sum();
    let set = set
        .coordinate(numbered("point", 0, points, "Points of all branches"))
        .variable(variable("branch", &over, wholes(branch), BRANCH))
        .variable(variable(
            "number",
            &over,
            number,
            ("Number of the point on its branch, from 0", "1"),
        ))
        .variable(values(
            name(&run.question.parameter),
            &over,
            &run.question.parameter,
            parameter,
        ))
        .variable(whole("period", |point| point.orbit.period(), PERIOD))
        .variable(Variable::new("stable", &over, stable).long_name("Whether the orbit is stable"))
        .variable(
            Variable::new("neutral", &over, neutral)
                .long_name("Whether rounding alone says if the orbit is stable"),
        )
        .variable(whole("outside", |point| point.outside, OUTSIDE))
        .variable(
            Variable::new(
                "sequence",
                &over,
                texts(seen().map(|seen| seen.sequence.as_str())),
            )
            .long_name("Order of the switches"),
        );
    let places = places(run);
    let set = multipliers(set, all());
    motion::section(
        set,
        "",
        &["point", "place"],
        &run.model,
        &sections(seen(), places),
    )
}

/// All multipliers of each point, NaN where an orbit has fewer.
fn multipliers<'a>(set: Dataset, points: impl Iterator<Item = &'a Point> + Clone) -> Dataset {
    let all = points.map(|point| &point.orbit.multipliers);
    let most = all.clone().map(Vec::len).max().unwrap_or(0);
    let part = |name, of: fn(&Multiplier) -> f64, meaning| {
        let of = |list: &'a Vec<Multiplier>| (0..most).map(|i| list.get(i).map_or(f64::NAN, of));
        let values: Vec<f64> = all.clone().flat_map(of).collect();
        variable(name, &["point", "multiplier"], values, meaning)
    };
    set.coordinate(numbered("multiplier", 1, most, "By falling modulus"))
        .variable(part(
            "multiplier_real",
            |m| m.re,
            ("Floquet multiplier, real", "1"),
        ))
        .variable(part(
            "multiplier_imaginary",
            |m| m.im,
            ("Floquet multiplier, imaginary", "1"),
        ))
}

fn specials(set: Dataset, run: &Run, report: &Report) -> Dataset {
    let over = ["special"];
    let all = &report.special_points;
    let parameter = &run.question.parameter;
    let text = |name, values: Vec<&str>, long_name: &str| {
        Variable::new(name, &over, texts(values)).long_name(long_name)
    };
    let whole =
        |name, numbers: Vec<usize>, meaning| variable(name, &over, wholes(numbers), meaning);
    let value = all.iter().map(|special| special.value).collect();
    let angle: Vec<f64> = all
        .iter()
        .map(|special| special.angle.unwrap_or(f64::NAN))
        .collect();
    let labels = all.iter().map(|special| special.label).collect();
    let kinds = all.iter().map(|special| special.kind).collect();
    let names = all.iter().map(|special| special.name).collect();
    let branches = all.iter().map(|special| special.branch).collect();
    let periods = all.iter().map(|special| special.period).collect();
    let before = all.iter().map(|special| special.outside[0]).collect();
    let after = all.iter().map(|special| special.outside[1]).collect();
    let set = set
        .dimension("special", all.len())
        .variable(text("special_label", labels, "Label of the special point"))
        .variable(text(
            "special_kind",
            kinds,
            "Kind of the special point, in short",
        ))
        .variable(text("special_name", names, "Kind of the special point"))
        .variable(whole("special_branch", branches, BRANCH))
        .variable(values(
            format!("special_{}", name(parameter)),
            &over,
            parameter,
            value,
        ))
        .variable(whole("special_period", periods, PERIOD))
        .variable(whole("special_outside_before", before, OUTSIDE))
        .variable(whole("special_outside_after", after, OUTSIDE))
        .variable(variable("special_angle", &over, angle, ANGLE));
    let seen = run.views.iter().flat_map(|view| &view.specials);
    let points = sections(seen, places(run));
    motion::section(set, "special_", &["special", "place"], &run.model, &points)
}

/// Nothing where nobody asked for them.
fn curves(set: Dataset, run: &Run, report: &Report) -> Dataset {
    let Some((_, second)) = &run.question.second else {
        return set;
    };
    let over = ["curve_point"];
    let points = || {
        let curves = report.curves.iter();
        curves.flat_map(|curve| curve.points.iter().map(move |point| (curve, point)))
    };
    let both = [&run.question.parameter, second];
    let labels = texts(points().map(|(curve, _)| curve.label));
    let periods = wholes(points().map(|(_, point)| point.period));
    let angle: Vec<f64> = points()
        .map(|(_, point)| point.angle.unwrap_or(f64::NAN))
        .collect();
    let mut set = set
        .dimension(over[0], points().count())
        .variable(
            Variable::new("curve_label", &over, labels)
                .long_name("Label of the special point that the curve is of"),
        )
        .variable(variable("curve_period", &over, periods, PERIOD))
        .variable(variable("curve_angle", &over, angle, ANGLE));
    for (index, parameter) in both.into_iter().enumerate() {
        let along = points().map(|(_, point)| point.values[index]).collect();
        let name = format!("curve_{}", name(parameter));
        set = set.variable(values(name, &over, parameter, along));
    }
    set
}
