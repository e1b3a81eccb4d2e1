//! The figures of a run: phase portrait and time history of each jumper.

use super::{Run, flights};
use crate::failure::Failure;
use crate::per_jumper::{PANELS, panel_title};
use crate::portrait::{self, Motion};
use crate::store::Store;
use crate::words::setting;
use saltus_results::{Axis, Curves, Figure, History, Panel};

pub(super) fn write(folder: &mut dyn Store, run: &Run) -> Result<(), Failure> {
    if run.jumpers() == 0 {
        return folder.figure("section", &amplitudes(run));
    }
    folder.figure("portrait", &portraits(run))?;
    folder.figure("history", &histories(run))
}

/// What the time history covers; less than a period of it counts as one.
fn covered(run: &Run) -> String {
    let points = run.trajectory.history.time.len();
    match points.div_ceil(super::POINTS as usize) {
        1 => "last period".to_owned(),
        periods => format!("last {periods} periods"),
    }
}

fn portraits(run: &Run) -> Figure {
    let section = &run.trajectory.section;
    let first = run.transient() + 1;
    let motion = Motion {
        title: format!(
            "Phase portrait: {}, {}",
            setting(&run.study, &run.model),
            covered(run)
        ),
        states: &run.trajectory.history.states,
        section: section.get(run.transient()..).unwrap_or_default(),
        seen: format!("At cos Ωt = 1, periods {first} to {}", section.len()),
    };
    portrait::portraits(&motion, run.jumpers())
}

fn histories(run: &Run) -> Figure {
    let title = format!(
        "Time history: {}, {}",
        setting(&run.study, &run.model),
        covered(run)
    );
    let shown = run.jumpers().min(PANELS);
    let mut panels: Vec<Panel> = Vec::new();
    for jumper in 0..shown {
        panels.extend([force(run, jumper), heights(run, jumper)]);
    }
    Figure::grid(1, panels).title(title).plot_size(820.0, 230.0)
}

fn history(run: &Run, jumper: usize, y: &str) -> History {
    let from = run.trajectory.history.time.first().copied();
    History::new(
        panel_title(jumper, run.jumpers()),
        Axis::new("Time t (s)"),
        Axis::new(y),
    )
    .shade("Flight", &flights::of(run, jumper, from.unwrap_or(0.0)))
}

fn force(run: &Run, jumper: usize) -> Panel {
    let history_of = &run.trajectory.history;
    let force: Vec<f64> = history_of.states.iter().map(|s| s.prf[jumper]).collect();
    history(run, jumper, "Reaction force/weight (-)")
        .curve("Plate reaction force", &history_of.time[..], force)
        .level("Body weight", 1.0)
        .into()
}

fn heights(run: &Run, jumper: usize) -> Panel {
    let eta = run.model.scales().jumpers[jumper].position;
    let history_of = &run.trajectory.history;
    let states = &history_of.states;
    let body: Vec<f64> = states.iter().map(|s| s.z[jumper] * eta).collect();
    let floor: Vec<f64> = states.iter().map(|s| s.floor[jumper]).collect();
    history(run, jumper, "Height (m)")
        // the legend is common, so the colour of the force means the force
        .curve("", [], [])
        .curve("Body z", &history_of.time[..], body)
        .curve("Floor under the feet", &history_of.time[..], floor)
        .into()
}

/// The empty plate has no body to follow: its amplitudes, once per period.
fn amplitudes(run: &Run) -> Figure {
    let skipped = run.transient();
    let section = &run.trajectory.section;
    let kept = section.get(skipped..).unwrap_or_default();
    let periods: Vec<f64> = (1..=kept.len()).map(|i| (skipped + i) as f64).collect();
    let curves = Curves::new(
        format!(
            "Empty plate, once per forcing period: {}",
            setting(&run.study, &run.model)
        ),
        Axis::new("Forcing period (-)"),
        Axis::new("Amplitude r/h (-)"),
    );
    let terms = run
        .model
        .setup()
        .plate
        .modes
        .w
        .iter()
        .take(PANELS)
        .enumerate();
    let curves = terms.fold(curves, |curves, (j, term)| {
        let values: Vec<f64> = kept.iter().map(|point| point.w[j]).collect();
        curves.line(
            format!("Term ({}, {})", term.m, term.n),
            &periods[..],
            values,
        )
    });
    Figure::new(curves)
}
