//! The tables of an orbit.

use super::Run;
use super::report::Report;
use crate::failure::Failure;
use crate::motion;
use crate::store::Store;
use saltus_results::Value;

pub(super) fn write(folder: &mut dyn Store, run: &Run, report: &Report) -> Result<(), Failure> {
    let (base, period) = (
        format!("{:?}", report.base_hz),
        format!("{}", report.period),
    );
    let note = |more: &[(&'static str, &'static str)]| {
        let mut settings = vec![
            ("saltus", env!("CARGO_PKG_VERSION")),
            ("study", "study.toml"),
            ("base motion (Hz)", base.as_str()),
            ("forcing periods", period.as_str()),
        ];
        settings.extend(more);
        settings
    };
    let mut header = vec!["point".to_owned()];
    header.extend(motion::header(&run.model));
    let points = run.portrait.section.iter().enumerate();
    let rows = points.map(|(index, point)| {
        let mut row = vec![Value::Integer(index as i64)];
        row.extend(motion::cells(point));
        row
    });
    folder.table("section.csv", &note(&motion::COLUMNS), &header, rows)?;

    let header = ["re", "im", "modulus", "error"].map(str::to_owned);
    let rows = report.multipliers.iter().zip(&report.multiplier_errors);
    let rows =
        rows.map(|(&[re, im], &error)| [re, im, re.hypot(im), error].map(Value::from).to_vec());
    folder.table("multipliers.csv", &note(&[]), &header, rows)?;

    motion::write_switches(folder, &report.switches, &note(&[]))
}
