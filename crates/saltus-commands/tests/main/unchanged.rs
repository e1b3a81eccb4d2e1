//! Two small results that are kept beside this file, asked again: a change of what a command writes is seen here, and
//! said. If it is meant, write the folder anew (`saltus rerun tests/data/sweep --out NEW` shows every difference) and
//! put it into CHANGELOG.md.

use saltus_commands::{RunContext, SavedResult};
use saltus_results::compare::Outcome;
use std::path::Path;

#[test]
fn kept_results_come_out_again_to_the_bit() {
    for name in ["attractors", "sweep"] {
        let kept = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("tests/data")
            .join(name);
        let out = tempfile::tempdir().unwrap();
        let saved = SavedResult::open(&kept).unwrap();
        let again = saved
            .rerun(Some(&out.path().join("again")), &RunContext::default())
            .unwrap();
        // another processor rounds otherwise, and then the numbers of a few periods differ in their last digits
        let rounds_alike = again.reasons.iter().all(|why| !why.contains("computed on"));
        assert!(
            again.identical || !rounds_alike,
            "{name}: {}",
            again.comparison.text()
        );
        let files = again.comparison.files.iter();
        for file in files {
            let there = !matches!(file.outcome, Outcome::Missing | Outcome::Extra);
            assert!(there, "{name}: {}", file.name);
        }
    }
}
