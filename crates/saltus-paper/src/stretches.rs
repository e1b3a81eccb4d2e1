//! Stretches of the damping ratio on which a cycle is stable: the ground of every verdict on regimes.
//!
//! A branch of periodic orbits is cut at the special points where the number of multipliers outside the unit circle
//! changes between none and some. What lies between two cuts with none outside is a stretch: there a motion on the
//! cycle stays on it, however slowly transients die. Near its ends they take thousands of periods, so a sweep
//! is no measure of where a cycle begins and ends.

use saltus::orbits::{Branch, BranchWithOrigin, End, Orbit, Special, SpecialKind};

/// Two bounds are one special point if they are nearer: it is located to far less.
const SAME: f64 = 1e-7;

/// A motion is on a cycle, or nearly so, if its samples are no further from it (eta). Cycles that are stable at one
/// damping ratio lie further apart, and between two points of a branch one is known to some 0.01.
const NEAR: f64 = 0.05;

/// The damping ratios over which a cycle is stable.
#[derive(Clone, Debug, PartialEq)]
pub struct Stretch {
    /// Forcing periods of the cycle.
    pub period: usize,
    /// Its lower end.
    pub from: Bound,
    /// Its upper end.
    pub to: Bound,
    /// Damping ratios, ascending, with z/eta and z'/(eta omega_h) at each place of the cycle.
    pub cycles: Vec<(f64, Vec<[f64; 2]>)>,
}

/// An end of a stretch.
#[derive(Clone, Debug, PartialEq)]
pub struct Bound {
    /// Place of the end.
    pub damping_ratio: f64,
    /// Event there.
    pub at: Edge,
}

/// Events that end a stretch.
#[derive(Clone, Debug, PartialEq)]
pub enum Edge {
    /// The scanned range.
    Range,
    /// A special point.
    Special(SpecialKind),
    /// The branch could not be followed further, for this reason: the cycle may be stable beyond.
    Lost(String),
}

impl Stretch {
    /// Whether the cycle is stable at a damping ratio.
    pub fn covers(&self, damping_ratio: f64) -> bool {
        (self.from.damping_ratio..=self.to.damping_ratio).contains(&damping_ratio)
    }

    /// Length in the damping ratio.
    pub fn width(&self) -> f64 {
        self.to.damping_ratio - self.from.damping_ratio
    }

    /// The section of the cycle, between two known ones on the straight line.
    fn section(&self, damping_ratio: f64) -> Option<Vec<[f64; 2]>> {
        let at = self
            .cycles
            .partition_point(|(zeta, _)| *zeta < damping_ratio);
        let at = at.clamp(1, self.cycles.len().checked_sub(1)?.max(1));
        let ((from, a), (to, b)) = (self.cycles.get(at - 1)?, self.cycles.get(at)?);
        let part = match to - from {
            0.0 => 0.0,
            width => ((damping_ratio - from) / width).clamp(0.0, 1.0),
        };
        let between = |(a, b): (&[f64; 2], &[f64; 2])| [0, 1].map(|i| a[i] + part * (b[i] - a[i]));
        Some(a.iter().zip(b).map(between).collect())
    }

    /// Whether a section lies on this cycle at a damping ratio where it is stable.
    pub(crate) fn holds(&self, damping_ratio: f64, z: &[f64], v: &[f64]) -> bool {
        let Some(places) = self
            .section(damping_ratio)
            .filter(|_| self.covers(damping_ratio))
        else {
            return false;
        };
        let near = |(z, v): (&f64, &f64)| {
            let off = |place: &[f64; 2]| (z - place[0]).abs().max((v - place[1]).abs());
            places.iter().map(off).fold(f64::INFINITY, f64::min) <= NEAR
        };
        z.iter().zip(v).all(near)
    }

    /// Whether it begins where a cycle of this period doubles.
    fn begins(&self, at: &Bound, period: usize) -> bool {
        let meets = |bound: &&Bound| (bound.damping_ratio - at.damping_ratio).abs() < SAME;
        self.period == 2 * period
            && at.at == Edge::Special(SpecialKind::PeriodDoubling)
            && [&self.from, &self.to].iter().any(meets)
    }

