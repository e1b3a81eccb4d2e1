//! The findings as text, Markdown and JSON. No times and no machine: equal input gives equal bits.

use saltus_paper::{Bound, Edge};
use saltus_results::MarkdownTable;
use serde::Serialize;

use super::Results;
use crate::kinds;

/// `facts.json`.
#[derive(Serialize)]
pub(super) struct Report {
    program: &'static str,
    version: &'static str,
    paper: &'static str,
    /// Whether it is a quick look: fewer values and periods, so that it may miss what is narrow.
    pub(super) quick: bool,
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
    pub(super) period: usize,
    pub(super) from: f64,
    /// Event at that end.
    pub(super) from_is: String,
    pub(super) to: f64,
    pub(super) to_is: String,
}

/// Remark on a quick look.
pub(super) const QUICK: &str = "A quick look (--quick): coarse grids, short runs, doublings up to 8T. It may miss \
                                what is narrower than its step; without --quick everything is finer.";

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
        let contact =
            |row: &saltus_paper::InertiaRow| (row.contact_ratio.0 - row.contact_ratio.1).abs();
        Self {
            program: "saltus",
            version: env!("CARGO_PKG_VERSION"),
            paper: "Dias & Del Prado, Human-Structure Interaction during jumping on Rectangular Plates",
            quick: results.quick,
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
        if self.quick {
            out += &format!("{QUICK}\n\n");
        }
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
            facts = facts.row(&[f.id, &f.claim, &f.value, f.verdict, &f.reading]);
        }
        let mut misprints = MarkdownTable::new(&["Where", "Printed", "Used here", "Effect"]);
        for m in &self.misprints {
            misprints = misprints.row(&[&m.place, &m.printed, &m.used, &m.effect]);
        }
        let quick = if self.quick {
            format!("{QUICK}\n\n")
        } else {
            String::new()
        };
        format!(
            "# {}\n\n{quick}## Facts\n\n{facts}\n## Misprints and gaps\n\n{misprints}",
            self.paper
        )
    }
}

impl CaseRow {
    fn new(result: &saltus_paper::CaseResult) -> Self {
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
    let is = |bound: &Bound| match &bound.at {
        Edge::Range => "end of the range".to_owned(),
        Edge::Special(kind) => kinds::name(kind).to_owned(),
        Edge::Lost(why) => why.clone(),
    };
    let panels = results.diagrams.iter().zip(&results.branches);
    let rows = panels.flat_map(|(diagram, panel)| {
        panel.stretches.iter().map(|one| RegimeRow {
            law: panel.law.name(),
            reference: panel.reference.name(),
            frequency_ratio: panel.ratio,
            base_hz: diagram.hertz,
            period: one.period,
            from: one.from.damping_ratio,
            from_is: is(&one.from),
            to: one.to.damping_ratio,
            to_is: is(&one.to),
        })
    });
    rows.collect()
}
