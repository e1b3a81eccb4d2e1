//! The statements of the paper, one by one, with our number and a verdict.

use std::fmt::Write as _;

use saltus::orbits::{MotionKind, SpecialKind};
use saltus::physics::{ContactLaw, FrequencyReference, Jumper, Plate};
use saltus::study::StudyError;

use crate::branches::PanelBranches;
use crate::cases::CaseResult;
use crate::setting::RATIOS;
use crate::stretches::{Bound, Edge, Stretch, cascade, families};

/// Outcome for a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Reproduced as stated.
    Reproduced,
    /// Reproduced but for a departure that we name.
    Departure,
    /// Not as stated.
    NotReproduced,
}

impl Verdict {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Reproduced => "reproduced",
            Self::Departure => "reproduced with a departure",
            Self::NotReproduced => "not reproduced",
        }
    }

    fn from_parts(parts: &[bool]) -> Self {
        match parts.iter().filter(|&&ok| ok).count() {
            n if n == parts.len() => Self::Reproduced,
            0 => Self::NotReproduced,
            _ => Self::Departure,
        }
    }
}

/// One statement of the paper.
#[derive(Clone, Debug, PartialEq)]
pub struct Fact {
    /// F1 to F8.
    pub id: &'static str,
    /// The paper's claim, in our words.
    pub claim: &'static str,
    /// Our finding.
    pub value: String,
    /// The verdict on the reading named in `reading`.
    pub verdict: Verdict,
    /// The reading it depends on, and what another reading would give.
    pub reading: String,
}

/// Value and verdict under one reading of omega_h.
type Finding = (String, Verdict);
type Find = fn(&Evidence<'_>) -> Finding;

/// All facts. `occupied` and `free` are the results of [`crate::run_cases`] under both readings, `branches` those of
/// [`crate::panel_branches`]. Every verdict on a regime rests on the stretches of `branches`: no sweep is asked.
///
/// # Errors
/// [`StudyError`] if there is no model of the paper's plate.
pub fn facts(
    occupied: &[CaseResult],
    free: &[CaseResult],
    branches: &[PanelBranches],
) -> Result<Vec<Fact>, StudyError> {
    let mut out = frequencies()?;
    let claims: [(&str, &str, Find); 5] = [
        (
            "F4",
            "Omega = 0.9: period 2 at small damping, one critical value, period 1 above it (Figs. 2a, 3a, 3b)",
            f4,
        ),
        (
            "F5",
            "Omega = 1.0: chaos at small damping, then 4T, then 2T; 2T at zeta_h = 0.28 (Figs. 2b, 3c-e)",
            f5,
        ),
        (
            "F6",
            "Omega = 1.1: chaos at small damping with periodic and quasi-periodic windows; quasi-periodic at \
             0.32, 0.36 suggests 4T (Figs. 2c, 3f, 3g)",
            f6,
        ),
        (
            "F7",
            "Omega = 1.1: a period-doubling cascade as the damping decreases from high values (Figs. 2c, 3h, 3g, 3f)",
            f7,
        ),
        (
            "F8",
            "hysteresis and coexisting attractors somewhere in the scanned range (abstract)",
            f8,
        ),
    ];
    for (id, claim, find) in claims {
        let evidence = |reference, cases| Evidence {
            reference,
            cases,
            branches,
        };
        let (value, verdict) = find(&evidence(FrequencyReference::Occupied, occupied));
        let (other, its_verdict) = find(&evidence(FrequencyReference::Free, free));
        let reading = format!(
            "omega_h is the occupied body frequency. With the free one ({}): {other}",
            its_verdict.words()
        );
        out.push(Fact {
            id,
            claim,
            value,
            verdict,
            reading,
        });
    }
    Ok(out)
}

/// F1 to F3, which need no motion.
fn frequencies() -> Result<Vec<Fact>, StudyError> {
    let plate = Plate::dias_del_prado();
    let jumper = Jumper::dias_del_prado(plate.length, plate.width);
    let empty = plate.frequencies_hz()?[0];
    let occupied = plate.occupied(&[jumper])?.hz;
    let stiffness = (std::f64::consts::TAU * 2.48).powi(2) * jumper.mass / 1000.0;
    let printed = |value: f64, text: &str| format!("{value:.3}") == text;
    let check = |ok: bool| {
        if ok {
            Verdict::Reproduced
        } else {
            Verdict::NotReproduced
        }
    };
    Ok(vec![
        Fact {
            id: "F1",
            claim: "the empty plate vibrates at 2.297 Hz",
            value: format!("{empty:.6} Hz"),
            verdict: check(printed(empty, "2.297")),
            reading: "linear frequency of w_11; independent of the in-plane terms".into(),
        },
        Fact {
            id: "F2",
            claim: "with the person on it: 2.243 Hz (plate) and 2.537 Hz (body)",
            value: format!("{:.6} Hz and {:.6} Hz", occupied[0], occupied[1]),
            verdict: check(printed(occupied[0], "2.243") && printed(occupied[1], "2.537")),
            reading:
                "w_11 w_13 w_31 w_33 (the printed list lacks w_31: 2.5382 Hz) and k_h = 18 600 N/m \
                      (with 2.48 Hz exactly: 2.5378 Hz)"
                    .into(),
        },
        Fact {
            id: "F3",
            claim: "omega_h = 2.48 Hz implies k_h = 18.6 kN/m",
            value: format!(
                "{stiffness:.3} kN/m; 18.6 kN/m is {:.4} Hz",
                jumper.omega() / std::f64::consts::TAU
            ),
            verdict: check(format!("{stiffness:.1}") == "18.6"),
            reading: "k_h = 18 600 N/m is used; see F2".into(),
        },
    ])
}

/// Grounds of a finding: everything under one reading.
struct Evidence<'a> {
    reference: FrequencyReference,
    cases: &'a [CaseResult],
    branches: &'a [PanelBranches],
}