    /// Whether another is this one or a part of it, seen from another branch.
    fn contains(&self, other: &Self) -> bool {
        let middle = f64::midpoint(other.from.damping_ratio, other.to.damping_ratio);
        let on = |section: Vec<[f64; 2]>| {
            let (z, v): (Vec<f64>, Vec<f64>) =
                section.iter().map(|place| (place[0], place[1])).unzip();
            self.holds(middle, &z, &v)
        };
        self.period == other.period
            && self.from.damping_ratio < other.from.damping_ratio + SAME
            && self.to.damping_ratio > other.to.damping_ratio - SAME
            && other.section(middle).is_some_and(on)
    }
}

/// The stretch with twice the period that begins at the end `at` of one with this period.
fn doubled<'a>(all: &'a [Stretch], at: &Bound, period: usize) -> Option<&'a Stretch> {
    all.iter().find(|one| one.begins(at, period))
}

/// From the longest stretch at the highest damping downwards: each has twice the period of the one before, and begins
/// where that one ends.
pub(crate) fn cascade(all: &[Stretch]) -> Vec<&Stretch> {
    let highest = |a: &&Stretch, b: &&Stretch| {
        let [a, b] = [a, b].map(|one| (one.to.damping_ratio, one.width()));
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    };
    let mut chain: Vec<&Stretch> = all.iter().max_by(highest).into_iter().collect();
    while let Some(last) = chain.last()
        && let Some(next) = doubled(all, &last.from, last.period)
    {
        chain.push(next);
    }
    chain
}

/// Cycles that are not born by doubling, with all that are born from them so: period, lowest and highest damping
/// ratio of each family, by falling damping ratio.
pub(crate) fn families(all: &[Stretch]) -> Vec<(usize, [f64; 2])> {
    let gives = |mother: &Stretch, one: &Stretch| {
        let ends = [&mother.from, &mother.to];
        ends.iter().any(|end| one.begins(end, mother.period))
    };
    let origin = |one: &&Stretch| all.iter().any(|mother| gives(mother, one));
    let family = |first: &Stretch| {
        let mut range = [first.from.damping_ratio, first.to.damping_ratio];
        let mut open = vec![first];
        while let Some(one) = open.pop() {
            range = [
                range[0].min(one.from.damping_ratio),
                range[1].max(one.to.damping_ratio),
            ];
            // twice the period each time, so this ends
            open.extend(
                [&one.from, &one.to]
                    .into_iter()
                    .filter_map(|end| doubled(all, end, one.period)),
            );
        }
        (first.period, range)
    };
    let mut out: Vec<_> = all.iter().filter(|one| !origin(one)).map(family).collect();
    out.sort_by(|a, b| b.1[1].total_cmp(&a.1[1]));
    out
}

/// Adds the stretches of `limbs` from number `first` on that are new. `section` gives the section of an orbit.
pub(crate) fn collect<E>(
    limbs: &[BranchWithOrigin],
    first: usize,
    section: impl Fn(&Orbit) -> Result<Vec<[f64; 2]>, E>,
    known: &mut Vec<Stretch>,
) -> Result<(), E> {
    for limb in &limbs[first..] {
        for run in runs(limbs, limb) {
            let mut cycles = Vec::new();
            for orbit in run.orbits {
                cycles.push((orbit.parameters[0], section(orbit)?));
            }
            cycles.sort_by(|a, b| a.0.total_cmp(&b.0));
            let ascending = run.ends[0].damping_ratio <= run.ends[1].damping_ratio;
            let [a, b] = run.ends;
            let (from, to) = if ascending { (a, b) } else { (b, a) };
            let stretch = Stretch {
                period: limb.branch.points[0].orbit.period(),
                from,
                to,
                cycles,
            };
            if !known.iter().any(|other| other.contains(&stretch)) {
                known.retain(|other| !stretch.contains(other));
                known.push(stretch);
            }
        }
    }
    Ok(())
}

/// A stable part of a branch.
struct Run<'a> {
    ends: [Bound; 2],
    orbits: Vec<&'a Orbit>,
}

