//! The figures of a run: phase portrait and time history of each jumper.

use super::{Found, flights};
use crate::answer::Take;
use crate::failure::CommandError;
use crate::per_jumper::{PANELS, page, panel_title};
use crate::portrait::{self, Motion};
use crate::words::setting;
use saltus_results::{Axis, Curves, Figure, History, Panel};

pub(super) fn draw(found: &Found, take: Take) -> Result<(), CommandError> {
    if found.jumpers() == 0 {
        return take("section", &amplitudes(found));
    }
    take("portrait", &portraits(found))?;
    if found.jumpers() <= FEW {
        return take("history", &histories(found, &[force, heights]));
    }
    take("history", &histories(found, &[force]))?;
    take("heights", &histories(found, &[heights]))
}

/// People whose forces and heights stand in one figure.
const FEW: usize = 3;
/// Periods shown of each where the panels are small.
const FEW_PERIODS: f64 = 6.0;

/// Periods from the beginning of the time history on, begun ones too.
fn periods(found: &Found) -> usize {
    let (times, table) = (&found.trajectory.history.time, &found.study.simulate);
    if table.times.is_none() {
        return times.len().div_ceil(table.samples_per_period as usize);
    }
    let begun = |first: &f64| (first / found.model.scales().period()).floor() as usize;
    let all = found.trajectory.section.len();
    times
        .first()
        .map_or(0, |first| all.saturating_sub(begun(first)))
}

fn covered(found: &Found) -> String {
    if found.study.simulate.times.is_some() {
        return format!("{} times", found.trajectory.history.time.len());
    }
    match periods(found) {
        1 => "last period".to_owned(),
        periods => format!("last {periods} periods"),
    }
}

fn portraits(found: &Found) -> Figure {
    let section = found.trajectory.section.get(found.transient()..);
    let section = section.unwrap_or_default();
    let (before, section) = section.split_at(section.len().saturating_sub(periods(found)));
    let motion = Motion {
        title: format!(
            "Phase portrait: {}, {}",
            setting(&found.study, &found.model),
            covered(found)
        ),
        states: &found.trajectory.history.states,
        section,
        before,
    };
    portrait::portraits(&motion, found.jumpers())
}

fn histories(found: &Found, kinds: &[fn(&Found, usize) -> Panel]) -> Figure {
    let title = format!(
        "Time history: {}, {}",
        setting(&found.study, &found.model),
        covered(found)
    );
    let shown = found.jumpers().min(PANELS);
    let panels = (0..shown).flat_map(|jumper| kinds.iter().map(move |panel| panel(found, jumper)));
    let figure = match found.jumpers() {
        ..=FEW => Figure::grid(1, panels).plot_size(820.0, 230.0),
        _ => page(1, panels.collect()),
    };
    figure.title(title)
}

fn history(found: &Found, jumper: usize, y: &str) -> History {
    let times = &found.trajectory.history.time;
    let from = times.first().copied();
    let mut axis = Axis::new("Time $t$ (s)");
    if let (true, Some(&last)) = (found.jumpers() > FEW, times.last()) {
        let period = std::f64::consts::TAU / found.model.scales().omega;
        axis = axis.range(last - FEW_PERIODS * period, last);
    }
    History::new(panel_title(jumper, found.jumpers()), axis, Axis::new(y))
        .shade("Flight", &flights::of(found, jumper, from.unwrap_or(0.0)))
}

fn force(found: &Found, jumper: usize) -> Panel {
    let history_of = &found.trajectory.history;
    let force: Vec<f64> = history_of.states.iter().map(|s| s.prf[jumper]).collect();
    history(found, jumper, "Reaction force/weight")
        .curve("Plate reaction force", &history_of.time[..], force)
        .level("Body weight", 1.0)
        .into()
}

fn heights(found: &Found, jumper: usize) -> Panel {
    let eta = found.model.scales().jumpers[jumper].position;
    let history_of = &found.trajectory.history;
    let states = &history_of.states;
    let body: Vec<f64> = states.iter().map(|s| s.z[jumper] * eta).collect();
    let floor: Vec<f64> = states.iter().map(|s| s.floor[jumper]).collect();
    history(found, jumper, "Height (m)")
        // the legend is common, so the colour of the force means the force
        .curve("", [], [])
        .curve("Body $z$", &history_of.time[..], body)
        .curve("Floor under the feet", &history_of.time[..], floor)
        .into()
}

/// The empty plate has no body to follow: its amplitudes, once per period.
fn amplitudes(found: &Found) -> Figure {
    let skipped = found.transient();
    let section = &found.trajectory.section;
    let kept = section.get(skipped..).unwrap_or_default();
    let periods: Vec<f64> = (1..=kept.len()).map(|i| (skipped + i) as f64).collect();
    let curves = Curves::new(
        format!(
            "Empty plate, once per forcing period: {}",
            setting(&found.study, &found.model)
        ),
        Axis::new("Forcing period"),
        Axis::new("Amplitude $r/h$"),
    );
    let terms = found
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
