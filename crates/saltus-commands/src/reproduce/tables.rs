//! The numbers behind the figures as CSV.

use saltus::physics::{ContactLaw, FrequencyReference};
use saltus::study::Pass;
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
    regimes(folder, report)?;
    fig2(folder, results)?;
    fig3(folder, results)?;
    inertia(folder, results)
}

/// Stretches of equal period along the sweeps of every diagram.
fn regimes(folder: &mut dyn Store, report: &Report) -> Result<(), Failure> {
    let rows = report.regimes.iter().map(|r| {
        vec![
            r.law.into(),
            r.reference.into(),
            r.frequency_ratio.into(),
            r.base_hz.into(),
            r.sweep.into(),
            r.period.into(),
            r.from.into(),
            r.to.into(),
        ]
    });
    folder.table(
        "regimes.csv",
        &[(
            "period",
            "forcing periods after which the kept samples repeat to 1e-3 eta; empty: they do not",
        )],
        &header(&[
            "law",
            "reference",
            "frequency_ratio",
            "base_hz",
            "sweep",
            "period",
            "from",
            "to",
        ]),
        rows,
    )
}

/// The samples of Fig. 2 in the paper's law and the occupied reading.
fn fig2(folder: &mut dyn Store, results: &Results) -> Result<(), Failure> {
    let shown = |d: &&saltus::study::paper::Diagram| {
        d.law == ContactLaw::ReactionForce && d.reference == FrequencyReference::Occupied
    };
    for (tag, diagram) in ["a", "b", "c"]
        .into_iter()
        .zip(results.diagrams.iter().filter(shown))
    {
        let name = |pass: &Pass| match pass {
            Pass::Up => "up".to_owned(),
            Pass::Down => "down".to_owned(),
            Pass::Start { z, v } => format!("start {z} {v}"),
        };
        let rows = diagram.rows.iter().flat_map(|row| {
            let pass = name(&diagram.passes[row.pass]);
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
