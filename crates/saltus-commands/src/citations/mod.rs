//! Works that an answer rests on. The entries are in `references.bib`; `docs/references.md` has the same works,
//! and those that only tests and figures use.

use crate::request::Request;
use saltus_config::{Inertia, Method, Study};
use serde::Serialize;

const REFERENCES: &str = include_str!("references.bib");

/// A work to be cited.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct Citation {
    /// Its key in BibTeX.
    pub key: &'static str,
    /// Its entry in BibTeX.
    pub bibtex: String,
    /// Its use, as "roots of guards".
    pub why: &'static str,
}

/// Works that an answer to `request` about `study` rests on: the program, the model, and the methods that were or may have
/// been used on the way, in this order. `study` is what [`Request::study`] gives.
pub fn citations(request: &Request, study: &Study) -> Vec<Citation> {
    works(request, study, env!("CARGO_PKG_VERSION"))
}

/// As a file of BibTeX: before each entry stands what it was used for.
pub fn bibtex(works: &[Citation]) -> String {
    let entry = |work: &Citation| format!("% {}\n{}", work.why, work.bibtex);
    works.iter().map(entry).collect::<Vec<_>>().join("\n")
}

/// As [`citations`], with the `version` of the program that gave the answer.
pub(crate) fn works(request: &Request, study: &Study, version: &str) -> Vec<Citation> {
    let mut works: Vec<Citation> = Vec::new();
    for &(key, why) in methods(request, study).into_iter().flatten() {
        if works.iter().all(|known| known.key != key) {
            works.push(Citation {
                key,
                bibtex: entry(key, version),
                why,
            });
        }
    }
    works
}

/// Keys with what each is used for.
type Uses = &'static [(&'static str, &'static str)];

const ALWAYS: Uses = &[
    ("saltus", "the program"),
    ("DP", "the model of plate, people and contact"),
];
const TAYLOR: Uses = &[("JZ2005", "integration by Taylor series")];
const RK4: Uses = &[("HW1996", "integration by RK4 and its limit of stability")];
const SWITCHES: Uses = &[(
    "MRR2005",
    "take-offs and touch-downs as roots of polynomials",
)];
const SLOW_MANIFOLD: Uses = &[("Lorenz1986", "in-plane motion on a slow manifold")];
const TANGENTS: Uses = &[
    ("Mueller1995", "what a switch does to the tangent flow"),
    ("BBCK2008", "saltation matrices and grazing"),
];
const EXPONENTS: Uses = &[
    ("Benettin1980", "Lyapunov exponents from tangent columns"),
    ("FlegalJones2010", "standard errors of exponents"),
    ("Schmeiser1982", "few and long batches behind them"),
    ("VatsFlegal2022", "what batches miss of slow correlations"),
    ("Das2017", "weighted Birkhoff averages"),
    ("SanderMeiss2020", "chaos told from motion on a torus"),
];
const DIMENSION: Uses = &[("KaplanYorke1979", "dimension from the exponents")];
const ORBITS: Uses = &[(
    "Kuznetsov2004",
    "stability and bifurcations of periodic orbits",
)];
const BRANCHES: Uses = &[
    ("Keller1977", "pseudo-arclength continuation"),
    ("Nordmark1991", "orbits beyond a grazing"),
];
const STARTS: Uses = &[
    ("Sobol1967", "initial conditions spread evenly"),
    ("Burley2020", "scrambling of these"),
    ("DRW2023", "attractors followed along a parameter"),
];
const SHARES: Uses = &[
    ("Wilson1927", "confidence intervals of shares"),
    ("HanleyLippmanHand1983", "bound on basins that no start met"),
    (
        "Garwood1936",
        "confidence intervals of the lifetime of chaos",
    ),
];

fn methods(request: &Request, study: &Study) -> Vec<Uses> {
    let mut uses = vec![ALWAYS];
    if *request == Request::Frequencies {
        return uses;
    }
    uses.extend(solver(request, study));
    uses.push(SWITCHES);
    if study.plate.inertia == Inertia::SlowManifold {
        uses.push(SLOW_MANIFOLD);
    }
    let labels = |periods: u32| match periods {
        0 => vec![],
        _ => vec![TANGENTS, EXPONENTS],
    };
    let more = match request {
        Request::Frequencies | Request::Simulate => vec![],
        Request::Sweep => vec![TANGENTS, EXPONENTS],
        Request::Map => labels(study.map.as_ref().map_or(0, |table| table.exponent)),
        Request::Basins { matched: false } => {
            labels(study.basins.as_ref().map_or(0, |table| table.exponent))
        }
        Request::Basins { matched: true } => vec![TANGENTS, EXPONENTS, STARTS],
        Request::Orbit => vec![TANGENTS, ORBITS],
        Request::Continue { .. } => vec![TANGENTS, ORBITS, BRANCHES],
        Request::Lyapunov => vec![TANGENTS, EXPONENTS, DIMENSION],
        Request::Attractors => vec![TANGENTS, EXPONENTS, ORBITS, STARTS, SHARES],
        Request::Reproduce { .. } => vec![TANGENTS, EXPONENTS, ORBITS, BRANCHES],
    };
    uses.extend(more);
    uses
}

/// Orbits are solved for by series, whatever the method on the way to them.
fn solver(request: &Request, study: &Study) -> Vec<Uses> {
    let orbits = matches!(request, Request::Orbit | Request::Continue { .. });
    match study.solver.method {
        Method::Taylor => vec![TAYLOR],
        Method::Rk4 if orbits => vec![RK4, TAYLOR],
        Method::Rk4 => vec![RK4],
    }
}

/// The entry of a key, which ends where the next one begins.
fn entry(key: &str, version: &str) -> String {
    let has_key = |entry: &&str| {
        let rest = entry.split_once('{').map(|(_, rest)| rest);
        rest.is_some_and(|rest| rest.split(',').next() == Some(key))
    };
    let found = REFERENCES.split("\n\n").find(has_key).unwrap_or_default();
    let entry = found.trim_end().replace("VERSION", version);
    format!("{entry}\n")
}

#[cfg(test)]
mod tests;
