//! The numbers behind the figures as CSV.

use saltus::study::Pass;
use saltus_paper::{Diagram, Met, PanelBranches};
use saltus_results::Value;

use super::Results;
use super::report::Report;
use crate::failure::Failure;
use crate::store::Store;

pub(super) fn header(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.to_owned()).collect()
}

/// Writes all tables.
pub(super) fn write(
    folder: &mut dyn Store,
    results: &Results,
    report: &Report,
) -> Result<(), Failure> {
    regimes(folder, results, report)?;
    sweeps(folder, results)?;
    fig2(folder, results)?;
    fig3(folder, results)?;
    inertia(folder, results)
}

/// Where which cycle is stable, under every law and both readings.
fn regimes(folder: &mut dyn Store, results: &Results, report: &Report) -> Result<(), Failure> {
    let longest = results.effort.cascade_period;
    let meaning = format!(
        "damping ratios between which the cycle of that period is stable: all its multipliers lie inside the unit \
         circle; doublings up to {longest}T of reaction-force, occupied, and up to 8T of the others"
    );
    let rows = report.regimes.iter().map(|r| {
        vec![
            r.law.into(),
            r.reference.into(),
            r.frequency_ratio.into(),
            r.base_hz.into(),
            Value::from(r.period as u32),
            r.from.into(),
            r.from_is.clone().into(),
            r.to.into(),
            r.to_is.clone().into(),
        ]
    });
    folder.table(
        "regimes.csv",
        &[("from, to", meaning.as_str())],
        &header(&[
            "law",
            "reference",
            "frequency_ratio",
            "base_hz",
            "period",
            "from",
            "from_is",
            "to",
            "to_is",
        ]),
        rows,
    )
}

/// What the motions of Fig. 2 have come to, held against the stable cycles.
fn sweeps(folder: &mut dyn Store, results: &Results) -> Result<(), Failure> {
    let rows = panels(results).flat_map(|(diagram, panel)| {
        diagram.rows.iter().map(|row| {
            let (cycle, repeats) = match Diagram::met(row, &panel.stretches) {
                Met::Cycle(period) => (Some(period as u32), None),
                Met::Slow(period) => (None, Some(period as u32)),
                Met::Other => (None, None),
            };
            vec![
                diagram.ratio.into(),
                pass_name(&diagram.passes[row.pass]).into(),
                row.value.into(),
                cycle.into(),
                repeats.into(),
            ]
        })
    });
    folder.table(
        "sweeps.csv",
        &[
            (
                "cycle",
                "period of the stable cycle that the motion is on, to 0.05 eta; empty: on none",
            ),
            (
                "slow",
                "periods after which a motion on no stable cycle repeats to 1e-3 eta: one that is still on its way",
            ),
        ],
        &header(&["frequency_ratio", "pass", "damping_ratio", "cycle", "slow"]),
        rows,
    )
}

/// What the motions of Fig. 2 have come to, counted.
pub(super) fn came_to(results: &Results) -> String {
    let met = panels(results).flat_map(|(diagram, panel)| {
        let met = |row| Diagram::met(row, &panel.stretches);
        diagram.rows.iter().map(met)
    });
    let (mut all, mut on, mut slow) = (0, 0, 0);
    for met in met {
        all += 1;
        on += u32::from(matches!(met, Met::Cycle(_)));
        slow += u32::from(matches!(met, Met::Slow(_)));
    }
    format!(
        "of {all} motions {on} are on a stable cycle and {slow} on a slow way to one (they repeat, but no such cycle is \
         stable there), as they are beside a bifurcation"
    )
}

/// The diagrams of the paper's law under the occupied reading, with what is behind them.
pub(super) fn panels(results: &Results) -> impl Iterator<Item = (&Diagram, &PanelBranches)> {
    let all = results.diagrams.iter().zip(&results.branches);
    all.filter(|(_, panel)| panel.detail.is_some())
}

fn pass_name(pass: &Pass) -> String {
    match pass {
        Pass::Up => "up".to_owned(),
        Pass::Down => "down".to_owned(),
        Pass::Start { z, v } => format!("start {z} {v}"),
    }
}

/// The samples of Fig. 2 in the paper's law and the occupied reading.
fn fig2(folder: &mut dyn Store, results: &Results) -> Result<(), Failure> {
    for (tag, (diagram, _)) in ["a", "b", "c"].into_iter().zip(panels(results)) {
        let rows = diagram.rows.iter().flat_map(|row| {
            let pass = pass_name(&diagram.passes[row.pass]);
            let z = row.z.first().map_or(&[][..], Vec::as_slice);
            z.iter()
                .map(move |&z| vec![pass.clone().into(), row.value.into(), z.into()])
        });
        let hertz = diagram.hertz.to_string();
        let settings = [
            ("base_hz", hertz.as_str()),
            ("transient_periods", &results.effort.transient.to_string()),
            (
                "z_eta",
                "height over eta = g/omega_h^2 at cos(Omega t) = 1, period by period",
            ),
        ];
        folder.table(
            &format!("fig2{tag}.csv"),
            &settings,
            &header(&["pass", "damping_ratio", "z_eta"]),
            rows,
        )?;
    }
    Ok(())
}

/// The Poincare points of Fig. 3.
fn fig3(folder: &mut dyn Store, results: &Results) -> Result<(), Failure> {
    let rows = results.cases.iter().flat_map(|result| {
        let case = result.case;
        result.trajectory.section.iter().map(move |s| {
            vec![
                Value::from(case.tag.to_string()),
                case.ratio.into(),
                case.damping_ratio.into(),
                s.z[0].into(),
                s.v[0].into(),
            ]
        })
    });
    folder.table(
        "fig3.csv",
        &[("v", "velocity over eta omega_h")],
        &header(&["panel", "frequency_ratio", "damping_ratio", "z_eta", "v"]),
        rows,
    )
}

/// Full against condensed, motion by motion.
fn inertia(folder: &mut dyn Store, results: &Results) -> Result<(), Failure> {
    let rows = results.inertia.rows.iter().map(|row| {
        vec![
            Value::from(row.ratio),
            row.damping_ratio.into(),
            row.difference.into(),
            row.contact_ratio.0.into(),
            row.contact_ratio.1.into(),
        ]
    });
    folder.table(
        "full-condensed.csv",
        &[(
            "difference_eta",
            "largest difference of the sections; empty where they are not both periodic",
        )],
        &header(&[
            "frequency_ratio",
            "damping_ratio",
            "difference_eta",
            "contact_ratio_full",
            "contact_ratio_condensed",
        ]),
        rows,
    )
}
