//! The time that a question is expected to take, told before it is asked.
//!
//! The work is counted in forcing periods (each command says how many, as a [`Part`]), and a probe of each part shows
//! how many there are to a second on this machine, with its threads and whatever else runs on it. The probe runs copies,
//! so that the answer has the same bits with and without it.

mod pace;

use crate::context::RunContext;
use crate::request::Request;
use pace::pace;
use saltus::hybrid::{Options, Point, System};
use saltus::model::{Model, ModelError};
use saltus_config::{Inertia, Study};
use serde::Serialize;
use std::fmt;
use std::time::Instant;

/// Trajectories that a thread runs side by side.
pub(crate) const LANES: usize = 8;

/// The time that a question is expected to take.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// Name of the command.
    pub command: &'static str,
    /// Expected time (s).
    pub seconds: f64,
    /// Threads it counts on.
    pub threads: usize,
    /// Forcing periods of all trajectories, about (-).
    pub periods: f64,
    /// Those that the probe ran (-).
    pub probed: u64,
    /// The other words of `plate.inertia` that are faster, each with its expected time (s); of long work only.
    pub others: Vec<(Inertia, f64)>,
}

impl Estimate {
    /// From here on work is long (s): whoever waits should know before.
    pub const LONG: f64 = 60.0;

    /// The same of one of `of` equal shares.
    #[must_use]
    pub fn share(mut self, of: u32) -> Self {
        let of = f64::from(of.max(1));
        self.seconds /= of;
        self.periods /= of;
        self.others.iter_mut().for_each(|other| other.1 /= of);
        self
    }

    /// Whether it takes more than a minute.
    pub fn is_long(&self) -> bool {
        self.seconds > Self::LONG
    }
}

/// One line: what, how long, from which probe, and what it would be with another inertia.
impl fmt::Display for Estimate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let threads = match self.threads {
            1 => "1 thread".to_owned(),
            more => format!("{more} threads"),
        };
        let (command, time) = (self.command, duration(self.seconds));
        let (probed, periods) = (self.probed, self.periods);
        write!(
            f,
            "{command}: about {time} on {threads} (probe of {probed} of {periods:.1e} forcing periods)"
        )?;
        for (place, (inertia, seconds)) in self.others.iter().enumerate() {
            let word = serde_json::to_value(inertia).unwrap_or_default();
            let time = duration(*seconds);
            match place {
                0 => write!(f, "; plate.inertia = {word} would take about {time}")?,
                _ => write!(f, ", {word} {time}")?,
            }
        }
        Ok(())
    }
}

/// Seconds, minutes, hours or days, to two digits.
fn duration(seconds: f64) -> String {
    let units = [
        (100.0, 1.0, "s"),
        (7200.0, 60.0, "minutes"),
        (172_800.0, 3600.0, "hours"),
    ];
    let fits = units.into_iter().find(|&(most, ..)| seconds <= most);
    let (_, unit, name) = fits.unwrap_or((f64::INFINITY, 86_400.0, "days"));
    let count = seconds / unit;
    // the digits below are not known
    let step = 10_f64.powf(count.max(1.0).log10().floor() - 1.0).max(1.0);
    format!("{} {name}", ((count / step).round() * step).max(1.0))
}

/// Work of one kind within a question.
#[derive(Clone)]
pub(crate) struct Part {
    /// Trajectories that run side by side, with their tangent columns; of many, as many as there is room for.
    pub(crate) starts: Vec<(System, Point)>,
    /// Forcing periods of all trajectories, about.
    pub(crate) periods: f64,
}

impl Part {
    /// Of trajectories with so many tangent columns.
    pub(crate) fn new(
        starts: impl IntoIterator<Item = (Model, Point)>,
        columns: usize,
        periods: f64,
    ) -> Result<Self, ModelError> {
        let wide = |(model, start): (Model, Point)| {
            let system = model.system();
            if columns == 0 {
                return Ok((system.clone(), start));
            }
            let system = system.with_tangents(columns)?;
            let start = system.point(&start.modes, &start.x[..model.free_states()]);
            Ok((system, start))
        };
        let starts = starts
            .into_iter()
            .map(wide)
            .collect::<Result<_, ModelError>>()?;
        Ok(Self { starts, periods })
    }

