//! Going on from many states at once until transients have died.

use saltus_hybrid::{End, Point, Sample, Segment, Status, Task, integrate_all};

use super::{Control, StudyError};
use crate::model::Model;

/// A motion after its transient.
#[derive(Clone, Debug, PartialEq)]
pub struct Settled {
    /// z/eta of the first body at the kept samples.
    pub z: Vec<f64>,
    /// z'/(eta omega_h) of the first body.
    pub v: Vec<f64>,
    /// Last state.
    pub end: Point,
    /// Status at the end.
    pub status: Status,
}

/// Runs each (model, start) for `transient` periods and keeps the `record` after that.
///
/// # Errors
/// [`StudyError::Integrate`] for options out of range, models of different structure, or when stopped.
pub fn settle(
    starts: &[(Model, Point)],
    transient: u64,
    record: u64,
    control: &Control,
) -> Result<Vec<Settled>, StudyError> {
    let task = |(model, start): &(Model, Point)| Run {
        segment: Some(Segment {
            system: model.system().clone(),
            start: start.clone(),
            periods: transient + record,
        }),
        model: model.clone(),
        control,
        transient,
        out: Settled {
            z: Vec::new(),
            v: Vec::new(),
            end: start.clone(),
            status: Status::Completed,
        },
    };
    let tasks = starts.iter().map(task).collect();
    let ended = integrate_all(&control.options, tasks, control.threads, &control.stop)?;
    Ok(ended.into_iter().map(|run| run.out).collect())
}

struct Run<'a> {
    segment: Option<Segment>,
    model: Model,
    control: &'a Control,
    transient: u64,
    out: Settled,
}

impl Task for Run<'_> {
    fn begin(&mut self) -> Option<Segment> {
        self.segment.take()
    }

    fn sample(&mut self, sample: &Sample<'_>) -> bool {
        self.control.count_period();
        if sample.period > self.transient && !sample.modes.is_empty() {
            self.out.z.push(self.model.z(0, sample.x));
            self.out.v.push(self.model.v(0, sample.x));
        }
        true
    }

    fn end(&mut self, end: End) -> Option<Segment> {
        self.out.end = end.point;
        self.out.status = end.status;
        None
    }
}
