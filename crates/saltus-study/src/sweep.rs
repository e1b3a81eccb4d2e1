//! The brute-force bifurcation diagram: for each value of a parameter, let transients die, then keep
//! the stroboscopic samples.

use saltus_hybrid::{End, Point, Sample, Segment, Status, Task, integrate_groups};

use crate::subject::Subject;
use crate::{Control, Outcome};

/// One way through the values; `A` is a start as people give it.
#[derive(Clone, Debug, PartialEq)]
pub enum Pass<A> {
    /// Upwards, the state carried on from value to value.
    Up,
    /// Downwards, the state carried on.
    Down,
    /// Each value anew from this start.
    Start(A),
}

/// A sweep through `values` (ascending).
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep<A> {
    /// Values of the parameter, ascending.
    pub values: Vec<f64>,
    /// The passes to make.
    pub passes: Vec<Pass<A>>,
    /// First start of the up and down passes.
    pub start: A,
    /// Periods before anything is kept.
    pub transient: u64,
    /// Periods kept.
    pub record: u64,
}

impl<A> Sweep<A> {
    /// Periods to run in all, for a progress display.
    pub fn periods(&self) -> u64 {
        (self.values.len() * self.passes.len()) as u64 * (self.transient + self.record)
    }
}

/// `count` values from `from` to `to`, both included.
pub fn linspace(from: f64, to: f64, count: usize) -> Vec<f64> {
    let last = count.saturating_sub(1).max(1) as f64;
    (0..count)
        .map(|i| from + (to - from) * i as f64 / last)
        .collect()
}

/// Samples and status at one value in one pass.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepRow<E> {
    /// Index of the pass in [`Sweep::passes`].
    pub pass: usize,
    /// Value of the parameter.
    pub value: f64,
    /// The section at the kept samples, channel by channel: `section[channel][sample]`.
    pub section: Vec<Vec<f64>>,
    /// Part of the kept time that each contact was closed.
    pub contact_ratio: Vec<f64>,
    /// End of the run, or the model's error.
    pub status: Result<Status, E>,
    /// Last state, to go on from; `None` without a model.
    pub end: Option<Point>,
}

/// Runs the sweep; one row per pass and value, pass by pass, values ascending within each.
///
/// A value without a model, or a trajectory that ends early, is a row that says so. A pass that
/// carries its state goes on from the pass's first start after such a row.
///
/// # Errors
/// [`StudyError::Integrate`](crate::StudyError::Integrate) for options out of range or when stopped.
pub fn sweep<S, F>(
    sweep: &Sweep<S::Start>,
    model_at: F,
    control: &Control,
) -> Outcome<Vec<SweepRow<S::NoModel>>, S>
where
    S: Subject,
    F: Fn(f64) -> Result<S, S::NoModel> + Sync,
{
    Ok(sweep_many(&[(sweep.clone(), &model_at)], control)?.remove(0))
}

/// Several sweeps at once, so that their chains share the lanes.
///
/// # Errors
/// As [`sweep`].
pub fn sweep_many<S, F>(
    sweeps: &[(Sweep<S::Start>, F)],
    control: &Control,
) -> Outcome<Vec<Vec<SweepRow<S::NoModel>>>, S>
where
    S: Subject,
    F: Fn(f64) -> Result<S, S::NoModel> + Sync,
{
    let mut tasks = Vec::new();
    for (sweep_index, (sweep, model_at)) in sweeps.iter().enumerate() {
        for (pass, way) in sweep.passes.iter().enumerate() {
            let mut values: Vec<(usize, f64)> = sweep.values.iter().copied().enumerate().collect();
            let task = |values, start: &S::Start| Chain {
                sweep_index,
                pass,
                values,
                next: 0,
                start: start.clone(),
                transient: sweep.transient,
                record: sweep.record,
                model_at,
                control,
                current: None,
                rows: Vec::new(),
            };
            match way {
                Pass::Up => tasks.push(task(values, &sweep.start)),
                Pass::Down => {
                    values.reverse();
                    tasks.push(task(values, &sweep.start));
                }
                Pass::Start(start) => {
                    tasks.extend(values.into_iter().map(|value| task(vec![value], start)));
                }
            }
        }
    }
    // The longest first: chains are sequential and would otherwise end last.
    tasks.sort_by_key(|task| std::cmp::Reverse(task.values.len()));
    let group_of = groups(sweeps);
    let mut grouped: Vec<Vec<_>> = Vec::new();
    for task in tasks {
        let group = group_of[task.sweep_index];
        grouped.resize_with(grouped.len().max(group + 1), Vec::new);
        grouped[group].push(task);
    }
    let ended = integrate_groups(&control.options, grouped, control.threads, &control.stop)?;
    let ended = ended.into_iter().flatten();
    let mut rows: Vec<Vec<(usize, SweepRow<S::NoModel>)>> = vec![Vec::new(); sweeps.len()];
    for chain in ended {
        rows[chain.sweep_index].extend(chain.rows);
    }
    for rows in &mut rows {
        rows.sort_by_key(|(index, row)| (row.pass, *index));
    }
    Ok(rows
        .into_iter()
        .map(|rows| rows.into_iter().map(|(_, row)| row).collect())
        .collect())
}

