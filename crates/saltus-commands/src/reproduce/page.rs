//! The result folder: figures, tables and the page that shows them.

use saltus::physics::FrequencyReference::{Free, Occupied};
use saltus_paper::Verdict;
use saltus_results::{Fact, Page, Verdict as Badge};

use super::album::Album;
use super::data::came_to;
use super::facts::{QUICK, RegimeRow, Report};
use super::{Results, branches, figures};
use crate::failure::CommandError;
use crate::store::Store;

/// Fills the folder.
pub(super) fn write(
    folder: &mut dyn Store,
    results: &Results,
    report: &Report,
) -> Result<(), CommandError> {
    folder.text("facts.md", &report.markdown())?;
    let mut album = Album {
        folder,
        page: Page::new("Dias & Del Prado, reproduced"),
    };
    album.say(&[
        "A person on a vibrating plate jumps, lands and jumps again: what can the motion do in the long \
         run? This page repeats every figure and statement of Dias & Del Prado, Human-Structure \
         Interaction during jumping on Rectangular Plates, with our numbers beside their words.",
    ]);
    if results.quick {
        album.say(&[QUICK]);
    }
    let verdict = verdict(results);
    album.with(|page| page.lead(&verdict));
    fig2(&mut album, results)?;
    statements(&mut album, results, report);
    branches::write(&mut album, results)?;
    fig3(&mut album, results)?;
    ambiguities(&mut album, results, report)?;
    beyond(&mut album, results, report)?;
    method(&mut album, results);
    let Album { folder, page } = album;
    folder.text("index.html", &page.render())
}

/// All verdicts in a line.
fn verdict(results: &Results) -> String {
    let count = |verdict: Verdict| {
        let its = results.facts.iter().filter(|fact| fact.verdict == verdict);
        its.count()
    };
    let all = results.facts.len();
    let mut line = format!(
        "{} of {all} statements of the paper are reproduced",
        count(Verdict::Reproduced)
    );
    for (verdict, words) in [
        (Verdict::Departure, "with a departure"),
        (Verdict::NotReproduced, "not reproduced"),
    ] {
        if count(verdict) > 0 {
            line += &format!(", {} {words}", count(verdict));
        }
    }
    line + "."
}

fn statements(album: &mut Album<'_>, results: &Results, report: &Report) {
    album.section("Statement by statement");
    let facts: Vec<Fact> = results
        .facts
        .iter()
        .zip(&report.facts)
        .map(|(fact, row)| Fact {
            name: row.id.into(),
            claim: row.claim.clone(),
            value: row.value.clone(),
            verdict: match fact.verdict {
                Verdict::Reproduced => Badge::Reproduced,
                Verdict::Departure => Badge::Departure,
                Verdict::NotReproduced => Badge::NotReproduced,
            },
            reading: row.reading.clone(),
        })
        .collect();
    album.with(|page| {
        page.facts(&facts)
            .files([("facts.json", "facts.json"), ("facts.md", "facts.md")])
    });
}

fn fig2(album: &mut Album<'_>, results: &Results) -> Result<(), CommandError> {
    album.section("The paper's Fig. 2: bifurcation diagrams");
    let effort = &results.effort;
    let caption = format!(
        "Height of the body once per forcing period against its damping ratio, {} values, {} periods kept \
         after {}. Black: rising sweep, which carries the state on. In colour, where they lead elsewhere: the falling sweep, \
         and runs that start anew at each value with the plate at rest. There attractors coexist, or transients are \
         long: {}.",
        effort.values,
        effort.record,
        effort.transient,
        came_to(results)
    );
    let data = [
        ("a", "fig2a.csv"),
        ("b", "fig2b.csv"),
        ("c", "fig2c.csv"),
        ("NetCDF", "fig2.nc"),
        ("what each motion came to", "sweeps.csv"),
    ];
    album.show("fig2", &figures::fig2(results, Occupied), &caption, &data)
}

fn fig3(album: &mut Album<'_>, results: &Results) -> Result<(), CommandError> {
    album.section("The paper's Fig. 3: the named motions");
    album.say(&[
        "The paper gives the damping ratio of (e), (f) and (g); the others are chosen inside the regime it \
         names: 0.15 and 0.35 in (a) and (b), 0.12 and 0.21 in (c) and (d), 0.45 in (h).",
    ]);
    let caption = "Phase portraits of the settled motion, flights in another colour, with the stroboscopic \
                   points. λ is the largest Lyapunov exponent where the points do not repeat.";
    album.show(
        "fig3",
        &figures::portraits(results),
        caption,
        &[("data", "fig3.csv")],
    )?;
    let rows: Vec<Vec<String>> = results
        .cases
        .iter()
        .map(|result| {
            vec![
                format!("3{}", result.case.tag),
                format!("{:.1}", result.case.ratio),
                format!(
                    "{:.2}{}",
                    result.case.damping_ratio,
                    if result.case.given { "" } else { " (ours)" }
                ),
                result.case.paper.into(),
                result.words(),
                format!("{:.3}", result.contact_ratio),
                format!("{:.2}", result.peak_force),
            ]
        })
        .collect();
    let header = [
        "Panel",
        "Ω/ω_h",
        "ζ_h",
        "Paper",
        "Ours",
        "Contact ratio",
        "Peak PRF/(m_h g)",
    ];
    album.with(|page| page.table(&header, rows));
    let caption = "The force between feet and plate over eight forcing periods, in body weights. Shaded: in \
                   flight, where it is zero.";
    album.show("fig3-forces", &figures::forces(results), caption, &[])
}

