//! The manifest of a result: question, model, methods, and their accuracy.
//!
//! Equal questions give equal answers on equal arithmetic: no time and no name of a machine.

use crate::citations::citations;
use crate::request::Request;
use saltus::hybrid::{Method, Options};
use saltus::study::ORBIT_METHOD;
use saltus_config::{Inertia, Study};
use serde_json::{Value, json};

/// For the manifest of a result of `request` about `study`, which is what [`Request::study`] gives.
///
/// `accuracy` is a list of sentences, each with its source within the project: what is known of the error of these
/// methods, not a bound on the error of this result.
pub fn about(request: &Request, study: &Study) -> Value {
    let options = study.options();
    let integrates = *request != Request::Frequencies;
    let keys = citations(request, study).into_iter().map(|work| work.key);
    json!({
        "request": request,
        "study_sha256": study.hash(),
        "version": env!("CARGO_PKG_VERSION"),
        "model": model(study),
        "method": integrates.then(|| method(&options.method)),
        "method_of_orbits": solves(request).then(|| method(&ORBIT_METHOD)),
        "accuracy": accuracy(request, study, &options),
        "arithmetic": arithmetic(&options),
        "citations": keys.collect::<Vec<_>>(),
    })
}

/// Whether orbits are solved for, which has a tolerance of its own.
pub(crate) fn solves(request: &Request) -> bool {
    use Request::{Continue, Orbit, Reproduce};
    matches!(request, Orbit | Continue { .. } | Reproduce { .. })
}

fn model(study: &Study) -> Value {
    let modes = &study.plate().modes;
    let in_plane = match study.plate.inertia {
        Inertia::Full => modes.u.len() + modes.v.len(),
        Inertia::SlowManifold | Inertia::Condensed => 0,
    };
    json!({
        "contact_law": study.contact.law,
        "inertia": study.plate.inertia,
        "terms": { "u": modes.u.len(), "v": modes.v.len(), "w": modes.w.len() },
        "jumpers": study.jumper.len(),
        "degrees_of_freedom": modes.w.len() + in_plane + study.jumper.len(),
    })
}

fn method(method: &Method) -> Value {
    match method {
        Method::Taylor { tolerance, order } => {
            json!({ "name": "taylor", "order": order, "tolerance": tolerance })
        }
        Method::Rk4 { steps_per_period } => {
            json!({ "name": "rk4", "order": 4, "steps_per_period": steps_per_period })
        }
    }
}

/// Arithmetic, which decides over the last digits beside the version: a result of another kind of machine need not have the same
/// bits.
fn arithmetic(options: &Options) -> Value {
    let fused = options.instructions.fused();
    json!({
        "architecture": std::env::consts::ARCH,
        "multiply_adds": if fused { "rounded once" } else { "rounded twice" },
    })
}

fn accuracy(request: &Request, study: &Study, options: &Options) -> Vec<Value> {
    let mut known = vec![PLATE];
    if *request != Request::Frequencies {
        known.push(match options.method {
            Method::Taylor { .. } => TAYLOR,
            Method::Rk4 { .. } => RK4,
        });
        known.push(CHAOS);
        match study.plate.inertia {
            Inertia::Full => {}
            Inertia::SlowManifold => known.push(SLOW_MANIFOLD),
            Inertia::Condensed => known.push(CONDENSED),
        }
    }
    if solves(request) {
        known.push(SPECIAL_POINTS);
    }
    if matches!(request, Request::Lyapunov | Request::Sweep) {
        known.push(EXPONENTS);
    }
    if *request == Request::Attractors {
        known.push(SHARES);
    }
    if matches!(request, Request::Reproduce { .. }) {
        known.extend([DIAGRAMS, CONDENSED]);
    }
    let statement = |(what, source): Known| json!({ "statement": what, "source": source });
    known.into_iter().map(statement).collect()
}

/// A statement and its source.
type Known = (&'static str, &'static str);

