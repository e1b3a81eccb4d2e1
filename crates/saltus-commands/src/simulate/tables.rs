//! The tables of a run.

use super::Run;
use super::report::Report;
use crate::failure::Failure;
use crate::motion;
use crate::per_jumper::column;
use crate::store::Store;
use saltus_results::Value;

pub(super) fn write(folder: &mut dyn Store, run: &Run, report: &Report) -> Result<(), Failure> {
    let (base, status) = (format!("{:?}", report.base_hz), report.status_text.as_str());
    let note = |more: &[(&'static str, &'static str)]| {
        let mut settings = vec![
            ("saltus", env!("CARGO_PKG_VERSION")),
            ("study", "study.toml"),
            ("base motion (Hz)", base.as_str()),
            ("status", status),
        ];
        settings.extend(more);
        settings
    };
    section(folder, run, &note(&motion::COLUMNS))?;
    history(folder, run, &note(&HISTORY))?;
    motion::write_switches(folder, &report.switches, &note(&[]))?;
    energy(folder, run, &note(&ENERGY))
}

const HISTORY: [(&str, &str); 4] = [
    motion::COLUMNS[0],
    motion::COLUMNS[1],
    ("prf", "plate reaction force over body weight (-)"),
    ("floor", "height of the plate under the feet (m)"),
];

const ENERGY: [(&str, &str); 1] = [(
    "balance of each period (J)",
    "stored = base + gravity - plate - legs + residual; dampers is a part of legs",
)];

fn section(
    folder: &mut dyn Store,
    run: &Run,
    settings: &[(&'static str, &str)],
) -> Result<(), Failure> {
    let mut header = vec!["period".to_owned(), "time_s".to_owned()];
    header.extend(motion::header(&run.model));
    let row = |(index, point): (usize, &saltus::model::Section)| {
        let period = Value::Integer(index as i64 + 1);
        let mut row = vec![period, run.section_time(index).into()];
        row.extend(motion::cells(point));
        row
    };
    let rows = run.trajectory.section.iter().enumerate().map(row);
    folder.table("section.csv", settings, &header, rows)
}

fn history(
    folder: &mut dyn Store,
    run: &Run,
    settings: &[(&'static str, &str)],
) -> Result<(), Failure> {
    let jumpers = run.jumpers();
    let mut header = vec!["time_s".to_owned()];
    for i in 0..jumpers {
        header.extend(["z", "v", "prf", "floor_m"].map(|name| column(name, i, jumpers)));
    }
    let history = &run.trajectory.history;
    let rows = history
        .time
        .iter()
        .zip(&history.states)
        .map(|(&time, seen)| {
            let mut row = vec![Value::from(time)];
            for i in 0..jumpers {
                row.extend([seen.z[i], seen.v[i], seen.prf[i], seen.floor[i]].map(Value::from));
            }
            row
        });
    folder.table("history.csv", settings, &header, rows)
}

fn energy(
    folder: &mut dyn Store,
    run: &Run,
    settings: &[(&'static str, &str)],
) -> Result<(), Failure> {
    let header = [
        "period", "base", "gravity", "plate", "legs", "dampers", "stored", "residual",
    ];
    let rows = run.trajectory.energy.iter().enumerate().map(|(index, e)| {
        let parts = [
            e.base, e.gravity, e.plate, e.legs, e.dampers, e.stored, e.residual,
        ];
        let mut row = vec![Value::Integer(index as i64 + 1)];
        row.extend(parts.map(Value::from));
        row
    });
    folder.table("energy.csv", settings, &header.map(str::to_owned), rows)
}
