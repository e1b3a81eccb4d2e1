//! The statements of the paper, one by one, with our number and a verdict.

use std::fmt::Write as _;

use saltus_orbits::{Nature, SpecialKind};

use super::{
    CaseResult, Coexistence, Diagram, PanelBranches, RATIOS, Regime, coexistence, regimes,
};
use crate::physics::{ContactLaw, FrequencyReference, Jumper, Plate};
use crate::study::{Control, StudyError};

/// What became of a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// As stated.
    Reproduced,
    /// As stated, but for something we say.
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
    /// What we find.
    pub value: String,
    /// The verdict on the reading named in `reading`.
    pub verdict: Verdict,
    /// The reading it depends on, and what another reading would give.
    pub reading: String,
}

/// Value and verdict under one reading of omega_h.
type Finding = (String, Verdict);
type Find = fn(&Evidence<'_>) -> Finding;

/// All facts. `occupied` and `free` are the results of [`super::run_cases`] under both readings, `branches` those of
/// [`super::panel_branches`], under the first.
///
/// # Errors
/// [`StudyError`] if there is no model of the paper's plate, or when stopped.
pub fn facts(
    diagrams: &[Diagram],
    occupied: &[CaseResult],
    free: &[CaseResult],
    branches: &[PanelBranches],
    control: &Control,
) -> Result<Vec<Fact>, StudyError> {
    let mut out = frequencies()?;
    let mut stretches = Vec::new();
    for diagram in diagrams
        .iter()
        .filter(|d| d.law == ContactLaw::ReactionForce)
    {
        stretches.push((diagram, coexistence(diagram, control)?));
    }
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
        let evidence = |reference, cases, branches| Evidence {
            diagrams,
            coexistence: &stretches,
            reference,
            cases,
            branches,
        };
        let (value, verdict) = find(&evidence(FrequencyReference::Occupied, occupied, branches));
        let (other, its_verdict) = find(&evidence(FrequencyReference::Free, free, &[]));
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

/// What a finding may look at: everything under one reading.
struct Evidence<'a> {
    diagrams: &'a [Diagram],
    coexistence: &'a [(&'a Diagram, Vec<Coexistence>)],
    reference: FrequencyReference,
    cases: &'a [CaseResult],
    /// Empty where none were followed.
    branches: &'a [PanelBranches],
}

impl Evidence<'_> {
    fn diagram(&self, ratio: f64) -> Option<&Diagram> {
        self.diagrams.iter().find(|d| {
            d.law == ContactLaw::ReactionForce && d.reference == self.reference && d.ratio == ratio
        })
    }

    fn case(&self, tag: char) -> Option<&CaseResult> {
        self.cases.iter().find(|result| result.case.tag == tag)
    }

    fn panel(&self, ratio: f64) -> Option<&PanelBranches> {
        self.branches.iter().find(|panel| panel.ratio == ratio)
    }

    fn words(&self, tag: char) -> String {
        self.case(tag).map_or_else(String::new, CaseResult::words)
    }

    fn has_period(&self, tag: char, n: u32) -> bool {
        self.case(tag)
            .is_some_and(|result| result.recurrence == Some(n))
    }

    fn is_chaotic(&self, tag: char) -> bool {
        let chaotic = |result: &CaseResult| result.verdict.nature == Nature::Chaotic;
        self.case(tag).is_some_and(chaotic)
    }

    /// Regimes of the up-sweep.
    fn up(&self, ratio: f64) -> Vec<Regime> {
        self.diagram(ratio)
            .map_or_else(Vec::new, |diagram| regimes(diagram, 0))
    }

    fn down(&self, ratio: f64) -> Vec<Regime> {
        self.diagram(ratio)
            .map_or_else(Vec::new, |diagram| regimes(diagram, 1))
    }
}

/// Periods in order of damping, without repeats and without the slow rows at bifurcations.
fn sequence(regimes: &[Regime]) -> Vec<u32> {
    let mut out: Vec<u32> = regimes.iter().filter_map(|r| r.period).collect();
    out.dedup();
    out
}

/// First and last damping ratio with this period.
fn range(regimes: &[Regime], period: u32) -> Option<(f64, f64)> {
    let mut with = regimes.iter().filter(|r| r.period == Some(period));
    let first = with.next()?;
    Some((first.from, with.next_back().unwrap_or(first).to))
}

fn f4(evidence: &Evidence<'_>) -> Finding {
    let up = evidence.up(RATIOS[0]);
    let value = match (range(&up, 2), range(&up, 1)) {
        (Some((_, last)), Some((first, _))) => {
            format!("2T up to zeta_h = {last:.3}, 1T from {first:.3}")
        }
        _ => format!("periods {:?}", sequence(&up)),
    };
    let parts = [
        sequence(&up) == [2, 1],
        evidence.has_period('a', 2),
        evidence.has_period('b', 1),
    ];
    (value, Verdict::from_parts(&parts))
}

fn f5(evidence: &Evidence<'_>) -> Finding {
    let up = evidence.up(RATIOS[1]);
    let four = range(&up, 4);
    let two = up
        .iter()
        .rev()
        .find(|r| r.period == Some(2))
        .map(|r| (r.from, r.to));
    let starts_irregular = up.first().is_some_and(|r| r.period.is_none());
    let mut value = format!(
        "zeta_h = 0.12: {}; 0.21: {}; 0.28: {}",
        evidence.words('c'),
        evidence.words('d'),
        evidence.words('e')
    );
    if let (Some(four), Some(two)) = (four, two) {
        let _ = write!(
            value,
            "; up-sweep 4T from {:.3}, 2T until {:.3}",
            four.0, two.1
        );
    }
    let ordered = four.zip(two).is_some_and(|(four, two)| four.0 < two.0);
    let parts = [
        starts_irregular && evidence.is_chaotic('c'),
        evidence.has_period('d', 4) && ordered,
        evidence.has_period('e', 2),
    ];
    (value, Verdict::from_parts(&parts))
}