    /// Of `count` trajectories, each `periods` long: of some of them, from all over their range, as many as `threads` run
    /// side by side.
    pub(crate) fn spread(
        count: usize,
        threads: usize,
        columns: usize,
        periods: f64,
        start_at: impl Fn(usize) -> Result<(Model, Point), ModelError>,
    ) -> Result<Self, ModelError> {
        let abreast = count.min(LANES * threads).max(1);
        let mut starts: Vec<(Model, Point)> = Vec::new();
        for i in 0..abreast {
            // one without a model costs nothing
            let Ok(start) = start_at(i * count / abreast) else {
                continue;
            };
            let first = starts.first().map_or(&start, |first| first);
            if start.0.system().same_structure(first.0.system()) {
                starts.push(start);
            }
        }
        Self::new(starts, columns, count as f64 * periods)
    }
}

/// Finding of a probe of a part.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pace {
    /// Forcing periods run.
    pub(crate) probed: u64,
    /// Time they took (s).
    pub(crate) seconds: f64,
}

impl Request {
    /// The time that [`Self::ask`] is expected to take, from a probe of at most a hundredth of the work, or of about a second
    /// if that is more. `None` if nothing can be said: the question makes no sense, was stopped, or has no work worth counting
    /// (`frequencies`, `orbit`). It is a guess within a factor of two or three, since nobody knows beforehand when motions
    /// settle; of `continue`, where the number of orbits is guessed too, hardly more than an order of magnitude.
    pub fn estimate(&self, study: &Study, context: &RunContext) -> Option<Estimate> {
        self.estimate_by(study, context, &mut |part, options| {
            let begun = Instant::now();
            pace(part, options, context, &|| begun.elapsed().as_secs_f64())
        })
    }

    /// As [`Self::estimate`] by any probe.
    pub(crate) fn estimate_by(
        &self,
        study: &Study,
        context: &RunContext,
        probe: &mut dyn FnMut(&Part, &Options) -> Option<Pace>,
    ) -> Option<Estimate> {
        let threads = match context.threads {
            0 => std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
            given => given,
        };
        let mut expected = |study: &Study| {
            let mut sum = (0.0, 0.0, 0);
            for part in self.parts(study, threads).ok()? {
                let pace = probe(&part, &study.options())?;
                let seconds = part.periods * pace.seconds / pace.probed as f64;
                sum = (sum.0 + seconds, sum.1 + part.periods, sum.2 + pace.probed);
            }
            (sum.2 > 0).then_some(sum)
        };
        let (seconds, periods, probed) = expected(study)?;
        let mut estimate = Estimate {
            command: self.name(),
            seconds,
            threads,
            periods,
            probed,
            others: Vec::new(),
        };
        let chosen = !matches!(self, Self::Reproduce { .. });
        if estimate.is_long() && chosen {
            for inertia in [Inertia::Full, Inertia::SlowManifold, Inertia::Condensed] {
                let mut other = study.clone();
                if std::mem::replace(&mut other.plate.inertia, inertia) != inertia {
                    let found = expected(&other).map(|found| (inertia, found.0));
                    let faster = found.filter(|other| other.1 < 0.8 * estimate.seconds);
                    estimate.others.extend(faster);
                }
            }
        }
        Some(estimate)
    }
}

#[cfg(test)]
mod tests {
    use super::{Estimate, Pace, duration, pace::pace};
    use crate::context::RunContext;
    use crate::request::Request;
    use saltus_config::{Inertia, Study};
    use std::sync::atomic::{AtomicU64, Ordering};

    fn requests() -> [Request; 8] {
        [
            Request::Simulate,
            Request::Sweep,
            Request::Map,
            Request::Basins { matched: false },
            Request::Lyapunov,
            Request::Attractors,
            Request::Continue {
                origin: None,
                over: None,
            },
            Request::Reproduce { quick: true },
        ]
    }

