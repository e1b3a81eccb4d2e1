//! The tables of branches: every point, every special point, every end, every curve.

use super::Run;
use super::report::{Branch, Report};
use crate::failure::Failure;
use crate::motion;
use crate::store::Store;
use saltus_results::Value;

type Rows = Vec<Vec<Value>>;

pub(super) fn write(folder: &mut dyn Store, run: &Run, report: &Report) -> Result<(), Failure> {
    let (parameter, label) = (run.question.parameter.key(), run.question.parameter.label());
    let note = |more: &[(&'static str, &'static str)]| {
        let mut settings = vec![
            ("saltus", env!("CARGO_PKG_VERSION")),
            ("study", "study.toml"),
            (parameter.as_str(), label.as_str()),
        ];
        settings.extend(more);
        settings
    };
    points(
        folder,
        run,
        &parameter,
        &note(&[&POINTS[..], &motion::COLUMNS].concat()),
    )?;
    let header = header(&[
        "label",
        "kind",
        "name",
        "branch",
        &parameter,
        "period",
        "outside_before",
        "outside_after",
        "angle",
        "sequence",
        "remark",
    ]);
    let rows = report.special_points.iter().map(|s| {
        vec![
            s.label.into(),
            s.kind.into(),
            s.name.into(),
            whole(s.branch),
            s.value.into(),
            whole(s.period),
            whole(s.outside[0]),
            whole(s.outside[1]),
            s.angle.into(),
            s.sequence.into(),
            s.remark.into(),
        ]
    });
    folder.table("special_points.csv", &note(&SPECIAL), &header, rows)?;
    ends(folder, report, &parameter, &note(&[]))?;
    match &run.question.second {
        Some((_, second)) => curves(folder, report, [&parameter, &second.key()], &note(&CURVES)),
        None => Ok(()),
    }
}

const POINTS: [(&str, &str); 4] = [
    (
        "origin",
        "label of the special point where the branch begins; empty for the first branch",
    ),
    ("outside", "Floquet multipliers outside the unit circle"),
    ("multiplier_re, multiplier_im", "the largest of them"),
    ("place", "which point of the orbit at cos(Omega t) = 1"),
];

const SPECIAL: [(&str, &str); 2] = [
    (
        "outside",
        "Floquet multipliers outside the unit circle, in the order of the branch",
    ),
    (
        "angle",
        "of the multiplier on the unit circle (rad), of Neimark-Sacker points",
    ),
];

const CURVES: [(&str, &str); 1] = [(
    "angle",
    "of the multiplier on the unit circle (rad), of Neimark-Sacker points",
)];

fn header(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

fn whole(number: usize) -> Value {
    Value::Integer(number as i64)
}

/// One line per point of a branch and place of its orbit.
fn points(
    folder: &mut dyn Store,
    run: &Run,
    parameter: &str,
    settings: &[(&str, &str)],
) -> Result<(), Failure> {
    let mut columns = header(&[
        "branch",
        "origin",
        "point",
        parameter,
        "period",
        "stable",
        "outside",
        "multiplier_re",
        "multiplier_im",
        "sequence",
        "place",
    ]);
    columns.extend(motion::header(&run.model));
    let rows = run.limbs.iter().zip(&run.views).enumerate();
    let rows = rows.flat_map(|(branch, (limb, view))| {
        let points = limb.branch.points.iter().zip(&view.points).enumerate();
        points.flat_map(move |(index, (point, seen))| {
            seen.section
                .iter()
                .enumerate()
                .map(move |(place, section)| {
                    let mut row = vec![
                        whole(branch),
                        limb.origin.as_deref().into(),
                        whole(index),
                        point.parameter.into(),
                        whole(point.orbit.period()),
                        match point.orbit.stability().is_stable() {
                            Some(stable) => stable.into(),
                            None => "neutral".into(),
                        },
                        whole(point.outside),
                        seen.multiplier.re.into(),
                        seen.multiplier.im.into(),
                        seen.sequence.as_str().into(),
                        whole(place),
                    ];
                    row.extend(motion::cells(section));
                    row
                })
        })
    });
    folder.table("branches.csv", settings, &columns, rows)
}

/// One line per branch.
fn ends(
    folder: &mut dyn Store,
    report: &Report,
    parameter: &str,
    settings: &[(&str, &str)],
) -> Result<(), Failure> {
    let (first, last) = (format!("{parameter}_first"), format!("{parameter}_last"));
    let columns = header(&[
        "branch",
        "origin",
        "period",
        "points",
        &first,
        &last,
        "end_first",
        "end_last",
    ]);
    let row = |branch: &Branch| {
        let value = |point: Option<&super::report::Point>| Value::from(point.map(|p| p.value));
        vec![
            whole(branch.branch),
            branch.origin.into(),
            whole(branch.period),
            whole(branch.points.len()),
            value(branch.points.first()),
            value(branch.points.last()),
            branch.ends[0].as_str().into(),
            branch.ends[1].as_str().into(),
        ]
    };
    let rows: Rows = report.branches.iter().map(row).collect();
    folder.table("ends.csv", settings, &columns, rows)
}

/// One line per point of a curve.
fn curves(
    folder: &mut dyn Store,
    report: &Report,
    [first, second]: [&str; 2],
    settings: &[(&str, &str)],
) -> Result<(), Failure> {
    let columns = header(&["label", "kind", "point", first, second, "period", "angle"]);
    let rows = report.curves.iter().flat_map(|curve| {
        let points = curve.points.iter().enumerate();
        points.map(|(index, point)| {
            vec![
                curve.label.into(),
                curve.kind.into(),
                whole(index),
                point.values[0].into(),
                point.values[1].into(),
                whole(point.period),
                point.angle.into(),
            ]
        })
    });
    folder.table("curves.csv", settings, &columns, rows)
}
