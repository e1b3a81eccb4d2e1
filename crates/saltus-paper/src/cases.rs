//! Fig. 3: phase portraits and Poincare points of eight named cases.

use saltus::hybrid::Point;
use saltus::model::{Contact, Inertia, Model, Section};
use saltus::orbits::{Criteria, MotionKind, Recurrence, Verdict, judge};
use saltus::physics::{ContactLaw, FrequencyReference};
use saltus::study::{
    Control, LyapunovRun, StudyError, Trajectory, lyapunov_of_states, recurrence, settle, simulate,
};

use crate::effort::Effort;
use crate::parallel::in_parallel;
use crate::setting::setup;

/// One panel of Fig. 3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// a to h.
    pub tag: char,
    /// Omega/omega_h.
    pub ratio: f64,
    /// zeta_h.
    pub damping_ratio: f64,
    /// Whether the paper gives this damping ratio; else we chose one inside the regime it names.
    pub given: bool,
    /// Name that the paper gives the motion.
    pub paper: &'static str,
}

/// The eight panels. The paper gives zeta_h for (e), (f) and (g) only.
pub fn cases() -> [Case; 8] {
    let case = |tag, ratio, damping_ratio, given, paper| Case {
        tag,
        ratio,
        damping_ratio,
        given,
        paper,
    };
    [
        case('a', 0.9, 0.15, false, "2T"),
        case('b', 0.9, 0.35, false, "1T"),
        case('c', 1.0, 0.12, false, "chaos"),
        case('d', 1.0, 0.21, false, "4T"),
        case('e', 1.0, 0.28, true, "2T"),
        case('f', 1.1, 0.32, true, "quasi-periodic"),
        case('g', 1.1, 0.36, true, "suggests 4T"),
        case('h', 1.1, 0.45, false, "2T"),
    ]
}

/// Findings for a case.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseResult {
    /// The case.
    pub case: Case,
    /// The settled motion: its time history covers the last periods, its section all kept ones.
    pub trajectory: Trajectory,
    /// Forcing period (s).
    pub period_seconds: f64,
    /// Forcing periods after which the section repeats to 1e-6; `None` if it does not.
    pub recurrence: Option<u32>,
    /// Kind of the motion, by its largest Lyapunov exponent per forcing period and its recurrence.
    pub verdict: Verdict,
    /// Part of the time on the floor over the kept periods.
    pub contact_ratio: f64,
    /// Largest plate reaction force in the time history, in body weights.
    pub peak_force: f64,
}

impl CaseResult {
    /// Flights of the first jumper as intervals (s) within the time history.
    pub fn flights(&self) -> Vec<(f64, f64)> {
        let time = &self.trajectory.history.time;
        let (Some(&first), Some(&last)) = (time.first(), time.last()) else {
            return Vec::new();
        };
        let mut out = Vec::new();
        let mut since = None;
        for switch in self.trajectory.switches.iter().filter(|s| s.jumper == 0) {
            match switch.into {
                Some(Contact::Flight) => since = Some(switch.time),
                Some(Contact::Stance) => {
                    let began = since.take().unwrap_or(0.0_f64);
                    if switch.time > first {
                        out.push((began.max(first), switch.time));
                    }
                }
                None => {}
            }
        }
        out.extend(since.map(|began| (began.max(first), last)));
        out
    }

    /// Number of bands, visited in turn, into which the heights of the section fall: 16 at most, a power of two.
    pub fn bands(&self) -> usize {
        let z: Vec<f64> = self.trajectory.section.iter().map(|s| s.z[0]).collect();
        let apart = |n: usize| {
            let range = |i: usize| {
                let visits = z.iter().skip(i).step_by(n);
                visits.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &z| {
                    [low.min(z), high.max(z)]
                })
            };
            let mut ranges: Vec<[f64; 2]> = (0..n).map(range).collect();
            ranges.sort_by(|a, b| a[0].total_cmp(&b[0]));
            ranges.windows(2).all(|pair| pair[0][1] < pair[1][0])
        };
        [16, 8, 4, 2].into_iter().find(|&n| apart(n)).unwrap_or(1)
    }

    /// Name of the motion in a word or two.
    pub fn words(&self) -> String {
        let exponent = self.verdict.exponent;
        let (mean, error) = (exponent.per_iterate, exponent.standard_error);
        match (self.verdict.kind, self.recurrence) {
            (MotionKind::Periodic(n), _) | (_, Some(n)) => format!("{n}T"),
            (MotionKind::Chaotic, _) => {
                let bands = match self.bands() {
                    1 => String::new(),
                    n => format!(" in {n} bands"),
                };
                format!("chaotic{bands} (exponent {mean:.4} ± {error:.4} per period)")
            }
            (MotionKind::QuasiPeriodic, _) => {
                format!("quasi-periodic (exponent {mean:.1e} ± {error:.0e} per period)")
            }
            (MotionKind::NotPeriodic | MotionKind::Undecided, _) => {
                format!("does not repeat (exponent {mean:.4} ± {error:.4} per period)")
            }
        }
    }
}

