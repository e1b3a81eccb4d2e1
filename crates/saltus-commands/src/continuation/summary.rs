//! What `saltus continue` says to people.

use super::Run;
use super::report::{Branch, Curve, Report, SpecialPoint};
use std::fmt::Write;

pub(super) fn text(run: &Run, report: &Report) -> String {
    let (question, along) = (&run.question, run.question.along());
    let points: usize = report.branches.iter().map(|b| b.points.len()).sum();
    let mut text = format!(
        "{} from {} to {}: {} with {points} points, {}\n\n",
        question.parameter.label(),
        along.from,
        along.to,
        count(report.branches.len(), "branch", "branches"),
        count(
            report.special_points.len(),
            "special point",
            "special points"
        ),
    );
    for branch in &report.branches {
        text += &branch_line(branch);
    }
    if !report.complete {
        text += "There are as many branches as are followed at most; others may be left.\n";
    }
    text += "\n";
    for special in &report.special_points {
        text += &special_line(special);
    }
    if !report.curves.is_empty() {
        text += "\n";
    }
    for curve in &report.curves {
        text += &curve_line(curve);
    }
    text
}

fn count(number: usize, one: &str, many: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { many })
}

fn branch_line(branch: &Branch) -> String {
    let values = || branch.points.iter().map(|point| point.value);
    let (low, high) = (
        values().fold(f64::INFINITY, f64::min),
        values().fold(f64::NEG_INFINITY, f64::max),
    );
    let stable = branch
        .points
        .iter()
        .filter(|point| point.stable == Some(true))
        .count();
    let from = branch
        .origin
        .map_or(String::new(), |at| format!(" from {at}"));
    format!(
        "branch {}: period {}{from}, {low:.8} to {high:.8}, {} ({stable} stable)\n  \
         ends: {}; {}\n",
        branch.branch,
        branch.period,
        count(branch.points.len(), "point", "points"),
        branch.ends[0],
        branch.ends[1]
    )
}

fn special_line(special: &SpecialPoint) -> String {
    let [before, after] = special.outside;
    let mut line = format!(
        "{:<6}{:<18}{:>16.8}  branch {}, period {}, multipliers outside {before} -> {after}",
        special.label, special.name, special.value, special.branch, special.period
    );
    if let Some(angle) = special.angle {
        // writing to a string cannot fail
        let _ = write!(line, ", angle {angle:.6} rad");
    }
    if let Some(remark) = special.remark {
        let _ = write!(line, "; {remark}");
    }
    line + "\n"
}

fn curve_line(curve: &Curve) -> String {
    let what = match (&curve.ends, curve.error) {
        (Some([first, last]), _) => {
            let points = count(curve.points.len(), "point", "points");
            format!("{points}, ends: {first}; {last}")
        }
        (None, error) => error.unwrap_or_default().to_owned(),
    };
    format!("curve {:<6}{what}\n", curve.label)
}
