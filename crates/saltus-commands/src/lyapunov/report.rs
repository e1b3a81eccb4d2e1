//! The JSON document of exponents.

use super::{Run, words};
use crate::status;
use saltus::orbits::Exponent;
use saltus::physics::ContactLaw;
use saltus_config::{Inertia, Study};
use serde::Serialize;
use std::f64::consts::TAU;

/// The document; `saltus lyapunov --help` explains each key.
#[derive(Serialize)]
pub(super) struct Report<'a> {
    version: &'static str,
    status: &'static str,
    pub(super) status_text: String,
    pub(super) base_hz: f64,
    pub(super) period_s: f64,
    states: usize,
    pub(super) transient: u64,
    pub(super) periods: u64,
    pub(super) replicas: usize,
    pub(super) periods_measured: usize,
    pub(super) nature: Motion,
    pub(super) from: &'static str,
    pub(super) exponents: Vec<Rate>,
    pub(super) sum: Rate,
    pub(super) divergence: Divergence,
    pub(super) kaplan_yorke: Option<Dimension>,
    study: &'a Study,
}

/// What the motion is.
#[derive(Serialize)]
pub(super) struct Motion {
    pub(super) name: &'static str,
    /// Forcing periods; null if not periodic.
    period: Option<u32>,
    pub(super) confidence: f64,
    pub(super) text: String,
}

/// An exponent or a sum of some; JSON has no -inf and no inf, so they are null.
#[derive(Serialize)]
pub(super) struct Rate {
    pub(super) per_period: f64,
    pub(super) standard_error: f64,
    /// Holds the true value with a probability of 0.95.
    pub(super) interval: [f64; 2],
    pub(super) per_second: f64,
    pub(super) per_second_error: f64,
}

/// The mean divergence of the flow, which the sum of all exponents must give.
#[derive(Serialize)]
pub(super) struct Divergence {
    pub(super) per_period: f64,
    pub(super) must_agree: bool,
    pub(super) reason: String,
    /// Sum less divergence; null where they need not agree.
    pub(super) difference: Option<f64>,
}

#[derive(Serialize)]
pub(super) struct Dimension {
    pub(super) value: f64,
    pub(super) standard_error: f64,
}

impl<'a> Report<'a> {
    pub(super) fn new(run: &'a Run) -> Self {
        let (spectrum, scales) = (&run.growth.spectrum, run.model.scales());
        let rate = |exponent: Exponent| Rate::new(&exponent, scales.period());
        let dimension = spectrum.kaplan_yorke().map(|found| Dimension {
            value: found.value,
            standard_error: found.standard_error,
        });
        Self {
            version: env!("CARGO_PKG_VERSION"),
            status: run.growth.status.name(),
            status_text: status::text(&run.growth.status, None),
            base_hz: scales.omega / TAU,
            period_s: scales.period(),
            states: run.model.free_states(),
            transient: run.how.transient,
            periods: run.how.periods,
            replicas: run.how.replicas,
            periods_measured: spectrum.iterates(),
            nature: Motion::new(run),
            from: match run.growth.cycle {
                Some(_) => "orbit",
                None => "record",
            },
            exponents: run.growth.exponents().into_iter().map(rate).collect(),
            sum: rate(run.growth.sum()),
            divergence: Divergence::new(run),
            kaplan_yorke: dimension,
            study: &run.study,
        }
    }
}

impl Motion {
    fn new(run: &Run) -> Self {
        let kind = run.verdict.kind;
        Self {
            name: kind.name(),
            period: kind.period(),
            confidence: run.verdict.confidence,
            text: words::meaning(&run.verdict),
        }
    }
}

impl Rate {
    fn new(exponent: &Exponent, period: f64) -> Self {
        Self {
            per_period: exponent.per_iterate,
            standard_error: exponent.standard_error,
            interval: exponent.interval(),
            per_second: exponent.per_iterate / period,
            per_second_error: exponent.standard_error / period,
        }
    }
}

impl Divergence {
    fn new(run: &Run) -> Self {
        let (asked, states) = (run.how.exponents, run.model.free_states());
        let (sum, mean) = (run.growth.sum().per_iterate, run.growth.divergence());
        let relaxing = run.study.contact_law() == ContactLaw::RelaxingLeg;
        let apart = if asked < states {
            Some(format!("only {asked} of {states} exponents are summed"))
        } else if relaxing && !run.study.jumper.is_empty() {
            Some("a relaxing leg forgets its length at touch-down, and all volume with it".into())
        } else if run.study.plate.inertia == Inertia::SlowManifold {
            Some("the divergence leaves out the inertia of in-plane motion".into())
        } else if sum.is_infinite() {
            Some("a direction shrinks by more than rounding can tell in one period".into())
        } else {
            None
        };
        Self {
            per_period: mean,
            must_agree: apart.is_none(),
            difference: apart.is_none().then_some(sum - mean),
            reason: apart.unwrap_or_else(|| {
                "all exponents are summed, and switches change no volume (Liouville)".into()
            }),
        }
    }
}