/// Periods run before anything is kept: long, because (g) sits near a period doubling.
const TRANSIENT: u64 = 2000;
/// Periods kept in the section, and in the time history.
const KEPT: u64 = 600;
const HISTORY: u64 = 64;
/// Points per period of the time history.
const POINTS: u32 = 240;

/// Runs all cases of the paper's law with the given reading of omega_h.
///
/// # Errors
/// [`StudyError`] if a case has no model, or when stopped.
pub fn run_cases(
    reference: FrequencyReference,
    effort: &Effort,
    control: &Control,
) -> Result<Vec<CaseResult>, StudyError> {
    let starts = settled(reference, control)?;
    let trajectories = in_parallel(&starts, control.threads, |(model, start)| {
        simulate(model, start, KEPT, HISTORY, POINTS, control)
    });
    let trajectories = trajectories.into_iter().collect::<Result<Vec<_>, _>>()?;
    let exponents = lyapunov_of_states(&starts, 1, effort.exponent_periods, control)?;
    let parts = starts.iter().zip(trajectories).zip(&exponents);
    let parts = cases().into_iter().zip(parts);
    Ok(parts
        .map(|(case, (((model, _), trajectory), growth))| result(case, model, trajectory, growth))
        .collect())
}

/// The models of all cases, and the states that they have settled to.
fn settled(
    reference: FrequencyReference,
    control: &Control,
) -> Result<Vec<(Model, Point)>, StudyError> {
    let law = ContactLaw::ReactionForce;
    let mut starts: Vec<(Model, Point)> = Vec::new();
    for case in cases() {
        let model = setup(
            case.damping_ratio,
            case.ratio,
            reference,
            law,
            Inertia::Condensed,
        )
        .model()?;
        let start = model.start(3.0, 2.0);
        starts.push((model, start));
    }
    let settled = settle(&starts, TRANSIENT, 0, control)?;
    for (start, settled) in starts.iter_mut().zip(settled) {
        start.1 = settled.end;
    }
    Ok(starts)
}

/// The findings for one case, from its settled motion and its exponents.
fn result(case: Case, model: &Model, trajectory: Trajectory, growth: &LyapunovRun) -> CaseResult {
    let column =
        |pick: fn(&Section) -> f64| -> Vec<f64> { trajectory.section.iter().map(pick).collect() };
    let (z, v) = (column(|s| s.z[0]), column(|s| s.v[0]));
    let recurrence = recurrence(&z, &v, 1e-6);
    let again = recurrence.map_or(Recurrence::Open, |period| {
        let rest = 1e-6;
        Recurrence::Recurs { period, rest }
    });
    let contact: f64 = trajectory.contact_ratio.iter().map(|ratio| ratio[0]).sum();
    CaseResult {
        case,
        period_seconds: model.scales().period(),
        recurrence,
        verdict: judge(&growth.spectrum, again, &Criteria::default()),
        contact_ratio: contact / trajectory.contact_ratio.len().max(1) as f64,
        peak_force: trajectory
            .history
            .states
            .iter()
            .map(|s| s.prf[0])
            .fold(0.0, f64::max),
        trajectory,
    }
}

impl Effort {
    /// Periods of the cases of Fig. 3 under one reading, for a progress display.
    pub fn case_periods(&self) -> u64 {
        8 * (TRANSIENT + KEPT + self.exponent_periods + 100)
    }
}