fn f6(evidence: &Evidence<'_>) -> Finding {
    let up = evidence.up(RATIOS[2]);
    let starts_irregular = up.first().is_some_and(|r| r.period.is_none());
    // Windows: periodic stretches between irregular ones.
    let last_irregular = up.iter().rposition(|r| r.period.is_none()).unwrap_or(0);
    let windows: Vec<String> = up[..last_irregular.max(1).min(up.len())]
        .iter()
        .filter_map(|r| Some((r.period?, r)))
        .filter(|(_, r)| r.to > r.from)
        .map(|(n, r)| format!("{n}T {:.3}-{:.3}", r.from, r.to))
        .collect();
    let value = format!(
        "windows {}; zeta_h = 0.32: {}; 0.36: {}",
        if windows.is_empty() {
            "none".into()
        } else {
            windows.join(", ")
        },
        evidence.words('f'),
        evidence.case('g').map_or_else(String::new, in_pairs)
    );
    let mut value = value;
    if let Some(panel) = evidence.panel(RATIOS[2]) {
        let tori = panel
            .transitions
            .iter()
            .filter(|t| matches!(t.kind, SpecialKind::NeimarkSacker { .. }));
        value += match tori.count() {
            0 => "; no branch has a Neimark-Sacker point, where a torus would begin",
            _ => "; there are Neimark-Sacker points, where tori begin",
        };
    }
    let torus = evidence
        .case('f')
        .is_some_and(|result| result.verdict.nature == Nature::QuasiPeriodic);
    let parts = [
        starts_irregular && !windows.is_empty(),
        torus,
        evidence.has_period('g', 4),
    ];
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
    let down = evidence.down(RATIOS[2]);
    let mut value = String::new();
    let mut lowest = Vec::new();
    for n in [2, 4, 8, 16] {
        // The stretch that belongs to the cascade is the one at the highest damping.
        if let Some(regime) = down.iter().rev().find(|r| r.period == Some(n)) {
            let _ = write!(value, "{n}T down to {:.3}; ", regime.from);
            lowest.push(regime.from);
        }
    }
    let _ = write!(
        value,
        "Fig. 3h (0.45) {}, 3g (0.36) {}, 3f (0.32) {}",
        evidence.words('h'),
        evidence.words('g'),
        evidence.words('f')
    );
    let mut doubling = lowest.len() >= 3 && lowest.windows(2).all(|w| w[1] < w[0]);
    if let Some(panel) = evidence.panel(RATIOS[2]) {
        let at: Vec<String> = panel
            .cascade
            .iter()
            .map(|(_, zeta)| format!("{zeta:.8}"))
            .collect();
        let _ = write!(value, "; the period doubles at {}", at.join(", "));
        let ratios = panel.cascade_ratios();
        if !ratios.is_empty() {
            let ratios: Vec<String> = ratios.iter().map(|ratio| format!("{ratio:.3}")).collect();
            let _ = write!(
                value,
                " (successive distances fall by {}; Feigenbaum's number is 4.669)",
                ratios.join(", ")
            );
        }
        doubling &= panel.cascade.len() >= 2;
    }
    let irregular = evidence
        .case('f')
        .is_some_and(|result| result.recurrence.is_none());
    let parts = [
        doubling,
        evidence.has_period('h', 2) || evidence.has_period('h', 4),
        irregular,
    ];
    (value, Verdict::from_parts(&parts))
}

fn f8(evidence: &Evidence<'_>) -> Finding {
    let mut found: Vec<(f64, &Coexistence)> = Vec::new();
    for (diagram, stretches) in evidence.coexistence {
        if diagram.law == ContactLaw::ReactionForce && diagram.reference == evidence.reference {
            found.extend(stretches.iter().map(|c| (diagram.ratio, c)));
        }
    }
    if found.is_empty() {
        return (
            "no two passes end on different attractors".into(),
            Verdict::NotReproduced,
        );
    }
    found.sort_by(|a, b| (b.1.to - b.1.from).total_cmp(&(a.1.to - a.1.from)));
    let name = |n: Option<u32>| n.map_or_else(|| "non-periodic".into(), |n| format!("{n}T"));
    let words = |(ratio, c): &(f64, &Coexistence)| {
        let (a, b) = (name(c.periods.0), name(c.periods.1));
        format!(
            "Omega = {ratio:.1}, zeta_h = {:.3}-{:.3} ({a} and {b} at the first)",
            c.from, c.to
        )
    };
    let longest: Vec<String> = found.iter().take(LONGEST).map(words).collect();
    let mut value = format!("two attractors at {}", longest.join("; "));
    if found.len() > LONGEST {
        let _ = write!(value, "; and {} shorter stretches", found.len() - LONGEST);
    }
    for panel in evidence.branches {
        for found in &panel.attractors.loops {
            let end = |jump: Option<[f64; 2]>| {
                jump.map_or_else(
                    || "not at all".into(),
                    |[low, high]| format!("between {low:.3} and {high:.3}"),
                )
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

/// Stretches of coexistence named in the table.
const LONGEST: usize = 3;