const PLATE: Known = (
    "The plate is a finite sum of sines, so it is slightly too stiff.",
    "README.md",
);
const TAYLOR: Known = (
    "At the tolerance 1e-10 twenty forcing periods of the paper's person agree with an independent program to \
     2e-9; at other tolerances the error follows the tolerance.",
    "crates/saltus/tests/main/independent.rs, crates/saltus-hybrid/tests/convergence.rs",
);
const RK4: Known = (
    "The error falls sixteenfold when the step halves, across switches too.",
    "crates/saltus-hybrid/tests/convergence.rs",
);
const CHAOS: Known = (
    "A chaotic motion is one of many: the smallest error grows until only its statistics mean anything.",
    "README.md",
);
const SLOW_MANIFOLD: Known = (
    "After twenty forcing periods of the paper's person the slow manifold is 2e-10 from the model with full in-plane \
     inertia at the frequency ratio 0.9, and 2e-9 at 1.1, in plate thicknesses.",
    "crates/saltus/tests/main/slow_manifold.rs",
);
const CONDENSED: Known = (
    "After twenty forcing periods of the paper's person the condensed model is 3e-5 from the model with full in-plane \
     inertia at the frequency ratio 0.9, and 7e-4 at 1.1, in plate thicknesses.",
    "crates/saltus/tests/main/slow_manifold.rs",
);
const SPECIAL_POINTS: Known = (
    "Special points of the paper's branches agree with a second method to 1e-9 in the damping ratio, folds to 3e-9, two \
     folds next to other special points to 2e-8.",
    "docs/benchmarks.md",
);
const EXPONENTS: Known = (
    "Exponents come with standard errors of their own.",
    "crates/saltus-orbits/src/exponents/batches.rs",
);
const SHARES: Known = (
    "Shares come with 95 % confidence intervals of their own.",
    "crates/saltus-study/src/fraction.rs",
);
const DIAGRAMS: Known = (
    "Diagrams are integrated at the tolerance 1e-7, with errors near 1e-6 after 20 periods.",
    "crates/saltus-commands/src/reproduce/mod.rs",
);

#[cfg(test)]
mod tests {
    use super::about;
    use crate::request::Request;
    use saltus_config::Study;

    #[test]
    fn a_result_says_what_it_is_and_says_it_again() {
        let mut study = crate::reproduce::study();
        let told = about(&Request::Simulate, &study);
        assert_eq!(told, about(&Request::Simulate, &study));
        assert_eq!(told["request"]["command"], "simulate");
        assert_eq!(told["study_sha256"], study.hash());
        // DP: 16 terms and one person
        assert_eq!(told["model"]["degrees_of_freedom"], 17);
        assert_eq!(told["model"]["contact_law"], "reaction-force");
        assert_eq!(told["method"]["tolerance"], 1e-10);
        assert_eq!(told["method_of_orbits"], serde_json::Value::Null);
        assert_eq!(told["citations"][0], "saltus");
        study.plate.inertia = saltus_config::Inertia::Condensed;
        let told = about(&Request::Orbit, &study);
        assert_eq!(told["model"]["degrees_of_freedom"], 5);
        assert_eq!(told["method_of_orbits"]["tolerance"], 1e-13);
        assert_eq!(
            about(&Request::Frequencies, &study)["method"],
            serde_json::Value::Null
        );
    }

    #[cfg(unix)]
    #[test]
    fn a_path_that_is_no_text_is_told_as_far_as_it_is() {
        use std::os::unix::ffi::OsStringExt;
        let from = std::ffi::OsString::from_vec(b"old\xff".to_vec()).into();
        let at = "PD1".to_owned();
        let origin = Some(crate::continuation::Labelled { from, at });
        let told = about(&Request::Continue { origin, over: None }, &Study::paper());
        assert_eq!(told["request"]["origin"]["from"], "old\u{fffd}");
    }

    #[test]
    fn the_source_of_a_statement_exists() {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let requests = [
            Request::Orbit,
            Request::Attractors,
            Request::Lyapunov,
            Request::Reproduce { quick: true },
        ];
        let inertias = [
            saltus_config::Inertia::SlowManifold,
            saltus_config::Inertia::Condensed,
        ];
        for (request, inertia) in requests.iter().flat_map(|r| inertias.map(|i| (r, i))) {
            let mut study = Study::paper();
            study.plate.inertia = inertia;
            let told = about(request, &study);
            for known in told["accuracy"].as_array().expect("a list") {
                for source in known["source"].as_str().expect("a text").split(", ") {
                    assert!(root.join(source).is_file(), "{source}");
                }
            }
        }
    }
}
