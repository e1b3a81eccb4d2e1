//! The tables of a run.

use super::Run;
use super::report::{Report, phase};
use crate::exit::Failure;
use crate::folder::Folder;
use crate::per_jumper::column;
use saltus_results::Value;

pub(super) fn write(folder: &mut Folder, run: &Run, report: &Report) -> Result<(), Failure> {
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
    section(folder, run, &note(&BODY))?;
    history(folder, run, &note(&BODY))?;
    switches(folder, report, &note(&[]))?;
    energy(folder, run, &note(&ENERGY))
}

const BODY: [(&str, &str); 6] = [
    ("z", "height over eta = g/omega_h^2 (-)"),
    ("v", "velocity over eta omega_h (-)"),
    ("phase", "contact or flight"),
    ("w_m_n", "plate amplitude over thickness h, term (m, n) (-)"),
    ("prf", "plate reaction force over body weight (-)"),
    ("floor", "height of the plate under the feet (m)"),
];

const ENERGY: [(&str, &str); 1] = [(
    "balance of each period (J)",
    "stored = base + gravity - plate - legs + residual; dampers is a part of legs",
)];

fn section(
    folder: &mut Folder,
    run: &Run,
    settings: &[(&'static str, &str)],
) -> Result<(), Failure> {
    let jumpers = run.jumpers();
    let mut header = vec!["period".to_owned(), "time_s".to_owned()];
    for i in 0..jumpers {
        header.extend(["z", "v", "phase"].map(|name| column(name, i, jumpers)));
    }
    let plate = &run.model.setup().plate;
    header.extend(plate.modes.w.iter().map(|w| format!("w_{}_{}", w.m, w.n)));
    let row = |(index, point): (usize, &saltus::model::Section)| {
        let mut row: Vec<Value> = vec![
            Value::Integer(index as i64 + 1),
            run.section_time(index).into(),
        ];
        for i in 0..jumpers {
            row.extend([
                point.z[i].into(),
                point.v[i].into(),
                phase(point.phase[i]).into(),
            ]);
        }
        row.extend(point.w.iter().copied().map(Value::from));
        row
    };
    let rows = run.trajectory.section.iter().enumerate().map(row);
    folder.table("section.csv", settings, &header, rows)
}

fn history(
    folder: &mut Folder,
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

fn switches(
    folder: &mut Folder,
    report: &Report,
    settings: &[(&'static str, &str)],
) -> Result<(), Failure> {
    let header = ["time_s", "jumper", "kind"].map(str::to_owned);
    let rows = report.switches.iter().map(|switch| {
        vec![
            switch.time.into(),
            Value::Integer(switch.jumper as i64),
            switch.kind.into(),
        ]
    });
    folder.table("switches.csv", settings, &header, rows)
}

fn energy(
    folder: &mut Folder,
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