    fn study() -> Study {
        let mut study = Study::paper();
        study.plate.inertia = Inertia::Condensed;
        study
    }

    /// With a probe that says that a period takes so many seconds.
    fn estimate(request: &Request, study: &Study, seconds: f64) -> Option<Estimate> {
        request.estimate_by(study, &RunContext::default(), &mut |part, _| {
            assert!(!part.starts.is_empty() && part.periods > 0.0);
            let probed = 4;
            Some(Pace {
                probed,
                seconds: seconds * probed as f64,
            })
        })
    }

    #[test]
    fn time_is_proportional_to_the_work_and_to_its_pace() {
        for request in requests() {
            let found = estimate(&request, &study(), 1e-9).expect("it has work");
            assert_eq!(found.command, request.name());
            assert!(!found.is_long() && found.others.is_empty(), "{found}");
            assert!((found.seconds / found.periods / 1e-9 - 1.0).abs() < 1e-9);
            let slow = estimate(&request, &study(), 1.0).expect("it has work");
            assert!(slow.is_long());
            // at the same pace no other is faster
            assert!(slow.others.is_empty(), "{slow}");
        }
        let map = estimate(&Request::Map, &study(), 1.0).expect("it has work");
        // 64 x 64 pixels, half of 400 + 64 periods and a fourth of 2000 + 500
        assert_eq!(map.periods, 4096.0 * (232.0 + 625.0));
    }

    #[test]
    fn what_has_no_work_or_no_model_has_no_estimate() {
        assert_eq!(estimate(&Request::Frequencies, &study(), 1.0), None);
        let mut none = study();
        none.map = None;
        assert_eq!(estimate(&Request::Map, &none, 1.0), None);
        let sets = ["plate.modes=4x4".to_owned()];
        let large = saltus_config::parse("large", &saltus_config::paper_template(), &sets);
        let large = large.expect("it is a study");
        assert_eq!(estimate(&Request::Simulate, &large, 1.0), None);
    }

    #[test]
    fn a_line_says_what_how_long_and_what_else() {
        let found = Estimate {
            command: "map",
            seconds: 847.0,
            threads: 2,
            periods: 1.9e6,
            probed: 300,
            others: vec![(Inertia::SlowManifold, 35.2), (Inertia::Condensed, 8.9)],
        };
        assert_eq!(
            found.to_string(),
            "map: about 14 minutes on 2 threads (probe of 300 of 1.9e6 forcing periods); \
             plate.inertia = \"slow-manifold\" would take about 35 s, \"condensed\" 9 s"
        );
        for (seconds, text) in [
            (0.01, "1 s"),
            (60.0, "60 s"),
            (90.0, "90 s"),
            (100.1, "2 minutes"),
            (4000.0, "67 minutes"),
            (10_000.0, "3 hours"),
            (1e6, "12 days"),
            (1e9, "12000 days"),
        ] {
            assert_eq!(duration(seconds), text);
        }
    }

    #[test]
    fn a_probe_ends_after_a_hundredth_of_short_work_and_goes_on_where_it_looks_long() {
        let context = RunContext {
            threads: 1,
            ..RunContext::default()
        };
        let mut long = study();
        long.simulate.periods = 10_000;
        let options = long.options();
        let parts = Request::Simulate.parts(&long, 1).expect("it has a model");
        // (what the clock gains whenever it is read, periods run)
        for (tick, periods) in [(0.0, 100), (1e-6, 100), (0.1, 4)] {
            let reads = AtomicU64::new(0);
            let clock = || reads.fetch_add(1, Ordering::Relaxed) as f64 * tick;
            let found = pace(&parts[0], &options, &context, &clock).expect("it runs");
            assert_eq!(found.probed, periods, "{tick}");
        }
        context.stop.store(true, Ordering::SeqCst);
        assert!(pace(&parts[0], &options, &context, &|| 0.0).is_none());
    }
}