impl Evidence<'_> {
    fn case(&self, tag: char) -> Option<&CaseResult> {
        self.cases.iter().find(|result| result.case.tag == tag)
    }

    /// The panels of the paper's law.
    fn panels(&self) -> impl Iterator<Item = &PanelBranches> {
        let is_it = |panel: &&PanelBranches| {
            panel.law == ContactLaw::ReactionForce && panel.reference == self.reference
        };
        self.branches.iter().filter(is_it)
    }

    fn panel(&self, ratio: f64) -> Option<&PanelBranches> {
        self.panels().find(|panel| panel.ratio == ratio)
    }

    fn stretches(&self, ratio: f64) -> &[Stretch] {
        self.panel(ratio).map_or(&[], |panel| &panel.stretches)
    }

    fn words(&self, tag: char) -> String {
        self.case(tag).map_or_else(String::new, CaseResult::words)
    }

    fn has_period(&self, tag: char, n: u32) -> bool {
        self.case(tag)
            .is_some_and(|result| result.recurrence == Some(n))
    }

    fn is_chaotic(&self, tag: char) -> bool {
        let chaotic = |result: &CaseResult| result.verdict.kind == MotionKind::Chaotic;
        self.case(tag).is_some_and(chaotic)
    }
}

/// The damping ratio of an end.
fn at(bound: &Bound) -> String {
    match bound.at {
        Edge::Range => format!("{}, the end of the range", bound.damping_ratio),
        _ => format!("{:.5}", bound.damping_ratio),
    }
}

/// Stretches in words, by falling damping.
fn in_words<'a>(stretches: impl IntoIterator<Item = &'a Stretch>) -> String {
    let word = |one: &Stretch| format!("{}T from {} to {}", one.period, at(&one.from), at(&one.to));
    let words: Vec<String> = stretches.into_iter().map(word).collect();
    words.join(", ")
}

fn f4(evidence: &Evidence<'_>) -> Finding {
    let stretches = evidence.stretches(RATIOS[0]);
    let chain = cascade(stretches);
    let mut value = format!("stable are {}", in_words(chain.iter().copied()));
    let beside = stretches.iter().filter(|one| !chain.contains(one));
    let beside = in_words(beside);
    if !beside.is_empty() {
        let _ = write!(value, "; beside these {beside} (see F8)");
    }
    let periods: Vec<usize> = chain.iter().map(|one| one.period).collect();
    let over_the_range = chain.last().is_some_and(|last| last.from.at == Edge::Range);
    let parts = [
        periods == [1, 2] && over_the_range,
        evidence.has_period('a', 2),
        evidence.has_period('b', 1),
    ];
    (value, Verdict::from_parts(&parts))
}

