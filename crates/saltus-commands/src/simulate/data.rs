//! Data of the answer, described once.

use super::Found;
use crate::data::{about, base, eta, motion, padded, whole};
use crate::quantities as q;
use crate::status;
use saltus::model::EnergyBalance;
use saltus_results::{Dataset, Quantity, Table};

pub(super) fn data(found: &Found) -> Dataset {
    let trajectory = &found.trajectory;
    let (end, omega) = (&trajectory.end, found.model.scales().omega);
    let set = about("Motion of people on a vibrating plate", &found.study)
        .attribute(q::STATUS.name, end.status.name())
        .attribute(q::STATUS_TEXT.name, status::text(&end.status, Some(omega)))
        .variable(q::PERIODS_RUN.is(whole(end.periods)))
        .variable(q::STEPS.is(whole(end.steps)));
    let set = motion::dimensions(base(set, &found.model), &found.model)
        .variable(q::ETA.over(&["jumper"], eta(&found.study, None)));
    let set = energy(jumpers(section(set, found), found), found);
    let set = motion::history(set, &trajectory.history, &found.model);
    motion::switches(set, &trajectory.switches)
}

fn section(set: Dataset, found: &Found) -> Dataset {
    let section = &found.trajectory.section;
    let times = (0..section.len()).map(|index| found.section_time(index));
    let points: Vec<_> = section.iter().map(Some).collect();
    let set = set
        .coordinate(q::SECTION_PERIOD.numbered(1, section.len()))
        .variable(q::SECTION_TIME.over(&["period"], times.collect::<Vec<f64>>()));
    let set = motion::section(set, "", &["period"], &found.model, &points);
    let table = Table::new("section", &["period"]).columns(&["period"]);
    let table = table.titled("time_s", "time");
    set.table(motion::columns(table, "", &found.model))
}

/// Contact and reaction of each person, in each period and behind the transient.
fn jumpers(set: Dataset, found: &Found) -> Dataset {
    let trajectory = &found.trajectory;
    let each = trajectory.contact_ratio.iter();
    let each = each.take(trajectory.section.len()).flatten().copied();
    set.variable(q::PERIOD_CONTACT_RATIO.over(&["period", "jumper"], each.collect::<Vec<f64>>()))
        .variable(q::MEAN_CONTACT_RATIO.over(&["jumper"], found.contact_ratio()))
        .variable(q::PEAK_REACTION.over(&["jumper"], found.peak_reaction()))
        .table(Table::of_document(&[
            "eta",
            "mean_contact_ratio",
            "peak_reaction",
        ]))
}

type Part = fn(&EnergyBalance) -> f64;

/// stored = base + gravity - plate - legs + residual
const ENERGY: [(Quantity, Part); 7] = [
    (q::ENERGY_BASE, |e| e.base),
    (q::ENERGY_GRAVITY, |e| e.gravity),
    (q::ENERGY_PLATE, |e| e.plate),
    (q::ENERGY_LEGS, |e| e.legs),
    (q::ENERGY_DAMPERS, |e| e.dampers),
    (q::ENERGY_STORED, |e| e.stored),
    (q::ENERGY_RESIDUAL, |e| e.residual),
];

fn energy(set: Dataset, found: &Found) -> Dataset {
    let (all, periods) = (&found.trajectory.energy, found.trajectory.section.len());
    let largest = found.largest();
    let set = set
        .variable(q::ENERGY_MAX_RESIDUAL.is(largest.residual))
        .variable(q::ENERGY_MAX_TURNOVER.is(largest.turnover))
        .variable(q::ENERGY_MAX_RELATIVE_RESIDUAL.is(largest.relative()));
    let part = |set: Dataset, (quantity, of): (Quantity, Part)| {
        let parts: Vec<f64> = all.iter().map(of).collect();
        let parts: Vec<f64> = padded(&parts, periods).collect();
        set.variable(quantity.over(&["period"], parts))
    };
    let set = ENERGY.into_iter().fold(set, part);
    let titled = |table: Table, (quantity, _): (Quantity, Part)| {
        table.titled(quantity.name.trim_start_matches("energy_"), quantity.name)
    };
    let table = Table::new("energy", &["period"]).columns(&["period"]);
    let table = ENERGY.into_iter().fold(table, titled);
    set.table(table.only_where("energy_residual"))
}

/// Largest numbers in the balance of energy of any period (J).
pub(super) struct Largest {
    pub(super) residual: f64,
    pub(super) turnover: f64,
}

impl Largest {
    /// Residual over turnover; 0 if nothing moved.
    pub(super) fn relative(&self) -> f64 {
        if self.turnover > 0.0 {
            self.residual / self.turnover
        } else {
            0.0
        }
    }
}

impl Found {
    pub(super) fn largest(&self) -> Largest {
        let periods = &self.trajectory.energy;
        let largest = |of: Part| periods.iter().map(of).fold(0.0, f64::max);
        Largest {
            residual: largest(|e| e.residual.abs()),
            turnover: largest(|e| {
                let parts = [e.base, e.gravity, e.plate, e.legs, e.stored];
                parts.iter().map(|part| part.abs()).sum()
            }),
        }
    }

    /// Part of the time on the floor of each person, the mean over the periods behind the transient.
    pub(super) fn contact_ratio(&self) -> Vec<f64> {
        let ratios = &self.trajectory.contact_ratio;
        let kept = ratios.get(self.transient()..).unwrap_or_default();
        let mean = |i| kept.iter().map(|period| period[i]).sum::<f64>() / kept.len() as f64;
        (0..self.jumpers()).map(mean).collect()
    }

    /// Largest in the time history of each person; NaN if the run ended before it.
    pub(super) fn peak_reaction(&self) -> Vec<f64> {
        let peaks = &self.trajectory.peak_reaction;
        let peak = |i: usize| peaks.get(i).copied().unwrap_or(f64::NAN);
        (0..self.jumpers()).map(peak).collect()
    }
}