/// Groups of sweeps that share a structure, so that they can share lanes: a group number for each.
fn groups<S, F>(sweeps: &[(Sweep<S::Start>, F)]) -> Vec<usize>
where
    S: Subject,
    F: Fn(f64) -> Result<S, S::NoModel> + Sync,
{
    let mut known: Vec<Option<S>> = Vec::new();
    let first = |(sweep, model_at): &(Sweep<S::Start>, F)| {
        sweep.values.iter().find_map(|&v| model_at(v).ok())
    };
    let mut group = |model: Option<S>| {
        let same = |other: &Option<S>| match (&model, other) {
            (Some(a), Some(b)) => a.system().same_structure(b.system()),
            _ => false,
        };
        known.iter().position(same).unwrap_or_else(|| {
            known.push(model.clone());
            known.len() - 1
        })
    };
    sweeps.iter().map(|sweep| group(first(sweep))).collect()
}

/// One pass with carried state, or one restart.
struct Chain<'a, S: Subject, F> {
    sweep_index: usize,
    pass: usize,
    values: Vec<(usize, f64)>,
    next: usize,
    start: S::Start,
    transient: u64,
    record: u64,
    model_at: &'a F,
    control: &'a Control,
    current: Option<Current<S>>,
    rows: Vec<(usize, SweepRow<S::NoModel>)>,
}

/// The value being run.
struct Current<S: Subject> {
    index: usize,
    model: S,
    row: SweepRow<S::NoModel>,
    closed: Vec<f64>,
}

impl<S, F> Chain<'_, S, F>
where
    S: Subject,
    F: Fn(f64) -> Result<S, S::NoModel> + Sync,
{
    /// The next value that has a model, from the carried state if there is one.
    fn advance(&mut self, mut carried: Option<(S, Point)>) -> Option<Segment> {
        while let Some(&(index, value)) = self.values.get(self.next) {
            self.next += 1;
            let mut row = SweepRow {
                pass: self.pass,
                value,
                section: Vec::new(),
                contact_ratio: Vec::new(),
                status: Ok(Status::Completed),
                end: None,
            };
            let stable = |model: S| model.check(&self.control.options).map(|()| model);
            match (self.model_at)(value).and_then(stable) {
                Err(error) => {
                    row.status = Err(error);
                    self.rows.push((index, row));
                    carried = None;
                }
                Ok(mut model) => {
                    let start = match &carried {
                        Some((previous, point)) => {
                            model.share(previous.system());
                            model.carry(previous, point)
                        }
                        None => model.start(&self.start),
                    };
                    let room = || Vec::with_capacity(self.record as usize);
                    row.section = (0..model.channels()).map(|_| room()).collect();
                    let segment = Segment {
                        system: model.system().clone(),
                        start,
                        periods: self.transient + self.record,
                    };
                    let closed = vec![0.0; model.contacts()];
                    self.current = Some(Current {
                        index,
                        model,
                        row,
                        closed,
                    });
                    return Some(segment);
                }
            }
        }
        None
    }
}

impl<S, F> Task for Chain<'_, S, F>
where
    S: Subject,
    F: Fn(f64) -> Result<S, S::NoModel> + Sync,
{
    fn begin(&mut self) -> Option<Segment> {
        self.advance(None)
    }

    fn sample(&mut self, sample: &Sample<'_>) -> bool {
        self.control.count_period();
        if let Some(current) = self
            .current
            .as_mut()
            .filter(|_| sample.period > self.transient)
        {
            let model = &current.model;
            for (channel, samples) in current.row.section.iter_mut().enumerate() {
                samples.push(model.channel(channel, sample.x));
            }
            for (contact, time) in current.closed.iter_mut().enumerate() {
                *time += model.contact_time(contact, sample.dwell);
            }
        }
        true
    }

    fn end(&mut self, end: End) -> Option<Segment> {
        let Current {
            index,
            model,
            mut row,
            closed,
        } = self.current.take()?;
        let kept = end.periods.saturating_sub(self.transient) as f64 * model.system().period();
        row.contact_ratio = closed.iter().map(|time| time / kept).collect();
        row.status = Ok(end.status);
        row.end = Some(end.point.clone());
        self.rows.push((index, row));
        let carried = (end.status == Status::Completed).then_some((model, end.point));
        self.advance(carried)
    }
}
