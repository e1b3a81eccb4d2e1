//! The JSON document of branches.

use super::Run;
use super::view::Seen;
use crate::kinds;
use crate::motion::SectionPoint;
use saltus::orbits::{Orbit, Special};
use saltus_config::{Parameter, Study};
use serde::Serialize;

/// The document; `saltus continue --help` explains each key.
#[derive(Serialize)]
pub(super) struct Report<'a> {
    version: &'static str,
    parameter: String,
    unit: &'static str,
    label: String,
    from: f64,
    to: f64,
    /// Whether no branch was left out because there were too many.
    pub(super) complete: bool,
    second: Option<Axis>,
    pub(super) special_points: Vec<SpecialPoint<'a>>,
    pub(super) branches: Vec<Branch<'a>>,
    pub(super) curves: Vec<Curve<'a>>,
    study: &'a Study,
}

#[derive(Serialize)]
struct Axis {
    parameter: String,
    unit: &'static str,
    label: String,
    from: f64,
    to: f64,
}

#[derive(Serialize)]
pub(super) struct Branch<'a> {
    pub(super) branch: usize,
    pub(super) origin: Option<&'a str>,
    pub(super) period: usize,
    pub(super) ends: [String; 2],
    pub(super) points: Vec<Point<'a>>,
}

#[derive(Serialize)]
pub(super) struct Point<'a> {
    pub(super) value: f64,
    /// Null if neutral.
    pub(super) stable: Option<bool>,
    pub(super) outside: usize,
    pub(super) multiplier: [f64; 2],
    pub(super) sequence: &'a str,
    section: Vec<SectionPoint<'a>>,
}

#[derive(Serialize)]
pub(super) struct SpecialPoint<'a> {
    pub(super) label: &'a str,
    pub(super) kind: &'static str,
    pub(super) name: &'static str,
    pub(super) branch: usize,
    pub(super) value: f64,
    pub(super) period: usize,
    pub(super) outside: [usize; 2],
    pub(super) angle: Option<f64>,
    pub(super) sequence: &'a str,
    pub(super) remark: Option<&'a str>,
    section: Vec<SectionPoint<'a>>,
    /// Of the orbit at hand, which is the last one before a grazing.
    orbit_value: f64,
    state: Vec<State<'a>>,
}

#[derive(Serialize)]
struct State<'a> {
    modes: &'a [usize],
    x: &'a [f64],
}

#[derive(Serialize)]
pub(super) struct Curve<'a> {
    pub(super) label: &'a str,
    pub(super) kind: Option<&'static str>,
    pub(super) ends: Option<[String; 2]>,
    pub(super) error: Option<&'a str>,
    pub(super) points: Vec<CurvePoint>,
}

#[derive(Serialize)]
pub(super) struct CurvePoint {
    pub(super) values: [f64; 2],
    pub(super) period: usize,
    pub(super) angle: Option<f64>,
}

impl<'a> Report<'a> {
    pub(super) fn new(run: &'a Run) -> Self {
        let question = &run.question;
        let (along, options) = (question.along(), question.options());
        let branches = run.limbs.iter().zip(&run.views).enumerate();
        let specials =
            |(branch, (limb, view)): (usize, (&'a saltus::orbits::Limb, &'a super::View))| {
                let all = limb.branch.specials.iter().zip(&view.specials);
                all.map(move |(special, seen)| {
                    SpecialPoint::new(branch, special, seen, along.parameter)
                })
            };
        Self {
            version: env!("CARGO_PKG_VERSION"),
            parameter: question.parameter.key(),
            unit: question.parameter.unit(),
            label: question.parameter.label(),
            from: along.from,
            to: along.to,
            complete: run.limbs.len() < options.branches,
            second: question
                .second
                .as_ref()
                .map(|(table, p)| axis(p, [table.from, table.to])),
            special_points: branches.clone().flat_map(specials).collect(),
            branches: branches
                .map(|(branch, (limb, view))| Branch {
                    branch,
                    origin: limb.origin.as_deref(),
                    period: period(limb),
                    ends: limb.branch.ends.each_ref().map(ToString::to_string),
                    points: limb
                        .branch
                        .points
                        .iter()
                        .zip(&view.points)
                        .map(|(point, seen)| Point::new(point, seen))
                        .collect(),
                })
                .collect(),
            curves: run.curves.iter().map(Curve::new).collect(),
            study: &run.study,
        }
    }
}

fn axis(parameter: &Parameter, [from, to]: [f64; 2]) -> Axis {
    Axis {
        parameter: parameter.key(),
        unit: parameter.unit(),
        label: parameter.label(),
        from,
        to,
    }
}

/// Forcing periods of the orbits of a branch.
pub(super) fn period(limb: &saltus::orbits::Limb) -> usize {
    limb.branch.points.first().map_or(0, |p| p.orbit.period())
}

impl<'a> Point<'a> {
    fn new(point: &saltus::orbits::Point, seen: &'a Seen) -> Self {
        Self {
            value: point.parameter,
            stable: point.orbit.stability().is_stable(),
            outside: point.outside,
            multiplier: [seen.multiplier.re, seen.multiplier.im],
            sequence: &seen.sequence,
            section: seen.section.iter().map(SectionPoint::from).collect(),
        }
    }
}

impl<'a> SpecialPoint<'a> {
    fn new(branch: usize, special: &'a Special, seen: &'a Seen, parameter: usize) -> Self {
        Self {
            label: &special.label,
            kind: special.kind.short(),
            name: kinds::name(&special.kind),
            branch,
            value: special.parameter,
            period: special.orbit.period(),
            outside: special.outside,
            angle: kinds::angle(&special.kind),
            sequence: &seen.sequence,
            remark: special.remark.as_deref(),
            section: seen.section.iter().map(SectionPoint::from).collect(),
            orbit_value: special.orbit.parameters[parameter],
            state: state(&special.orbit),
        }
    }
}

fn state(orbit: &Orbit) -> Vec<State<'_>> {
    let places = orbit.places.iter();
    places
        .map(|place| State {
            modes: &place.modes,
            x: &place.x,
        })
        .collect()
}

impl<'a> Curve<'a> {
    fn new(followed: &'a super::Followed) -> Self {
        let curve = followed.outcome.as_ref();
        let points = curve.map_or(&[][..], |curve| &curve.points);
        Self {
            label: &followed.label,
            kind: followed.special.as_ref().map(|s| s.kind.short()),
            ends: curve
                .ok()
                .map(|c| c.ends.each_ref().map(ToString::to_string)),
            error: curve.err().map(String::as_str),
            points: points
                .iter()
                .map(|point| CurvePoint {
                    values: point.parameters,
                    period: point.orbit.period(),
                    angle: point.pair.map(saltus::orbits::Multiplier::argument),
                })
                .collect(),
        }
    }
}