/// Beginning or end of a stable part.
struct Cut<'a> {
    bound: Bound,
    /// The orbit there, if it is one of the branch and none of its points.
    orbit: Option<&'a Orbit>,
    /// The first point behind it.
    behind: usize,
}

impl<'a> Cut<'a> {
    fn at(special: &'a Special) -> Self {
        Self {
            bound: bound(special),
            orbit: Some(&special.orbit),
            behind: special.near + 1,
        }
    }
}

/// The stable parts of a limb, in the order of its points.
fn runs<'a>(limbs: &'a [BranchWithOrigin], limb: &'a BranchWithOrigin) -> Vec<Run<'a>> {
    let branch = &limb.branch;
    let points = &branch.points;
    let begins_stable = match branch.specials.first() {
        Some(special) => special.outside[0] == 0,
        // at its birth a multiplier is 1, and which side of the circle it is on is chance
        None => points[points.len() - 1].stable,
    };
    let end = |side: usize| Cut {
        bound: end(limbs, limb, side),
        orbit: last_special(branch, side).map(|special| &special.orbit),
        behind: side * points.len(),
    };
    let mut open = begins_stable.then(|| end(0));
    let mut out = Vec::new();
    let mut close = |from: Option<Cut<'a>>, to: Cut<'a>| {
        let Some(from) = from else { return };
        let inside = points[from.behind..to.behind]
            .iter()
            .map(|point| &point.orbit);
        out.push(Run {
            orbits: from
                .orbit
                .into_iter()
                .chain(inside)
                .chain(to.orbit)
                .collect(),
            ends: [from.bound, to.bound],
        });
    };
    for special in &branch.specials {
        match special.outside.map(|outside| outside == 0) {
            [true, false] => close(open.take(), Cut::at(special)),
            [false, true] => open = Some(Cut::at(special)),
            _ => {}
        }
    }
    close(open, end(1));
    joined(branch, out)
}

/// On a closed curve the part behind the start and the one before it are one.
fn joined<'a>(branch: &Branch, mut runs: Vec<Run<'a>>) -> Vec<Run<'a>> {
    let seam = |run: &Run<'_>, end: usize| matches!(run.ends[end].at, Edge::Lost(_));
    let closed = branch.ends[1] == End::Closed && runs.len() > 1;
    if closed && seam(&runs[0], 0) && seam(&runs[runs.len() - 1], 1) {
        let last = runs.remove(runs.len() - 1);
        let first = &mut runs[0];
        first.ends[0] = last.ends[0].clone();
        first.orbits.splice(0..0, last.orbits);
    }
    runs
}

fn bound(special: &Special) -> Bound {
    Bound {
        damping_ratio: special.parameter,
        at: Edge::Special(special.kind.clone()),
    }
}

/// The special point at which a branch ends, if it does so at one.
fn last_special(branch: &Branch, side: usize) -> Option<&Special> {
    let special = match side {
        0 => branch.specials.first(),
        _ => branch.specials.last(),
    };
    special.filter(|_| matches!(branch.ends[side], End::Halved | End::Grazing))
}

/// End of a limb: where it meets or comes from another one, a special point of either.
fn end(limbs: &[BranchWithOrigin], limb: &BranchWithOrigin, side: usize) -> Bound {
    let branch = &limb.branch;
    let point = &branch.points[side * (branch.points.len() - 1)];
    let is_origin = |special: &&Special| Some(&special.label) == limb.origin.as_ref();
    let mut all = limbs.iter().flat_map(|limb| &limb.branch.specials);
    let at = match branch.ends[side] {
        End::Start | End::Closed => all.find(is_origin),
        _ => last_special(branch, side),
    };
    let damping_ratio = point.parameter;
    match (at, &branch.ends[side]) {
        (Some(special), _) => bound(special),
        (None, End::RangeEnd) => Bound {
            damping_ratio,
            at: Edge::Range,
        },
        (None, why) => Bound {
            damping_ratio,
            at: Edge::Lost(why.to_string()),
        },
    }
}
