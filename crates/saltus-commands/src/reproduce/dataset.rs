//! The clouds of Fig. 2 as a dataset for xarray and its like.

use super::Results;
use crate::dataset::motion::HEIGHT;
use crate::dataset::{about, coordinate, name, numbered, padded, texts, variable};
use crate::failure::Failure;
use saltus::physics::{ContactLaw, FrequencyReference};
use saltus::study::Pass;
use saltus_config::{Parameter, Study};
use saltus_paper::Diagram;
use saltus_results::{Dataset, Variable};

/// The panels in the paper's law and the occupied reading.
pub(super) fn fig2(results: &Results) -> Result<Dataset, Failure> {
    let shown = |d: &&Diagram| {
        d.law == ContactLaw::ReactionForce && d.reference == FrequencyReference::Occupied
    };
    let panels: Vec<&Diagram> = results.diagrams.iter().filter(shown).collect();
    let damping = Parameter::parse("jumper.damping_ratio")?;
    let (passes, rows) = panels
        .first()
        .map_or((&[][..], &[][..]), |panel| (&panel.passes, &panel.rows));
    let values = rows.iter().filter(|row| row.pass == 0).map(|row| row.value);
    let values: Vec<f64> = values.collect();
    let record = results.effort.record as usize;
    let heights = panels.iter().flat_map(|panel| &panel.rows).flat_map(|row| {
        let samples = row.z.first().map_or(&[][..], Vec::as_slice);
        padded(samples, record)
    });
    let heights: Vec<f64> = heights.collect();
    let start = |part: fn((f64, f64)) -> f64| -> Vec<f64> {
        let of = |pass: &Pass| match *pass {
            Pass::Start { z, v } => part((z, v)),
            Pass::Up | Pass::Down => f64::NAN,
        };
        passes.iter().map(of).collect()
    };
    let directions = passes.iter().map(|pass| match pass {
        Pass::Up => "up",
        Pass::Down => "down",
        Pass::Start { .. } => "start",
    });
    let hertz: Vec<f64> = panels.iter().map(|panel| panel.hertz).collect();
    let tags = texts(["a", "b", "c"].into_iter().take(panels.len()));
    let over = ["panel", "pass", &name(&damping), "sample"];
    let anew = "where it begins anew at each value";
    Ok(about("Fig. 2 of Dias & Del Prado", &Study::paper())
        .attribute("coordinates", "base_frequency direction start_z start_v")
        .coordinate(Variable::coordinate("panel", tags).long_name("Panel of the figure"))
        .coordinate(numbered("pass", 0, passes.len(), "Way through the values"))
        .coordinate(coordinate(&damping, &values))
        .coordinate(numbered(
            "sample",
            1,
            record,
            "Forcing period of the record",
        ))
        .variable(variable(
            "base_frequency",
            &over[..1],
            hertz,
            ("Frequency of the base motion", "Hz"),
        ))
        .variable(crate::dataset::words(
            "direction",
            &over[1..2],
            &["up", "down", "start"],
            directions,
            "Up and down carry the state on; start begins anew at each value",
        ))
        .variable(variable(
            "start_z",
            &over[1..2],
            start(|s| s.0),
            (&format!("First height over eta, {anew}"), "1"),
        ))
        .variable(variable(
            "start_v",
            &over[1..2],
            start(|s| s.1),
            (&format!("First velocity over eta omega_h, {anew}"), "1"),
        ))
        .variable(variable("z", &over, heights, HEIGHT)))
}
