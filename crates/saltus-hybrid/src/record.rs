//! A record of one trajectory: every sample and every switch.

use std::sync::atomic::AtomicBool;

use crate::run::integrate;
use crate::system::Point;
use crate::task::{End, IntegrateError, Options, Sample, Segment, Switch, SwitchKind, Task};

/// A switch in a [`Recording`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecordedSwitch {
    /// Time since the start of the run.
    pub time: f64,
    /// Unit that switched.
    pub unit: usize,
    /// Mode change or tangency.
    pub kind: SwitchKind,
}

/// A trajectory without its dense output.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// State at the end of each period.
    pub samples: Vec<Point>,
    /// Switches and tangencies in time order.
    pub switches: Vec<RecordedSwitch>,
    /// Its end.
    pub end: End,
}

struct Recorder {
    segment: Option<Segment>,
    period: f64,
    samples: Vec<Point>,
    switches: Vec<RecordedSwitch>,
    end: Option<End>,
}

impl Task for Recorder {
    fn begin(&mut self) -> Option<Segment> {
        self.segment.take()
    }
    fn sample(&mut self, sample: &Sample<'_>) -> bool {
        self.samples.push(Point {
            modes: sample.modes.to_vec(),
            x: sample.x.to_vec(),
        });
        true
    }
    fn switch(&mut self, switch: &Switch<'_>) {
        let time = switch.period as f64 * self.period + switch.time;
        self.switches.push(RecordedSwitch {
            time,
            unit: switch.unit,
            kind: switch.kind,
        });
    }
    fn end(&mut self, end: End) -> Option<Segment> {
        self.end = Some(end);
        None
    }
}

/// Runs one segment and keeps its samples and switches.
///
/// # Errors
/// As [`integrate`].
///
/// ```
/// use saltus_hybrid::{Segment, Options, Status, record, testing};
/// let ball = testing::bouncing_ball(9.81, 0.8, 10.0);
/// let start = ball.point(&[0], &[1.0, 0.0]);
/// let run = record(&Segment { system: ball, start, periods: 1 }, &Options::default())?;
/// // Infinitely many bounces in finite time: the run reports that and stops.
/// assert!(matches!(run.end.status, Status::Chattering { .. }));
/// # Ok::<(), saltus_hybrid::IntegrateError>(())
/// ```
pub fn record(segment: &Segment, options: &Options) -> Result<Recording, IntegrateError> {
    let recorder = Recorder {
        period: segment.system.period(),
        segment: Some(segment.clone()),
        samples: Vec::new(),
        switches: Vec::new(),
        end: None,
    };
    let mut out = None;
    integrate(options, [recorder], &AtomicBool::new(false), |task| {
        out = Some(task);
    })?;
    let task = out.ok_or(IntegrateError::Interrupted)?;
    let end = task.end.ok_or(IntegrateError::Interrupted)?;
    Ok(Recording {
        samples: task.samples,
        switches: task.switches,
        end,
    })
}
