//! The kind of a motion, and how sure that is, for people.

use saltus::orbits::{MotionKind, UndecidedReason, Verdict};

/// Meaning of the name, or why there is none and what may help.
pub(super) fn meaning(verdict: &Verdict) -> String {
    let text = match verdict.kind {
        MotionKind::Periodic(1) => "it repeats every forcing period, and small deviations die out",
        MotionKind::Periodic(n) => {
            return format!("it repeats every {n} forcing periods, and small deviations die out");
        }
        MotionKind::QuasiPeriodic => {
            "it never repeats, yet small deviations neither grow nor die out: a torus"
        }
        MotionKind::Chaotic => "it never repeats, and small deviations grow, again and again",
        MotionKind::NotPeriodic | MotionKind::Undecided => verdict.doubt.map_or("", reason),
    };
    text.to_owned()
}

fn reason(doubt: UndecidedReason) -> &'static str {
    match doubt {
        UndecidedReason::Sign => {
            "the sign of the largest exponent is not certain; more lyapunov.periods may tell"
        }
        UndecidedReason::Growth => {
            "deviations grow, but not yet by more than what leaves an unstable cycle shows; \
             more lyapunov.periods may tell"
        }
        UndecidedReason::Drift => {
            "it is still on its way to a cycle or from one; a longer lyapunov.transient may tell"
        }
        UndecidedReason::NoPeriod => {
            "deviations die out, but no period up to 64 is seen; a longer lyapunov.transient may tell"
        }
        UndecidedReason::UnstableCycle => {
            "it repeats while deviations grow: an unstable cycle, or a chaotic transient before a \
             stable one; another [start] or a longer lyapunov.transient may tell"
        }
    }
}

/// A probability; what is not certain is never called so.
pub(super) fn percent(confidence: f64) -> String {
    if confidence > 0.9999 {
        "> 99.99 %".to_owned()
    } else {
        format!("{:.2} %", 100.0 * confidence)
    }
}
