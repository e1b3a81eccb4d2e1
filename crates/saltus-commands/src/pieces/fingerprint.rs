//! The work that pieces are of, key by key, so that a difference can be named.

use super::Job;
use super::cut::Cut;
use saltus::study::{Control, simulate};
use saltus_config::Study;
use saltus_results::Seal;
use serde_json::Value;

/// Names and values that must all be the same.
pub(super) struct Fingerprint(Vec<(String, String)>);

/// Forcing periods of the run that shows how numbers are rounded: several flights and landings.
const SHOWN: u64 = 8;

impl Fingerprint {
    pub(super) fn of<J: Job>(job: &J, cut: Cut) -> Self {
        let mut names = vec![
            ("command".to_owned(), job.command().to_owned()),
            ("saltus".to_owned(), env!("CARGO_PKG_VERSION").to_owned()),
            (J::ITEMS.to_owned(), cut.items.to_string()),
            (format!("{} in a piece", J::ITEMS), cut.size.to_string()),
        ];
        let tree = serde_json::to_value(job.study()).unwrap_or_default();
        let other = |table: &str| ["sweep", "simulate", "map", "basins"].contains(&table);
        for (table, value) in tree.as_object().into_iter().flatten() {
            if table == job.command() || !other(table) {
                flatten(table, value, &mut names);
            }
        }
        let rounding = rounding(job.study(), &Control::default());
        names.push(("rounding, as a short run shows it,".to_owned(), rounding));
        Self(names)
    }

    pub(super) fn names(&self) -> Vec<(&str, &str)> {
        let entries = self.0.iter();
        entries
            .map(|(name, value)| (name.as_str(), value.as_str()))
            .collect()
    }

    pub(super) fn seal(&self) -> Seal {
        Seal::of(&self.names())
    }
}

fn flatten(name: &str, value: &Value, out: &mut Vec<(String, String)>) {
    match value {
        Value::Object(table) => table
            .iter()
            .for_each(|(key, value)| flatten(&format!("{name}.{key}"), value, out)),
        Value::Array(items) if items.iter().any(Value::is_object) => items
            .iter()
            .enumerate()
            .for_each(|(i, value)| flatten(&format!("{name}.{i}"), value, out)),
        other => out.push((name.to_owned(), other.to_string())),
    }
}

/// The last state of a short run, bit by bit. Processors without fused multiply-adds round otherwise than those with,
/// and so may another build or mathematical library: what they would make of an item cannot be mixed. Names of
/// instruction sets would tell less, and more than matters: AVX2 and AVX-512 give the same bits.
fn rounding(study: &Study, control: &Control) -> String {
    let control = Control {
        options: saltus::hybrid::Options {
            instructions: control.options.instructions,
            ..study.options()
        },
        threads: 1,
        ..Control::default()
    };
    let shown = || {
        let model = study.setup().model().ok()?;
        let start = model.start(study.start.z, study.start.v);
        let run = simulate(&model, &start, SHOWN, 0, 1, &control).ok()?;
        let last = run.section.last()?;
        Some((last.z.first()?.to_bits(), last.v.first()?.to_bits()))
    };
    // without a model here the items may have one all the same; they are then not told apart by this
    shown().map_or("unknown".to_owned(), |(z, v)| format!("{z:016x}-{v:016x}"))
}

#[cfg(test)]
mod tests {
    use super::rounding;
    use saltus::hybrid::{Instructions, Options};
    use saltus::study::Control;
    use saltus_config::Study;

    #[test]
    fn machines_that_round_otherwise_are_told_apart_and_others_are_not() {
        let with = |instructions| {
            let options = Options {
                instructions,
                ..Options::default()
            };
            let control = Control {
                options,
                ..Control::default()
            };
            let mut study = Study::paper();
            study.plate.inertia = saltus_config::Inertia::Condensed;
            rounding(&study, &control)
        };
        let best = with(Instructions::Best);
        assert_eq!(best, with(Instructions::Avx2));
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("fma") {
            assert_ne!(best, with(Instructions::Baseline));
        }
    }
}
