//! The findings as text, Markdown and JSON. No times and no machine: equal input gives equal bits.

use saltus::study::paper::{RATIOS, regimes};
use saltus_results::{MarkdownTable, Value};
use serde::Serialize;

use super::Results;

/// `facts.json`.
#[derive(Serialize)]
pub(super) struct Report {
    program: &'static str,
    version: &'static str,
    paper: &'static str,
    pub(super) facts: Vec<FactRow>,
    pub(super) misprints: Vec<MisprintRow>,
    pub(super) full_against_condensed: Inertia,
    cases: Vec<CaseRow>,
    pub(super) regimes: Vec<RegimeRow>,
}

#[derive(Serialize)]
pub(super) struct FactRow {
    pub(super) id: &'static str,
    pub(super) claim: String,
    pub(super) value: String,
    pub(super) verdict: &'static str,
    pub(super) reading: String,
}

#[derive(Serialize)]
pub(super) struct MisprintRow {
    pub(super) place: String,
    pub(super) printed: String,
    pub(super) used: String,
    pub(super) effect: String,
}

#[derive(Serialize)]
pub(super) struct Inertia {
    /// Motions compared.
    pub(super) compared: usize,
    /// On the same periodic attractor in both models.
    pub(super) periodic: usize,
    /// Largest difference of these, in eta.
    pub(super) largest_difference_eta: f64,
    /// Largest difference of the contact ratios of all.
    pub(super) largest_contact_ratio_difference: f64,
}

#[derive(Serialize)]
struct CaseRow {
    figure: String,
    frequency_ratio: f64,
    damping_ratio: f64,
    given_in_paper: bool,
    paper: &'static str,
    ours: String,
    period: Option<u32>,
    exponent_per_period: f64,
    exponent_standard_error: f64,
    confidence: f64,
    contact_ratio: f64,
    peak_force_weights: f64,
}

#[derive(Serialize)]
pub(super) struct RegimeRow {
    pub(super) law: &'static str,
    pub(super) reference: &'static str,
    pub(super) frequency_ratio: f64,
    pub(super) base_hz: f64,
    /// "up" or "down".
    pub(super) sweep: &'static str,
    /// `null`: the samples do not repeat.
    pub(super) period: Option<u32>,
    pub(super) from: f64,
    pub(super) to: f64,
}

/// Symbols for the names that plain text gives them.
pub(super) fn symbols(text: &str) -> String {
    [
        ("omega_h", "ω_h"),
        ("zeta_h", "ζ_h"),
        ("Omega", "Ω"),
        ("psi", "ψ"),
        (" eta", " η"),
        ("+-", "±"),
    ]
    .into_iter()
    .fold(text.to_owned(), |text, (name, symbol)| {
        text.replace(name, symbol)
    })
}

impl Report {
    pub(super) fn new(results: &Results) -> Self {
        let contact = |row: &saltus::study::paper::InertiaRow| {
            (row.contact_ratio.0 - row.contact_ratio.1).abs()
        };
        Self {
            program: "saltus",
            version: env!("CARGO_PKG_VERSION"),
            paper: "Dias & Del Prado, Human-Structure Interaction during jumping on Rectangular Plates",
            facts: results
                .facts
                .iter()
                .map(|fact| FactRow {
                    id: fact.id,
                    claim: symbols(fact.claim),
                    value: symbols(&fact.value),
                    verdict: fact.verdict.words(),
                    reading: symbols(&fact.reading),
                })
                .collect(),
            misprints: results
                .misprints
                .iter()
                .map(|m| MisprintRow {
                    place: symbols(m.place),
                    printed: symbols(m.printed),
                    used: symbols(m.used),
                    effect: symbols(&m.effect),
                })
                .collect(),
            full_against_condensed: Inertia {
                compared: results.inertia.rows.len(),
                periodic: results.inertia.periodic,
                largest_difference_eta: results.inertia.largest,
                largest_contact_ratio_difference: results
                    .inertia
                    .rows
                    .iter()
                    .map(contact)
                    .fold(0.0, f64::max),
            },
            cases: results.cases.iter().map(CaseRow::new).collect(),
            regimes: regime_rows(results),
        }
    }

    /// The table of facts for a terminal.
    pub(super) fn text(&self) -> String {
        let mut out = String::from("Dias & Del Prado, statement by statement\n\n");
        for fact in &self.facts {
            out += &format!("{}  {}\n", fact.id, fact.claim);
            out += &format!(
                "    ours:    {}\n    verdict: {}\n",
                fact.value, fact.verdict
            );
            out += &format!("    reading: {}\n", fact.reading);
        }
        let i = &self.full_against_condensed;
        out += &format!(
            "\nFull against condensed model: {} of {} motions on the same periodic attractor, at most {:.1e} eta apart\n",
            i.periodic, i.compared, i.largest_difference_eta
        );
        out
    }

    /// `facts.md`.
    pub(super) fn markdown(&self) -> String {
        let mut facts = MarkdownTable::new(&["", "Claim", "Ours", "Verdict", "Reading"]);
        for f in &self.facts {
            facts = facts.row([f.id, &f.claim, &f.value, f.verdict, &f.reading].map(Value::from));
        }
        let mut misprints = MarkdownTable::new(&["Where", "Printed", "Used here", "Effect"]);
        for m in &self.misprints {
            misprints = misprints.row(
                [&m.place, &m.printed, &m.used, &m.effect].map(|text| Value::from(text.as_str())),
            );
        }
        format!(
            "# {}\n\n## Facts\n\n{facts}\n## Misprints and gaps\n\n{misprints}",
            self.paper
        )
    }
}

impl CaseRow {
    fn new(result: &saltus::study::paper::CaseResult) -> Self {
        let case = result.case;
        Self {
            figure: format!("3{}", case.tag),
            frequency_ratio: case.ratio,
            damping_ratio: case.damping_ratio,
            given_in_paper: case.given,
            paper: case.paper,
            ours: result.words(),
            period: result.recurrence,
            exponent_per_period: result.verdict.exponent.per_iterate,
            exponent_standard_error: result.verdict.exponent.standard_error,
            confidence: result.verdict.confidence,
            contact_ratio: result.contact_ratio,
            peak_force_weights: result.peak_force,
        }
    }
}

fn regime_rows(results: &Results) -> Vec<RegimeRow> {
    let mut out = Vec::new();
    for ratio in RATIOS {
        for diagram in results.diagrams.iter().filter(|d| d.ratio == ratio) {
            for (pass, sweep) in [(0, "up"), (1, "down")] {
                out.extend(regimes(diagram, pass).into_iter().map(|regime| RegimeRow {
                    law: diagram.law.name(),
                    reference: diagram.reference.name(),
                    frequency_ratio: ratio,
                    base_hz: diagram.hertz,
                    sweep,
                    period: regime.period,
                    from: regime.from,
                    to: regime.to,
                }));
            }
        }
    }
    out
}