fn f5(evidence: &Evidence<'_>) -> Finding {
    let stretches = evidence.stretches(RATIOS[1]);
    let of = |period: usize| stretches.iter().filter(move |one| one.period == period);
    let widest = |period| of(period).max_by(|a, b| a.width().total_cmp(&b.width()));
    let (four, two) = (widest(4), widest(2));
    let mut value = format!(
        "zeta_h = 0.12: {}; 0.21: {}; 0.28: {}",
        evidence.words('c'),
        evidence.words('d'),
        evidence.words('e')
    );
    let shown = stretches.iter().filter(|one| one.period <= 4);
    let _ = write!(value, "; stable are {}", in_words(shown));
    let ordered = four
        .zip(two)
        .is_some_and(|(four, two)| four.from.damping_ratio < two.from.damping_ratio);
    let irregular = |one: &Stretch| !one.covers(0.12);
    let parts = [
        evidence.is_chaotic('c') && stretches.iter().all(irregular),
        evidence.has_period('d', 4) && ordered && of(4).any(|one| one.covers(0.21)),
        evidence.has_period('e', 2) && of(2).any(|one| one.covers(0.28)),
    ];
    (value, Verdict::from_parts(&parts))
}

fn f6(evidence: &Evidence<'_>) -> Finding {
    let stretches = evidence.stretches(RATIOS[2]);
    let lowest = cascade(stretches)
        .last()
        .map_or(f64::NAN, |last| last.from.damping_ratio);
    let windows = families(stretches);
    let windows: Vec<String> = windows
        .iter()
        .filter(|(_, range)| range[1] < lowest)
        .map(|(period, [from, to])| format!("{period}T {from:.5}-{to:.5}"))
        .collect();
    let mut value = format!(
        "below {lowest:.5} windows, each with the doublings of its period: {}; zeta_h = 0.32: {}; 0.36: {}",
        match windows[..] {
            [] => "none".to_owned(),
            _ => windows.join(", "),
        },
        evidence.words('f'),
        evidence.case('g').map_or_else(String::new, in_pairs)
    );
    if let Some(detail) = evidence
        .panel(RATIOS[2])
        .and_then(|panel| panel.detail.as_ref())
    {
        let torus = |kind: &SpecialKind| matches!(kind, SpecialKind::NeimarkSacker { .. });
        value += match detail.transitions.iter().any(|point| torus(&point.kind)) {
            false => "; no branch has a Neimark-Sacker point, where a torus would begin",
            true => "; there are Neimark-Sacker points, where tori begin",
        };
    }
    let torus = evidence
        .case('f')
        .is_some_and(|result| result.verdict.kind == MotionKind::QuasiPeriodic);
    let parts = [!windows.is_empty(), torus, evidence.has_period('g', 4)];
    (value, Verdict::from_parts(&parts))
}

/// The motion in words; a 2n-periodic one just born from an n-periodic one looks like n points.
fn in_pairs(result: &CaseResult) -> String {
    let words = result.words();
    let Some(half) = result
        .recurrence
        .filter(|&n| n >= 8 && n % 2 == 0)
        .map(|n| n as usize / 2)
    else {
        return words;
    };
    let z: Vec<f64> = result.trajectory.section.iter().map(|s| s.z[0]).collect();
    let apart = z
        .iter()
        .zip(&z[half..])
        .take(half)
        .fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
    let size =
        z.iter().fold(f64::MIN, |m, v| m.max(*v)) - z.iter().fold(f64::MAX, |m, v| m.min(*v));
    format!("{words} ({half} pairs of points at most {apart:.2} eta apart, of {size:.1} in all)")
}

fn f7(evidence: &Evidence<'_>) -> Finding {
    let chain = cascade(evidence.stretches(RATIOS[2]));
    let mut value = format!(
        "stable are {}; Fig. 3h (0.45) {}, 3g (0.36) {}, 3f (0.32) {}",
        in_words(chain.iter().copied()),
        evidence.words('h'),
        evidence.words('g'),
        evidence.words('f')
    );
    let doubles = |one: &&&Stretch| one.from.at == Edge::Special(SpecialKind::PeriodDoubling);
    let doublings = chain.iter().filter(doubles);
    let doublings: Vec<f64> = doublings.map(|one| one.from.damping_ratio).collect();
    let digits: Vec<String> = doublings.iter().map(|zeta| format!("{zeta:.8}")).collect();
    let _ = write!(value, "; the period doubles at {}", digits.join(", "));
    let ratio = |w: &[f64]| format!("{:.3}", (w[0] - w[1]) / (w[1] - w[2]));
    let ratios: Vec<String> = doublings.windows(3).map(ratio).collect();
    if !ratios.is_empty() {
        let _ = write!(
            value,
            " (successive distances fall by {}; Feigenbaum's number is 4.669)",
            ratios.join(", ")
        );
    }
    let irregular = |result: &CaseResult| result.recurrence.is_none();
    let parts = [
        doublings.len() >= 3,
        evidence.has_period('h', 2) || evidence.has_period('h', 4),
        evidence.case('f').is_some_and(irregular),
    ];
    (value, Verdict::from_parts(&parts))
}

