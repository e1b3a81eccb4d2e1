//! The description of a study, and warnings of what is legal but probably not meant.

use crate::failure::CommandError;
use crate::words::short;
use saltus::physics::BaseFrequency;
use saltus_config::{AxisTable, SecondTable, Study};
use serde::Serialize;
use std::fmt::Write;

/// Legal, but probably not meant.
pub fn warnings(study: &Study) -> Vec<String> {
    let impossible = study.setup().check().err();
    let plate = study.plate();
    let unmoved = |&(_, jumper): &(usize, &saltus::physics::Jumper)| plate.on_nodal_lines(jumper);
    let jumpers = study.jumpers();
    let alone = jumpers.iter().enumerate().filter(unmoved).map(|(i, _)| {
        format!("jumper.{i} stands on a nodal line of every mode: plate and jumper cannot feel each other")
    });
    let plane = |name, axes: [&AxisTable; 2]| {
        let mut refused = axes
            .into_iter()
            .filter_map(|axis| study.set(&axis.parameter, axis.from()).err());
        refused
            .next()
            .map(|error| format!("[{name}] cannot run: {error}"))
    };
    let map = study.map.iter().filter_map(|t| plane("map", [&t.x, &t.y]));
    let basins = study
        .basins
        .iter()
        .filter_map(|t| plane("basins", [&t.x, &t.y]));
    let sweep = study.sweep.iter().filter_map(|sweep| {
        let refused = study.set(&sweep.parameter, sweep.axis().from()).err()?;
        Some(format!("[sweep] cannot run: {refused}"))
    });
    let branches = study.continuation.iter().filter_map(|table| {
        let refused = table.start(study).err()?;
        Some(format!("[continue] cannot run: {refused}"))
    });
    let attractors = study.attractors.sweep().into_iter().filter_map(|axis| {
        let refused = study.set(&axis.parameter, axis.from()).err()?;
        Some(format!("[attractors] cannot run: {refused}"))
    });
    let impossible = impossible.iter().map(ToString::to_string);
    impossible
        .chain(alone)
        .chain(sweep)
        .chain(map)
        .chain(basins)
        .chain(branches)
        .chain(attractors)
        .collect()
}

/// Description of a study and its questions, line by line.
///
/// # Errors
/// [`CommandError::Computation`] if the frequency of the base cannot be computed.
pub fn describe(study: &Study) -> Result<String, CommandError> {
    let plate = study.plate();
    let mut text = String::new();
    let mut line = |name: &str, what: String| {
        // writing to a string cannot fail
        let _ = writeln!(text, "  {name:<11}{what}");
    };
    line(
        "plate",
        format!(
            "{} x {} x {} m, {} u + {} v + {} w terms, {} inertia",
            short(plate.length),
            short(plate.width),
            short(plate.thickness),
            plate.modes.u.len(),
            plate.modes.v.len(),
            plate.modes.w.len(),
            word(&study.plate.inertia),
        ),
    );
    for jumper in study.jumpers() {
        line(
            "jumper",
            format!(
                "{} kg at ({}, {}) m, {} N/m, damping ratio {}",
                short(jumper.mass),
                short(jumper.x),
                short(jumper.y),
                short(jumper.stiffness),
                short(jumper.damping_ratio)
            ),
        );
    }
    line("contact", study.contact_law().name().to_owned());
    line("base", base(study)?);
    line("solver", word(&study.solver.method));
    for (name, question) in questions(study) {
        line(name, question);
    }
    for warning in warnings(study) {
        line("warning", warning);
    }
    Ok(text)
}

/// Questions, table by table.
fn questions(study: &Study) -> Vec<(&'static str, String)> {
    let range = |name: &str, from, to| format!("{name} from {} to {}", short(from), short(to));
    let axis = |a: &AxisTable| range(&a.parameter, a.from(), a.to());
    let plane = |x: &AxisTable, y: &AxisTable| {
        let pixels = format!("{} x {} pixels", x.count(), y.count());
        format!("{} by {}, {pixels}", axis(x), axis(y))
    };
    let sweep = study.sweep.as_ref().map(|t| {
        let values = axis(&t.axis());
        format!(
            "{values}, {} values, {}",
            t.axis().count(),
            word(&t.direction)
        )
    });
    let map = study.map.as_ref().map(|t| plane(&t.x, &t.y));
    let basins = study.basins.as_ref().map(|t| plane(&t.x, &t.y));
    let branches = study.continuation.as_ref().map(|t| {
        let curves = |s: &SecondTable| format!(", curves by {}", range(&s.parameter, s.from, s.to));
        let curves = t.second.as_ref().map_or_else(String::new, curves);
        range(&t.parameter, t.from, t.to) + &curves
    });
    let attractors = study.attractors.sweep().map(|a| {
        let starts = study.attractors.starts;
        format!("{}, {} values, {starts} starts", axis(&a), a.count())
    });
    let asked = [
        ("sweep", sweep),
        ("map", map),
        ("basins", basins),
        ("continue", branches),
        ("attractors", attractors),
    ];
    let asked = asked.into_iter();
    asked
        .filter_map(|(name, what)| Some((name, what?)))
        .collect()
}

fn base(study: &Study) -> Result<String, CommandError> {
    let base = study.base();
    let omega = base
        .omega(&study.plate(), &study.jumpers())
        .map_err(CommandError::computation)?;
    let hertz = omega / std::f64::consts::TAU;
    let reading = match base.frequency {
        BaseFrequency::Hertz(_) => String::new(),
        BaseFrequency::Ratio { ratio, reference } => {
            format!(" ({} x the {} frequency)", short(ratio), reference.name())
        }
    };
    let amplitude = short(base.amplitude);
    Ok(format!("{amplitude} m at {hertz:.4} Hz{reading}"))
}

/// A choice as the study file spells it.
fn word(choice: &impl Serialize) -> String {
    match serde_json::to_value(choice) {
        Ok(serde_json::Value::String(word)) => word,
        _ => String::new(),
    }
}
