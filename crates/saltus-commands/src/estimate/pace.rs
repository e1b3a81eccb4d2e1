//! The probe: the trajectories of a part, for a moment.

use super::{Estimate, Pace, Part};
use crate::context::RunContext;
use saltus::hybrid::{End, Options, Point, Sample, Segment, System, Task, integrate_all};
use std::sync::atomic::{AtomicU64, Ordering};

/// A probe of long work takes so many seconds, and the longest allowed, for models of which a period takes longer.
const ENOUGH: f64 = 0.3;
const LONGEST: f64 = 1.0;

/// Periods of each trajectory that a probe is long enough with, in that time.
const EACH: u64 = 4;

/// Runs the trajectories of `part` until their pace is known; `clock` gives the seconds since the begin.
pub(super) fn pace(
    part: &Part,
    options: &Options,
    context: &RunContext,
    clock: &(dyn Fn() -> f64 + Sync),
) -> Option<Pace> {
    let done = AtomicU64::new(0);
    let enough = || {
        let (n, t) = (done.fetch_add(1, Ordering::Relaxed) + 1, clock());
        let short = t * part.periods < Estimate::LONG * n as f64;
        let each = n >= EACH * part.starts.len() as u64;
        (short && n as f64 * 100.0 >= part.periods) || (t >= ENOUGH && each) || t >= LONGEST
    };
    let starts = part.starts.iter();
    let tasks = starts.map(|(system, start)| Run {
        system,
        start,
        enough: &enough,
    });
    integrate_all(options, tasks.collect(), context.threads, &context.stop).ok()?;
    let pace = Pace {
        probed: done.load(Ordering::Relaxed),
        seconds: clock(),
    };
    (pace.probed > 0).then_some(pace)
}

/// One trajectory. Its columns begin anew in each period, so that they neither vanish nor grow beyond all bounds.
struct Run<'a, F> {
    system: &'a System,
    start: &'a Point,
    enough: &'a F,
}

impl<F: Fn() -> bool + Sync> Task for Run<'_, F> {
    fn begin(&mut self) -> Option<Segment> {
        let mut start = self.start.clone();
        self.tangents(self.system.columns_mut(&mut start.x));
        Some(Segment {
            system: self.system.clone(),
            start,
            periods: u64::MAX,
        })
    }

    fn sample(&mut self, _: &Sample<'_>) -> bool {
        !(self.enough)()
    }

    fn tangents(&mut self, columns: &mut [f64]) {
        let states = self.system.declared_len();
        for (i, column) in columns.chunks_mut(states.max(1)).enumerate() {
            column.fill(0.0);
            column[i % states] = 1.0;
        }
    }

    fn end(&mut self, _: End) -> Option<Segment> {
        None
    }
}
