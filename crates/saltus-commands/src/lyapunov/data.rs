//! Data of the answer, described once.

use super::{Found, words};
use crate::data::{about, base, each_number, whole, wholes};
use crate::quantities as q;
use crate::status;
use saltus::orbits::Exponent;
use saltus::physics::ContactLaw;
use saltus_config::Inertia;
use saltus_results::{Dataset, Table};

pub(super) fn data(found: &Found) -> Dataset {
    let (growth, how, kind) = (&found.growth, &found.how, found.verdict.kind);
    let set = about(
        "Lyapunov exponents of people on a vibrating plate",
        &found.study,
    )
    .attribute(q::STATUS.name, growth.status.name())
    .attribute(q::STATUS_TEXT.name, status::text(&growth.status, None))
    .attribute(q::NATURE.name, kind.name())
    .attribute(q::NATURE_TEXT.name, words::meaning(&found.verdict))
    .attribute(q::EXPONENTS_FROM.name, found.source())
    .variable(q::PERIOD.is(whole(kind.period().unwrap_or(0))).gap(0))
    .variable(q::CONFIDENCE.is(found.verdict.confidence))
    .variable(q::STATES.is(whole(found.model.free_states())))
    .variable(q::TRANSIENT.is(whole(how.transient)))
    .variable(q::PERIODS_ASKED.is(whole(how.periods)))
    .variable(q::REPLICAS.is(whole(how.replicas)))
    .variable(q::PERIODS_MEASURED.is(whole(growth.spectrum.iterates())));
    let set = exponents(base(set, &found.model), found);
    convergence(sums(set, found), found)
}

fn exponents(set: Dataset, found: &Found) -> Dataset {
    let over = ["exponent_number"];
    let (all, period) = (found.growth.exponents(), found.model.scales().period());
    let of = |value: &dyn Fn(&Exponent) -> f64| -> Vec<f64> { all.iter().map(value).collect() };
    set.coordinate(q::EXPONENT_NUMBER.numbered(1, all.len()))
        .variable(q::EXPONENT.over(&over, of(&|e| e.per_iterate)))
        .variable(q::EXPONENT_ERROR.over(&over, of(&|e| e.standard_error)))
        .variable(q::EXPONENT_LOW.over(&over, of(&|e| e.interval()[0])))
        .variable(q::EXPONENT_HIGH.over(&over, of(&|e| e.interval()[1])))
        .variable(q::EXPONENT_PER_SECOND.over(&over, of(&|e| e.per_iterate / period)))
        .variable(q::EXPONENT_PER_SECOND_ERROR.over(&over, of(&|e| e.standard_error / period)))
        .table(
            Table::new("exponents", &over)
                .columns(&[
                    "exponent_number",
                    "exponent",
                    "exponent_error",
                    "exponent_low",
                    "exponent_high",
                    "exponent_per_second",
                    "exponent_per_second_error",
                ])
                .in_document(),
        )
}

fn sums(set: Dataset, found: &Found) -> Dataset {
    let (sum, period) = (found.growth.sum(), found.model.scales().period());
    let (low, high) = sum.interval().into();
    let (must_agree, reason) = found.check();
    let dimension = found.growth.spectrum.kaplan_yorke();
    let dimension = dimension.map_or([f64::NAN; 2], |found| [found.value, found.standard_error]);
    set.attribute(q::DIVERGENCE_TEXT.name, reason)
        .variable(q::EXPONENT_SUM.is(sum.per_iterate))
        .variable(q::EXPONENT_SUM_ERROR.is(sum.standard_error))
        .variable(q::EXPONENT_SUM_LOW.is(low))
        .variable(q::EXPONENT_SUM_HIGH.is(high))
        .variable(q::EXPONENT_SUM_PER_SECOND.is(sum.per_iterate / period))
        .variable(q::EXPONENT_SUM_PER_SECOND_ERROR.is(sum.standard_error / period))
        .variable(q::DIVERGENCE.is(found.growth.divergence()))
        .variable(q::DIVERGENCE_MUST_AGREE.is(must_agree))
        .variable(q::DIVERGENCE_DIFFERENCE.is(found.difference().unwrap_or(f64::NAN)))
        .variable(q::KAPLAN_YORKE.is(dimension[0]))
        .variable(q::KAPLAN_YORKE_ERROR.is(dimension[1]))
}

/// The exponents from the first periods of the record, one row for each length; the last is the whole.
fn convergence(set: Dataset, found: &Found) -> Dataset {
    let over = ["periods", "exponent_number"];
    let records = &found.convergence;
    let of = |value: fn(&Exponent) -> f64| -> Vec<f64> {
        let exponents = records.iter().flat_map(|running| &running.exponents);
        exponents.map(value).collect()
    };
    let lengths = wholes(records.iter().map(|running| running.iterates));
    set.coordinate(q::RECORD_PERIODS.along(lengths))
        .variable(q::RUNNING_EXPONENT.over(&over, of(|e| e.per_iterate)))
        .variable(q::RUNNING_ERROR.over(&over, of(|e| e.standard_error)))
        .table(
            Table::new("convergence", &over[..1])
                .columns(&["periods"])
                .titled("exponent", "running_exponent")
                .titled("error", "running_error")
                .beside("exponent_number", each_number(found.how.exponents)),
        )
}

impl Found {
    /// Source of the exponents.
    pub(super) fn source(&self) -> &'static str {
        match self.growth.cycle {
            Some(_) => "orbit",
            None => "record",
        }
    }

    /// Whether the sum of the exponents must be the mean divergence of the flow, and why or why not.
    pub(super) fn check(&self) -> (bool, String) {
        let (asked, states) = (self.how.exponents, self.model.free_states());
        let relaxing = self.study.contact_law() == ContactLaw::RelaxingLeg;
        let apart = if asked < states {
            format!("only {asked} of {states} exponents are summed")
        } else if relaxing && !self.study.jumper.is_empty() {
            "a relaxing leg forgets its length at touch-down, and all volume with it".to_owned()
        } else if self.study.plate.inertia == Inertia::SlowManifold {
            "the divergence leaves out the inertia of in-plane motion".to_owned()
        } else if self.growth.sum().per_iterate.is_infinite() {
            "a direction shrinks by more than rounding can tell in one period".to_owned()
        } else {
            let agree = "all exponents are summed, and switches change no volume (Liouville)";
            return (true, agree.to_owned());
        };
        (false, apart)
    }

    /// Sum of the exponents less mean divergence, where they must agree.
    pub(super) fn difference(&self) -> Option<f64> {
        let off = self.growth.sum().per_iterate - self.growth.divergence();
        self.check().0.then_some(off)
    }
}