/// Stretches of coexistence named in the table.
const LONGEST: usize = 3;

fn f8(evidence: &Evidence<'_>) -> Finding {
    let mut found = Vec::new();
    for panel in evidence.panels() {
        let all = overlaps(&panel.stretches);
        found.extend(all.into_iter().map(|overlap| (panel.ratio, overlap)));
    }
    if found.is_empty() {
        return (
            "no two cycles are stable at one damping ratio".into(),
            Verdict::NotReproduced,
        );
    }
    found.sort_by(|(_, a), (_, b)| (b.to - b.from).total_cmp(&(a.to - a.from)));
    let words = |(ratio, overlap): &(f64, Overlap)| {
        let pairs: Vec<String> = overlap
            .periods
            .iter()
            .map(|(a, b)| format!("{a}T and {b}T"))
            .collect();
        format!(
            "Omega = {ratio:.1}, zeta_h = {:.5}-{:.5} ({})",
            overlap.from,
            overlap.to,
            pairs.join(", ")
        )
    };
    let longest: Vec<String> = found.iter().take(LONGEST).map(words).collect();
    let mut value = format!("two stable cycles at {}", longest.join("; "));
    if found.len() > LONGEST {
        let _ = write!(value, "; and {} shorter stretches", found.len() - LONGEST);
    }
    for panel in evidence.panels() {
        for found in panel
            .detail
            .iter()
            .flat_map(|detail| &detail.attractors.loops)
        {
            let end = |jump: Option<[f64; 2]>| {
                jump.map_or_else(|| "not at all".into(), |jump| jumps(&panel.stretches, jump))
            };
            let _ = write!(
                value,
                "; hysteresis at Omega = {:.1}: rising, the motion jumps {}, falling {}",
                panel.ratio,
                end(found.jump_up),
                end(found.jump_down)
            );
        }
    }
    (value, Verdict::Reproduced)
}

/// Place of a jump between two damping ratios: the only end of a stretch there that is no doubling, if there is one.
fn jumps(stretches: &[Stretch], [low, high]: [f64; 2]) -> String {
    let ends = stretches.iter().flat_map(|one| [&one.from, &one.to]);
    let jump = |bound: &&Bound| {
        let doubling = [SpecialKind::PeriodDoubling, SpecialKind::Halving];
        let is_doubling = |kind: &SpecialKind| doubling.contains(kind);
        (low..=high).contains(&bound.damping_ratio)
            && matches!(&bound.at, Edge::Special(kind) if !is_doubling(kind))
    };
    match ends.filter(jump).collect::<Vec<_>>()[..] {
        [one] => format!("at {:.5}", one.damping_ratio),
        _ => format!("between {low:.3} and {high:.3}"),
    }
}

/// Damping ratios at which two cycles or more are stable.
struct Overlap {
    from: f64,
    to: f64,
    /// Periods of the pairs.
    periods: Vec<(usize, usize)>,
}

fn overlaps(stretches: &[Stretch]) -> Vec<Overlap> {
    let mut pairs: Vec<([f64; 2], (usize, usize))> = Vec::new();
    for (i, a) in stretches.iter().enumerate() {
        for b in &stretches[i + 1..] {
            let from = a.from.damping_ratio.max(b.from.damping_ratio);
            let to = a.to.damping_ratio.min(b.to.damping_ratio);
            // a doubling is an end of both
            if to - from > 1e-7 {
                let periods = (a.period.min(b.period), a.period.max(b.period));
                pairs.push(([from, to], periods));
            }
        }
    }
    pairs.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
    let mut out: Vec<Overlap> = Vec::new();
    for ([from, to], periods) in pairs {
        match out.last_mut().filter(|last| from <= last.to + 1e-7) {
            Some(last) => {
                last.to = last.to.max(to);
                if !last.periods.contains(&periods) {
                    last.periods.push(periods);
                }
            }
            None => out.push(Overlap {
                from,
                to,
                periods: vec![periods],
            }),
        }
    }
    out
}