fn ambiguities(
    album: &mut Album<'_>,
    results: &Results,
    report: &Report,
) -> Result<(), CommandError> {
    album.section("Where the paper is ambiguous");
    album.say(&[
        "The paper drives the plate at 0.9, 1.0 and 1.1 ω_h without saying which ω_h: that of the body \
         on the flexible plate (occupied, 2.5373 Hz) or on rigid ground (free, 2.4794 Hz). The figure above \
         takes the first; here is the second.",
    ]);
    let caption = "Fig. 2 again, with ω_h the body's frequency on rigid ground: the thresholds move, and \
                   what the paper says at 0.32 and 0.36 no longer holds.";
    album.show(
        "fig2-free",
        &figures::fig2(results, Free),
        caption,
        &[("regimes", "regimes.csv")],
    )?;
    album.with(|page| {
        let rows = report
            .misprints
            .iter()
            .map(|m| [&m.place, &m.printed, &m.used, &m.effect].map(String::as_str));
        page.details(
            "Misprints and gaps, with the size of their effect",
            |page| page.table(&["Where", "Printed", "Used here", "Effect"], rows),
        )
    });
    Ok(())
}

fn beyond(album: &mut Album<'_>, results: &Results, report: &Report) -> Result<(), CommandError> {
    album.section("Beyond the paper");
    album.say(&[
        "When do feet touch the floor? The paper lets contact begin as soon as the reaction force would be \
         positive (reaction-force), which with a damped leg is while the foot is still in the air. A leg that \
         returns to its natural length in flight (gap), or one that relaxes towards it (relaxing-leg), lands \
         later.",
    ]);
    let caption =
        "Fig. 2 under three contact laws. The sequences are the same; the thresholds shift.";
    album.show(
        "fig2-laws",
        &figures::laws(results),
        caption,
        &[("regimes", "regimes.csv")],
    )?;
    let rows: Vec<Vec<String>> = law_rows(&report.regimes);
    album.with(|page| {
        let title = "Stable cycles under each law, where they are stable over 0.02 or more";
        page.details(title, |page| {
            page.table(&["Ω/ω_h", "Law", "Stable cycles (ζ_h)"], rows)
                .files([("all of them", "regimes.csv")])
        })
    });
    let i = &report.full_against_condensed;
    let caption = format!(
        "All 17 degrees of freedom (in-plane modes at 253 to 1344 Hz) against 5, the in-plane motion following \
         statically. Of {} motions from the same start {} end on the same periodic attractor, at most {:.1e} η \
         apart. The others are chaotic, or a chaotic transient took them to another attractor; all contact \
         ratios differ by at most {:.3}.",
        i.compared, i.periodic, i.largest_difference_eta, i.largest_contact_ratio_difference
    );
    let data = [("data", "full-condensed.csv")];
    album.show(
        "full-condensed",
        &figures::inertia(results),
        &caption,
        &data,
    )
}

/// For each law the cycles that are stable over at least 0.02, by falling damping.
fn law_rows(regimes: &[RegimeRow]) -> Vec<Vec<String>> {
    let mut out: Vec<Vec<String>> = Vec::new();
    let wide = |r: &&RegimeRow| r.reference == "occupied" && r.to - r.from >= 0.02;
    for regime in regimes.iter().filter(wide) {
        let stretch = format!("{}T {:.5}-{:.5}", regime.period, regime.from, regime.to);
        let ratio = format!("{:.1}", regime.frequency_ratio);
        match out
            .iter_mut()
            .find(|row| row[0] == ratio && row[1] == regime.law)
        {
            Some(row) => row[2] += &format!(", {stretch}"),
            None => out.push(vec![ratio, regime.law.into(), stretch]),
        }
    }
    out.sort_by(|a, b| a[0].cmp(&b[0]));
    out
}

fn method(album: &mut Album<'_>, results: &Results) {
    album.section("How it was computed");
    let effort = &results.effort;
    let solver = "Taylor series with adaptive steps; take-off and touch-down located to rounding. The diagrams \
                  allow 1e-7 of the plate thickness per step, the named motions 1e-10. The paper's Figs. 2 and 3 use the \
                  condensed model.";
    let exponents = format!(
        "Exponents: the tangent flow over {} periods, standard errors from batches long enough to be independent.",
        effort.exponent_periods
    );
    let version = format!("saltus {}", env!("CARGO_PKG_VERSION"));
    album.with(|page| {
        page.list([solver, exponents.as_str(), version.as_str()])
            .paragraph("Repeat it, or change it:")
            .code("saltus reproduce\nsaltus init paper --out paper.toml\nsaltus sweep paper.toml --out sweep")
            .files([("study.toml (the paper's case)", "study.toml")])
    });
}
