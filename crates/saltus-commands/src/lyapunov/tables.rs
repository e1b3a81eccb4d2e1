//! The table of convergence.

use super::Run;
use crate::failure::Failure;
use crate::store::Store;
use saltus::orbits::Running;
use saltus_results::Value;

/// One line per length of record, the last one the whole.
pub(super) fn write(
    folder: &mut dyn Store,
    run: &Run,
    convergence: &[Running],
) -> Result<(), Failure> {
    let replicas = run.how.replicas.to_string();
    let settings = [
        ("saltus", env!("CARGO_PKG_VERSION")),
        ("study", "study.toml"),
        ("replicas", replicas.as_str()),
        ("periods", "forcing periods of each replica so far"),
        (
            "exponent_k",
            "mean growth per forcing period (natural logarithm), the largest first",
        ),
        (
            "error_k",
            "its standard error; inf while the record is too short for one",
        ),
    ];
    let pairs =
        (1..=run.how.exponents).flat_map(|k| [format!("exponent_{k}"), format!("error_{k}")]);
    let header: Vec<String> = std::iter::once("periods".to_owned()).chain(pairs).collect();
    let row = |running: &Running| {
        let pairs = running
            .exponents
            .iter()
            .flat_map(|e| [e.per_iterate, e.standard_error]);
        let periods = Value::Integer(running.iterates as i64);
        std::iter::once(periods)
            .chain(pairs.map(Value::from))
            .collect()
    };
    folder.table(
        "convergence.csv",
        &settings,
        &header,
        convergence.iter().map(row),
    )
}
