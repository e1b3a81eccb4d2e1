//! Going on from many states at once until transients have died.

use saltus_hybrid::{End, Point, Sample, Segment, Status, Task, integrate_all};

use crate::subject::Subject;
use crate::{Control, Outcome};

/// A motion after its transient.
#[derive(Clone, Debug, PartialEq)]
pub struct Settled {
    /// The section at the kept samples, channel by channel: `section[channel][sample]`.
    pub section: Vec<Vec<f64>>,
    /// Last state.
    pub end: Point,
    /// Status at the end.
    pub status: Status,
}

/// Runs each (model, start) for `transient` periods and keeps the `record` after that.
///
/// # Errors
/// [`StudyError::Integrate`](crate::StudyError::Integrate) for options out of range, models of different structure, or when stopped.
pub fn settle<S: Subject>(
    starts: &[(S, Point)],
    transient: u64,
    record: u64,
    control: &Control,
) -> Outcome<Vec<Settled>, S> {
    let task = |(model, start): &(S, Point)| Run {
        segment: Some(Segment {
            system: model.system().clone(),
            start: start.clone(),
            periods: transient + record,
        }),
        model: model.clone(),
        control,
        transient,
        out: Settled {
            section: vec![Vec::new(); model.channels()],
            end: start.clone(),
            status: Status::Completed,
        },
    };
    let tasks = starts.iter().map(task).collect();
    let ended = integrate_all(&control.options, tasks, control.threads, &control.stop)?;
    Ok(ended.into_iter().map(|run| run.out).collect())
}

struct Run<'a, S> {
    segment: Option<Segment>,
    model: S,
    control: &'a Control,
    transient: u64,
    out: Settled,
}

impl<S: Subject> Task for Run<'_, S> {
    fn begin(&mut self) -> Option<Segment> {
        self.segment.take()
    }

    fn sample(&mut self, sample: &Sample<'_>) -> bool {
        self.control.count_period();
        if sample.period > self.transient {
            for (channel, samples) in self.out.section.iter_mut().enumerate() {
                samples.push(self.model.channel(channel, sample.x));
            }
        }
        true
    }

    fn end(&mut self, end: End) -> Option<Segment> {
        self.out.end = end.point;
        self.out.status = end.status;
        None
    }
}
