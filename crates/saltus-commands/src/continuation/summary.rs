//! Summary of `saltus continue` for people.

use super::data::period;
use super::{Followed, Found};
use crate::kinds;
use saltus::orbits::{BranchWithOrigin, Special};
use std::fmt::Write;

pub(super) fn text(found: &Found) -> String {
    let (question, along) = (&found.question, found.question.along());
    let points = found.limbs.iter().map(|limb| limb.branch.points.len());
    let mut text = format!(
        "{} from {} to {}: {} with {} points, {}\n\n",
        question.parameter.label(),
        along.from,
        along.to,
        count(found.limbs.len(), "branch", "branches"),
        points.sum::<usize>(),
        count(found.specials().count(), "special point", "special points"),
    );
    for (branch, limb) in found.limbs.iter().enumerate() {
        text += &branch_line(branch, limb);
    }
    if !found.complete() {
        text += "There are as many branches as are followed at most; others may be left.\n";
    }
    text += "\n";
    for (branch, special, _) in found.specials() {
        text += &special_line(branch, special);
    }
    if !found.curves.is_empty() {
        text += "\n";
    }
    for curve in &found.curves {
        text += &curve_line(curve);
    }
    text
}

fn count(number: usize, one: &str, many: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { many })
}

fn branch_line(branch: usize, limb: &BranchWithOrigin) -> String {
    let points = &limb.branch.points;
    let values = || points.iter().map(|point| point.parameter);
    let (low, high) = (
        values().fold(f64::INFINITY, f64::min),
        values().fold(f64::NEG_INFINITY, f64::max),
    );
    let stable = points
        .iter()
        .filter(|point| point.orbit.stability().is_stable() == Some(true))
        .count();
    let from = limb
        .origin
        .as_ref()
        .map_or(String::new(), |at| format!(" from {at}"));
    let [first, last] = &limb.branch.ends;
    format!(
        "branch {branch}: period {}{from}, {low:.8} to {high:.8}, {} ({stable} stable)\n  \
         ends: {first}; {last}\n",
        period(limb),
        count(points.len(), "point", "points"),
    )
}

fn special_line(branch: usize, special: &Special) -> String {
    let [before, after] = special.outside;
    let mut line = format!(
        "{:<6}{:<18}{:>16.8}  branch {branch}, period {}, multipliers outside {before} -> {after}",
        special.label,
        kinds::name(&special.kind),
        special.parameter,
        special.orbit.period()
    );
    if let Some(angle) = kinds::angle(&special.kind) {
        // writing to a string cannot fail
        let _ = write!(line, ", angle {angle:.6} rad");
    }
    if let Some(remark) = &special.remark {
        let _ = write!(line, "; {remark}");
    }
    line + "\n"
}

fn curve_line(followed: &Followed) -> String {
    let what = match &followed.outcome {
        Ok(curve) => {
            let points = count(curve.points.len(), "point", "points");
            let [first, last] = &curve.ends;
            format!("{points}, ends: {first}; {last}")
        }
        Err(error) => error.clone(),
    };
    format!("curve {:<6}{what}\n", followed.label)
}
