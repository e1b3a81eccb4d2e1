//! What says that an attractor is one, in JSON and in words.

use super::report::Share;
use saltus::orbits::{Exponent, MotionKind};
use saltus::study::{Counted, Survival, Transient};
use serde::{Serialize, Serializer};

/// Evidence for one attractor; what does not apply to its kind is null.
#[derive(Clone, Serialize)]
pub(super) struct Evidence {
    #[serde(serialize_with = "by_name")]
    pub(super) kind: MotionKind,
    /// Largest modulus of the Floquet multipliers of a cycle.
    pub(super) multiplier: Option<f64>,
    /// Largest Lyapunov exponent per forcing period, where it says what the motion is, and its standard error.
    pub(super) exponent: Option<f64>,
    pub(super) exponent_error: Option<f64>,
    /// Of chaos.
    pub(super) survival: Option<Watched>,
}

/// Motions watched in chaos.
#[derive(Clone, Copy, Serialize)]
pub(super) struct Watched {
    pub(super) motions: u32,
    pub(super) ended: u32,
    pub(super) periods: u64,
    /// Mean lifetime (forcing periods), low, high; null for infinite ones.
    pub(super) lifetime: [Option<f64>; 3],
}

/// Chaos that ends.
#[derive(Clone, Serialize)]
pub(super) struct Passing {
    #[serde(flatten)]
    pub(super) drawn: Share,
    #[serde(flatten)]
    pub(super) watched: Watched,
    /// Number of the attractor that most of the watched motions ended on.
    pub(super) to: usize,
}

fn by_name<S: Serializer>(kind: &MotionKind, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(kind.name())
}

impl From<&Counted> for Evidence {
    fn from(counted: &Counted) -> Self {
        let motion = &counted.entry.attractor;
        let exponent = motion.exponent.filter(|_| motion.kind.never_repeats());
        let number = |of: fn(&Exponent) -> f64| exponent.as_ref().map(of);
        Self {
            kind: motion.kind,
            multiplier: motion.multiplier,
            exponent: number(|exponent| exponent.per_iterate),
            exponent_error: number(|exponent| exponent.standard_error),
            survival: counted.survival.map(Watched::from),
        }
    }
}

impl From<Survival> for Watched {
    fn from(survival: Survival) -> Self {
        Self {
            motions: survival.motions,
            ended: survival.ended,
            periods: survival.periods,
            lifetime: survival
                .lifetime()
                .map(|periods| periods.is_finite().then_some(periods)),
        }
    }
}

impl Passing {
    /// `number` gives the number of an attractor by its place.
    pub(super) fn new(transient: &Transient, number: impl Fn(usize) -> usize) -> Self {
        Self {
            drawn: transient.fraction.into(),
            watched: transient.survival.into(),
            to: number(transient.to),
        }
    }

    pub(super) fn in_words(&self) -> String {
        let [mean, low, high] = self.watched.lifetime.map(Option::unwrap_or_default);
        format!(
            "     {} first states in chaos that ends: {} of {} motions left it, lifetime {mean:.0} periods \
             ({low:.0} to {high:.0}); counted for {}",
            self.drawn.starts, self.watched.ended, self.watched.motions, self.to
        )
    }
}

impl Evidence {
    /// Number in datasets; 0 stands for no attractor. An attractor is never undecided.
    pub(super) fn code(&self) -> u64 {
        1 + self.kind.code().min(MotionKind::NotPeriodic.code()) as u64
    }

    pub(super) fn in_words(&self) -> String {
        if let Some(multiplier) = self.multiplier {
            return format!("stable, largest multiplier {multiplier:.4}");
        }
        let exponent = self.exponent.zip(self.exponent_error);
        let exponent =
            exponent.map(|(exponent, error)| format!("exponent {exponent:.4} ± {error:.4}"));
        let survival = self.survival.map(|watched| {
            let [_, low, _] = watched.lifetime;
            format!(
                "none of {} motions left it in {} periods: lifetime above {:.0} with 95 % confidence",
                watched.motions,
                watched.periods,
                low.unwrap_or_default()
            )
        });
        let parts: Vec<String> = exponent.into_iter().chain(survival).collect();
        parts.join(", ")
    }
}
